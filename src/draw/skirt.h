/// Outlines of meshes, and the skirts that hang there: strips a pixel wide that stick out of the surface and fade. They soften outlines, those of
/// a leg before another too, without multisampling. Private to the stage's files of draw/.
#ifndef DRAW_SKIRT_H
#define DRAW_SKIRT_H

#include "draw/morph_looks.h"
#include "draw/painter.h"
#include <stdbool.h>
#include <stdint.h>

// Where a mesh's outlines are as the eye sees them, and where its skirt goes.

/// A mesh as it stands.
struct skirt_mesh {
    const uint32_t *indices;
    const int *neighbours; ///< model/adjacency.h
    const float (*place)[3];
    bool *front;   ///< of each triangle, whether it faces the eye: skirt_face() says
    bool mirrored; ///< triangles are clockwise seen from outside
};

/// Says which triangles face the eye, of the indices first … end − 1.
void skirt_face(const struct skirt_mesh *mesh, int first, int end, const float eye[3]);

/// Of the edges from the corners first … end − 1 the first where what is seen ends: where it turns away from the eye, and where the mesh
/// ends. `end` where there is none.
int skirt_next(const struct skirt_mesh *mesh, int first, int end, bool both_sides);

/// How far the skirt sticks out at both ends of the edge from a corner: a pixel, across the line of sight. `normal` are the skin's there.
/// `pixel` is metres a pixel at a distance of 1 m.
void skirt_out(const struct skirt_mesh *mesh, int corner, const float normal[2][3], const float eye[3], float pixel,
               float out[2][3]);

// Draws skirts, and surfaces that come as they stand.

/// What a skirt shows at a vertex of its mesh.
struct skirt_vertex {
    float place[3], normal[3]; ///< world
    float color[4];            ///< linear, with opacity
    float uv[2], phase[2];     ///< as stage_mesh.frag has them
    float cover;               ///< 1 on the surface, 0 a pixel off it
};

struct stage_skirt {
    GLuint program, vertex_array, buffer, indices, white;
    struct painter_uniforms shared;
    struct {
        GLint shade, line, cutoff, blended, both_sides, base;
    } at;
    struct skirt_vertex *vertices;
    struct {
        GLuint program;
        GLint shade, line;
        struct painter_uniforms shared;
    } plain; ///< for surfaces alone
};

/// False with a sentence; then there is nothing to free.
bool stage_skirt_create(struct stage_skirt *skirt, struct error *error);
void stage_skirt_destroy(struct stage_skirt *skirt);

/// Uses its program, whose uniforms `at` the caller sets; a white picture, opaque, and the unit for others until stage_skirt_leave().
void stage_skirt_use(const struct stage_skirt *skirt, const struct stage_view *view, float seam);

void stage_skirt_leave(void);

/// Uses a program for surfaces of which nothing is left out, has a picture or is seen through: its pixels are cheaper. `shade` as in
/// stage_skirt.vert, `line` as in stage_mesh.frag.
void stage_plain_use(const struct stage_skirt *skirt, const struct stage_view *view, const float shade[2],
                     float line);

/// Says all but place and cover of a vertex.
typedef void skirt_look(const void *context, uint32_t vertex, struct skirt_vertex *out);

/// Draws the skirt of the triangles from index `first` to `end`.
void stage_skirt_draw(const struct stage_skirt *skirt, const struct skirt_mesh *mesh, int first, int end,
                      bool both_sides, const float eye[3], float seam, skirt_look *look, const void *context);

// Surfaces that come as they stand.

/// What a vertex looks like: its colour, linear, with opacity; its place in a picture; and its phase, as in stage_mesh.frag. A coat's are as
/// stage_skirt.vert has them.
struct surface_look {
    float color[4], uv[2], phase[2];
};

struct stage_surface {
    GLuint vertex_array;  ///< without indices
    GLuint moving, looks; ///< all places, then all normals; what vertices look like
    int count;            ///< vertices
};

void stage_surface_create(struct stage_surface *surface, int count, const struct surface_look *looks);
void stage_surface_free(struct stage_surface *surface);

/// Both return the bytes.
long stage_surface_move(const struct stage_surface *surface, const float (*place)[3], const float (*normal)[3]);
long stage_surface_show(const struct stage_surface *surface, const struct surface_look *looks);

// The outlines of soft characters.

/// What of a figure's outlines is kept, and how it stands.
struct morph_skirt {
    uint32_t *sorted
        [2]; ///< of the fine and of the coarse triangles, as morph_looks_sort() has them; NULL: as the figure has them
    int *neighbours[2];
    float (*place)[3], (*normal)[3]; ///< of each vertex
    bool *front;                     ///< of each triangle
};

/// `sorted` are set, and stay its own.
void morph_skirt_create(struct morph_skirt *skirt, const struct figure *figure, const struct morph_looks *looks);
void morph_skirt_free(struct morph_skirt *skirt);

/// The figure as it stands, its fine or its coarse triangles; and how many indices these are.
struct skirt_mesh morph_skirt_mesh(const struct morph_skirt *skirt, const struct figure *figure, bool coarse);
int morph_skirt_count(const struct figure *figure, bool coarse);

#endif

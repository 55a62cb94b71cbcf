/// Draws the skirts (draw/skirt.h) of what the GPU moves: soft and imported characters. Private to the stage's files of draw/.
#ifndef DRAW_STAGE_SKIRT_H
#define DRAW_STAGE_SKIRT_H

#include "draw/painter.h"
#include "draw/skirt.h"

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
        GLint shade, line, cutoff, blended;
    } at;
    struct skirt_vertex *vertices;
};

/// False with a sentence; then there is nothing to free.
bool stage_skirt_create(struct stage_skirt *skirt, struct error *error);
void stage_skirt_destroy(struct stage_skirt *skirt);

/// Uses its program, whose uniforms `at` the caller sets; a white picture, opaque, and the unit for others until stage_skirt_leave().
void stage_skirt_use(const struct stage_skirt *skirt, const struct stage_view *view, float seam);

void stage_skirt_leave(void);

/// Says all but place and cover of a vertex.
typedef void skirt_look(const void *context, uint32_t vertex, struct skirt_vertex *out);

/// Draws the skirt of the triangles from index `first` to `end`.
void stage_skirt_draw(const struct stage_skirt *skirt, const struct skirt_mesh *mesh, int first, int end,
                      bool both_sides, const float eye[3], float seam, skirt_look *look, const void *context);

#endif

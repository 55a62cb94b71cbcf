/// Imported characters, foxes and soft characters as one kind of thing: triangles that stand in the world, posed once a frame on the CPU, and
/// their skirts: strips a pixel wide that stick out of outlines and fade. They soften outlines, those of a leg before another too, without
/// multisampling. Private to the stage's files of draw/.
#ifndef DRAW_POSED_H
#define DRAW_POSED_H

#include "draw/stage.h"
#include <stdbool.h>
#include <stdint.h>

/// What a vertex looks like: its colour, linear, with opacity; its place in a picture; and its phase, as in stage_mesh.frag. Of a coat they
/// mean what is said there too.
struct posed_look {
    float color[4], uv[2], phase[2], cover; ///< the last: 1 on the surface, 0 a pixel off it
};

/// Triangles of one material, one after the other.
struct posed_part {
    int first, end;             ///< indices
    int vertex;                 ///< the first of its own
    int node;                   ///< of the file, that shows it
    bool mirrored;              ///< as it stands, triangles are clockwise seen from outside
    enum stage_program program; ///< that draws its surface
    int material;               ///< −1: none
    float base[4];              ///< the material's colour, linear, with opacity
    float cutoff;               ///< opacity below which nothing is drawn; 0: all is
    bool blended, both_sides;
    GLuint picture, sampler; ///< 0: none
};

/// All zero is none.
struct posed {
    uint32_t *indices;
    int *neighbours; ///< model/adjacency.h
    float (*place)[3], (*normal)[3];
    struct posed_look *looks;
    bool *front; ///< of each triangle, whether it faces the eye
    struct posed_part *parts;
    int vertex_count, index_count, part_count;
    int map_coordinate, map_axis; ///< whose phases a soft character's colours show, and
    uint64_t map_version;         ///< of the figure in them
    // On the GPU.
    GLuint vertex_array, index_buffer;
    GLuint moving_buffer, look_buffer; ///< all places, then all normals; looks of vertices
    GLuint *pictures, *samplers;
    int picture_count, sampler_count;
};

/// All nodes' meshes, one after the other. Nothing where they are too many: a small file can claim any number of triangles.
void posed_from_gltf(struct posed *mesh, const struct gltf *gltf);
/// The fine or the coarse triangles, sorted by material if that is to be seen.
void posed_from_figure(struct posed *mesh, const struct figure *figure, bool coarse);
void posed_free(struct posed *mesh);

/// Both move all vertices, and mark the triangles that face the eye. They allocate nothing.
void posed_pose_gltf(struct posed *mesh, const struct stage_model *shown, const float eye[3]);
void posed_pose_figure(struct posed *mesh, const struct stage_character *shown, const float eye[3]);

/// Says which triangles face the eye.
void posed_face(struct posed *mesh, const float eye[3]);

/// Shows its own colours or its phases; false where it does so already.
bool posed_map_figure(struct posed *mesh, const struct stage_character *shown);

// Skirts.

/// A corner of a skirt.
struct skirt_vertex {
    float place[3], normal[3]; ///< world
    struct posed_look look;
};

enum { SKIRT_CORNERS = 4 }; ///< of an edge

/// From the corner `from` on, the first edge of a part where its visible surface ends: it turns away from the eye, or the mesh
/// ends. The part's end where there is none.
int skirt_next(const struct posed *mesh, const struct posed_part *part, int from);

/// The strip at the edge from a corner: along the edge, and back a pixel off it. `seam` is metres a pixel at a distance of 1 m.
void skirt_hang(const struct posed *mesh, const struct posed_part *part, int corner, const float eye[3], float seam,
                struct skirt_vertex out[SKIRT_CORNERS]);

// On the GPU.

/// All return the bytes. Pictures that cannot be decoded, or are larger than the driver takes, are left out.
long posed_upload(struct posed *mesh);
long posed_upload_gltf_pictures(struct posed *mesh, const struct gltf *gltf);
long posed_upload_figure_pictures(struct posed *mesh, const struct looks *looks);
long posed_upload_places(const struct posed *mesh);
long posed_upload_looks(const struct posed *mesh);

/// Frees its memory too.
void posed_delete(struct posed *mesh);

/// Attributes of stage_skirt.vert.
enum { POSED_PLACE, POSED_NORMAL, POSED_COLOR, POSED_UV, POSED_PHASE, POSED_COVER };

/// Describes those of looks that lie in each `stride` bytes at an offset.
void posed_look_attributes(size_t stride, size_t offset);

#endif

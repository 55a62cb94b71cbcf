/// Characters and foxes as triangles in world space, posed once per frame on the CPU. Skirts are strips one pixel
/// wide along outlines that fade outwards. They anti-alias outlines without multisampling, also where a leg crosses another. Private to the
/// stage's files of draw/.
#ifndef DRAW_POSED_H
#define DRAW_POSED_H

#include "base/need.h"
#include "draw/stage.h"
#include <stdbool.h>
#include <stdint.h>

/// A vertex's linear colour with opacity, its place in a picture, and its phase. Coats use these fields differently; see stage_mesh.frag.
struct posed_look {
    float color[4], uv[2], phase[2], cover; ///< cover: 1 on the surface, 0 at the skirt's outer edge
};

/// The triangles of one material.
struct posed_part {
    int first, end; ///< indices
    int vertex;     ///< its first vertex
    int node;       ///< the file's node that shows it
    const struct gltf_part *own;
    bool mirrored;              ///< as posed, triangles are clockwise seen from outside
    enum stage_program program; ///< for its surface
    const struct gltf_material *material;
    GLuint picture, sampler; ///< 0: none
};

/// All zero: none.
struct posed {
    struct pool pool;
    uint32_t *indices;
    int *neighbours; ///< model/adjacency.h
    float (*place)[3], (*normal)[3];
    struct posed_look *looks;
    bool *front; ///< per triangle: faces the eye
    struct posed_part *parts;
    int vertex_count, index_count, part_count;
    uint64_t phases; ///< hash of the figure, its version, the coordinate and the axis that are shown; 0: own colours
    // On the GPU.
    GLuint vertex_array, index_buffer;
    GLuint moving_buffer, look_buffer; ///< all positions, then all normals; looks of vertices
    GLuint *pictures, *samplers;
    int picture_count, sampler_count;
};

/// The meshes of all nodes. Empty if they have too many triangles: a small file can claim any number.
void posed_from_gltf(struct posed *mesh, const struct gltf *gltf);
void posed_free(struct posed *mesh);

/// Moves all vertices and marks the triangles that face the eye. Allocates nothing.
void posed_pose(struct posed *mesh, const struct stage_model *shown, const float eye[3]);

/// Switches between own colours and the figure's phases; false if nothing changed.
bool posed_map(struct posed *mesh, const struct stage_model *shown);

// Skirts.

enum { SKIRT_CORNERS = 4 }; ///< per edge

/// The first outline edge of a part, from corner `from` on: the mesh ends there or turns away from the eye. Returns the part's end if there
/// is none.
int skirt_next(const struct posed *mesh, const struct posed_part *part, int from);

/// The SKIRT_CORNERS of the strip along the edge at a corner. `seam` is metres per pixel at a distance of 1 m.
void skirt_hang(const struct posed *mesh, const struct posed_part *part, int corner, const float eye[3], float seam,
                float (*place)[3], float (*normal)[3], struct posed_look *look);

#endif

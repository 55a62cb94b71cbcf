/// An imported character as one mesh that stands in the world: posed once a frame on the CPU, for its surface and its skirts alike.
/// Private to the stage's files of draw/.
#ifndef DRAW_MODEL_SURFACE_H
#define DRAW_MODEL_SURFACE_H

#include "draw/skirt.h"
#include "model/gltf.h"

/// All nodes' meshes, one after the other, part after part. All zero: they are too many, and nothing is drawn.
struct model_surface {
    uint32_t *indices;
    int *neighbours; ///< model/adjacency.h
    float (*place)[3], (*normal)[3];
    bool *front;                     ///< of each triangle
    int *first_vertex, *first_index; ///< of each node, and behind the last
    int vertex_count, index_count;
};

/// Finds what lies across edges. Meshes of different nodes have nothing to do with each other.
void model_surface_create(struct model_surface *surface, const struct gltf *gltf);
void model_surface_free(struct model_surface *surface);

/// Moves all of it, and says what faces the eye. Allocates nothing.
void model_surface_pose(const struct model_surface *surface, const struct gltf *gltf, const struct gltf_pose *pose,
                        const float root[16], const float eye[3]);

/// As it stands; only the indices of that node are right, as nodes are mirrored one by one.
struct skirt_mesh model_surface_mesh(const struct model_surface *surface, const struct gltf *gltf,
                                     const struct gltf_pose *pose, int node);

#endif

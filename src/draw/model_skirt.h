/// The skirts of imported characters. Private to the stage's files of draw/.
#ifndef DRAW_MODEL_SKIRT_H
#define DRAW_MODEL_SKIRT_H

#include "draw/skirt.h"
#include "model/gltf.h"

/// All nodes' meshes, one after the other, part after part, as one that stands in the world. All zero: they are too many, and edges stay hard.
struct model_skirt {
    uint32_t *indices;
    int *neighbours;
    float (*place)[3], (*normal)[3];
    bool *front;
    int *first_vertex, *first_index; ///< of each node
};

/// Finds what lies across edges. Meshes of different nodes have nothing to do with each other.
void model_skirt_create(struct model_skirt *skirt, const struct gltf *gltf);
void model_skirt_free(struct model_skirt *skirt);

/// Whether a node without a skin is mirrored, which turns its triangles round.
bool model_is_mirrored(const struct gltf *gltf, const struct gltf_pose *pose, int node);

/// Moves a node's mesh, and says what of it faces the eye.
struct skirt_mesh model_skirt_pose(const struct model_skirt *skirt, const struct gltf *gltf,
                                   const struct gltf_pose *pose, int node, const float root[16], const float eye[3]);

#endif

/// The box around a posed glTF character, without posing its vertices: skin stays within the boxes of what follows each joint.
#ifndef MODEL_GLTF_BOUNDS_H
#define MODEL_GLTF_BOUNDS_H

#include "model/gltf.h"

/// What follows one joint of a mesh's skin, or a whole mesh that has none.
struct gltf_box {
    int node;           ///< that shows the mesh
    int joint;          ///< of its skin, −1: none
    float lo[3], hi[3]; ///< of these vertices in the mesh's own space
};

struct gltf_bounds {
    struct gltf_box *boxes;
    int count;
};

/// false if memory is short.
bool gltf_bounds_create(const struct gltf *gltf, struct gltf_bounds *bounds);
void gltf_bounds_free(struct gltf_bounds *bounds);

/// The box in the model's space; it may be a little too large, never too small for morph weights from −1 to 1. Allocates nothing.
void gltf_bounds_at(const struct gltf_bounds *bounds, const struct gltf *gltf, const struct gltf_pose *pose,
                    float lo[3], float hi[3]);

#endif

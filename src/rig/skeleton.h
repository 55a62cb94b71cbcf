/// The bones of an imported character as one sees and points at them: a line from each joint to the next.
///
/// Bones are the joints of skins; in a file without skins all nodes that have a parent.
#ifndef RIG_SKELETON_H
#define RIG_SKELETON_H

#include "model/gltf.h"

/// From a node to a child that is a bone too; where there is none, on to a tip.
struct bone {
    int node;     ///< that turns it
    int child;    ///< −1: it ends in a tip
    float tip[3]; ///< in the node's own space
};

struct skeleton {
    struct bone *bones;
    int count; ///< one for each pair of joints, one for each tip
};

void skeleton_create(const struct gltf *gltf, const struct gltf_pose *rest, struct skeleton *skeleton);
void skeleton_free(struct skeleton *skeleton);

/// Where a bone begins and ends in a pose, in the character's space.
void skeleton_ends(const struct bone *bone, const struct gltf_pose *pose, float ends[2][3]);

#endif

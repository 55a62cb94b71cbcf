/// How the fox's skin follows the joints of its tail, for the stage and for exports.
///
/// A vertex hangs on slots: slot 0 is the body at the tail's base, slot n + 1 follows joint n; those of the body's other parts (limbs.h)
/// come behind. On the tail its weights are the uniform cubic B-spline along it, four joints at a time; on the torso it hangs on two parts.
#ifndef MODEL_TAIL_SKIN_H
#define MODEL_TAIL_SKIN_H

#include "model/limbs.h"
#include "model/mesh.h"
#include "model/pose.h"
#include <stdint.h>

enum {
    TAIL_SLOTS = POSE_MAX_JOINTS + LIMBS,
    TAIL_INFLUENCES =
        4, ///< slots of a vertex; where the torso goes over into the tail, slot 0 is one of the joints' four
};

/// Bind → world for each slot, as the first three rows of a matrix. Returns how many slots the pose has: joints + LIMBS.
int tail_slots(const struct pose *pose, float rows[TAIL_SLOTS][3][4]);

/// The slots that a vertex hangs on, each named once, and their weights, whose sum is 1; slots that are not used are 0 with weight 0.
/// `segment` is a joint's length at bind size.
void tail_influences(const struct vertex *vertex, int joints, float segment, uint16_t slot[TAIL_INFLUENCES],
                     float weight[TAIL_INFLUENCES]);

/// Places and unit normals of a mesh's vertices on a posed tail; `normals` may be NULL. Allocates nothing.
void tail_skin(const struct pose *pose, const struct mesh *mesh, float (*positions)[3], float (*normals)[3]);

#endif

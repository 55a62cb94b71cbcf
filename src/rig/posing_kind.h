/// How each kind of rig is posed. Private to src/rig.
#ifndef RIG_POSING_KIND_H
#define RIG_POSING_KIND_H

#include "rig/posing.h"

struct posing_functions {
    /// `values` are those of the rig's inputs; the rest of `pose` is filled in. false if its model is missing.
    bool (*pose)(const struct posing *posing, int rig, double position, const wiggly_value *values,
                 const struct by_hand *by_hand, struct rig_pose *pose);
    void (*bounds)(const struct rig_pose *pose, float lo[3], float hi[3]);
};

/// tail_posing …
#define POSING_FUNCTIONS(constant, name) extern const struct posing_functions name##_posing;
RIG_KIND_LIST(POSING_FUNCTIONS)
#undef POSING_FUNCTIONS

#endif

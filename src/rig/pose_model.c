/// Poses an imported character.
#include "rig/posing_kind.h"

static bool pose(const struct posing *posing, int rig, double position, const wiggly_value *values,
                 const struct by_hand *by_hand, struct rig_pose *posed)
{
    (void)posing, (void)rig, (void)position, (void)values, (void)by_hand, (void)posed;
    return false;
}

static void bounds(const struct rig_pose *posed, float lo[3], float hi[3]) { (void)posed, (void)lo, (void)hi; }

const struct posing_functions model_posing = {pose, bounds};

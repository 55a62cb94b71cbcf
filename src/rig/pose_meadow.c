/// Where a meadow is. Its reeds are too many for a pose: the stage asks for each by itself (meadow.h).
#include "rig/posing_kind.h"
#include <string.h>

/// What reeds that lean over reach beyond their area, of their height.
static const double LEAN = 0.6, TALLEST = 1.3;

static bool pose(const struct posing *posing, int rig, double position, const wiggly_value *values,
                 const struct by_hand *by_hand, struct rig_pose *posed)
{
    const struct meadow_rig *meadow = &posing->document->rigs[rig]->meadow;
    (void)position, (void)values, (void)by_hand;
    if (meadow_count(models_meadow(posing->models)) == 0) return false;
    for (int side = 0; side < 2; side++) {
        float *corner = side ? posed->meadow.hi : posed->meadow.lo;
        const double sign = side ? 1 : -1;
        corner[0] = (float)(sign * (0.5 * meadow->area[0] + LEAN * meadow->height));
        corner[1] = side ? (float)(TALLEST * meadow->height) : 0;
        corner[2] = (float)(sign * (0.5 * meadow->area[1] + LEAN * meadow->height));
    }
    return true;
}

static void bounds(const struct rig_pose *posed, float lo[3], float hi[3])
{
    memcpy(lo, posed->meadow.lo, sizeof posed->meadow.lo);
    memcpy(hi, posed->meadow.hi, sizeof posed->meadow.hi);
}

const struct posing_functions meadow_posing = {pose, bounds, NULL};

/// Moves and measures a posed tail.
#include "model/pose.h"
#include "model/fox.h"
#include "model/limbs.h"
#include "model/vector.h"
#include <math.h>

void pose_bounds(const struct pose *pose, float lo[3], float hi[3])
{
    const float scale = pose->scale;
    limbs_bounds(&pose->limbs, lo, hi);
    for (int k = 0; k < 3; k++) {
        lo[k] = pose->matrix[0][12 + k] + scale * lo[k];
        hi[k] = pose->matrix[0][12 + k] + scale * hi[k];
    }
    for (int n = 0; n < pose->count; n++) {
        const float along = FOX_TAIL_LENGTH * (float)n / (float)(pose->count - 1);
        const float radius = scale * fox_tail_radius(along);
        for (int k = 0; k < 3; k++) {
            lo[k] = fminf(lo[k], pose->matrix[n][12 + k] - radius);
            hi[k] = fmaxf(hi[k], pose->matrix[n][12 + k] + radius);
        }
    }
}

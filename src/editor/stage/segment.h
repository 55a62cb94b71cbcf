/// Segments on the screen.
#ifndef EDITOR_STAGE_SEGMENT_H
#define EDITOR_STAGE_SEGMENT_H

#include <math.h>

/// How far along the segment a … b the point nearest to p is, 0 … 1.
static inline float segment_nearest(const float a[2], const float b[2], const float p[2])
{
    const float dx = b[0] - a[0], dy = b[1] - a[1], square = dx * dx + dy * dy;
    const float along = (p[0] - a[0]) * dx + (p[1] - a[1]) * dy;
    return square > 0 ? fmaxf(0, fminf(1, along / square)) : 0;
}

#endif

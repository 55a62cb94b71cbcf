/// What single values between samples and rows of them have in common.
#ifndef SPLINE_EVALUATE_H
#define SPLINE_EVALUATE_H

#include <math.h>
#include <wiggly/wiggly.h>

/// Index of a neighbour sample, at most two from one of the curve's: wrapped in a loop; -1 where there is none.
static inline int evaluate_neighbour(const wiggly_curve *curve, int i)
{
    if (curve->start == WIGGLY_LOOP) {
        int period = curve->samples - 1;
        return i < 0 ? i + period : i >= period ? i - period : i;
    }
    return i < 0 || i >= curve->samples ? -1 : i;
}

/// A position taken into the domain: sample i (the result) and u beyond it, 0 ≤ u < 1.
static inline int evaluate_locate(const wiggly_curve *curve, double position, double *u)
{
    double last = curve->samples - 1;
    if (!(position >= 0 && position < last)) {
        if (curve->start == WIGGLY_LOOP) {
            position -= last * floor(position / last);
            if (!(position < last)) position = 0; // rounded up to the seam
        } else {
            position = fmin(fmax(position, 0), last);
        }
        if (!(position >= 0)) position = 0; // NaN
    }
    int i = (int)position;
    *u = position - i;
    return i;
}

#endif

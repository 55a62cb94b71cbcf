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

/// c0 + c1 u + c2 u² + c3 u³.
typedef struct cubic {
    double c0, c1, c2, c3;
} cubic;

/// Catmull-Rom between `from` at 0 and `to` at 1.
static inline cubic cubic_through(double before, double from, double to, double after)
{
    double c1 = 0.5 * (after - from), c0 = 0.5 * (to - before), step = to - from;
    return (cubic){from, c0, 3 * step - 2 * c0 - c1, c0 + c1 - 2 * step};
}

static inline double cubic_at(cubic p, double u) { return p.c0 + u * (p.c1 + u * (p.c2 + u * p.c3)); }

/// A block of a row's values from number k on, each from its own interval; complex mode, at least four samples. Returns the number
/// of the value after it.
int evaluate_apart(const wiggly_curve *curve, double from, double by, int k, int count, float *out, size_t stride);

#endif

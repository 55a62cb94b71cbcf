/// Values whose squares a double cannot hold, in units of a power of two: everything that is solved for is linear in them, so only the power
/// differs.
#include "spline/problem.h"
#include <float.h>
#include <math.h>

/// The largest power of two that is a double, either way.
enum { MOST = 1000 };

static inline double larger(double a, double b) { return a > b ? a : b; }

double scale_size(const wiggly_solver *solver, const wiggly_desc *desc)
{
    const wiggly_param *y = &desc->equilibrium;
    const double n = desc->samples, n4 = n * n * n * n, seconds = n * desc->step;
    double size = 0;
    for (int k = 0; k < desc->knot_count; k++) {
        const wiggly_knot *knot = &desc->knots[k];
        if (knot->still) continue;
        size = larger(fabs(knot->value), size);
        if (knot->has_phase && desc->mode == WIGGLY_COMPLEX) size = larger(fabs(knot->phase), size);
        // What a slope moves at most: its line, if it is stiff beside the jets, which bend by less than n⁴.
        if (knot->has_slope)
            size = larger(seconds * fabs(knot->slope) * fmin(1, knot_stiffness(knot) * desc->step * n4), size);
    }
    if (variation_is_set(desc)) {
        const double farthest = variation_farthest(desc);
        size = larger(desc->variation * (farthest > 0 ? farthest : 1), size);
    }
    if (!y->track || (solver->y_is_safe && size * SAFE_VALUE >= 1))
        return larger(y->track ? 0 : fabs(y->value), size);
    return larger(extent_size(extent_of(y->track, desc->samples)), size);
}

double scale_for(double size)
{
    int exponent;
    if (!(size > 0) || (size <= SAFE_VALUE && size * SAFE_VALUE >= 1)) return 1;
    frexp(fmin(size, DBL_MAX), &exponent);
    return ldexp(1, exponent > MOST ? -MOST : exponent < -MOST ? MOST : -exponent);
}

void scale_values(wiggly_solver *solver, double scale, wiggly_desc *desc)
{
    solver->scale = scale;
    if (scale == 1) return;
    for (int k = 0; k < desc->knot_count; k++) {
        wiggly_knot *knot = &solver->scaled[k];
        *knot = desc->knots[k];
        knot->value *= scale, knot->slope *= scale, knot->phase *= scale;
    }
    if (variation_is_set(desc) && variation_farthest(desc) == 0) desc->variation *= scale;
    desc->knots = solver->scaled;
    desc->low *= scale, desc->high *= scale;
    desc->equilibrium.value *= scale;
    if (!desc->equilibrium.track) return;
    for (int i = 0; i < desc->samples; i++) solver->y[i] = scale * desc->equilibrium.track[i];
    desc->equilibrium.track = solver->y;
}

void scale_back(const wiggly_desc *desc, double scale, wiggly_curve *curve)
{
    double *const rows[] = {curve->total, curve->y, curve->re, curve->im};
    const size_t stride = curve->stride ? curve->stride : 1;
    for (int r = 0; r < 4; r++) {
        for (int i = 0; i < desc->samples && rows[r]; i++) rows[r][i] /= scale;
    }
    for (int k = 0; k < desc->knot_count; k++) { // a small one beside large ones may have left the range
        const wiggly_knot *knot = &desc->knots[k];
        if (!knot->still) curve->total[knot->sample] = knot->value;
    }
    for (int i = 0; i < desc->samples && curve->floats; i++)
        curve->floats[(size_t)i * stride] = (float)curve->total[i];
    for (int i = 0; i < 2; i++) curve->before[i] /= scale;
}

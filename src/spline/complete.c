/// The steps after x is found: a plausibility check, the samples outside the system, the total and the rest of the curve.
#include "maths/maths.h"
#include "spline/problem.h"
#include "spline/wide.h"
#include <math.h>
#include <string.h>

static const double blow_up = 1e4;

WIDEST extent extent_of(const double *values, int count)
{
    enum { LANES = 8 };
    double low[LANES], high[LANES];
    for (int k = 0; k < LANES; k++) low[k] = high[k] = values[0];
    int i = 0;
    for (; i + LANES <= count; i += LANES) {
        for (int k = 0; k < LANES; k++) {
            low[k] = values[i + k] < low[k] ? values[i + k] : low[k];
            high[k] = values[i + k] > high[k] ? values[i + k] : high[k];
        }
    }
    extent all = {low[0], high[0]};
    for (int k = 1; k < LANES; k++) {
        all.low = low[k] < all.low ? low[k] : all.low;
        all.high = high[k] > all.high ? high[k] : all.high;
    }
    for (; i < count; i++) {
        all.low = values[i] < all.low ? values[i] : all.low;
        all.high = values[i] > all.high ? values[i] : all.high;
    }
    return all;
}

/// The scale to compare max |x| with: the largest of |w| over knots, T·|slope| over slopes, and y's range.
static double problem_scale(const problem *p)
{
    const extent y = p->y ? extent_of(p->y, p->desc->samples) : (extent){0, 0};
    double scale = y.high - y.low;
    double t = (p->start == WIGGLY_LOOP ? p->count : p->count - 1) * p->desc->step;
    for (int k = 0; k < p->desc->knot_count; k++) {
        const wiggly_knot *knot = &p->desc->knots[k];
        if (knot->still) continue;
        double size = fabs(problem_knot_re(p, knot));
        if (size > scale) scale = size;
        if (problem_is_whole(p, knot)) scale = fmax(scale, fabs(problem_knot_im(p, knot)));
        if (knot->has_slope && t * fabs(knot->slope) > scale) scale = t * fabs(knot->slope);
    }
    return scale;
}

bool problem_blew_up(const problem *p, const wiggly_curve *curve)
{
    double scale = problem_scale(p);
    bool is_complex = p->desc->mode == WIGGLY_COMPLEX;
    const double *re = curve->re + p->first, *im = curve->im + p->first;
    double bound = extent_size(extent_of(re, p->count));
    if (is_complex) bound = maths_hypot(bound, extent_size(extent_of(im, p->count)));
    if (!(scale > 0) || bound <= blow_up * scale) return false;
    for (int k = 0; k < p->count && is_complex; k++) {
        if (maths_hypot(re[k], im[k]) > blow_up * scale) return true;
    }
    return !is_complex;
}

WIDEST static void fill(double *x, double value, int count)
{
    for (int i = 0; i < count; i++) x[i] = value;
}

WIDEST static void add_constant(double *restrict total, double y, const double *restrict re, int count)
{
    for (int i = 0; i < count; i++) total[i] = y + re[i];
}

WIDEST static void add_to(double *restrict total, const double *restrict about, const double *restrict re, int count)
{
    for (int i = 0; i < count; i++) total[i] = about[i] + re[i];
}

/// w + u from w, where u is about − y.
WIDEST static void add_swing(double *restrict re, const double *restrict about, const double *restrict y, int count)
{
    for (int i = 0; i < count; i++) re[i] += about[i] - y[i];
}

/// The same of a constant.
WIDEST static void take_bend(double *restrict re, double level, const double *restrict y, int count)
{
    for (int i = 0; i < count; i++) re[i] += level - y[i];
}

WIDEST static void add(double *restrict im, const double *restrict u, int count)
{
    for (int i = 0; i < count; i++) im[i] += u[i];
}

/// Fills the total, about + w; x, w + u, if it differs; and y, if the caller wants it.
static void add_equilibrium(const problem *p, wiggly_curve *curve)
{
    int n = p->desc->samples;
    if (curve->y && !p->y) fill(curve->y, p->level, n);
    if (curve->y && p->y && curve->y != p->y) memcpy(curve->y, p->y, sizeof *p->y * (size_t)n);
    if (!p->about) {
        add_constant(curve->total, p->level, curve->re, n);
    } else {
        add_to(curve->total, p->about, curve->re, n);
    }
    for (int k = 0; k < p->desc->knot_count; k++) {
        const wiggly_knot *knot = &p->desc->knots[k];
        if (knot->still && p->about) continue; // the sum is exact
        curve->total[knot->sample] = knot->still ? problem_y(p, knot->sample) : knot->value;
    }
    if (p->start == WIGGLY_LOOP) curve->total[n - 1] = curve->total[0];
    if (p->y && !p->about) take_bend(curve->re, p->level, p->y, n);
    if (p->y && p->about && p->about != p->y) add_swing(curve->re, p->about, p->y, n);
    if (p->response.im) add(curve->im, p->response.im, n);
}

static void add_floats(const wiggly_curve *curve, int count)
{
    size_t stride = curve->stride ? curve->stride : 1;
    for (int i = 0; i < count; i++) curve->floats[(size_t)i * stride] = (float)curve->total[i];
}

static void set_centre(wiggly_solver *solver, const problem *p, double *omega)
{
    const wiggly_desc *desc = p->desc;
    if (poles_are_constant(desc)) {
        fill(omega, problem_filter(solver, p)->at.centre, desc->samples);
    } else {
        poles_block_centres(desc, 0, desc->samples, problem_least_damping(p), omega);
    }
}

/// Before the first knot w is constant; for a cubic solved for its total, x is.
static void hold_before_first(const problem *p, wiggly_curve *curve)
{
    int first = p->first;
    bool total = p->y && !p->about;
    curve->before[0] = total ? curve->re[first] + (p->level - p->y[first]) : curve->re[first];
    curve->before[1] = curve->im[first];
    for (int i = 0; i < first; i++) {
        curve->re[i] = total ? curve->re[first] + (p->y[i] - p->y[first]) : curve->re[first];
        curve->im[i] = curve->im[first];
    }
    curve->before[0] += p->held.re;
    curve->before[1] += p->held.im;
}

void problem_complete(wiggly_solver *solver, const problem *p, wiggly_curve *curve)
{
    const wiggly_desc *desc = p->desc;
    int n = desc->samples;
    if (desc->mode != WIGGLY_COMPLEX) fill(curve->im, 0, n);
    hold_before_first(p, curve);
    if (p->start == WIGGLY_LOOP) curve->re[n - 1] = curve->re[0], curve->im[n - 1] = curve->im[0];
    add_equilibrium(p, curve);
    if (curve->floats) add_floats(curve, n);
    if (curve->omega) set_centre(solver, p, curve->omega);
    curve->samples = n;
    curve->step = desc->step;
    curve->first = p->first;
    curve->mode = desc->mode;
    curve->start = p->start;
}

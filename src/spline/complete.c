/// What follows once x is found: whether it can be meant, the samples outside the system, the total and what else a curve holds.
#include "spline/problem.h"
#include "spline/wide.h"
#include <math.h>
#include <string.h>

static const double blow_up = 1e4;

/// Largest less smallest.
static double range_of(const double *values, int count)
{
    double low = values[0], high = values[0];
    for (int i = 1; i < count; i++) {
        low = fmin(low, values[i]);
        high = fmax(high, values[i]);
    }
    return high - low;
}

/// Largest of |value − y| over knots, T·|slope| over slopes, and y's range: what max |x| is measured against.
static double problem_scale(const problem *p)
{
    double scale = p->y ? range_of(p->y, p->desc->samples) : 0;
    double t = (p->start == WIGGLY_LOOP ? p->count : p->count - 1) * p->desc->step;
    for (int k = 0; k < p->desc->knot_count; k++) {
        const wiggly_knot *knot = &p->desc->knots[k];
        double size = fabs(knot->value - problem_y(p, knot->sample));
        if (size > scale) scale = size;
        if (knot->has_slope && t * fabs(knot->slope) > scale) scale = t * fabs(knot->slope);
    }
    return scale;
}

/// Largest |x|, eight at once.
WIDEST static double largest_magnitude(const double *x, int count)
{
    double largest[8] = {0}, all = 0;
    int i = 0;
    for (; i + 8 <= count; i += 8) {
        for (int k = 0; k < 8; k++) largest[k] = fabs(x[i + k]) > largest[k] ? fabs(x[i + k]) : largest[k];
    }
    for (; i < count; i++) all = fmax(all, fabs(x[i]));
    for (int k = 0; k < 8; k++) all = fmax(all, largest[k]);
    return all;
}

bool problem_blew_up(const problem *p, const chain *solved, const wiggly_curve *curve)
{
    double scale = problem_scale(p);
    if (solved && p->desc->mode == WIGGLY_CUBIC && solved->cubic_bound <= blow_up * scale) return false;
    bool is_complex = p->desc->mode == WIGGLY_COMPLEX;
    const double *re = curve->re + p->first, *im = curve->im + p->first;
    double bound = largest_magnitude(re, p->count);
    if (is_complex) bound = hypot(bound, largest_magnitude(im, p->count));
    if (!(scale > 0) || bound <= blow_up * scale) return false;
    for (int k = 0; k < p->count && is_complex; k++) {
        if (hypot(re[k], im[k]) > blow_up * scale) return true;
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

/// y, where it is asked for, and the total.
static void add_equilibrium(const problem *p, wiggly_curve *curve)
{
    int n = p->desc->samples;
    if (!p->y) {
        double y = p->desc->equilibrium.value;
        if (curve->y) fill(curve->y, y, n);
        add_constant(curve->total, y, curve->re, n);
    } else {
        if (curve->y && curve->y != p->y) memcpy(curve->y, p->y, sizeof *p->y * (size_t)n);
        for (int i = 0; i < n; i++) curve->total[i] = p->y[i] + curve->re[i];
    }
    for (int k = 0; k < p->desc->knot_count; k++) curve->total[p->desc->knots[k].sample] = p->desc->knots[k].value;
    if (p->start == WIGGLY_LOOP) curve->total[n - 1] = curve->total[0];
}

static void add_floats(const wiggly_curve *curve, int count)
{
    size_t stride = curve->stride ? curve->stride : 1;
    for (int i = 0; i < count; i++) curve->floats[(size_t)i * stride] = (float)curve->total[i];
}

static void set_centre(wiggly_solver *solver, const problem *p, double *omega)
{
    const wiggly_desc *desc = p->desc;
    double floor = p->start == WIGGLY_LOOP ? LEAST_DAMPING * p->calm : 0;
    if (!poles_are_constant(desc)) {
        for (int i = 0; i < desc->samples; i++) omega[i] = poles_at(desc, i, floor).centre;
    } else if (p->start == WIGGLY_LOOP) {
        fill(omega, poles_at(desc, 0, floor).centre, desc->samples);
    } else {
        fill(omega, solver_filter(solver, desc)->at.centre, desc->samples);
    }
}

void problem_complete(wiggly_solver *solver, const problem *p, wiggly_curve *curve)
{
    const wiggly_desc *desc = p->desc;
    int n = desc->samples;
    if (desc->mode != WIGGLY_COMPLEX) fill(curve->im, 0, n);
    for (int i = 0; i < p->first; i++) curve->re[i] = curve->re[p->first], curve->im[i] = curve->im[p->first];
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

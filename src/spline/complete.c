/// The steps after x is found: the free motion after the last knot, a plausibility check, the samples outside the system, the total and the
/// rest of the curve.
#include "maths/maths.h"
#include "spline/problem.h"
#include "maths/wide.h"
#include <math.h>
#include <string.h>

static const double blow_up = 1e4;

// --- the free motion after the last knot: w_{i+1} = e^{ph} w_i, p = −ζω_n + jω_n√(1−ζ²); a cubic holds its total ---

WIDEST static void scale_powers(const double *restrict power_re, const double *restrict power_im, cplx w, int count,
                                double *restrict re, double *restrict im)
{
    for (int i = 0; i < count; i++) {
        re[i] = power_re[i] * w.re - power_im[i] * w.im;
        im[i] = power_re[i] * w.im + power_im[i] * w.re;
    }
}

/// Fills each run of samples on its own, counted from the knot, so that the result does not depend on `from`. The powers of the motion before
/// are kept.
static void fill_constant(free_powers *power, cplx exponent, cplx w, int from, int count, double *re, double *im)
{
    const int end = from % FREE_RUN + count, needed = end < FREE_RUN ? end : FREE_RUN;
    if (power->count < needed || power->exponent.re != exponent.re || power->exponent.im != exponent.im) {
        const cplx turn = cplx_exp(exponent);
        cplx at = {1, 0};
        *power = (free_powers){.exponent = exponent, .count = needed};
        for (int i = 0; i < needed; i++) {
            power->re[i] = at.re, power->im[i] = at.im;
            at = cplx_mul(at, turn);
        }
    }
    for (int i = 0; i < count;) {
        const int run = (from + i) / FREE_RUN, begin = (from + i) % FREE_RUN, rest = FREE_RUN - begin;
        const int n = rest < count - i ? rest : count - i;
        cplx base = w;
        if (run > 0) base = cplx_mul(cplx_exp(cplx_scale(run * (double)FREE_RUN, exponent)), w);
        scale_powers(power->re + begin, power->im + begin, base, n, re + i, im + i);
        i += n;
    }
}

void problem_fill_tail(wiggly_solver *solver, const problem *p, cplx w, int from, int count, double *re, double *im)
{
    if (p->desc->mode != WIGGLY_COMPLEX) {
        problem_fill(re, w.re, count);
    } else if (poles_are_constant(p->desc)) {
        fill_constant(&solver->powers, problem_filter(solver, p)->passive, w, from, count, re, im);
    } else {
        poles here = poles_at(p->desc, p->latest, 0);
        for (int k = 1; k < from + count; k++) { // p of an interval is the mean at its ends
            const poles next = poles_at(p->desc, p->latest + k, 0);
            const cplx both = cplx_add(poles_passive(&here), poles_passive(&next));
            w = cplx_mul(cplx_exp(cplx_scale(0.5 * p->desc->step, both)), w);
            here = next;
            if (k >= from) re[k - from] = w.re, im[k - from] = w.im;
        }
    }
}

void problem_settle(wiggly_solver *solver, const problem *p, double *re, double *im)
{
    const int after = p->latest + 1, count = p->desc->samples - after;
    if (!p->settles || count < 1) return;
    problem_fill_tail(solver, p, (cplx){re[p->latest], im[p->latest]}, 1, count, re + after, im + after);
}

// --- the curve -------------------------------------------------------------------------------------------------------

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

bool problem_blew_up(const problem *p, const wiggly_curve *curve)
{
    const wiggly_desc *desc = p->desc;
    const double t = (p->start == WIGGLY_LOOP ? p->count : p->count - 1) * desc->step;
    const bool is_complex = desc->mode == WIGGLY_COMPLEX;
    double scale = 0; // the largest of y's range, |w| over knots, and T·|slope| over slopes
    if (p->y) {
        const extent y = extent_of(p->y, desc->samples);
        scale = y.high - y.low;
    }
    for (int k = 0; k < desc->knot_count; k++) {
        const wiggly_knot *knot = &desc->knots[k];
        if (knot->still) continue;
        scale = fmax(scale, fabs(problem_knot_re(p, knot)));
        if (problem_is_whole(p, knot)) scale = fmax(scale, fabs(problem_knot_im(p, knot)));
        if (knot->has_slope) scale = fmax(scale, t * fabs(knot->slope));
    }
    const double *re = curve->re + p->first, *im = curve->im + p->first;
    double bound = extent_size(extent_of(re, p->count));
    if (is_complex) bound = maths_hypot(bound, extent_size(extent_of(im, p->count)));
    if (!(scale > 0) || bound <= blow_up * scale) return false;
    for (int k = 0; k < p->count && is_complex; k++) {
        if (maths_hypot(re[k], im[k]) > blow_up * scale) return true;
    }
    return !is_complex;
}

WIDEST void problem_fill(double *x, double value, int count)
{
    for (int i = 0; i < count; i++) x[i] = value;
}

/// Fills the total, about + w; x, w + u, if it differs; and y, if the caller wants it.
WIDEST static void add_equilibrium(const problem *p, const wiggly_curve *curve)
{
    const int n = p->desc->samples;
    const double *const about = p->about, *const y = p->y, *const u = p->response.im, level = p->level;
    double *restrict total = curve->total, *restrict re = curve->re, *restrict im = curve->im;
    if (curve->y && !y) problem_fill(curve->y, level, n);
    if (curve->y && y && curve->y != y) memcpy(curve->y, y, sizeof *y * (size_t)n);
    for (int i = 0; i < n; i++) total[i] = (about ? about[i] : level) + re[i];
    for (int k = 0; k < p->desc->knot_count; k++) {
        const wiggly_knot *knot = &p->desc->knots[k];
        if (knot->still && about) continue; // the sum is exact
        total[knot->sample] = knot->still ? problem_y(p, knot->sample) : knot->value;
    }
    if (p->start == WIGGLY_LOOP) total[n - 1] = total[0];
    for (int i = 0; i < n && y && about != y; i++) re[i] += (about ? about[i] : level) - y[i];
    for (int i = 0; i < n && u; i++) im[i] += u[i];
}

void problem_complete(wiggly_solver *solver, const problem *p, wiggly_curve *curve)
{
    const wiggly_desc *desc = p->desc;
    const int n = desc->samples, first = p->first;
    double *const re = curve->re, *const im = curve->im;
    if (desc->mode != WIGGLY_COMPLEX) problem_fill(im, 0, n);
    // Before the first knot w is constant; for a cubic solved for its total, x is.
    const bool is_total = p->y && !p->about;
    curve->before[0] = p->held.re + (is_total ? re[first] + (p->level - p->y[first]) : re[first]);
    curve->before[1] = p->held.im + im[first];
    for (int i = 0; i < first; i++) {
        re[i] = is_total ? re[first] + (p->y[i] - p->y[first]) : re[first];
        im[i] = im[first];
    }
    if (p->start == WIGGLY_LOOP) re[n - 1] = re[0], im[n - 1] = im[0];
    add_equilibrium(p, curve);
    const size_t stride = curve->stride ? curve->stride : 1;
    for (int i = 0; i < n && curve->floats; i++) curve->floats[(size_t)i * stride] = (float)curve->total[i];
    if (curve->omega && poles_are_constant(desc)) {
        problem_fill(curve->omega, problem_filter(solver, p)->at.centre, n);
    } else if (curve->omega) {
        poles_block_centres(desc, 0, n, problem_least_damping(p), curve->omega);
    }
    curve->samples = n;
    curve->step = desc->step;
    curve->first = first;
    curve->mode = desc->mode;
    curve->start = p->start;
}

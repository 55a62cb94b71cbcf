/// Solves one spline by the chain or by the band; if the problem is singular, solves the nearest one that is not (docs/mathematics.md, last
/// rule of Constraints). Then completes the curve.
#include "maths/maths.h"
#include "maths/wide.h"
#include "spline/host.h"
#include "spline/problem.h"
#include <float.h>
#include <math.h>
#include <string.h>

const char *wiggly_version(void) { return WIGGLY_VERSION; }

wiggly_desc wiggly_default_desc(void)
{
    return (wiggly_desc){.size = sizeof(wiggly_desc),
                         .samples = 1,
                         .step = 1.0 / 24,
                         .bandwidth.value = 0.1,
                         .calm = 1,
                         .has_calm = true};
}

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

WIDEST void problem_fill(double *x, double value, int count)
{
    for (int i = 0; i < count; i++) x[i] = value;
}

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

// --- a solve ---------------------------------------------------------------------------------------------------------

/// Times the scale of knots and equilibrium: a larger x is no solution.
static const double implausible = 1e4;

static double tolerance(wiggly_mode mode) { return mode == WIGGLY_CUBIC ? 1e-9 : 1e-8; }

/// Copies w and the motion after the system into the curve's arrays.
static void unpack(wiggly_solver *solver, const problem *p, wiggly_curve *curve)
{
    const system_rows *rows = &solver->rows;
    double *re = curve->re + p->first, *im = curve->im + p->first;
    for (int k = 0; k < rows->count; k++) {
        re[k] = rows->x[2 * k];
        if (p->desc->mode == WIGGLY_COMPLEX) im[k] = rows->x[2 * k + 1];
    }
    problem_settle(solver, p, curve->re, curve->im);
}

/// Whether max |x| is implausible for the knots.
static bool blew_up(const problem *p, const wiggly_curve *curve)
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
    if (!(scale > 0) || bound <= implausible * scale) return false;
    for (int k = 0; k < p->count && is_complex; k++) {
        if (maths_hypot(re[k], im[k]) > implausible * scale) return true;
    }
    return !is_complex;
}

/// Solves the problem, by the chain if that is right for sure, else by the band; if it is singular, solves the nearest one that is not.
static wiggly_status minimise_safely(wiggly_solver *solver, problem *p, wiggly_curve *curve, minimum *result)
{
    const chain *c = &solver->chain;
    const bool is_complex = p->desc->mode == WIGGLY_COMPLEX;
    double *const re = curve->re + p->first, *const im = curve->im + p->first;
    wiggly_status status = p->status;
    for (;;) {
        if (!p->thorough && problem_solve_chain(solver, p, re, im) && c->size < INFINITY &&
            c->error <= tolerance(p->desc->mode) * c->size) {
            *result = (minimum){
                .by_chain = true, .solved = true, .largest = c->size, .error = c->error + p->response.error};
        } else {
            problem_set_rows(solver, p);
            *result = solver_minimise(solver);
            unpack(solver, p, curve);
        }
        // x must be a double in the caller's units, too, and its sum with the equilibrium
        const double most = 0.25 * DBL_MAX * solver->scale;
        const bool is_told = solver->scale >= 1 || (extent_size(extent_of(re, p->count)) < most &&
                                                    (!is_complex || extent_size(extent_of(im, p->count)) < most));
        const bool may_be_singular = p->start == WIGGLY_LOOP ? p->calm == 0 : p->free_end;
        if (result->solved && is_told && !(may_be_singular && (result->lost || blew_up(p, curve)))) return status;
        if (may_be_singular && p->calm == 0) {
            problem_set_calm(solver, p, FALLBACK_CALM);
            status = WIGGLY_CALMED;
        } else if (may_be_singular && p->free_end && p->earliest >= 0 && !p->level_slope) {
            p->level_slope = true;
            status = WIGGLY_LEVELLED;
        } else {
            break;
        }
    }
    system_rows *rows = &solver->rows; // straight lines join the knots
    problem_set_rows(solver, p);
    int before = -1;
    for (int k = 0; k < rows->count; k++) {
        if (!(rows->fixed[k] & FIXED_RE)) continue;
        for (int i = before + 1; i < k; i++) {
            double from = before < 0 ? rows->x[2 * k] : rows->x[2 * before];
            double u = (double)(i - before) / (k - before); // separately: the difference might overflow
            rows->x[2 * i] = from * (1 - u) + rows->x[2 * k] * u;
        }
        before = k;
    }
    for (int i = before + 1; before >= 0 && i < rows->count; i++) rows->x[2 * i] = rows->x[2 * before];
    unpack(solver, p, curve);
    *result = (minimum){.solved = true, .error = p->response.error};
    return WIGGLY_SINGULAR;
}

/// Domains too short for a jet row (M < 3) or where nothing moves: each w is its knot's, else the earliest knot's, else 0. For a cubic solved
/// for its total x is 0 there; with the filter x, not the total, is the earliest knot's.
static void solve_short(wiggly_solver *solver, const problem *p, wiggly_curve *curve)
{
    const wiggly_desc *desc = p->desc;
    const bool is_total = p->y && !p->about;
    double *const re = curve->re, *const im = curve->im, other[2] = {0, 0};
    if (p->earliest >= 0 && p->start != WIGGLY_REST) {
        const wiggly_knot *knot = &desc->knots[solver->order[0]];
        other[0] = problem_knot_re(p, knot);
        if (problem_is_whole(p, knot)) other[1] = problem_knot_im(p, knot);
    }
    for (int i = p->first; i < p->first + p->count; i++) re[i] = other[0], im[i] = other[1];
    if (is_total && p->earliest >= 0 && !problem_oscillates(p)) {
        for (int i = p->first; i < p->first + p->count; i++) re[i] += p->y[i] - p->y[p->earliest];
    }
    if (is_total && p->earliest < 0 && (p->start != WIGGLY_REST || p->count < 3)) {
        for (int i = 0; i < desc->samples; i++) re[i] = p->y[i] - p->level;
    }
    for (int n = 0; n < desc->knot_count; n++) {
        const wiggly_knot *knot = &desc->knots[n];
        re[knot->sample] = problem_knot_re(p, knot);
        if (problem_is_whole(p, knot)) im[knot->sample] = problem_knot_im(p, knot);
    }
}

/// Whether nothing moves w: no knots, and no drive.
static bool is_unmoved(const problem *p)
{
    if (problem_is_asked(p)) return false;
    if (p->start == WIGGLY_FREE || !p->y) return true;
    if (p->desc->mode == WIGGLY_CUBIC) return p->start == WIGGLY_LOOP || problem_oscillates(p);
    if (problem_oscillates(p)) return true;
    if (p->start == WIGGLY_REST) return false;
    bool moves = false, rings = false;
    for (int i = 0; i < p->desc->samples - 1; i++) {
        moves = moves || p->y[i] != p->y[0];
        rings = rings || poles_at(p->desc, i, 0).natural > 0;
    }
    return !moves || !rings;
}

/// If the total is a smaller share of x than this, its error is relative to that share of x.
static const double negligible = 1e-6;

/// Adds an error of x, relative to the larger of the total's range and its largest magnitude.
static wiggly_status judge(wiggly_curve *curve, double error, wiggly_status status)
{
    if (error > 0) {
        const extent total = extent_of(curve->total, curve->samples), re = extent_of(curve->re, curve->samples);
        const double size = fmax(fmax(total.high - total.low, extent_size(total)), negligible * extent_size(re));
        curve->error += size > 0 ? error / size : DBL_MAX;
        // A curve that is all error has no meaningful size.
        if (curve->error > 1 && curve->error < DBL_MAX) curve->error = DBL_MAX;
    }
    return status == WIGGLY_OK && !(curve->error <= tolerance(curve->mode)) ? WIGGLY_INEXACT : status;
}

/// The curve with the solver's own arrays for missing ones; they are unused once x is found.
static wiggly_curve with_arrays(const wiggly_solver *solver, const wiggly_curve *curve)
{
    wiggly_curve all = *curve;
    if (!all.re) all.re = solver->re;
    if (!all.im) all.im = solver->im;
    if (!all.total) all.total = solver->rows.jet;
    return all;
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

/// Computes the rest from x: samples outside the system, the total, the equilibrium, the band's centre.
static void complete(wiggly_solver *solver, const problem *p, wiggly_curve *curve)
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

/// x behind row 1, from that and the one before: the filter run forward (r_i = 0, Figure 5).
static void run_forward(system_rows *rows)
{
    // x is a double sum of small steps; what a sum loses is carried along, or N² additions would show (Kahan)
    const double *first = rows->x;
    double x[2] = {first[2], first[3]}, step[2] = {first[2] - first[0], first[3] - first[1]};
    double lost_x[2] = {0}, lost_step[2] = {0};
    for (int i = 1; i < rows->count - 1; i++) {
        const coefficients at = system_coefficients(rows, i);
        const cplx drive = rows->driven ? rows->drive[i] : (cplx){0, 0};
        const cplx e = {step[0], step[1]}, behind = {x[0] - e.re, x[1] - e.im};
        const cplx more = cplx_sub(cplx_sub(cplx_mul(at.m, e), cplx_mul(at.p, behind)), drive);
        const double by[2] = {more.re, more.im};
        for (int part = 0; part < 2; part++) {
            const double a = by[part] - lost_step[part], moved = step[part] + a;
            lost_step[part] = (moved - step[part]) - a;
            step[part] = moved;
            const double b = (step[part] - lost_x[part]) - lost_step[part], sum = x[part] + b;
            lost_x[part] = (sum - x[part]) - b;
            x[part] = sum;
            rows->x[2 * i + 2 + part] = x[part];
        }
    }
}

wiggly_status problem_find(wiggly_solver *solver, problem *p, wiggly_curve *curve, minimum *result)
{
    *result = (minimum){.solved = true, .error = p->response.error};
    if (problem_winds_up(p)) {
        problem_solve_gaps(solver, p, curve, result);
    } else if (p->count < 3 || is_unmoved(p)) {
        solve_short(solver, p, curve);
    } else if (p->start == WIGGLY_REST && !problem_is_asked(p)) { // nothing constrains it
        problem_set_rows(solver, p);
        run_forward(&solver->rows);
        unpack(solver, p, curve);
    } else {
        return minimise_safely(solver, p, curve, result);
    }
    return p->status;
}

wiggly_status wiggly_solve(wiggly_solver *solver, const wiggly_desc *desc, wiggly_curve *curve)
{
    if (!solver || !curve || !desc) return WIGGLY_ERROR_ARGUMENT;
    if (!curve_fits(curve)) return WIGGLY_ERROR_SIZE;
    wiggly_desc own;
    curve->knot = -1;
    const host_state host = host_leave();
    wiggly_status status = desc_read(desc, &own);
    if (status == WIGGLY_OK) status = solver_solve(solver, &own, curve);
    host_return(&host);
    return status;
}

wiggly_status solver_solve_scaled(wiggly_solver *solver, const wiggly_desc *desc, wiggly_curve *curve)
{
    problem p;
    wiggly_curve all = with_arrays(solver, curve);
    wiggly_status status;
    const bool limited = limits_are_set(desc) && !solver->pulls; // pins have priority
    problem_pose(solver, desc, all.y && !limited ? all.y : solver->y, &p);
    wiggly_desc ordered;
    curve->knot = limited ? limits_prepare(solver, &p, &ordered) : -1;
    if (curve->knot >= 0) return WIGGLY_ERROR_KNOT_LIMIT;
    for (;;) {
        minimum result = {0};
        status = (limited ? limits_find : problem_find)(solver, &p, &all, &result);
        if (status >= WIGGLY_ERROR_ARGUMENT) return status;
        complete(solver, &p, &all);
        if (limited) limits_clamp(solver, &p, &all);
        all.error = 0;
        all.refinements = result.sweeps;
        status = judge(&all, result.error, status);
        if (status != WIGGLY_INEXACT || p.thorough || !(result.by_chain || problem_response_error(&p) > 0)) break;
        p.thorough = true;
    }
    all.total = curve->total, all.re = curve->re, all.im = curve->im; // the caller's
    all.knot = -1;
    *curve = all;
    return status;
}

wiggly_status solver_add_error(const wiggly_solver *solver, wiggly_curve *curve, double error, wiggly_status status)
{
    wiggly_curve all = with_arrays(solver, curve);
    status = judge(&all, error, status);
    curve->error = all.error;
    return status;
}

void solver_scale_back(const wiggly_solver *solver, const wiggly_desc *desc, wiggly_curve *curve)
{
    const double scale = solver->scale;
    if (scale != 1) {
        const wiggly_curve all = with_arrays(solver, curve);
        double *const arrays[] = {all.total, all.y, all.re, all.im};
        const size_t stride = all.stride ? all.stride : 1;
        for (int a = 0; a < 4; a++) {
            for (int i = 0; i < desc->samples && arrays[a]; i++) arrays[a][i] /= scale;
        }
        for (int k = 0; k < desc->knot_count; k++) { // a small one beside large ones may have left the range
            const wiggly_knot *knot = &desc->knots[k];
            if (!knot->still) all.total[knot->sample] = knot->value;
        }
        for (int i = 0; i < desc->samples && all.floats; i++) all.floats[(size_t)i * stride] = (float)all.total[i];
        for (int i = 0; i < 2; i++) curve->before[i] /= scale;
    }
    if (curve->slope) evaluate_slopes(desc, curve);
}

wiggly_status solver_solve(wiggly_solver *solver, const wiggly_desc *desc, wiggly_curve *curve)
{
    if (desc->samples == 0 && desc->knot_count == 0) {
        curve->samples = curve->first = curve->refinements = 0;
        curve->error = curve->before[0] = curve->before[1] = 0;
        curve->step = desc->step, curve->mode = desc->mode, curve->start = desc->start;
        curve->knot = -1;
        return WIGGLY_OK;
    }
    wiggly_status status = problem_check(solver, desc, &curve->knot);
    if (status != WIGGLY_OK) return status;
    wiggly_desc scaled = *desc;
    scale_values(solver, scale_for(scale_size(solver, desc)), &scaled);
    status = solver_solve_scaled(solver, &scaled, curve);
    if (status < WIGGLY_ERROR_ARGUMENT) solver_scale_back(solver, desc, curve);
    return status;
}

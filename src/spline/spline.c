/// Solves one spline by the chain or by the band; if the problem is singular, solves the nearest one that is not (docs/mathematics.md, last
/// rule of Constraints).
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

/// Straight lines between knots, shown if the system is singular in any case.
static void join_knots(wiggly_solver *solver, const problem *p)
{
    system_rows *rows = &solver->rows;
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
        if (result->solved && is_told && !(may_be_singular && (result->lost || problem_blew_up(p, curve))))
            return status;
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
    join_knots(solver, p);
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

/// Copies the caller's curve with the members that its version has.
static wiggly_curve read_curve(const wiggly_curve *curve)
{
    if (curve->size >= sizeof *curve) return *curve;
    wiggly_curve own = {0};
    memcpy(&own, curve, curve->size);
    return own;
}

/// The curve with the solver's own arrays for missing ones; they are unused once x is found.
static wiggly_curve with_arrays(const wiggly_solver *solver, const wiggly_curve *curve)
{
    wiggly_curve all = read_curve(curve);
    if (!all.re) all.re = solver->re;
    if (!all.im) all.im = solver->im;
    if (!all.total) all.total = solver->rows.jet;
    return all;
}

/// Restores the caller's arrays.
static void keep_asked(wiggly_curve *curve, wiggly_curve all)
{
    all.total = curve->total, all.re = curve->re, all.im = curve->im;
    all.knot = -1;
    if (curve->size >= sizeof *curve) {
        *curve = all;
    } else {
        memcpy(curve, &all, curve->size);
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
        solver_run_forward(solver, 1);
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
        problem_complete(solver, &p, &all);
        if (limited) limits_clamp(solver, &p, &all);
        all.error = 0;
        all.refinements = result.sweeps;
        status = judge(&all, result.error, status);
        if (status != WIGGLY_INEXACT || p.thorough || !(result.by_chain || problem_response_error(&p) > 0)) break;
        p.thorough = true;
    }
    keep_asked(curve, all);
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
        wiggly_curve all = read_curve(curve);
        all.samples = all.first = all.refinements = 0;
        all.error = all.before[0] = all.before[1] = 0;
        all.step = desc->step, all.mode = desc->mode, all.start = desc->start;
        keep_asked(curve, all);
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

/// The rules around the minimisation (docs/mathematics.md, Constraints): where the domain starts, what is fixed, what is implied,
/// and what to do where the problem has no single answer.
#include "spline/problem.h"
#include <limits.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

static const double implied_stiffness = 1000;
static const double fallback_calm = 0.05;

wiggly_desc wiggly_default_desc(void)
{
    return (wiggly_desc){.samples = 1, .step = 1.0 / 24, .bandwidth.value = 0.1, .calm = 1};
}

static bool param_is_finite(wiggly_param param, int samples)
{
    if (!param.track) return isfinite(param.value);
    for (int i = 0; i < samples; i++) {
        if (!isfinite(param.track[i])) return false;
    }
    return true;
}

static wiggly_status check_desc(const wiggly_solver *solver, const wiggly_desc *desc)
{
    if (!solver || !desc) return WIGGLY_ERROR_ARGUMENT;
    if (desc->samples < 1 || desc->knot_count < 0 || (desc->knot_count > 0 && !desc->knots))
        return WIGGLY_ERROR_ARGUMENT;
    if (desc->samples > solver->samples || desc->knot_count > solver->knots) return WIGGLY_ERROR_CAPACITY;
    if (desc->mode == WIGGLY_COMPLEX && desc->spring_friction) return WIGGLY_ERROR_SPRING;
    if (desc->start == WIGGLY_LOOP && desc->samples < 2) return WIGGLY_ERROR_LOOP;
    if (!(desc->step > 0 && desc->step < INFINITY) || !(desc->calm >= 0 && desc->calm <= 1))
        return WIGGLY_ERROR_NUMBER;
    for (const desc_member *m = desc_members; m->name; m++) {
        if (m->kind == DESC_PARAM && !param_is_finite(*desc_param(desc, m), desc->samples))
            return WIGGLY_ERROR_NUMBER;
    }
    for (int i = 0; desc->equilibrium.track && i < desc->samples; i++) {
        if (!(fabs(desc->equilibrium.track[i]) <= LARGEST_VALUE)) return WIGGLY_ERROR_NUMBER;
    }
    if (!(fabs(desc->equilibrium.value) <= LARGEST_VALUE)) return WIGGLY_ERROR_NUMBER;
    for (int k = 0; k < desc->knot_count; k++) {
        const wiggly_knot *knot = &desc->knots[k];
        if (!(fabs(knot->value) <= LARGEST_VALUE)) return WIGGLY_ERROR_NUMBER;
        if (knot->has_slope && !(isfinite(knot->slope) && knot->stiffness > 0 && knot->stiffness < INFINITY)) {
            return WIGGLY_ERROR_NUMBER;
        }
    }
    return WIGGLY_OK;
}

/// Fills `order`; knots that are in order already, as a document's are, cost one look each.
static wiggly_status order_knots(wiggly_solver *solver, const wiggly_desc *desc)
{
    int end = desc->samples - (desc->start == WIGGLY_LOOP ? 1 : 0);
    bool ordered = true;
    for (int k = 0; k < desc->knot_count; k++) {
        int sample = desc->knots[k].sample;
        if (sample < 0 || sample >= end) return WIGGLY_ERROR_KNOT;
        ordered = ordered && (k == 0 || sample > desc->knots[k - 1].sample);
        solver->order[k] = k;
    }
    if (ordered) return WIGGLY_OK;
    for (int i = 0; i < desc->samples; i++) solver->knot_at[i] = -1;
    for (int k = 0; k < desc->knot_count; k++) {
        if (solver->knot_at[desc->knots[k].sample] >= 0) return WIGGLY_ERROR_KNOT;
        solver->knot_at[desc->knots[k].sample] = k;
    }
    for (int i = 0, n = 0; i < desc->samples; i++) {
        if (solver->knot_at[i] >= 0) solver->order[n++] = solver->knot_at[i];
    }
    return WIGGLY_OK;
}

static void set_domain(wiggly_solver *solver, problem *p)
{
    const wiggly_desc *desc = p->desc;
    p->earliest = desc->knot_count > 0 ? desc->knots[solver->order[0]].sample : -1;
    bool on_rest = p->earliest == 0 || p->earliest == 1;
    p->start = desc->start == WIGGLY_REST && on_rest ? WIGGLY_FREE : desc->start;
    p->first = p->start == WIGGLY_FREE && p->earliest > 0 ? p->earliest : 0;
    system_rows *rows = &solver->rows;
    rows->loop = p->start == WIGGLY_LOOP;
    rows->is_complex = desc->mode == WIGGLY_COMPLEX;
    rows->count = p->count = rows->loop ? desc->samples - 1 : desc->samples - p->first;
}

static double y_at(const problem *p, const system_rows *rows, int k)
{
    if (rows->loop) k = (k + rows->count) % rows->count;
    return problem_y(p, p->first + k);
}

/// Coefficients, drive and imaginary weights of every row.
static void set_filter(wiggly_solver *solver, const problem *p)
{
    chain_forget(&solver->chain); // its tables lie where the matrix will be
    system_rows *rows = &solver->rows;
    double floor = rows->loop ? LEAST_DAMPING * p->calm : 0;
    bool constant = poles_are_constant(p->desc), weighted = p->start != WIGGLY_REST || p->desc->knot_count > 0;
    double intervals = rows->loop ? rows->count : rows->count - 1, t = intervals * p->desc->step, weight = 0;
    for (int k = 0; k < rows->count; k++) {
        if (k == 0 || !constant) {
            poles at = poles_at(p->desc, p->first + k, floor);
            rows->at[k] = poles_coefficients(&at, p->desc->step);
            weight = weighted ? 1 / (pow(intervals, 4) * (1 + pow(at.natural * t, 8))) : 0;
        } else {
            rows->at[k] = rows->at[0];
        }
        rows->im_weight[k] = weight;
        bool inner = rows->loop || (k > 0 && k < rows->count - 1);
        double bend = 0;
        if (inner && p->desc->equilibrium.track) {
            double here = y_at(p, rows, k);
            bend = (y_at(p, rows, k + 1) - here) - (here - y_at(p, rows, k - 1));
        }
        rows->drive[k] = (cplx){rows->at[k].g.re * bend, rows->at[k].g.im * bend};
    }
}

static void add_slope(system_rows *rows, const problem *p, int sample, double slope, double stiffness)
{
    int k = sample - p->first;
    bool last = !rows->loop && k == rows->count - 1;
    slope_row row = {.p = last ? k - 1 : k, .weight = fmin(stiffness * p->desc->step, STIFFEST)};
    row.q = rows->loop ? (row.p + 1) % rows->count : row.p + 1;
    row.target = p->desc->step * slope - (y_at(p, rows, row.q) - y_at(p, rows, row.p));
    if (row.p >= 0) rows->slopes[rows->slope_count++] = row;
}

static void set_start(wiggly_solver *solver, problem *p)
{
    start_cost *start = &solver->rows.start;
    *start = (start_cost){0};
    if (p->start == WIGGLY_FREE) {
        if (poles_are_constant(p->desc)) {
            *start = solver_filter(solver, p->desc)->start;
        } else {
            poles at = poles_at(p->desc, p->first, LEAST_DAMPING);
            *start = poles_start_cost(&at, p->desc->step);
        }
        start->h00 *= p->calm;
        start->d *= p->calm;
    }
    p->free_end = p->start == WIGGLY_FREE && !(start->h00 > 0);
}

/// Slopes (also implied ones) and fixed unknowns; x holds the fixed values and 0 elsewhere.
static void set_constraints(wiggly_solver *solver, const problem *p)
{
    system_rows *rows = &solver->rows;
    rows->slope_count = 0;
    int width = rows->is_complex ? 2 : 1;
    memset(rows->x, 0, sizeof(double) * (size_t)(width * rows->count));
    memset(rows->fixed, 0, (size_t)rows->count);
    if (p->start == WIGGLY_REST) rows->fixed[0] = rows->fixed[1] = FIXED_RE | FIXED_IM;
    for (int n = 0; n < p->desc->knot_count; n++) {
        const wiggly_knot *knot = &p->desc->knots[solver->order[n]];
        int k = knot->sample - p->first;
        rows->fixed[k] |= FIXED_RE;
        rows->x[width * k] = knot->value - problem_y(p, knot->sample);
        if (knot->has_slope) add_slope(rows, p, knot->sample, knot->slope, knot->stiffness);
    }
    bool alone = p->desc->knot_count == 1 && rows->slope_count == 0;
    if (p->level || (alone && p->free_end)) add_slope(rows, p, p->earliest, 0, implied_stiffness);
}

/// x of the system into the curve's arrays.
static void unpack(const wiggly_solver *solver, const problem *p, wiggly_curve *curve)
{
    const system_rows *rows = &solver->rows;
    double *re = curve->re + p->first, *im = curve->im + p->first;
    for (int k = 0; k < rows->count; k++) {
        re[k] = rows->x[rows->is_complex ? 2 * k : k];
        if (rows->is_complex) im[k] = rows->x[2 * k + 1];
    }
}

/// x into the curve: by the chain where it serves, else by refinement.
static minimum attempt(wiggly_solver *solver, problem *p, wiggly_curve *curve)
{
    minimum result = {.solved = true};
    set_start(solver, p);
    if (problem_fits_chain(solver, p) && problem_solve_chain(solver, p, curve->re + p->first, curve->im + p->first)) {
        result.error = solver->chain.error;
        result.by_chain = true;
        return result;
    }
    set_filter(solver, p);
    set_constraints(solver, p);
    result = solver_minimise(solver);
    unpack(solver, p, curve);
    return result;
}

/// Knots joined by straight lines: what is shown where the system is singular whatever was tried.
static void join_knots(wiggly_solver *solver, const problem *p)
{
    system_rows *rows = &solver->rows;
    int width = rows->is_complex ? 2 : 1, before = -1;
    set_constraints(solver, p);
    for (int k = 0; k < rows->count; k++) {
        if (!(rows->fixed[k] & FIXED_RE)) continue;
        for (int i = before + 1; i < k; i++) {
            double from = before < 0 ? rows->x[width * k] : rows->x[width * before];
            double u = (double)(i - before) / (k - before); // each part by itself: the difference might overflow
            rows->x[width * i] = from * (1 - u) + rows->x[width * k] * u;
        }
        before = k;
    }
    for (int i = before + 1; before >= 0 && i < rows->count; i++) rows->x[width * i] = rows->x[width * before];
}

/// Solves, and where the problem is singular as asked, solves the nearest one that is not (docs/mathematics.md, last rule of Constraints).
static wiggly_status minimise_safely(wiggly_solver *solver, problem *p, wiggly_curve *curve, minimum *result)
{
    wiggly_status status = WIGGLY_OK;
    for (;;) {
        *result = attempt(solver, p, curve);
        bool may_be_singular = p->start == WIGGLY_LOOP ? p->calm == 0 : p->free_end;
        if (result->solved &&
            !(may_be_singular &&
              (result->weak || problem_blew_up(p, result->by_chain ? &solver->chain : NULL, curve))))
            return status;
        if (solver_must_stop(solver->stop)) break;
        if (may_be_singular && p->calm == 0) {
            p->calm = fallback_calm;
            status = WIGGLY_CALMED;
        } else if (may_be_singular && p->free_end && p->earliest >= 0 && !p->level) {
            p->level = true;
            status = WIGGLY_LEVELLED;
        } else {
            break;
        }
    }
    join_knots(solver, p);
    unpack(solver, p, curve);
    *result = (minimum){.solved = true};
    return WIGGLY_SINGULAR;
}

/// Domains too short for a jet row (M < 3) or without anything that moves: each x is its knot's, else the earliest knot's, else 0.
static void solve_short(wiggly_solver *solver, const problem *p)
{
    system_rows *rows = &solver->rows;
    const wiggly_desc *desc = p->desc;
    int width = rows->is_complex ? 2 : 1;
    double other = p->earliest >= 0 ? desc->knots[solver->order[0]].value - problem_y(p, p->earliest) : 0;
    memset(rows->x, 0, sizeof(double) * (size_t)(width * rows->count));
    for (int k = 0; k < rows->count; k++) rows->x[width * k] = other;
    for (int n = 0; n < desc->knot_count; n++) {
        rows->x[width * (desc->knots[n].sample - p->first)] =
            desc->knots[n].value - problem_y(p, desc->knots[n].sample);
    }
}

/// True where nothing moves x: no knots, and no drive that could.
static bool is_still(const problem *p)
{
    if (p->desc->knot_count > 0) return false;
    if (p->start == WIGGLY_FREE) return true;
    if (!p->desc->equilibrium.track) return true;
    if (p->start == WIGGLY_REST) return false;
    bool moves = false, rings = false;
    for (int i = 0; i < p->desc->samples - 1; i++) {
        moves = moves || p->y[i] != p->y[0];
        rings = rings || poles_at(p->desc, i, 0).natural > 0;
    }
    return !moves || !rings;
}

static double tolerance(wiggly_mode mode) { return mode == WIGGLY_CUBIC ? 1e-9 : 1e-8; }

/// Error relative to the larger of the total's range and its largest magnitude.
static wiggly_status judge(wiggly_curve *curve, const minimum *result, wiggly_status status)
{
    curve->error = 0;
    if (result->error > 0) {
        double low = curve->total[0], high = low;
        for (int i = 1; i < curve->samples; i++) low = fmin(low, curve->total[i]), high = fmax(high, curve->total[i]);
        curve->error = result->error / fmax(high - low, fmax(fabs(low), fabs(high)));
    }
    curve->refinements = result->sweeps > 1 ? result->sweeps - 1 : 0;
    return status == WIGGLY_OK && !(curve->error <= tolerance(curve->mode)) ? WIGGLY_INEXACT : status;
}

wiggly_status problem_pose(wiggly_solver *solver, const wiggly_desc *desc, double *y, problem *p)
{
    wiggly_status status = check_desc(solver, desc);
    if (status == WIGGLY_OK) status = order_knots(solver, desc);
    if (status != WIGGLY_OK) return status;
    *p = (problem){.desc = desc, .calm = desc->calm};
    if (desc->equilibrium.track) {
        memmove(y, desc->equilibrium.track, sizeof *y * (size_t)desc->samples);
        if (desc->start == WIGGLY_LOOP) y[desc->samples - 1] = y[0];
        p->y = y;
    }
    set_domain(solver, p);
    set_start(solver, p);
    return WIGGLY_OK;
}

wiggly_status solver_describe(wiggly_solver *solver, const wiggly_desc *desc, double *y)
{
    problem p;
    wiggly_status status = problem_pose(solver, desc, y, &p);
    if (status != WIGGLY_OK) return status;
    for (int i = 0; i < desc->samples; i++) y[i] = problem_y(&p, i);
    set_filter(solver, &p);
    set_constraints(solver, &p);
    system_matrix(&solver->rows, &solver->matrix);
    return WIGGLY_OK;
}

/// The curve with the solver's own arrays in place of missing ones: they are free once x is found.
static wiggly_curve with_arrays(const wiggly_solver *solver, const wiggly_curve *curve)
{
    wiggly_curve all = *curve;
    if (!all.re) all.re = solver->rows.gradient;
    if (!all.im) all.im = solver->rows.gradient + solver->samples;
    if (!all.total) all.total = solver->rows.jet;
    return all;
}

/// Back to the caller's arrays.
static void keep_asked(wiggly_curve *curve, wiggly_curve all)
{
    all.total = curve->total, all.re = curve->re, all.im = curve->im;
    *curve = all;
}

/// Whether nothing is to be minimised: too short, nothing moves, or nothing constrains.
static bool is_plain(const problem *p)
{
    return p->count < 3 || is_still(p) || (p->start == WIGGLY_REST && p->desc->knot_count == 0);
}

static void solve_plain(wiggly_solver *solver, const problem *p, wiggly_curve *curve)
{
    if (p->count < 3 || is_still(p)) {
        solve_short(solver, p);
    } else {
        set_filter(solver, p);
        solver_run_forward(solver);
    }
    unpack(solver, p, curve);
}

wiggly_status wiggly_solve(wiggly_solver *solver, const wiggly_desc *desc, wiggly_curve *curve)
{
    if (!solver || !curve) return WIGGLY_ERROR_ARGUMENT;
    problem p;
    wiggly_curve all = with_arrays(solver, curve);
    wiggly_status status = problem_pose(solver, desc, all.y ? all.y : solver->y, &p);
    if (status != WIGGLY_OK) return status;
    minimum result = {.solved = true};
    if (is_plain(&p)) {
        solve_plain(solver, &p, &all);
    } else {
        status = minimise_safely(solver, &p, &all, &result);
    }
    problem_complete(solver, &p, &all);
    status = judge(&all, &result, status);
    keep_asked(curve, all);
    return status;
}

bool problem_pose_for_group(wiggly_solver *solver, const wiggly_desc *desc, problem *p)
{
    return problem_pose(solver, desc, solver->y, p) == WIGGLY_OK && !is_plain(p) && problem_fits_chain(solver, p);
}

bool problem_finish(wiggly_solver *solver, const problem *p, wiggly_curve *curve)
{
    wiggly_curve all = with_arrays(solver, curve);
    if (!chain_fill(&solver->chain, all.re + p->first, all.im + p->first)) return false;
    if (p->free_end && problem_blew_up(p, &solver->chain, &all)) return false;
    problem_complete(solver, p, &all);
    all.error = 0;
    all.refinements = 0;
    keep_asked(curve, all);
    return true;
}

// The rules around the minimisation (spec: "Energy", "Constraints"): where the domain starts, what is fixed, what is implied,
// and what to do where the problem has no single answer.
#include "spline/solver.h"
#include <limits.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

static const double implied_stiffness = 1000;
static const double fallback_calm = 0.05;
static const double least_damping = 0.05; ///< of the start's cost, and times calm of a loop
static const double blow_up = 1e4;
static const double stiffest =
    1e20; ///< a slope row heavier than this is met to the last digit anyway, and could overflow

wiggly_desc wiggly_default_desc(void)
{
    return (wiggly_desc){.samples = 1, .step = 1.0 / 24, .bandwidth.value = 0.1, .calm = 1};
}

/// Bytes per sample of everything that carve() hands out; keep both in step.
enum {
    DOUBLES_PER_SAMPLE = 3 + 4 + 4 + 2 * BORDER_MAX + 1 + 2 + 2 + 4,
    BYTES_PER_SAMPLE = (int)(DOUBLES_PER_SAMPLE * sizeof(double) + sizeof(coefficients) + sizeof(cplx) + sizeof(int) +
                             sizeof(unsigned char)),
};

size_t wiggly_memsize(int samples, int knots)
{
    if (samples < 1 || knots < 0) return 0;
    size_t per_sample, per_knot, sum;
    if (__builtin_mul_overflow((size_t)samples, (size_t)BYTES_PER_SAMPLE, &per_sample) ||
        __builtin_mul_overflow((size_t)knots + 1, sizeof(slope_row), &per_knot) ||
        __builtin_add_overflow(per_sample, per_knot, &sum) ||
        __builtin_add_overflow(sum, sizeof(wiggly_solver) + 64, &sum)) {
        return 0;
    }
    return sum;
}

static void *take(unsigned char **at, size_t bytes)
{
    void *p = *at;
    *at += bytes;
    return p;
}

/// Largest alignment first, so that nothing needs padding.
static void carve(wiggly_solver *solver)
{
    unsigned char *at = (unsigned char *)(solver + 1);
    size_t n = (size_t)solver->samples;
    system_rows *rows = &solver->rows;
    pentadiagonal *m = &solver->matrix;
    rows->at = take(&at, n * sizeof(coefficients));
    rows->drive = take(&at, n * sizeof(cplx));
    m->diagonal = take(&at, 3 * n * sizeof(double));
    m->below = take(&at, 4 * n * sizeof(double));
    m->below2 = take(&at, 4 * n * sizeof(double));
    m->border = take(&at, 2 * BORDER_MAX * n * sizeof(double));
    rows->im_weight = take(&at, n * sizeof(double));
    rows->x = take(&at, 2 * n * sizeof(double));
    rows->gradient = take(&at, 2 * n * sizeof(double));
    rows->jet = take(&at, 4 * n * sizeof(double));
    rows->slopes = take(&at, ((size_t)solver->knots + 1) * sizeof(slope_row));
    solver->knot_at = take(&at, n * sizeof(int));
    rows->fixed = take(&at, n);
}

wiggly_status wiggly_create_at(void *memory, size_t size, int samples, int knots, wiggly_solver **solver)
{
    size_t needed = wiggly_memsize(samples, knots);
    if (!memory || !solver || !needed || (uintptr_t)memory % sizeof(double) != 0) return WIGGLY_ERROR_ARGUMENT;
    if (size < needed) return WIGGLY_ERROR_MEMORY;
    memset(memory, 0, needed);
    *solver = memory;
    (*solver)->samples = samples;
    (*solver)->knots = knots;
    carve(*solver);
    return WIGGLY_OK;
}

wiggly_status wiggly_create(int samples, int knots, wiggly_solver **solver)
{
    size_t size = wiggly_memsize(samples, knots);
    if (!solver || !size) return WIGGLY_ERROR_ARGUMENT;
    void *memory = malloc(size);
    if (!memory) return WIGGLY_ERROR_MEMORY;
    wiggly_status status = wiggly_create_at(memory, size, samples, knots, solver);
    (*solver)->owned = true;
    return status;
}

void wiggly_destroy(wiggly_solver *solver)
{
    if (solver && solver->owned) free(solver);
}

static bool param_is_finite(wiggly_param param, int samples)
{
    if (!param.track) return isfinite(param.value);
    for (int i = 0; i < samples; i++) {
        if (!isfinite(param.track[i])) return false;
    }
    return true;
}

static wiggly_status check_desc(const wiggly_solver *solver, const wiggly_desc *desc, const wiggly_curve *curve)
{
    if (!solver || !desc || !curve || !curve->total || !curve->y || !curve->re || !curve->im || !curve->omega) {
        return WIGGLY_ERROR_ARGUMENT;
    }
    if (desc->samples < 1 || desc->knot_count < 0 || (desc->knot_count > 0 && !desc->knots))
        return WIGGLY_ERROR_ARGUMENT;
    if (desc->samples > solver->samples || desc->knot_count > solver->knots) return WIGGLY_ERROR_CAPACITY;
    if (desc->mode == WIGGLY_COMPLEX && desc->spring_friction) return WIGGLY_ERROR_SPRING;
    if (desc->start == WIGGLY_LOOP && desc->samples < 2) return WIGGLY_ERROR_LOOP;
    if (!(desc->step > 0 && desc->step < INFINITY) || !(desc->calm >= 0 && desc->calm <= 1))
        return WIGGLY_ERROR_NUMBER;
    const wiggly_param *params[] = {&desc->frequency, &desc->damping,  &desc->bandwidth,
                                    &desc->spring,    &desc->friction, &desc->equilibrium};
    for (size_t p = 0; p < sizeof params / sizeof *params; p++) {
        if (!param_is_finite(*params[p], desc->samples)) return WIGGLY_ERROR_NUMBER;
    }
    for (int k = 0; k < desc->knot_count; k++) {
        const wiggly_knot *knot = &desc->knots[k];
        if (!isfinite(knot->value)) return WIGGLY_ERROR_NUMBER;
        if (knot->has_slope && !(isfinite(knot->slope) && knot->stiffness > 0 && knot->stiffness < INFINITY)) {
            return WIGGLY_ERROR_NUMBER;
        }
    }
    return WIGGLY_OK;
}

/// Fills knot_at for the description's samples.
static wiggly_status place_knots(wiggly_solver *solver, const wiggly_desc *desc)
{
    int end = desc->samples - (desc->start == WIGGLY_LOOP ? 1 : 0);
    for (int i = 0; i < desc->samples; i++) solver->knot_at[i] = -1;
    for (int k = 0; k < desc->knot_count; k++) {
        int sample = desc->knots[k].sample;
        if (sample < 0 || sample >= end || solver->knot_at[sample] >= 0) return WIGGLY_ERROR_KNOT;
        solver->knot_at[sample] = k;
    }
    return WIGGLY_OK;
}

/// One solve in progress: the description with the rules of the start applied.
typedef struct problem {
    const wiggly_desc *desc;
    const double *y; ///< of the whole domain; a loop's last is its first
    wiggly_start start;
    double calm;
    int first;     ///< sample of the system's row 0
    int earliest;  ///< sample of the earliest knot, or -1
    bool level;    ///< a level slope is implied at the earliest knot
    bool free_end; ///< c·H = 0
} problem;

static double range_of(const double *values, int count)
{
    double low = values[0], high = values[0];
    for (int i = 1; i < count; i++) {
        low = fmin(low, values[i]);
        high = fmax(high, values[i]);
    }
    return high - low;
}

static void set_domain(wiggly_solver *solver, problem *p)
{
    const wiggly_desc *desc = p->desc;
    p->earliest = -1;
    for (int i = 0; i < desc->samples && p->earliest < 0 && desc->knot_count > 0; i++) {
        if (solver->knot_at[i] >= 0) p->earliest = i;
    }
    bool on_rest = p->earliest == 0 || (desc->samples > 1 && solver->knot_at[1] >= 0);
    p->start = desc->start == WIGGLY_REST && on_rest ? WIGGLY_FREE : desc->start;
    p->first = p->start == WIGGLY_FREE && p->earliest > 0 ? p->earliest : 0;
    system_rows *rows = &solver->rows;
    rows->loop = p->start == WIGGLY_LOOP;
    rows->is_complex = desc->mode == WIGGLY_COMPLEX;
    rows->count = rows->loop ? desc->samples - 1 : desc->samples - p->first;
}

static double y_at(const problem *p, const system_rows *rows, int k)
{
    if (rows->loop) k = (k + rows->count) % rows->count;
    return p->y[p->first + k];
}

/// Coefficients, drive and imaginary weights of every row.
static void set_filter(wiggly_solver *solver, const problem *p)
{
    system_rows *rows = &solver->rows;
    double floor = rows->loop ? least_damping * p->calm : 0;
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
    slope_row row = {.p = last ? k - 1 : k, .weight = fmin(stiffness * p->desc->step, stiffest)};
    row.q = rows->loop ? (row.p + 1) % rows->count : row.p + 1;
    row.target = p->desc->step * slope - (y_at(p, rows, row.q) - y_at(p, rows, row.p));
    if (row.p >= 0) rows->slopes[rows->slope_count++] = row;
}

/// Start cost, slopes (also implied ones) and fixed unknowns; x holds the fixed values and 0 elsewhere.
static void set_constraints(wiggly_solver *solver, problem *p)
{
    system_rows *rows = &solver->rows;
    rows->start = (start_cost){0};
    if (p->start == WIGGLY_FREE) {
        poles at = poles_at(p->desc, p->first, least_damping);
        rows->start = poles_start_cost(&at, p->desc->step);
        rows->start.h00 *= p->calm;
        rows->start.d *= p->calm;
    }
    p->free_end = p->start == WIGGLY_FREE && !(rows->start.h00 > 0);
    rows->slope_count = 0;
    int width = rows->is_complex ? 2 : 1;
    memset(rows->x, 0, sizeof(double) * (size_t)(width * rows->count));
    memset(rows->fixed, 0, (size_t)rows->count);
    if (p->start == WIGGLY_REST) rows->fixed[0] = rows->fixed[1] = FIXED_RE | FIXED_IM;
    for (int k = 0; k < rows->count; k++) {
        int index = solver->knot_at[p->first + k];
        if (index < 0) continue;
        const wiggly_knot *knot = &p->desc->knots[index];
        rows->fixed[k] |= FIXED_RE;
        rows->x[width * k] = knot->value - p->y[p->first + k];
        if (knot->has_slope) add_slope(rows, p, p->first + k, knot->slope, knot->stiffness);
    }
    bool alone = p->desc->knot_count == 1 && rows->slope_count == 0;
    if (p->level || (alone && p->free_end)) add_slope(rows, p, p->earliest, 0, implied_stiffness);
}

/// Largest of |value − y| over knots, T·|slope| over slopes, and y's range: what max |x| is measured against.
static double problem_scale(const system_rows *rows, const problem *p)
{
    double scale = range_of(p->y, p->desc->samples);
    double t = (rows->loop ? rows->count : rows->count - 1) * p->desc->step;
    for (int k = 0; k < p->desc->knot_count; k++) {
        const wiggly_knot *knot = &p->desc->knots[k];
        scale = fmax(scale, fabs(knot->value - p->y[knot->sample]));
        if (knot->has_slope) scale = fmax(scale, t * fabs(knot->slope));
    }
    return scale;
}

static minimum attempt(wiggly_solver *solver, problem *p)
{
    set_filter(solver, p);
    set_constraints(solver, p);
    return solver_minimise(solver);
}

/// Knots joined by straight lines: what is shown where the system is singular whatever was tried.
static void join_knots(wiggly_solver *solver, const problem *p)
{
    system_rows *rows = &solver->rows;
    int width = rows->is_complex ? 2 : 1, before = -1;
    set_constraints(
        solver,
        &(problem){.desc = p->desc, .y = p->y, .start = p->start, .first = p->first, .earliest = p->earliest});
    for (int k = 0; k < rows->count; k++) {
        if (!(rows->fixed[k] & FIXED_RE)) continue;
        for (int i = before + 1; i < k; i++) {
            double from = before < 0 ? rows->x[width * k] : rows->x[width * before];
            rows->x[width * i] = from + (rows->x[width * k] - from) * (i - before) / (k - before);
        }
        before = k;
    }
    for (int i = before + 1; before >= 0 && i < rows->count; i++) rows->x[width * i] = rows->x[width * before];
}

/// Solves, and where the problem is singular as asked, solves the nearest one that is not (spec: last rule of "Constraints").
static wiggly_status minimise_safely(wiggly_solver *solver, problem *p, minimum *result)
{
    double scale = problem_scale(&solver->rows, p);
    wiggly_status status = WIGGLY_OK;
    for (;;) {
        *result = attempt(solver, p);
        bool may_be_singular = p->start == WIGGLY_LOOP ? p->calm == 0 : p->free_end;
        bool blown_up = scale > 0 && result->largest > blow_up * scale;
        if (result->solved && !(may_be_singular && (result->weak || blown_up))) return status;
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
    *result = (minimum){.solved = true};
    return WIGGLY_SINGULAR;
}

/// Domains too short for a jet row (M < 3): each x is its knot's, else the earliest knot's, else 0.
static void solve_short(wiggly_solver *solver, const problem *p)
{
    system_rows *rows = &solver->rows;
    int width = rows->is_complex ? 2 : 1;
    for (int k = 0; k < rows->count; k++) {
        int index = solver->knot_at[p->first + k];
        int source = index >= 0 ? p->first + k : p->earliest;
        rows->x[width * k] = source >= 0 ? p->desc->knots[solver->knot_at[source]].value - p->y[source] : 0;
        if (rows->is_complex) rows->x[2 * k + 1] = 0;
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

static void write_curve(const wiggly_solver *solver, const problem *p, wiggly_curve *curve)
{
    const system_rows *rows = &solver->rows;
    const wiggly_desc *desc = p->desc;
    int width = rows->is_complex ? 2 : 1;
    bool constant = poles_are_constant(desc);
    double floor = rows->loop ? least_damping * p->calm : 0, omega = 0;
    for (int i = 0; i < desc->samples; i++) {
        int k = i < p->first ? 0 : rows->loop && i == rows->count ? 0 : i - p->first;
        curve->re[i] = rows->x[width * k];
        curve->im[i] = rows->is_complex ? rows->x[width * k + 1] : 0;
        int index = solver->knot_at[i];
        curve->total[i] = index >= 0 ? desc->knots[index].value : curve->y[i] + curve->re[i];
        if (i == 0 || !constant) omega = poles_at(desc, i, floor).centre;
        curve->omega[i] = omega;
    }
    if (rows->loop) curve->total[rows->count] = curve->total[0];
    curve->samples = desc->samples;
    curve->step = desc->step;
    curve->first = p->first;
    curve->mode = desc->mode;
    curve->start = p->start;
}

static double tolerance(wiggly_mode mode) { return mode == WIGGLY_CUBIC ? 1e-9 : 1e-8; }

/// Error relative to the larger of the total's range and its largest magnitude.
static wiggly_status judge(wiggly_curve *curve, const minimum *result, wiggly_status status)
{
    double magnitude = range_of(curve->total, curve->samples);
    for (int i = 0; i < curve->samples; i++) magnitude = fmax(magnitude, fabs(curve->total[i]));
    curve->error = result->error > 0 ? result->error / magnitude : 0;
    curve->refinements = result->sweeps > 1 ? result->sweeps - 1 : 0;
    return status == WIGGLY_OK && !(curve->error <= tolerance(curve->mode)) ? WIGGLY_INEXACT : status;
}

wiggly_status wiggly_solve(wiggly_solver *solver, const wiggly_desc *desc, wiggly_curve *curve)
{
    wiggly_status status = check_desc(solver, desc, curve);
    if (status == WIGGLY_OK) status = place_knots(solver, desc);
    if (status != WIGGLY_OK) return status;
    for (int i = 0; i < desc->samples; i++) {
        curve->y[i] = desc->equilibrium.track ? desc->equilibrium.track[i] : desc->equilibrium.value;
    }
    if (desc->start == WIGGLY_LOOP) curve->y[desc->samples - 1] = curve->y[0];
    problem p = {.desc = desc, .y = curve->y, .calm = desc->calm};
    set_domain(solver, &p);
    minimum result = {.solved = true};
    if (is_still(&p)) {
        memset(solver->rows.x, 0, sizeof(double) * (size_t)(solver->rows.count * (solver->rows.is_complex ? 2 : 1)));
    } else if (solver->rows.count < 3) {
        solve_short(solver, &p);
    } else if (p.start == WIGGLY_REST && desc->knot_count == 0) {
        set_filter(solver, &p);
        solver_run_forward(solver);
    } else {
        status = minimise_safely(solver, &p, &result);
    }
    write_curve(solver, &p, curve);
    return judge(curve, &result, status);
}

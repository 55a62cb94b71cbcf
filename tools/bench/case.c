/// One spline of the benchmark: compares it with LAPACK on the squared system, and times it.
#include "base/need.h"
#include "base/progress.h"
#include "bench/bench.h"
#include "spline/problem.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double seconds_a_case = 0.2, seconds_beside = 0.05;
static const double agreement = 1e-6; ///< of the largest value; dpbsv's own error here is about 1e-9

/// Data of a case.
struct work {
    wiggly_solver *solver;
    wiggly_desc desc;
    wiggly_knot *knots; ///< its own
    wiggly_curve curve;
    double *about; ///< subtracted from the curve to get the system's x
    /// The system in LAPACK's lower band storage (column major) and its right side, before and after solving.
    double *band, *right, *solved_band, *solved;
    int unknowns, band_width;
};

enum { MOST_BAND = 5 };

static bool is_limited(const wiggly_desc *desc) { return desc->has_high; }

/// Limits, means of several and noise are no linear system, and gaps are many, so such a case is timed without LAPACK.
static bool is_alone(const wiggly_desc *desc) { return is_limited(desc) || desc->variation > 0 || desc->wind_up > 0; }

static void work_create(struct work *w, const wiggly_desc *desc, const char *name)
{
    const size_t n = (size_t)desc->samples, band = 2 * n * (MOST_BAND + 1);
    double *total = need_zeroed(6 * n + 2 * (band + 2 * n), sizeof *total);
    *w = (struct work){.desc = *desc, .about = total + 5 * n, .band = total + 6 * n};
    w->curve = (wiggly_curve){.size = sizeof(wiggly_curve),
                              .total = total,
                              .y = total + n,
                              .re = total + 2 * n,
                              .im = total + 3 * n,
                              .omega = total + 4 * n};
    w->right = w->band + band;
    w->solved_band = w->right + 2 * n;
    w->solved = w->solved_band + band;
    w->knots = need_zeroed((size_t)desc->knot_count, sizeof *w->knots);
    memcpy(w->knots, desc->knots, sizeof *w->knots * (size_t)desc->knot_count);
    w->desc.knots = w->knots;
    const int held = is_limited(desc) ? desc->samples : 0;
    const wiggly_status status = wiggly_create(desc->samples, desc->knot_count + held, &w->solver);
    if (status != WIGGLY_OK) bench_stop("%s: %s", name, wiggly_status_text(status));
}

static void work_destroy(struct work *w)
{
    wiggly_destroy(w->solver);
    free(w->knots);
    free(w->curve.total);
}

void bench_forget(wiggly_solver *solver)
{
    solver->filter.known = false;
    solver->wind.is_kept = false;
    solver->band.is_kept = false;
    chain_forget(&solver->chain);
}

/// The rows of the description, with knots fixed in x, as the solver's own minimiser would find them, and its matrix.
static void describe(struct work *w)
{
    problem p;
    wiggly_desc own;
    int knot;
    if (desc_read(&w->desc, &own) != WIGGLY_OK || problem_check(w->solver, &own, &knot) != WIGGLY_OK)
        bench_stop("the description is not valid");
    problem_pose(w->solver, &own, w->about, &p);
    for (int i = 0; i < own.samples; i++) w->about[i] = problem_about(&p, i);
    problem_set_rows(w->solver, &p);
    system_matrix(&w->solver->rows, &w->solver->band);
}

/// Whether an unknown is known.
static bool is_known(const system_rows *rows, int k, int part)
{
    return rows->fixed[k] & (part ? FIXED_IM : FIXED_RE);
}

/// The squared matrix, with 1 for known unknowns. The right side is the gradient at "knots fixed, 0 elsewhere", so the solution is x minus
/// the knots. Entries below the last row are never read.
static void fill_band(struct work *w)
{
    const band_matrix *m = &w->solver->band;
    const system_rows *rows = &w->solver->rows;
    describe(w);
    const int width = m->is_complex ? 2 : 1, kd = width == 2 ? MOST_BAND : 2;
    system_gradient(rows, NULL, NULL);
    w->unknowns = width * m->count;
    w->band_width = kd;
    memset(w->band, 0, sizeof(double) * (size_t)(w->unknowns * (kd + 1)));
    for (int unknown = 0; unknown < w->unknowns; unknown++) {
        const int k = unknown / width, part = unknown % width;
        const band_block block = band_block_at(m, k);
        const double *const from[3] = {block.d, block.e, block.f};
        double *column = w->band + (size_t)unknown * (size_t)(kd + 1);
        w->right[unknown] = 0;
        column[0] = 1;
        if (is_known(rows, k, part)) continue;
        w->right[unknown] = rows->gradient[2 * k + part];
        for (int by = 0; by < 3 && k + by < m->count; by++) {
            for (int row = by ? 0 : part; row < width; row++) {
                const double value = by ? from[by][2 * row + part] : from[0][row + part];
                if (!is_known(rows, k + by, row)) column[by * width + row - part] = value;
            }
        }
    }
}

/// Seconds for LAPACKE_dpbsv; NAN on failure.
static double run_dpbsv(struct work *w, const struct lapack *lapack)
{
    const int rows = w->band_width + 1;
    memcpy(w->solved_band, w->band, sizeof(double) * (size_t)w->unknowns * (size_t)rows);
    memcpy(w->solved, w->right, sizeof(double) * (size_t)w->unknowns);
    double start = clock_now();
    int info = lapack->dpbsv(LAPACK_COLUMNS_FIRST, 'L', w->unknowns, w->band_width, 1, w->solved_band, rows,
                             w->solved, w->unknowns);
    double time = clock_now() - start;
    return info == 0 ? time : NAN;
}

/// The curve with dpbsv's solution instead of ours: the largest difference, relative to the largest value; NAN on failure.
static double compare(struct work *w, const struct lapack *lapack)
{
    const system_rows *rows = &w->solver->rows;
    double worst = 0 * run_dpbsv(w, lapack), largest = 0;
    bool swings = w->desc.equilibrium.track && rows->is_complex && w->desc.passive == WIGGLY_OSCILLATOR;
    int width = rows->is_complex ? 2 : 1;
    for (int i = 0; i < width * rows->count; i++) {
        int sample = w->curve.first + i / width;
        bool im = i % width == 1;
        double ours = im ? w->curve.im[sample] : w->curve.total[sample];
        double theirs = w->solved[i] + rows->x[2 * (i / width) + i % width];
        if (!im) theirs += w->about[sample];
        if (im && swings) theirs += w->solver->response.im[sample];
        worst = fmax(worst, fabs(theirs - ours)) + 0 * theirs;
        largest = fmax(largest, fabs(ours));
    }
    return worst / largest;
}

/// Fastest of several runs of LAPACK, per sample.
static double time_lapack(struct work *w, const struct lapack *lapack)
{
    double best = INFINITY, end = clock_now() + seconds_beside;
    for (int run = 0; bench_goes_on(run, end); run++) {
        double time = run_dpbsv(w, lapack);
        if (!(time >= 0)) return NAN;
        if (run > 0) best = fmin(best, time);
    }
    return 1e9 * best / w->desc.samples;
}

/// wiggly_solve(), everything included.
static void time_solver(struct bench *bench, struct work *w, bool values_only, struct bench_result *result)
{
    int runs = 0;
    double end = clock_now() + seconds_a_case;
    for (; bench_goes_on(runs, end); runs++) {
        w->knots[w->desc.knot_count / 2].value += runs % 2 ? -1e-3 : 1e-3;
        if (!values_only) bench_forget(w->solver);
        double start = clock_now();
        wiggly_solve(w->solver, &w->desc, &w->curve);
        bench->times[runs] = clock_now() - start;
    }
    bench_sum_up(bench, runs, w->desc.samples, result);
}

void bench_case(struct bench *bench, const wiggly_desc *desc, bool values_only, struct bench_result *result)
{
    struct work w;
    work_create(&w, desc, result->name);
    wiggly_status status = wiggly_solve(w.solver, &w.desc, &w.curve);
    if (status != WIGGLY_OK) bench_stop("%s: %s", result->name, wiggly_status_text(status));
    result->samples = desc->samples;
    result->error = w.curve.error;
    // A loop's system has blocks in the corners, so it is not banded.
    if (!is_alone(desc) && bench->lapack.dpbsv && desc->start != WIGGLY_LOOP) {
        fill_band(&w);
        result->error = compare(&w, &bench->lapack);
        if (!(result->error <= agreement))
            bench_stop("%s: differs from LAPACKE_dpbsv by %g of the largest value", result->name, result->error);
        result->dpbsv_ns_per_sample = time_lapack(&w, &bench->lapack);
    }
    wiggly_set_method(w.solver, WIGGLY_BAND);
    wiggly_solve(w.solver, &w.desc, &w.curve);
    time_solver(bench, &w, values_only, result);
    result->band_ns_per_sample = result->ns_per_sample;
    wiggly_set_method(w.solver, WIGGLY_CHAIN);
    wiggly_solve(w.solver, &w.desc, &w.curve);
    time_solver(bench, &w, values_only, result);
    work_destroy(&w);
}

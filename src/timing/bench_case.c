/// One spline of the benchmark: its check against LAPACK, and its times.
#include "timing/bench_case.h"
#include "base/clock.h"
#include "spline/solver.h"
#include "timing/bench_input.h"
#include "timing/bench_lapack.h"
#include "timing/statistics.h"
#include <math.h>
#include <stdlib.h>

static const double seconds_a_case = 0.2, seconds_beside = 0.05;
static const double agreement = 1e-6; ///< of the largest value: dpbsv's own error on these systems is about 1e-9

/// What one case works on.
struct work {
    wiggly_solver *solver;
    struct bench_input input;
    wiggly_curve curve;
    double *about; ///< what the system's x is measured from
    struct banded banded;
};

static void work_destroy(struct work *w)
{
    wiggly_destroy(w->solver);
    bench_input_destroy(&w->input);
    banded_destroy(&w->banded);
    free(w->curve.total);
}

static bool is_limited(const wiggly_desc *desc) { return desc->high < INFINITY; }

/// Limits, the mean of several and noise are no system for LAPACK: such a case is timed alone.
static bool is_alone(const wiggly_desc *desc) { return is_limited(desc) || desc->steady > 0 || desc->variation > 0; }

static bool work_create(struct work *w, const wiggly_desc *desc)
{
    size_t n = (size_t)desc->samples;
    *w = (struct work){0};
    if (!bench_input_copy(&w->input, desc) || !banded_create(&w->banded, desc->samples)) return false;
    double *total = w->curve.total = calloc(6 * n, sizeof *total);
    if (!total) return false;
    w->curve.y = total + n;
    w->curve.re = total + 2 * n;
    w->curve.im = total + 3 * n;
    w->curve.omega = total + 4 * n;
    w->about = total + 5 * n;
    int held = is_limited(desc) ? desc->samples : 0;
    return wiggly_create(desc->samples, desc->knot_count + held, &w->solver) == WIGGLY_OK;
}

bool bench_goes_on(int runs, double end) { return runs < MAX_RUNS && (runs < MIN_RUNS || clock_now() < end); }

void bench_sum_up(struct bench *bench, int runs, double samples, struct bench_result *result)
{
    statistics_sort(bench->times, runs);
    result->ns_per_sample = 1e9 * bench->times[0] / samples;
    result->p50_us = 1e6 * statistics_quantile(bench->times, runs, 0.5);
    result->p99_us = 1e6 * statistics_quantile(bench->times, runs, 0.99);
}

struct bench_result bench_blank(wiggly_mode mode, int samples)
{
    static const char *const names[] = {"complex", "real", "cubic"};
    return (struct bench_result){.mode = names[mode],
                                 .samples = samples,
                                 .splines = 1,
                                 .threads = 1,
                                 .lanes = 1,
                                 .band_ns_per_sample = NAN,
                                 .dpbsv_ns_per_sample = NAN,
                                 .zpbsv_ns_per_sample = NAN,
                                 .peak_mb = NAN};
}

/// Compares the samples of the system with dpbsv's, relative to the largest value; NAN where it failed.
static double compare(struct work *w, const struct lapack *lapack)
{
    const system_rows *rows = &w->solver->rows;
    const wiggly_desc *desc = &w->input.desc;
    solver_describe(w->solver, desc, w->about);
    bool swings = desc->equilibrium.track && rows->is_complex && desc->passive == WIGGLY_OSCILLATOR;
    banded_fill(&w->banded, w->solver);
    double worst = banded_solve(&w->banded, lapack) * 0, largest = 0;
    int width = rows->is_complex ? 2 : 1;
    for (int i = 0; i < width * rows->count; i++) {
        int sample = w->curve.first + i / width;
        bool im = i % width == 1;
        double ours = im ? w->curve.im[sample] : w->curve.total[sample];
        double theirs = banded_solution(&w->banded, i) + rows->x[i];
        if (!im) theirs += w->about[sample];
        if (im && swings) theirs += w->solver->swing.im[sample];
        worst = fmax(worst, fabs(theirs - ours)) + 0 * theirs;
        largest = fmax(largest, fabs(ours));
    }
    return worst / largest;
}

/// Solves by the band of all samples, block by block: a factor and a solve.
static double run_band(struct work *w)
{
    double start = clock_now();
    solver_describe(w->solver, &w->input.desc, w->about);
    bool good = pentadiagonal_factor(&w->solver->matrix) != RANK_BROKEN;
    system_right_side(&w->solver->rows);
    pentadiagonal_solve(&w->solver->matrix, w->solver->rows.gradient);
    double time = clock_now() - start;
    return good ? time : NAN;
}

enum way { BY_BAND, BY_DPBSV, BY_ZPBSV };

/// Fastest of several runs of one way, per sample.
static double time_way(struct work *w, const struct lapack *lapack, enum way way)
{
    double best = INFINITY, end = clock_now() + seconds_beside;
    for (int run = 0; bench_goes_on(run, end); run++) {
        double time = way == BY_BAND    ? run_band(w)
                      : way == BY_DPBSV ? banded_solve(&w->banded, lapack)
                                        : banded_solve_hermitian(&w->banded, lapack, w->solver);
        if (!(time >= 0)) return NAN;
        if (run > 0) best = fmin(best, time);
    }
    return 1e9 * best / w->input.desc.samples;
}

static void time_solver(struct bench *bench, struct work *w, bool values_only, struct bench_result *result)
{
    int runs = 0;
    double end = clock_now() + seconds_a_case;
    for (; bench_goes_on(runs, end); runs++) {
        w->input.knots[w->input.desc.knot_count / 2].value += runs % 2 ? -1e-3 : 1e-3;
        if (!values_only) solver_forget(w->solver);
        double start = clock_now();
        wiggly_solve(w->solver, &w->input.desc, &w->curve);
        bench->times[runs] = clock_now() - start;
    }
    bench_sum_up(bench, runs, w->input.desc.samples, result);
}

static bool run(struct bench *bench, struct work *w, bool values_only, struct bench_result *result,
                struct error *error)
{
    const struct lapack *lapack = &bench->lapack;
    const wiggly_desc *desc = &w->input.desc;
    wiggly_set_method(w->solver, bench->method);
    wiggly_status status = wiggly_solve(w->solver, desc, &w->curve);
    if (status != WIGGLY_OK)
        return fail(error, ERROR_ENVIRONMENT, "%s: %s", result->name, wiggly_status_text(status));
    result->error = w->curve.error;
    if (lapack->dpbsv && !is_alone(desc)) {
        result->error = compare(w, lapack);
        if (!(result->error <= agreement)) {
            return fail(error, ERROR_ENVIRONMENT, "%s: differs from LAPACKE_dpbsv by %g of the largest value",
                        result->name, result->error);
        }
        result->dpbsv_ns_per_sample = time_way(w, lapack, BY_DPBSV);
        if (desc->mode == WIGGLY_COMPLEX && desc->start != WIGGLY_LOOP)
            result->zpbsv_ns_per_sample = time_way(w, lapack, BY_ZPBSV);
    }
    if (!is_alone(desc)) result->band_ns_per_sample = time_way(w, lapack, BY_BAND);
    time_solver(bench, w, values_only, result);
    return true;
}

bool bench_case(struct bench *bench, const wiggly_desc *desc, bool values_only, struct bench_result *result,
                struct error *error)
{
    struct work w;
    bool good = work_create(&w, desc) || fail(error, ERROR_ENVIRONMENT, "out of memory for %s", result->name);
    good = good && run(bench, &w, values_only, result, error);
    work_destroy(&w);
    return good;
}

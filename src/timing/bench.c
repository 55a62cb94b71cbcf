/// The solver's benchmark: cases, checks and times.
#include "timing/bench.h"
#include "base/clock.h"
#include "base/lapack.h"
#include "spline/batch.h"
#include "spline/chain_lanes.h"
#include "spline/solver.h"
#include "timing/statistics.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { CROWD = 10000, CROWD_SAMPLES = 240 };
enum { KNOT_EVERY = 24, KD = 5, COMPLEX_KD = 2, MIN_RUNS = 5, MAX_RUNS = 2000 };
static const double seconds_a_case = 0.6;
static const double agreement = 1e-6; ///< of the largest value: dpbsv's own error on these systems is about 1e-9

static const struct bench_case {
    const char *name, *mode_name;
    wiggly_mode mode;
    int samples;
    bool values_only; ///< only knots' values change from run to run
} cases[] = {
    {"single/complex/240", "complex", WIGGLY_COMPLEX, 240, false},
    {"single/complex/1000", "complex", WIGGLY_COMPLEX, 1000, false},
    {"single/complex/10000", "complex", WIGGLY_COMPLEX, 10000, false},
    {"single/complex/100000", "complex", WIGGLY_COMPLEX, 100000, false},
    {"single/real/240", "real", WIGGLY_REAL, 240, false},
    {"single/real/1000", "real", WIGGLY_REAL, 1000, false},
    {"single/real/10000", "real", WIGGLY_REAL, 10000, false},
    {"single/real/100000", "real", WIGGLY_REAL, 100000, false},
    {"single/cubic/240", "cubic", WIGGLY_CUBIC, 240, false},
    {"single/cubic/1000", "cubic", WIGGLY_CUBIC, 1000, false},
    {"single/cubic/10000", "cubic", WIGGLY_CUBIC, 10000, false},
    {"single/cubic/100000", "cubic", WIGGLY_CUBIC, 100000, false},
    {"resolve/complex/240", "complex", WIGGLY_COMPLEX, 240, true},
    {"resolve/complex/1000", "complex", WIGGLY_COMPLEX, 1000, true},
    {"resolve/complex/10000", "complex", WIGGLY_COMPLEX, 10000, true},
    {"resolve/complex/100000", "complex", WIGGLY_COMPLEX, 100000, true},
};

/// What one case works on.
struct work {
    wiggly_solver *solver;
    wiggly_desc desc;
    wiggly_knot *knots;
    wiggly_curve curve;
    double *band, *right; ///< dpbsv's matrix and right-hand side, and copies that it may overwrite
    double *band_copy, *right_copy;
    double complex *zband, *zright;
    double times[MAX_RUNS];
};

static void work_destroy(struct work *w)
{
    wiggly_destroy(w->solver);
    free(w->knots);
    free(w->curve.total);
    free(w->band);
    free(w->zband);
}

static bool work_create(struct work *w, const struct bench_case *c, int gap)
{
    size_t n = (size_t)c->samples;
    memset(w, 0, sizeof *w);
    w->knots = calloc(n / (size_t)gap + 2, sizeof *w->knots);
    double *numbers = calloc(5 * n, sizeof *numbers);
    w->curve = (wiggly_curve){numbers,         numbers + n,     numbers + 2 * n,
                              numbers + 3 * n, numbers + 4 * n, .samples = c->samples};
    w->band = calloc(2 * (2 * n * (KD + 1) + 2 * n), sizeof(double));
    w->zband = calloc(n * (COMPLEX_KD + 1) + n, sizeof(double complex));
    if (!w->knots || !numbers || !w->band || !w->zband ||
        wiggly_create(c->samples, c->samples / gap + 2, &w->solver) != WIGGLY_OK) {
        return false;
    }
    w->right = w->band + 2 * n * (KD + 1);
    w->band_copy = w->right + 2 * n;
    w->right_copy = w->band_copy + 2 * n * (KD + 1);
    w->zright = w->zband + n * (COMPLEX_KD + 1);
    w->desc = wiggly_default_desc();
    w->desc.samples = c->samples;
    w->desc.mode = c->mode;
    w->desc.frequency.value = 1;
    w->desc.damping.value = 0.05;
    w->desc.knots = w->knots;
    for (int i = 0; i < c->samples; i += gap) {
        w->knots[w->desc.knot_count] = (wiggly_knot){.sample = i, .value = sin(1.7 * w->desc.knot_count)};
        w->desc.knot_count++;
    }
    return true;
}

/// The squared system in LAPACK's lower band storage (column major), with the gradient at "knots fixed, 0 elsewhere" on the
/// right: its solution is x less the knots.
static int band_from_system(struct work *w)
{
    system_rows *rows = &w->solver->rows;
    const pentadiagonal *m = &w->solver->matrix;
    solver_describe(w->solver, &w->desc, w->curve.y);
    system_gradient(rows);
    int width = rows->is_complex ? 2 : 1, n = width * rows->count, kd = width == 2 ? KD : 2;
    memset(w->band, 0, sizeof(double) * (size_t)(n * (kd + 1)));
    for (int k = 0; k < rows->count; k++) {
        for (int part = 0; part < width; part++) {
            double *column = w->band + (size_t)(width * k + part) * (size_t)(kd + 1);
            if (width == 1) {
                column[0] = m->diagonal[k], column[1] = m->below[k], column[2] = m->below2[k];
                continue;
            }
            const double *d = m->diagonal + 3 * k, *e = m->below + 4 * k, *f = m->below2 + 4 * k;
            column[0] = part ? d[2] : d[0];
            if (!part) column[1] = d[1];
            for (int r = 0; r < 2; r++)
                column[2 + r - part] = e[2 * r + part], column[4 + r - part] = f[2 * r + part];
        }
    }
    memcpy(w->right, rows->gradient, sizeof(double) * (size_t)n);
    return n;
}

static double run_dpbsv(struct work *w, const struct lapack *lapack, int n)
{
    int kd = w->solver->rows.is_complex ? KD : 2;
    memcpy(w->band_copy, w->band, sizeof(double) * (size_t)n * (size_t)(kd + 1));
    memcpy(w->right_copy, w->right, sizeof(double) * (size_t)n);
    double start = clock_now();
    int info = lapack->dpbsv(LAPACK_COLUMNS_FIRST, 'L', n, kd, 1, w->band_copy, kd + 1, w->right_copy, n);
    double time = clock_now() - start;
    return info == 0 ? time : NAN;
}

/// The Hermitian system if knots fixed both parts: between knots it is the same.
static double run_zpbsv(struct work *w, const struct lapack *lapack)
{
    const system_rows *rows = &w->solver->rows;
    int n = rows->count;
    memset(w->zband, 0, sizeof(double complex) * (size_t)(n * (COMPLEX_KD + 2)));
    for (int i = 1; i < n - 1; i++) {
        double complex a = 2 + rows->at[i].m.re + rows->at[i].m.im * I,
                       b = a - 1 + rows->at[i].p.re + rows->at[i].p.im * I;
        double complex *before = w->zband + (i - 1) * 3, *here = before + 3, *after = here + 3;
        before[0] += conj(b) * b, before[1] -= conj(a) * b, before[2] += b;
        here[0] += conj(a) * a, here[1] -= a;
        after[0] += 1;
    }
    for (int i = 0; i < n; i++) w->zband[3 * i] += rows->fixed[i] ? 1e3 : 1e-9, w->zright[i] = 1;
    double start = clock_now();
    int info = lapack->zpbsv(LAPACK_COLUMNS_FIRST, 'L', n, COMPLEX_KD, 1, w->zband, COMPLEX_KD + 1, w->zright, n);
    double time = clock_now() - start;
    return info == 0 ? time : NAN;
}

/// Compares x with dpbsv's, relative to the largest value; NAN where it failed.
static double compare(struct work *w, const struct lapack *lapack)
{
    int n = band_from_system(w), width = w->solver->rows.is_complex ? 2 : 1;
    double worst = run_dpbsv(w, lapack, n) * 0, largest = 0;
    for (int i = 0; i < n; i++) {
        const double *ours = width == 2 && i % 2 ? w->curve.im : w->curve.re;
        double theirs = w->right_copy[i] + w->solver->rows.x[i];
        worst = fmax(worst, fabs(theirs - ours[i / width])) + 0 * theirs;
        largest = fmax(largest, fabs(ours[i / width]));
    }
    return worst / largest;
}

/// Fastest of several runs of one LAPACK solver, per sample.
static double time_lapack(struct work *w, const struct lapack *lapack, bool is_complex, int n)
{
    double best = INFINITY, end = clock_now() + seconds_a_case / 4;
    for (int run = 0; run < MAX_RUNS && (run < MIN_RUNS || clock_now() < end); run++) {
        double time = is_complex ? run_zpbsv(w, lapack) : run_dpbsv(w, lapack, n);
        if (!(time >= 0)) return NAN;
        if (run > 0) best = fmin(best, time);
    }
    return 1e9 * best / w->desc.samples;
}

static void time_solver(struct work *w, bool values_only, struct bench_result *result)
{
    int runs = 0;
    for (double end = clock_now() + seconds_a_case; runs < MAX_RUNS && (runs < MIN_RUNS || clock_now() < end);
         runs++) {
        w->knots[w->desc.knot_count / 2].value += 1e-3;
        if (!values_only) solver_forget(w->solver);
        double start = clock_now();
        wiggly_solve(w->solver, &w->desc, &w->curve);
        w->times[runs] = clock_now() - start;
    }
    statistics_sort(w->times, runs);
    result->ns_per_sample = 1e9 * w->times[0] / w->desc.samples;
    result->p50_us = 1e6 * statistics_quantile(w->times, runs, 0.5);
    result->p99_us = 1e6 * statistics_quantile(w->times, runs, 0.99);
}

static bool run_case(struct work *w, const struct bench_case *c, const struct lapack *lapack,
                     struct bench_result *result, struct error *error)
{
    *result = (struct bench_result){.name = c->name,
                                    .mode = c->mode_name,
                                    .samples = c->samples,
                                    .splines = 1,
                                    .threads = 1,
                                    .lanes = 1,
                                    .dpbsv_ns_per_sample = NAN,
                                    .zpbsv_ns_per_sample = NAN};
    wiggly_status status = wiggly_solve(w->solver, &w->desc, &w->curve);
    if (status != WIGGLY_OK) return fail(error, ERROR_ENVIRONMENT, "%s: %s", c->name, wiggly_status_text(status));
    result->error = w->curve.error;
    if (lapack->dpbsv) {
        result->error = compare(w, lapack);
        if (!(result->error <= agreement)) {
            return fail(error, ERROR_ENVIRONMENT, "%s: differs from LAPACKE_dpbsv by %g of the largest value",
                        c->name, result->error);
        }
        result->dpbsv_ns_per_sample =
            time_lapack(w, lapack, false, w->solver->rows.count * (w->solver->rows.is_complex ? 2 : 1));
        if (lapack->zpbsv && w->solver->rows.is_complex)
            result->zpbsv_ns_per_sample = time_lapack(w, lapack, true, 0);
    }
    time_solver(w, c->values_only, result);
    return true;
}

/// 10,000 splines of 240 samples, every knot changed between runs, for total and Im x.
struct crowd {
    wiggly_desc *desc;
    wiggly_curve *curve;
    wiggly_knot *knots;
    double *numbers;
};

static bool crowd_create(struct crowd *crowd)
{
    enum { PER_SPLINE = CROWD_SAMPLES / KNOT_EVERY };
    *crowd = (struct crowd){
        .desc = calloc(CROWD, sizeof *crowd->desc),
        .curve = calloc(CROWD, sizeof *crowd->curve),
        .knots = calloc((size_t)CROWD * PER_SPLINE, sizeof *crowd->knots),
        .numbers = calloc((size_t)CROWD * 2 * CROWD_SAMPLES, sizeof *crowd->numbers),
    };
    if (!crowd->desc || !crowd->curve || !crowd->knots || !crowd->numbers) return false;
    for (int s = 0; s < CROWD; s++) {
        wiggly_desc *desc = &crowd->desc[s];
        *desc = wiggly_default_desc();
        desc->samples = CROWD_SAMPLES;
        desc->frequency.value = 1;
        desc->damping.value = 0.05;
        desc->knots = crowd->knots + s * PER_SPLINE;
        desc->knot_count = PER_SPLINE;
        for (int k = 0; k < PER_SPLINE; k++) {
            crowd->knots[s * PER_SPLINE + k] =
                (wiggly_knot){.sample = KNOT_EVERY * k + (5 * s + 7 * k) % 11, .value = sin(s + 2.0 * k)};
        }
        crowd->curve[s].total = crowd->numbers + (size_t)s * 2 * CROWD_SAMPLES;
        crowd->curve[s].im = crowd->curve[s].total + CROWD_SAMPLES;
    }
    return true;
}

static void crowd_destroy(struct crowd *crowd)
{
    free(crowd->desc);
    free(crowd->curve);
    free(crowd->knots);
    free(crowd->numbers);
}

/// Times the crowd on several threads; `single` is the line with the LAPACK figures to compare with.
static bool run_crowd(struct crowd *crowd, int threads, int lanes, const struct bench_result *single, double *times,
                      struct bench_result *result)
{
    wiggly_batch *batch = NULL;
    if (batch_of_lanes(CROWD_SAMPLES, CROWD_SAMPLES / KNOT_EVERY, threads, lanes, &batch) != WIGGLY_OK) return false;
    int runs = 0;
    wiggly_status worst = WIGGLY_OK;
    for (double end = clock_now() + seconds_a_case; runs < MAX_RUNS && (runs < MIN_RUNS || clock_now() < end);
         runs++) {
        for (int k = 0; k < CROWD * (CROWD_SAMPLES / KNOT_EVERY); k++) crowd->knots[k].value *= -1;
        double start = clock_now();
        wiggly_status status = wiggly_batch_solve(batch, crowd->desc, crowd->curve, NULL, CROWD);
        times[runs] = clock_now() - start;
        worst = status > worst ? status : worst;
    }
    wiggly_batch_destroy(batch);
    statistics_sort(times, runs);
    *result = *single;
    result->name = "batch/complex/10000x240";
    result->splines = CROWD;
    result->threads = threads;
    result->lanes = lanes > 0 ? lanes : 1;
    result->ns_per_sample = 1e9 * times[0] / CROWD_SAMPLES / CROWD;
    result->p50_us = 1e6 * statistics_quantile(times, runs, 0.5);
    result->p99_us = 1e6 * statistics_quantile(times, runs, 0.99);
    return worst == WIGGLY_OK;
}

static bool run_crowds(const struct bench_result *single, double *times,
                       void (*done)(void *, const struct bench_result *), void *user, struct error *error)
{
    struct crowd crowd;
    bool good = crowd_create(&crowd);
    for (int lanes = chain_lanes(); good && lanes >= 0; lanes -= 4) {
        for (int threads = 1; good && threads <= 2; threads++) {
            struct bench_result result;
            good = run_crowd(&crowd, threads, lanes, single, times, &result);
            if (good) done(user, &result);
        }
    }
    crowd_destroy(&crowd);
    return good || fail(error, ERROR_ENVIRONMENT, "batch/complex/10000x240 could not be solved");
}

/// A knot in the middle of a million samples is dragged, up and down and along, and the thousand samples around it are read;
/// compared with wiggly_solve() of the same spline first.
static bool run_edit(double *times, void (*done)(void *, const struct bench_result *), void *user,
                     struct error *error)
{
    enum { SAMPLES = 1000000, GAP = 100, PART = 1000, EDITED = SAMPLES / GAP / 2 };
    struct work *w = malloc(sizeof *w);
    wiggly_take *take = NULL;
    double part[PART], worst = 0;
    struct bench_result result = {.name = "edit/complex/1000000",
                                  .mode = "complex",
                                  .samples = SAMPLES,
                                  .splines = 1,
                                  .threads = 1,
                                  .lanes = 1,
                                  .dpbsv_ns_per_sample = NAN,
                                  .zpbsv_ns_per_sample = NAN};
    bool good =
        w &&
        work_create(w, &(struct bench_case){.name = result.name, .mode = WIGGLY_COMPLEX, .samples = SAMPLES}, GAP) &&
        wiggly_take_create(&w->desc, &take) == WIGGLY_OK;
    for (int run = 0; good && run < MAX_RUNS; run++) {
        wiggly_knot knot = w->knots[EDITED];
        knot.value += 1e-3;
        knot.sample = EDITED * GAP + (13 * run) % 41 - 20;
        int from = knot.sample - PART / 2;
        double start = clock_now();
        good = wiggly_take_set_knot(take, EDITED, knot) == WIGGLY_OK &&
               wiggly_take_read(take, from, PART, part, NULL) == WIGGLY_OK;
        times[run] = clock_now() - start;
        w->knots[EDITED] = knot;
        if (run > 0) continue;
        good = good && wiggly_solve(w->solver, &w->desc, &w->curve) == WIGGLY_OK;
        for (int i = 0; good && i < PART; i++) worst = fmax(worst, fabs(part[i] - w->curve.total[from + i]));
    }
    if (good) {
        statistics_sort(times, MAX_RUNS);
        result.ns_per_sample = 1e9 * times[0] / PART;
        result.p50_us = 1e6 * statistics_quantile(times, MAX_RUNS, 0.5);
        result.p99_us = 1e6 * statistics_quantile(times, MAX_RUNS, 0.99);
        result.error = worst;
        done(user, &result);
    }
    wiggly_take_destroy(take);
    if (w) work_destroy(w);
    free(w);
    return (good && worst <= 1e-9) || fail(error, ERROR_ENVIRONMENT, "%s: off by %g", result.name, worst);
}

static void name_cpu(char *name, size_t size)
{
    char line[256];
    snprintf(name, size, "unknown");
    FILE *file = fopen("/proc/cpuinfo", "r");
    while (file && fgets(line, sizeof line, file)) {
        char *colon = strncmp(line, "model name", 10) == 0 ? strchr(line, ':') : NULL;
        if (!colon) continue;
        line[strcspn(line, "\n")] = '\0';
        snprintf(name, size, "%s", colon + 2);
        break;
    }
    if (file) fclose(file);
}

bool bench_run(struct bench_machine *machine, void (*done)(void *user, const struct bench_result *result), void *user,
               struct error *error)
{
    struct lapack lapack;
    lapack_load(&lapack, machine->blas, sizeof machine->blas);
    name_cpu(machine->cpu, sizeof machine->cpu);
    bool good = true;
    struct bench_result first = {0};
    struct work *w = malloc(sizeof *w);
    for (size_t c = 0; good && w && c < sizeof cases / sizeof *cases; c++) {
        struct bench_result result;
        good = work_create(w, &cases[c], KNOT_EVERY) ||
               fail(error, ERROR_ENVIRONMENT, "out of memory for %s", cases[c].name);
        good = good && run_case(w, &cases[c], &lapack, &result, error);
        if (good) done(user, &result);
        if (c == 0) first = result;
        work_destroy(w);
    }
    good = good && w && run_crowds(&first, w->times, done, user, error) && run_edit(w->times, done, user, error);
    if (!w) good = fail(error, ERROR_ENVIRONMENT, "out of memory");
    free(w);
    lapack_unload(&lapack);
    return good;
}

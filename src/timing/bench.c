/// The solver's benchmark: its cases, one after the other.
#include "timing/bench.h"
#include "base/clock.h"
#include "spline/solver.h"
#include "timing/bench_case.h"
#include "timing/bench_input.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>

enum { COMPLEX = 1 << WIGGLY_COMPLEX, REAL = 1 << WIGGLY_REAL, CUBIC = 1 << WIGGLY_CUBIC };
enum { ALL = COMPLEX | REAL | CUBIC, LENGTHS = 4, LARGE = 10000000, LARGE_RUNS = 3 };

static const struct {
    const char *name;
    enum bench_kind kind;
    int modes;
    int samples[LENGTHS];
    bool values_only; ///< only knots' values change from run to run
} plan[] = {
    {"single", BENCH_SINGLE, ALL, {240, 1000, 10000, 100000}, false},
    {"resolve", BENCH_SINGLE, COMPLEX, {240, 1000, 10000, 100000}, true},
    {"irregular", BENCH_IRREGULAR, COMPLEX, {240, 1000, 100000}, false},
    {"irregular", BENCH_IRREGULAR, REAL | CUBIC, {240}, false},
    {"rest", BENCH_REST, ALL, {240}, false},
    {"equilibrium", BENCH_EQUILIBRIUM, ALL, {240}, false},
    {"slopes", BENCH_SLOPES, ALL, {240}, false},
    {"last", BENCH_ENDS, ALL, {240}, false},
    {"last-slope", BENCH_END_SLOPES, ALL, {240}, false},
    {"loop", BENCH_LOOP, COMPLEX, {240, 1000, 100000}, false},
    {"loop", BENCH_LOOP, REAL | CUBIC, {240}, false},
    {"resolve-loop", BENCH_LOOP, ALL, {240}, true},
    {"track", BENCH_TRACK, COMPLEX, {240, 1000, 100000}, false},
    {"track", BENCH_TRACK, REAL, {240}, false},
    {"short-1", BENCH_SHORT_1, COMPLEX | REAL, {240}, false},
    {"short-2", BENCH_SHORT_2, COMPLEX | REAL, {240}, false},
    {"short-4", BENCH_SHORT_4, COMPLEX | REAL, {240}, false},
    {"short-8", BENCH_SHORT_8, COMPLEX | REAL, {240}, false},
    {"limits", BENCH_LIMITS, COMPLEX, {240, 1000}, false},
    {"limits", BENCH_LIMITS, REAL | CUBIC, {240}, false},
    {"steady", BENCH_STEADY, COMPLEX, {240, 1000}, false},
    {"steady", BENCH_STEADY, REAL, {240}, false},
    {"variation", BENCH_VARIATION, COMPLEX, {240, 1000}, false},
    {"variation", BENCH_VARIATION, REAL, {240}, false},
};
enum { PLANS = sizeof plan / sizeof *plan };

static bool run_plan(struct bench *bench, int n, wiggly_mode mode, int samples, struct bench_result *result,
                     struct error *error)
{
    struct bench_input input;
    *result = bench_blank(mode, samples);
    snprintf(result->name, sizeof result->name, "%s/%s/%d", plan[n].name, result->mode, samples);
    bool good = bench_input_create(&input, plan[n].kind, mode, samples) ||
                fail(error, ERROR_ENVIRONMENT, "out of memory for %s", result->name);
    good = good && bench_case(bench, &input.desc, plan[n].values_only, result, error);
    bench_input_destroy(&input);
    return good;
}

/// Drags the knot in the middle up and down and along, and reads the samples around it, `part` of them. Compared with
/// wiggly_solve() of the same spline first: the largest difference, or NAN where that failed.
static double edit(struct bench *bench, struct bench_input *input, wiggly_take *take, wiggly_solver *solver,
                   wiggly_curve *curve, double *values, int part)
{
    int edited = input->desc.knot_count / 2, at = input->knots[edited].sample;
    double worst = 0;
    bool good = true;
    for (int run = 0; good && run < MAX_RUNS; run++) {
        wiggly_knot knot = input->knots[edited];
        knot.value += 1e-3;
        knot.sample = at + (13 * run) % 41 - 20;
        int from = knot.sample - part / 2;
        double start = clock_now();
        good = wiggly_take_set_knot(take, edited, knot) == WIGGLY_OK &&
               wiggly_take_read(take, from, part, values, NULL) == WIGGLY_OK;
        bench->times[run] = clock_now() - start;
        input->knots[edited] = knot;
        if (run > 0) continue;
        good = good && wiggly_solve(solver, &input->desc, curve) == WIGGLY_OK;
        for (int i = 0; good && i < part; i++) worst = fmax(worst, fabs(values[i] - curve->total[from + i]));
    }
    return good ? worst : NAN;
}

static bool run_edit(struct bench *bench, void (*done)(void *, const struct bench_result *), void *user,
                     struct error *error)
{
    enum { SAMPLES = 1000000, PART = 1000 };
    struct bench_input input;
    wiggly_take *take = NULL;
    wiggly_solver *solver = NULL;
    double values[PART];
    wiggly_curve curve = {.total = calloc(SAMPLES, sizeof(double))};
    struct bench_result result = bench_blank(WIGGLY_COMPLEX, SAMPLES);
    snprintf(result.name, sizeof result.name, "edit/complex/%d", SAMPLES);
    bool good = bench_input_create(&input, BENCH_EDIT, WIGGLY_COMPLEX, SAMPLES) && curve.total &&
                wiggly_take_create(&input.desc, &take) == WIGGLY_OK &&
                wiggly_create(SAMPLES, input.desc.knot_count, &solver) == WIGGLY_OK;
    result.error = good ? edit(bench, &input, take, solver, &curve, values, PART) : NAN;
    good = result.error <= 1e-9;
    if (good) {
        bench_sum_up(bench, MAX_RUNS, PART, &result);
        done(user, &result);
    }
    wiggly_take_destroy(take);
    wiggly_destroy(solver);
    bench_input_destroy(&input);
    free(curve.total);
    return good || fail(error, ERROR_ENVIRONMENT, "%s: off by %g", result.name, result.error);
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

struct bench *bench_open(struct bench_machine *machine, wiggly_method method, struct error *error)
{
    struct bench *bench = calloc(1, sizeof *bench);
    if (!bench) {
        fail(error, ERROR_ENVIRONMENT, "out of memory");
        return NULL;
    }
    bench->method = method;
    lapack_load(&bench->lapack, machine->blas, sizeof machine->blas);
    name_cpu(machine->cpu, sizeof machine->cpu);
    return bench;
}

void bench_close(struct bench *bench)
{
    if (bench) lapack_unload(&bench->lapack);
    free(bench);
}

bool bench_run(struct bench *bench, void (*done)(void *user, const struct bench_result *result), void *user,
               struct error *error)
{
    struct bench_result result, shortest[BENCH_EDIT + 1] = {0}; // complex, by kind
    for (int n = 0; n < PLANS; n++) {
        for (wiggly_mode mode = WIGGLY_COMPLEX; mode <= WIGGLY_CUBIC; mode++) {
            for (int l = 0; l < LENGTHS && plan[n].modes >> mode & 1 && plan[n].samples[l]; l++) {
                if (!run_plan(bench, n, mode, plan[n].samples[l], &result, error)) return false;
                if (mode == WIGGLY_COMPLEX && l == 0 && !plan[n].values_only) shortest[plan[n].kind] = result;
                done(user, &result);
            }
        }
    }
    return bench_batches(bench, shortest, done, user, error) && bench_pins(bench, done, user, error) &&
           run_edit(bench, done, user, error);
}

bool bench_large(struct bench *bench, struct bench_result *result, struct error *error)
{
    struct bench_input input;
    wiggly_solver *solver = NULL;
    struct rusage usage;
    wiggly_curve curve = {.total = calloc(LARGE, sizeof(double))};
    wiggly_status status = WIGGLY_ERROR_MEMORY;
    *result = bench_blank(WIGGLY_COMPLEX, LARGE);
    snprintf(result->name, sizeof result->name, "loop/complex/%d", LARGE);
    if (bench_input_create(&input, BENCH_LOOP, WIGGLY_COMPLEX, LARGE) && curve.total)
        status = wiggly_create(LARGE, input.desc.knot_count, &solver);
    for (int run = 0; run < LARGE_RUNS && status == WIGGLY_OK; run++) {
        solver_forget(solver);
        wiggly_set_method(solver, bench->method);
        double start = clock_now();
        status = wiggly_solve(solver, &input.desc, &curve);
        bench->times[run] = clock_now() - start;
    }
    bench_sum_up(bench, LARGE_RUNS, LARGE, result);
    result->error = curve.error;
    if (getrusage(RUSAGE_SELF, &usage) == 0) result->peak_mb = (double)usage.ru_maxrss / 1024;
    wiggly_destroy(solver);
    bench_input_destroy(&input);
    free(curve.total);
    return status == WIGGLY_OK || fail(error, ERROR_ENVIRONMENT, "%s: %s", result->name, wiggly_status_text(status));
}

bool bench_spline(struct bench *bench, const char *name, const wiggly_desc *desc, struct bench_result *result,
                  struct error *error)
{
    *result = bench_blank(desc->mode, desc->samples);
    snprintf(result->name, sizeof result->name, "%s", name);
    return bench_case(bench, desc, false, result, error);
}

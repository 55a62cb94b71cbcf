/// The benchmark's batches: 10,000 splines of 240 samples, every knot changed between runs, for total and Im x.
#include "base/clock.h"
#include "spline/batch.h"
#include "spline/chain_lanes.h"
#include "timing/bench_case.h"
#include "timing/bench_input.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { CROWD = 10000, SAMPLES = 240, GAP = 24, KNOTS = SAMPLES / GAP };
static const double seconds_a_batch = 0.5;

struct crowd {
    wiggly_desc *desc;
    wiggly_curve *curve;
    wiggly_knot *knots;
    double *numbers, *equilibria;
};

static void describe(struct crowd *crowd, int s, enum bench_kind kind)
{
    wiggly_desc *desc = &crowd->desc[s];
    *desc = wiggly_default_desc();
    desc->samples = SAMPLES;
    desc->start = kind == BENCH_LOOP ? WIGGLY_LOOP : kind == BENCH_REST ? WIGGLY_REST : WIGGLY_FREE;
    desc->frequency.value = 1;
    desc->damping.value = 0.05;
    desc->knots = crowd->knots + s * KNOTS;
    desc->knot_count = KNOTS;
    for (int k = 0; k < KNOTS; k++) {
        crowd->knots[s * KNOTS + k] =
            (wiggly_knot){.sample = GAP * k + 2 + (5 * s + 7 * k) % 11, .value = sin(s + 2.0 * k)};
    }
    crowd->curve[s].total = crowd->numbers + (size_t)s * 2 * SAMPLES;
    crowd->curve[s].im = crowd->curve[s].total + SAMPLES;
    if (kind != BENCH_EQUILIBRIUM) return;
    double *y = crowd->equilibria + (size_t)s * SAMPLES;
    for (int i = 0; i < SAMPLES; i++) y[i] = sin(0.02 * i + s);
    desc->equilibrium.track = y;
}

static bool crowd_create(struct crowd *crowd, enum bench_kind kind)
{
    *crowd = (struct crowd){
        .desc = calloc(CROWD, sizeof *crowd->desc),
        .curve = calloc(CROWD, sizeof *crowd->curve),
        .knots = calloc((size_t)CROWD * KNOTS, sizeof *crowd->knots),
        .numbers = calloc((size_t)CROWD * 2 * SAMPLES, sizeof *crowd->numbers),
        .equilibria = calloc((size_t)CROWD * SAMPLES, sizeof *crowd->equilibria),
    };
    if (!crowd->desc || !crowd->curve || !crowd->knots || !crowd->numbers || !crowd->equilibria) return false;
    for (int s = 0; s < CROWD; s++) describe(crowd, s, kind);
    return true;
}

static void crowd_destroy(struct crowd *crowd)
{
    free(crowd->desc);
    free(crowd->curve);
    free(crowd->knots);
    free(crowd->numbers);
    free(crowd->equilibria);
}

/// Times the crowd on several threads.
static bool run_crowd(struct bench *bench, struct crowd *crowd, int threads, int lanes, struct bench_result *result)
{
    wiggly_batch *batch = NULL;
    if (batch_of_lanes(SAMPLES, KNOTS, threads, lanes, &batch) != WIGGLY_OK) return false;
    int runs = 0;
    wiggly_status worst = WIGGLY_OK;
    for (double end = clock_now() + seconds_a_batch; bench_goes_on(runs, end); runs++) {
        for (int k = 0; k < CROWD * KNOTS; k++) crowd->knots[k].value *= -1;
        double start = clock_now();
        wiggly_status status = wiggly_batch_solve(batch, crowd->desc, crowd->curve, NULL, CROWD);
        bench->times[runs] = clock_now() - start;
        worst = status > worst ? status : worst;
    }
    wiggly_batch_destroy(batch);
    result->splines = CROWD;
    result->threads = threads;
    result->lanes = lanes > 0 ? lanes : 1;
    bench_sum_up(bench, runs, (double)SAMPLES * CROWD, result);
    return worst == WIGGLY_OK;
}

/// The kinds that go together are timed on one thread and two, in lanes as wide as can be, narrower, and one by one; the others
/// as they are by default on one thread.
static const struct {
    enum bench_kind kind;
    const char *name;
    bool every_way;
} kinds[] = {
    {BENCH_SINGLE, "batch/complex/10000x240", true},
    {BENCH_REST, "batch/rest/10000x240", false},
    {BENCH_EQUILIBRIUM, "batch/equilibrium/10000x240", false},
    {BENCH_LOOP, "batch/loop/10000x240", false},
};

bool bench_batches(struct bench *bench, const struct bench_result *singles,
                   void (*done)(void *user, const struct bench_result *result), void *user, struct error *error)
{
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
        struct crowd crowd;
        struct bench_result result = singles[kinds[k].kind];
        bool good = crowd_create(&crowd, kinds[k].kind);
        snprintf(result.name, sizeof result.name, "%s", kinds[k].name);
        for (int lanes = chain_lanes(); good && lanes >= 0; lanes -= 4) {
            for (int threads = 1; good && threads <= 2; threads++) {
                if (!kinds[k].every_way && (lanes < chain_lanes() || threads > 1)) continue;
                good = run_crowd(bench, &crowd, threads, lanes, &result);
                if (good) done(user, &result);
            }
        }
        crowd_destroy(&crowd);
        if (!good) return fail(error, ERROR_ENVIRONMENT, "%s could not be solved", result.name);
    }
    return true;
}

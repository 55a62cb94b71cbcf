/// The benchmark's batches: 10,000 splines of 240 samples, every knot changed between runs, for total and Im x.
#include "base/need.h"
#include "base/progress.h"
#include "bench/bench.h"
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
    crowd->curve[s].size = sizeof crowd->curve[s];
    crowd->curve[s].total = crowd->numbers + (size_t)s * 2 * SAMPLES;
    crowd->curve[s].im = crowd->curve[s].total + SAMPLES;
    if (kind != BENCH_EQUILIBRIUM) return;
    double *y = crowd->equilibria + (size_t)s * SAMPLES;
    for (int i = 0; i < SAMPLES; i++) y[i] = sin(0.02 * i + s);
    desc->equilibrium.track = y;
}

static void crowd_create(struct crowd *crowd, enum bench_kind kind)
{
    *crowd = (struct crowd){
        .desc = need_zeroed(CROWD, sizeof *crowd->desc),
        .curve = need_zeroed(CROWD, sizeof *crowd->curve),
        .knots = need_zeroed((size_t)CROWD * KNOTS, sizeof *crowd->knots),
        .numbers = need_zeroed((size_t)CROWD * 2 * SAMPLES, sizeof *crowd->numbers),
        .equilibria = need_zeroed((size_t)CROWD * SAMPLES, sizeof *crowd->equilibria),
    };
    for (int s = 0; s < CROWD; s++) describe(crowd, s, kind);
}

static void crowd_destroy(struct crowd *crowd)
{
    free(crowd->desc);
    free(crowd->curve);
    free(crowd->knots);
    free(crowd->numbers);
    free(crowd->equilibria);
}

/// Times all splines on several threads.
static void run_crowd(struct bench *bench, struct crowd *crowd, int threads, struct bench_result *result)
{
    wiggly_batch *batch = NULL;
    int runs = 0;
    wiggly_status worst = wiggly_batch_create(SAMPLES, KNOTS, threads, &batch);
    for (double end = clock_now() + seconds_a_batch; worst == WIGGLY_OK && bench_goes_on(runs, end); runs++) {
        for (int k = 0; k < CROWD * KNOTS; k++) crowd->knots[k].value *= -1;
        double start = clock_now();
        worst = wiggly_batch_solve(batch, crowd->desc, crowd->curve, NULL, CROWD);
        bench->times[runs] = clock_now() - start;
    }
    wiggly_batch_destroy(batch);
    if (worst != WIGGLY_OK) bench_stop("%s: %s", result->name, wiggly_status_text(worst));
    result->splines = CROWD;
    result->threads = threads;
    bench_sum_up(bench, runs, (double)SAMPLES * CROWD, result);
}

/// The plain kind is timed on one and on two threads, the others on one.
static const struct {
    enum bench_kind kind;
    const char *name;
    int most_threads;
} kinds[] = {
    {BENCH_SINGLE, "batch/complex/10000x240", 2},
    {BENCH_REST, "batch/rest/10000x240", 1},
    {BENCH_EQUILIBRIUM, "batch/equilibrium/10000x240", 1},
    {BENCH_LOOP, "batch/loop/10000x240", 1},
};

void bench_batches(struct bench *bench)
{
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
        struct crowd crowd;
        struct bench_result result = bench_blank(WIGGLY_COMPLEX, SAMPLES);
        crowd_create(&crowd, kinds[k].kind);
        snprintf(result.name, sizeof result.name, "%s", kinds[k].name);
        for (int threads = 1; threads <= kinds[k].most_threads; threads++) {
            run_crowd(bench, &crowd, threads, &result);
            bench_report(bench, &result);
        }
        crowd_destroy(&crowd);
    }
}

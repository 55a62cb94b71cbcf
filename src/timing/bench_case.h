/// What the parts of the benchmark share. Private to them.
#ifndef TIMING_BENCH_CASE_H
#define TIMING_BENCH_CASE_H

#include "base/lapack.h"
#include "timing/bench.h"

enum { MIN_RUNS = 5, MAX_RUNS = 20000 };

struct bench {
    struct lapack lapack;
    wiggly_method method;
    double times[MAX_RUNS]; ///< seconds of each run of a case
};

/// Which runs of a case belong to it: at least MIN_RUNS, at most MAX_RUNS, and no new one when its time is over.
bool bench_goes_on(int runs, double end);

/// The figures that follow from `runs` times of so many samples each.
void bench_sum_up(struct bench *bench, int runs, double samples, struct bench_result *result);

/// A line without figures.
struct bench_result bench_blank(wiggly_mode mode, int samples);

/// Verifies a description and times it; `values_only`: a solver that has just solved it all but for a knot's value.
bool bench_case(struct bench *bench, const wiggly_desc *desc, bool values_only, struct bench_result *result,
                struct error *error);

/// Ten thousand splines of each kind at once; `singles` are lines of one such spline, by kind (bench_input.h).
bool bench_batches(struct bench *bench, const struct bench_result *singles,
                   void (*done)(void *user, const struct bench_result *result), void *user, struct error *error);

/// Groups of splines whose pins are dragged.
bool bench_pins(struct bench *bench, void (*done)(void *user, const struct bench_result *result), void *user,
                struct error *error);

#endif

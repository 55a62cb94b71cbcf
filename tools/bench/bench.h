/// The solver's benchmark: a table of cases, each verified before timing, compared with LAPACK's banded Cholesky on the same systems. Any
/// error ends the program with a message.
#ifndef BENCH_BENCH_H
#define BENCH_BENCH_H

#include "base/lapack.h"
#include <stdio.h>
#include <wiggly/more.h>

/// A line of the table. Times are of one core; NAN: not measured.
struct bench_result {
    char name[40]; ///< "single/complex/1000"
    const char *mode;
    int samples, splines, threads;
    double ns_per_sample;       ///< fastest run of the whole solve: poles, assembly, factor, refinement
    double p50_us, p99_us;      ///< of one solve
    double band_ns_per_sample;  ///< the band of all samples, block by block: assembly, factor and one solve
    double dpbsv_ns_per_sample; ///< LAPACKE_dpbsv, factor and solve only; none for loops
    double error;   ///< largest relative difference to LAPACKE, else to the band; else the solver's estimate
    double peak_mb; ///< the process' peak memory so far
};

enum { MIN_RUNS = 5, MAX_RUNS = 20000 };

/// Shared by all cases.
struct bench {
    struct lapack lapack;
    char blas[256];         ///< the loaded BLAS, or why there is none
    FILE *json;             ///< the lines so far, or NULL
    int lines;              ///< reported so far
    double times[MAX_RUNS]; ///< seconds of each run of a case
};

void bench_open(struct bench *bench);

/// A line without results.
struct bench_result bench_blank(wiggly_mode mode, int samples);

/// Whether a case needs another run: at least MIN_RUNS, at most MAX_RUNS, none after its time is over.
bool bench_goes_on(int runs, double end);

/// Computes results from `runs` times of `samples` samples each.
void bench_sum_up(struct bench *bench, int runs, double samples, struct bench_result *result);

/// Prints a line.
void bench_report(struct bench *bench, const struct bench_result *result);

/// Ends the program with a message.
_Noreturn void bench_stop(const char *format, ...) __attribute__((format(printf, 1, 2)));

/// Forgets everything that a solver keeps for the case that little changes: its next solve is a whole one. Changes no result.
void bench_forget(wiggly_solver *solver);

/// Verifies a description with knots and times it. `values_only`: the solver has just solved it with another value of a knot.
void bench_case(struct bench *bench, const wiggly_desc *desc, bool values_only, struct bench_result *result);

enum bench_kind {
    BENCH_SINGLE,      ///< evenly spaced knots, so all stretches are alike
    BENCH_IRREGULAR,   ///< irregular knots, as in all kinds below
    BENCH_REST,        ///< from rest
    BENCH_EQUILIBRIUM, ///< the equilibrium moves
    BENCH_SLOPES,      ///< every other knot has a slope
    BENCH_ENDS,        ///< knots on the first and the last sample
    BENCH_END_SLOPES,  ///< these with slopes
    BENCH_LOOP,
    BENCH_TRACK,         ///< the frequency moves
    BENCH_SHORT,         ///< a single period
    BENCH_LIMITS,        ///< the curve stays within 1.02 of the largest knot
    BENCH_VARIATION,     ///< another motion through the same knots
    BENCH_WIND_UP,       ///< each knot is wound up for, for half a period
    BENCH_WIND_UP_TRACK, ///< the same where the frequency moves
};

/// A spline of a kind; knots[middle] may be changed.
struct bench_input {
    wiggly_desc desc;
    wiggly_knot *knots;
    double *track;
};

void bench_input_create(struct bench_input *input, enum bench_kind kind, wiggly_mode mode, int samples);
void bench_input_destroy(struct bench_input *input);

/// Ten thousand splines of each kind at once; groups of splines with dragged pins; and the splines of assets/scenes that have knots and one
/// solution, including tracks, as a geometric mean.
void bench_batches(struct bench *bench);
void bench_pins(struct bench *bench);
void bench_scenes(struct bench *bench);

#endif

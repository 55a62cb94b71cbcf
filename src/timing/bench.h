/// The solver's benchmark: a table of cases, each verified before it is timed, beside LAPACK's banded solvers on the same systems.
#ifndef TIMING_BENCH_H
#define TIMING_BENCH_H

#include "base/error.h"
#include <wiggly/wiggly.h>

/// One line of the table. Times are of one core.
struct bench_result {
    char name[40]; ///< "single/complex/1000"
    const char *mode;
    int samples, splines, threads, lanes;
    double ns_per_sample;       ///< fastest run of the whole solve: poles, assembly, factor, refinement
    double p50_us, p99_us;      ///< of one solve
    double band_ns_per_sample;  ///< the band of all samples, block by block: assembly, factor and one solve
    double dpbsv_ns_per_sample; ///< LAPACKE_dpbsv, factor and solve alone; NAN where LAPACKE is not installed
    double zpbsv_ns_per_sample; ///< LAPACKE_zpbsv on the system with both parts of the knots fixed; NAN likewise
    double error;               ///< largest difference to LAPACKE (refined once), relative; else own estimate
    double peak_mb;             ///< most memory the process had until then; NAN where that says nothing
};

/// The machine, for the report.
struct bench_machine {
    char cpu[128];
    char blas[256]; ///< the BLAS that was loaded, or why there is none
};

/// What all cases share.
struct bench;

/// Solves by `method`, but for batches and edits, which are chains; says what machine it is. NULL with a sentence where memory is
/// short.
struct bench *bench_open(struct bench_machine *machine, wiggly_method method, struct error *error);
void bench_close(struct bench *bench);

/// Runs every case; `done` is called after each. false with a sentence if a result is wrong.
bool bench_run(struct bench *bench, void (*done)(void *user, const struct bench_result *result), void *user,
               struct error *error);

/// A loop of 10,000,000 samples, its total alone, and the memory that this takes: to be run before all else. Without LAPACKE.
bool bench_large(struct bench *bench, struct bench_result *result, struct error *error);

/// Runs a spline of the caller's, which has knots.
bool bench_spline(struct bench *bench, const char *name, const wiggly_desc *desc, struct bench_result *result,
                  struct error *error);

#endif

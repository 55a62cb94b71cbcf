/// The solver's benchmark: a table of cases, each verified before it is timed, beside LAPACK's banded solvers on the same systems.
#ifndef TIMING_BENCH_H
#define TIMING_BENCH_H

#include "base/error.h"

/// One line of the table. Times are of one core.
struct bench_result {
    const char *name; ///< "single/complex/1000"
    const char *mode;
    int samples, splines, threads, lanes;
    double ns_per_sample;       ///< fastest run of the whole solve: poles, assembly, factor, refinement
    double p50_us, p99_us;      ///< of one solve
    double dpbsv_ns_per_sample; ///< LAPACKE_dpbsv, factor and solve alone; NAN where LAPACKE is not installed
    double zpbsv_ns_per_sample; ///< LAPACKE_zpbsv on the system with both parts of the knots fixed; NAN likewise
    double error;               ///< largest difference to LAPACKE (refined once), relative; else own estimate
};

/// The machine, for the report.
struct bench_machine {
    char cpu[128];
    char blas[256]; ///< the BLAS that was loaded, or why there is none
};

/// Runs every case; `done` is called after each. false with a sentence if a result is wrong.
bool bench_run(struct bench_machine *machine, void (*done)(void *user, const struct bench_result *result), void *user,
               struct error *error);

#endif

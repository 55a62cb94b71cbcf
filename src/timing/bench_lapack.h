/// A solver's system as LAPACK's banded solvers take it: for the benchmark.
#ifndef TIMING_BENCH_LAPACK_H
#define TIMING_BENCH_LAPACK_H

#include "base/lapack.h"
#include "spline/solver.h"

enum { MOST_BORDER = 4 }; ///< unknowns of a loop's last two samples

/// The squared system in LAPACK's lower band storage (column major). A loop is bordered: the band has all but its last two
/// samples, their columns stand as right-hand sides beside the first, and the small system that is left is solved here.
struct banded {
    int samples; ///< capacity
    int width;   ///< unknowns a sample
    int unknowns, band_width, border;
    double *band, *right; ///< right-hand sides: the gradient's, then one for each unknown of the border
    double *band_copy, *right_copy;
    double corner[MOST_BORDER][MOST_BORDER], corner_right[MOST_BORDER], corner_solution[MOST_BORDER];
    double complex *hermitian, *hermitian_right;
};

bool banded_create(struct banded *b, int samples);
void banded_destroy(struct banded *b);

/// Takes what solver_describe() left: the gradient at "knots fixed, 0 elsewhere" stands on the right, so that the solution is x
/// less the knots.
void banded_fill(struct banded *b, wiggly_solver *solver);

/// Seconds that LAPACKE_dpbsv takes, with what a border needs; NAN where it failed.
double banded_solve(struct banded *b, const struct lapack *lapack);

/// An unknown of the solution.
static inline double banded_solution(const struct banded *b, int unknown)
{
    return unknown < b->unknowns ? b->right_copy[unknown] : b->corner_solution[unknown - b->unknowns];
}

/// Seconds that LAPACKE_zpbsv takes for the Hermitian system if knots fixed both parts: between knots it is the same. Not of a loop.
double banded_solve_hermitian(struct banded *b, const struct lapack *lapack, const wiggly_solver *solver);

#endif

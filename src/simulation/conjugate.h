/// Conjugate gradients, preconditioned by the inverses of the diagonal blocks.
///
/// Why no factorisation: in a time step the matrix is κM + K, whose first term keeps the condition low. Some twenty products
/// of a matrix that fits the cache replace a factorisation whose fill would not (times in README.md), and no library is
/// needed.
#ifndef SIMULATION_CONJUGATE_H
#define SIMULATION_CONJUGATE_H

#include "simulation/blocks.h"
#include <stdbool.h>

/// Scratch: four vectors and the preconditioner. Made once for any number of solves.
struct conjugate {
    double (*r)[3], (*z)[3], (*p)[3], (*q)[3];
    double (*inverse)[9]; ///< of the diagonal blocks
};
void conjugate_create(struct conjugate *conjugate, int rows);
void conjugate_free(struct conjugate *conjugate);

/// Solves A x = b for a definite A from the guess x, until the residual in the preconditioner's norm has fallen by
/// `tolerance` relative to that of x = 0. Returns the iterations taken, at most `limit`.
int conjugate_solve(struct conjugate *conjugate, const struct blocks *a, const double (*b)[3], double (*x)[3],
                    double tolerance, int limit);

#endif

/// Sparse symmetric matrices of 3×3 blocks, one block row per node, both triangles stored, and their solution by conjugate gradients,
/// preconditioned by the inverses of the diagonal blocks.
///
/// No factorisation: in a time step the matrix is κM + K, and κM keeps the condition number low. Some twenty products with a
/// matrix that fits the cache are faster than a factorisation with its fill-in (times in README.md), and need no library.
#ifndef SIMULATION_BLOCKS_H
#define SIMULATION_BLOCKS_H

#include "base/pool.h"
#include "simulation/element.h"
#include <stdbool.h>

struct blocks {
    int rows;
    int *start;         ///< rows + 1
    int *column;        ///< ascending in each row
    double (*block)[9]; ///< row by row
    int *diagonal;      ///< per row: index of block (i, i)
};

/// The pattern of a mesh, in memory of `pool`: a block for each pair of nodes that share an element.
void blocks_create(struct blocks *blocks, int nodes, const struct element *elements, int count, struct pool *pool);

/// Index of the block (row, column), which must be in the pattern.
int blocks_find(const struct blocks *blocks, int row, int column);

/// y = A x, one vector of three per row.
void blocks_multiply(const struct blocks *blocks, const double (*x)[3], double (*y)[3]);

/// Scratch: four vectors and the preconditioner. Made once for any number of solves, in memory of `pool`.
struct conjugate {
    double (*r)[3], (*z)[3], (*p)[3], (*q)[3];
    double (*inverse)[9]; ///< of the diagonal blocks
};
void conjugate_create(struct conjugate *conjugate, int rows, struct pool *pool);

/// Solves A x = b for a definite A from the guess x, until the residual in the preconditioner's norm has fallen by
/// `tolerance` relative to that of x = 0. Returns the iterations taken, at most `limit`.
int conjugate_solve(struct conjugate *conjugate, const struct blocks *a, const double (*b)[3], double (*x)[3],
                    double tolerance, int limit);

#endif

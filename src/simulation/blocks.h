/// Sparse symmetric matrices of 3×3 blocks, one block row per node, both triangles stored.
#ifndef SIMULATION_BLOCKS_H
#define SIMULATION_BLOCKS_H

#include "simulation/element.h"
#include <stdbool.h>

struct blocks {
    int rows;
    int *start;         ///< rows + 1
    int *column;        ///< ascending in each row
    double (*block)[9]; ///< row by row
    int *diagonal;      ///< per row: index of block (i, i)
};

/// The pattern of a mesh: a block for each pair of nodes that share an element.
void blocks_create(struct blocks *blocks, int nodes, const struct element *elements, int count);
void blocks_free(struct blocks *blocks);

/// Index of the block (row, column), which must be in the pattern.
int blocks_find(const struct blocks *blocks, int row, int column);

/// y = A x, one vector of three per row.
void blocks_multiply(const struct blocks *blocks, const double (*x)[3], double (*y)[3]);

#endif

/// A block-tridiagonal system of 3×3 blocks, condensed in a tree: a change of a few rows is answered in O(log rows).
#ifndef SPLINE_TREE_H
#define SPLINE_TREE_H

#include "spline/chain.h"

enum { TREE_FAN = 16, TREE_MAX_LEVELS = 8 };

/// A run of rows with all but its ends eliminated: what is left couples the first and the last row.
typedef struct tree_element {
    double first[6], last[6]; ///< diagonal blocks (00 01 02 11 12 22)
    double coupling[9];       ///< A_{last,first}
    double right_first[3], right_last[3];
    bool weak; ///< a pivot inside has lost digits
} tree_element;

/// One row of a run while it is eliminated, and what is kept to solve for it later.
typedef struct tree_row {
    double pivot[6];    ///< inverse
    double below[9];    ///< A_{k+1,k}
    double to_first[9]; ///< A_{k,first} at the time of its elimination
    double right[3];
} tree_row;

typedef struct tree {
    chain *chain; ///< whose rows (not factored) are the leaves
    int levels;
    int count[TREE_MAX_LEVELS]; ///< elements of each level; level 0 are the leaves
    tree_element *elements[TREE_MAX_LEVELS];
    tree_row *rows[TREE_MAX_LEVELS]; ///< of the runs that the level's elements condense
} tree;

/// Elements of all levels for a number of rows; how many rows of runs each level has.
int tree_shape(int rows, int count[TREE_MAX_LEVELS], int run_rows[TREE_MAX_LEVELS]);

/// Condenses what depends on the chain's rows `from` … `to`; everything for 0 … rows − 1. false where a pivot is not positive.
bool tree_update(tree *tree, int from, int to);

/// The same where the chain has one row more than at the last time, and only its last rows differ.
bool tree_grow(tree *tree);

/// Solves for the chain's nodes `from` … `to` at least: adds the solution to them. false where the root cannot be solved.
bool tree_solve(const tree *tree, int from, int to);

#endif

/// Small dense symmetric matrices, row-major, n × n.
#ifndef MATHS_SYMMETRIC_H
#define MATHS_SYMMETRIC_H

/// `a` is destroyed; values ascend; row k of `vectors` is the k-th eigenvector, of length 1. Meant for n up to a few hundred.
void symmetric_eigen(int n, double *a, double *values, double *vectors);

/// Replaces the first `count` rows of a's lower triangle by their Cholesky factor, and the others by their Schur complement. A row that depends
/// on those before it is left out: its unknown becomes 0.
void symmetric_reduce(int n, int count, double *a);

/// b ← a⁻¹ b, with all of a's rows factored. Returns bᵀ a⁻¹ b; a row that was left out counts at least as much as its pivot was in doubt.
double symmetric_solve(int n, const double *a, double *b);

/// y ← a x.
void symmetric_multiply(int n, int stride, const double *a, const double *x, double *y);

#endif

/// Small dense symmetric matrices, row-major, n × n.
#ifndef SPLINE_SYMMETRIC_H
#define SPLINE_SYMMETRIC_H

/// Eigenvalues, and the eigenvectors as the columns of `vectors`; `a` is destroyed. For a symmetric positive semidefinite `a`.
void symmetric_eigen(int n, double *a, double *values, double *vectors);

/// The first `count` rows of a's lower triangle ← their Cholesky factor, the others what they are to each other where the first are kept
/// still: the Schur complement. A row that depends on those before it is left out: its unknown comes out 0.
void symmetric_reduce(int n, int count, double *a);

/// b ← a⁻¹ b, of an a whose rows are all factored.
void symmetric_solve(int n, const double *a, double *b);

/// y ← a x.
void symmetric_multiply(int n, int stride, const double *a, const double *x, double *y);

#endif

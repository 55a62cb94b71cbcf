/// Small dense symmetric matrices, row-major, n × n.
#ifndef SPLINE_SYMMETRIC_H
#define SPLINE_SYMMETRIC_H

/// Eigenvalues, and the eigenvectors as the columns of `vectors`; `a` is destroyed. For a symmetric positive semidefinite `a`.
void symmetric_eigen(int n, double *a, double *values, double *vectors);

/// a's lower triangle ← its Cholesky factor. A row that depends on those before it is left out: its unknown comes out 0.
void symmetric_factor(int n, double *a);

/// Row i of the factor, from those above it, which are factored.
void symmetric_factor_row(int n, double *a, int i);

/// b ← a⁻¹ b, of a factored a.
void symmetric_solve(int n, const double *a, double *b);

/// The same for the first `count` rows and columns.
void symmetric_solve_part(int n, int count, const double *a, double *b);

#endif

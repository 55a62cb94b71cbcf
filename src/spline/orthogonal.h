/// The un-squared rows R of a system, brought to triangular form Q U = R by Householder reflections: Uᵀ U is the same matrix that
/// pentadiagonal.h factors, but its condition was never squared. For long domains.
#ifndef SPLINE_ORTHOGONAL_H
#define SPLINE_ORTHOGONAL_H

#include "spline/system.h"

/// Factors into the memory of `matrix` (diagonal: U_kk, below: U_{k,k+1}, below2: U_{k,k+2}, border: U_{k,seam}).
pentadiagonal_rank orthogonal_factor(const system_rows *rows, pentadiagonal *matrix);

/// b ← (Uᵀ U)⁻¹ b after a successful factor.
void orthogonal_solve(const pentadiagonal *matrix, double *b);

#endif

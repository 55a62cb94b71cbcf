/// The spline in quadruple precision, for long domains: rows of the energy as docs/mathematics.md has them, normal equations in
/// a band, L D Lᵀ. Written for clarity; constant parameters, no equilibrium, start free.
#ifndef TESTS_QUAD_H
#define TESTS_QUAD_H

#include <wiggly/more.h>

/// Solves; re and im receive desc->samples numbers (im may be NULL outside complex mode). Exits the test on a bad pivot.
void quad_solve(const wiggly_desc *desc, double *re, double *im);

#endif

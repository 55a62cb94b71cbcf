/// Solves a spline in quadruple precision, for long domains: the energy's rows from docs/mathematics.md, banded normal equations, L D Lᵀ.
/// Written for clarity: constant parameters, no equilibrium, free start.
#ifndef TESTS_QUAD_H
#define TESTS_QUAD_H

#include <wiggly/more.h>

/// re and im receive desc->samples numbers; im may be NULL outside complex mode. Exits the test on a bad pivot.
void quad_solve(const wiggly_desc *desc, double *re, double *im);

#endif

/// One spline of many (wiggly_batch_solve_many()). Internal to src/spline.
#ifndef SPLINE_MANY_H
#define SPLINE_MANY_H

#include "spline/solver.h"

/// Solves spline number `spline` by a description that was read (desc_read()).
wiggly_status many_solve(wiggly_solver *solver, const wiggly_desc *desc, const wiggly_many *many, int spline);

#endif

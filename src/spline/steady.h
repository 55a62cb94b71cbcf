/// Steady splines: the mean of the solutions at frequencies around the description's (docs/mathematics.md, Steady). Internal to
/// src/spline.
#ifndef SPLINE_STEADY_H
#define SPLINE_STEADY_H

#include "spline/problem.h"

/// Whether there is more than one solution to take the mean of: not of a cubic, nor without knots, nor where pins pull.
bool steady_is_set(const problem *p);

/// problem_find() of a steady spline, or limits_find() where it has limits.
wiggly_status steady_find(wiggly_solver *solver, problem *p, wiggly_curve *curve, minimum *result);

#endif

/// A curve with its own arrays, for solver tests.
#ifndef TESTS_CURVE_H
#define TESTS_CURVE_H

#include "near.h"

#include <wiggly/more.h>

static inline wiggly_curve curve_create(int samples)
{
    double *numbers = calloc(5 * (size_t)samples, sizeof *numbers);
    size_t n = (size_t)samples;
    return (wiggly_curve){.size = sizeof(wiggly_curve),
                          .total = numbers,
                          .y = numbers + n,
                          .re = numbers + 2 * n,
                          .im = numbers + 3 * n,
                          .omega = numbers + 4 * n};
}

/// Solves into it with a solver of its own.
static inline void curve_solve(wiggly_curve *curve, const wiggly_desc *desc)
{
    wiggly_solver *solver;
    assert_int_equal(wiggly_create(desc->samples, desc->knot_count, &solver), WIGGLY_OK);
    assert_int_equal(wiggly_solve(solver, desc, curve), WIGGLY_OK);
    wiggly_destroy(solver);
}

static inline void curve_destroy(wiggly_curve *curve) { free(curve->total); }

#endif

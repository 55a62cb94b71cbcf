/// A curve with its own arrays, for solver tests.
#ifndef TESTS_CURVE_H
#define TESTS_CURVE_H

#include "near.h"

#include <wiggly/more.h>

/// A curve in 5 × samples numbers.
static inline wiggly_curve curve_in(double *numbers, int samples)
{
    size_t n = (size_t)samples;
    return (wiggly_curve){.size = sizeof(wiggly_curve),
                          .total = numbers,
                          .y = numbers + n,
                          .re = numbers + 2 * n,
                          .im = numbers + 3 * n,
                          .omega = numbers + 4 * n};
}

static inline wiggly_curve curve_create(int samples)
{
    return curve_in(calloc(5 * (size_t)samples, sizeof(double)), samples);
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

/// For TESTS_BETWEEN(): a solver and a curve that all tests of a file share.
#define SHARED_SOLVER_AND_CURVE(samples, knots)                                                                      \
    static wiggly_solver *solver;                                                                                    \
    static wiggly_curve curve;                                                                                       \
    static int set_up(__attribute__((unused)) void **state)                                                          \
    {                                                                                                                \
        curve = curve_create(samples);                                                                               \
        return (int)wiggly_create(samples, knots, &solver);                                                          \
    }                                                                                                                \
    static int tear_down(__attribute__((unused)) void **state)                                                       \
    {                                                                                                                \
        curve_destroy(&curve);                                                                                       \
        wiggly_destroy(solver);                                                                                      \
        return 0;                                                                                                    \
    }

#endif

/// Solves splines whose knots and curves are in strided arrays. The knots of the current spline are copied to the solver's memory; a curve
/// with a stride is scattered from there.
#include "spline/many.h"
#include <limits.h>
#include <math.h>

static double number(const wiggly_numbers *of, int spline, int k)
{
    return of->at ? of->at[spline * of->by_spline + k * of->by_number] : NAN;
}

/// The nearest sample; outside the range if an int cannot hold it.
static int nearest(double sample)
{
    const double whole = floor(sample + 0.5);
    return fabs(whole) < INT_MAX ? (int)whole : -1;
}

/// Returns the number of knots, at most one more than there is room for.
static int fill_knots(const wiggly_many *many, int spline, wiggly_knot *knots, int room)
{
    int count = 0;
    for (int k = 0; k < many->knot_count && count <= room; k++) {
        const double sample = number(&many->sample, spline, k), slope = number(&many->slope, spline, k),
                     phase = number(&many->phase, spline, k), stiffness = number(&many->stiffness, spline, k);
        if (isnan(sample)) continue;
        knots[count++] = (wiggly_knot){.sample = nearest(sample),
                                       .has_slope = !isnan(slope),
                                       .has_phase = !isnan(phase),
                                       .still = number(&many->still, spline, k) > 0,
                                       .value = number(&many->value, spline, k),
                                       .slope = slope,
                                       .stiffness = many->stiffness.at ? stiffness : 0,
                                       .phase = phase};
    }
    return count;
}

/// A knot's index among all of its spline's, counting those left out.
static int place_of(const wiggly_many *many, int spline, int knot)
{
    int k = 0;
    for (int left = knot; k < many->knot_count; k++) {
        if (!isnan(number(&many->sample, spline, k)) && left-- == 0) break;
    }
    return knot < 0 ? -1 : k;
}

/// The caller's row; the solver's if the caller's is strided; NULL if it is not wanted.
static double *row_of(const wiggly_rows *rows, int spline, double *own)
{
    if (!rows->at) return NULL;
    return rows->by_number == 1 ? rows->at + spline * rows->by_spline : own;
}

static void scatter(const wiggly_rows *rows, int spline, const double *from, int count)
{
    if (!rows->at || rows->by_number == 1) return;
    double *to = rows->at + spline * rows->by_spline;
    for (int i = 0; i < count; i++) to[i * rows->by_number] = from[i];
}

wiggly_status many_solve(wiggly_solver *solver, const wiggly_desc *desc, const wiggly_many *many, int spline)
{
    wiggly_desc own = *desc;
    own.knots = solver->filled;
    own.knot_count = fill_knots(many, spline, solver->filled, solver->knots);
    // Where a solve itself keeps them if the caller does not want them.
    double *const total = solver->rows.jet, *const y = solver->y, *const re = solver->limits.re,
                  *const im = solver->limits.im;
    wiggly_curve curve = {.size = sizeof curve,
                          .total = row_of(&many->total, spline, total),
                          .y = row_of(&many->y, spline, y),
                          .re = row_of(&many->re, spline, re),
                          .im = row_of(&many->im, spline, im),
                          .knot = -1};
    const wiggly_status status = solver_solve(solver, &own, &curve);
    if (many->knot) many->knot[spline] = place_of(many, spline, curve.knot);
    if (status >= WIGGLY_ERROR_ARGUMENT) return status;
    scatter(&many->total, spline, total, own.samples);
    scatter(&many->y, spline, y, own.samples);
    scatter(&many->re, spline, re, own.samples);
    scatter(&many->im, spline, im, own.samples);
    return status;
}

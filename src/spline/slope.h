/// The slope of a solved curve at a sample: a knot with this slope and the curve's value does not change the curve.
#ifndef SPLINE_SLOPE_H
#define SPLINE_SLOPE_H

#include "spline/forced_response.h"

/// Numbers a sample that it needs where the equilibrium follows a track.
enum { CURVE_SLOPE_ROOM = 3 + RESPONSE_ROOM };

/// That slope, per second. `desc` is what was solved; of its knots only the last is read. `room` has CURVE_SLOPE_ROOM numbers a sample; NULL
/// where the equilibrium is constant.
double curve_slope(const wiggly_desc *desc, const wiggly_curve *curve, int sample, double *room);

#endif

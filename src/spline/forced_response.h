/// The forced response: a damped oscillator's free motion as its equilibrium moves (docs/mathematics.md, Passive).
#ifndef SPLINE_FORCED_RESPONSE_H
#define SPLINE_FORCED_RESPONSE_H

#include "spline/system.h"

/// Numbers a sample that a loop needs.
enum { RESPONSE_ROOM = 20 };

/// The response u to an equilibrium, as arrays of N numbers.
typedef struct forced_response {
    double *total;        ///< y + Re u
    double *im;           ///< Im u; 0 in real mode
    double *speed;        ///< of y + Re u, 1/s: at rest before the first sample, constant after the last
    double error;         ///< a bound of u's, absolute
    double rounding;      ///< of that, what each sample has for itself
    double state[2];      ///< bounds of q's and z's (forced_response.c)
    double missed[2];     ///< of what their steps miss, all together
    double floor;         ///< the least damping ratio
    const double *offset; ///< what settling knots add to the equilibrium: Im u sees its speed, too; NULL: nothing
    double *room;         ///< scratch of a loop: RESPONSE_ROOM numbers a sample
} forced_response;

/// u for the equilibrium y, N numbers, in complex or real mode; in a loop the last is the first. `calm` sets the loop's damping floor.
/// WIGGLY_CALMED if a loop of calm 0 has no response, or one of 10⁴ times y's range: u is then that of calm 0.05.
wiggly_status forced_response_find(const wiggly_desc *desc, const double *y, double calm, forced_response *u);

/// A bound of ‖W^½ R e‖ for the error e of u: what of it is no free motion of the rows (minimise.c).
double forced_response_slip(const wiggly_desc *desc, const forced_response *u, const system_rows *rows);

/// u of an equilibrium that nothing swings about: 0.
void forced_response_rest(const wiggly_desc *desc, const double *y, forced_response *u);

// The slope of a solved curve at a sample: a knot with this slope and the curve's value does not change the curve.

/// Numbers a sample that it needs where the equilibrium follows a track.
enum { CURVE_SLOPE_ROOM = 3 + RESPONSE_ROOM };

/// That slope, per second. `desc` is what was solved; of its knots only the last is read. `room` has CURVE_SLOPE_ROOM numbers a sample; NULL
/// where the equilibrium is constant.
double curve_slope(const wiggly_desc *desc, const wiggly_curve *curve, int sample, double *room);

#endif

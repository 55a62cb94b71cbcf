/// The forced response: a damped oscillator's free motion as its equilibrium moves (docs/mathematics.md, Passive).
#ifndef SPLINE_FORCED_RESPONSE_H
#define SPLINE_FORCED_RESPONSE_H

#include <wiggly/more.h>

/// Numbers a sample that a loop of varying parameters needs.
enum { RESPONSE_ROOM = 19 };

/// The response u to an equilibrium, as arrays of N numbers.
typedef struct forced_response {
    double *total;        ///< y + Re u
    double *im;           ///< Im u; 0 in real mode
    double *speed;        ///< of Re u, 1/s; in the middle of its jump
    double error;         ///< estimated, of u
    const double *offset; ///< what settling knots add to the equilibrium: Im u sees its speed, too; NULL: nothing
    double *room;         ///< scratch: RESPONSE_ROOM numbers a sample
} forced_response;

/// u for the equilibrium y, N numbers, in complex or real mode; in a loop the last is the first. `calm` sets the loop's damping floor.
/// WIGGLY_CALMED if a loop of calm 0 has no response, or one of 10⁴ times y's range: u is then that of calm 0.05.
wiggly_status forced_response_find(const wiggly_desc *desc, const double *y, double calm, forced_response *u);

/// u of a constant equilibrium: 0.
void forced_response_rest(const wiggly_desc *desc, const double *y, forced_response *u);

/// The speed of y + Re u at a sample, 1/s, from y's differences on both sides: at rest before the first, constant after the last.
double forced_response_speed(const wiggly_desc *desc, const double *y, const forced_response *u, int sample);

#endif

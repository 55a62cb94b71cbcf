/// The forced response: what a damped oscillator does by itself as its equilibrium moves (docs/mathematics.md, Passive).
#ifndef SPLINE_FORCED_RESPONSE_H
#define SPLINE_FORCED_RESPONSE_H

#include <wiggly/more.h>

/// The answer u to an equilibrium, as arrays of N numbers.
typedef struct forced_response {
    double *total; ///< y + Re u
    double *im;    ///< Im u; 0 in real mode
    double *speed; ///< of Re u, 1/s; in the middle of its jump
    double error;  ///< estimated, of u
} forced_response;

/// u of a description whose equilibrium is y, N numbers, in complex or real mode; in a loop the last is the first. `calm` is that of
/// the loop's damping floor. WIGGLY_CALMED where a loop of calm 0 has no answer, or one 10⁴ times y's range: that of calm 0.05 then.
wiggly_status forced_response_find(const wiggly_desc *desc, const double *y, double calm, forced_response *u);

/// u of an equilibrium that stays where it is: 0.
void forced_response_rest(const wiggly_desc *desc, const double *y, forced_response *u);

/// The speed of y + Re u at a sample, 1/s: y's differences on both sides, from rest before the first, straight on behind the last.
double forced_response_speed(const wiggly_desc *desc, const double *y, const forced_response *u, int sample);

#endif

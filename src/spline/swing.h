/// What a damped oscillator does by itself as its equilibrium moves (docs/mathematics.md, Passive).
#ifndef SPLINE_SWING_H
#define SPLINE_SWING_H

#include <wiggly/wiggly.h>

/// The answer u to an equilibrium, as arrays of N numbers.
typedef struct swing {
    double *total; ///< y + Re u
    double *im;    ///< Im u; 0 in real mode
    double *speed; ///< of Re u, 1/s; in the middle of its jump
    double error;  ///< estimated, of u
} swing;

/// u of a description whose equilibrium is y, N numbers, in complex or real mode; in a loop the last is the first. `calm` is that of
/// the loop's damping floor. WIGGLY_CALMED where a loop of calm 0 has no answer, or one 10⁴ times y's range: that of calm 0.05 then.
wiggly_status swing_answer(const wiggly_desc *desc, const double *y, double calm, swing *u);

/// u of an equilibrium that stays where it is: 0.
void swing_rest(const wiggly_desc *desc, const double *y, swing *u);

/// The speed of y + Re u at a sample, 1/s: y's differences on both sides, from rest before the first, straight on behind the last.
double swing_speed(const wiggly_desc *desc, const double *y, const swing *u, int sample);

#endif

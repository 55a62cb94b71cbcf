/// Shared by the textbook's files.
#ifndef TESTS_TEXTBOOK_PARTS_H
#define TESTS_TEXTBOOK_PARTS_H

#include "textbook.h"

/// An unknown's row in the band. A loop's samples are folded, 0, P − 1, 1, P − 2 …, so that neighbours across its seam are close, too.
int textbook_place(const struct textbook *book, int unknown);

/// A parameter at a sample.
real textbook_param(wiggly_param param, int sample);

/// Poles at a sample, with a damping ratio of at least `floor`.
struct textbook_poles textbook_poles_at(const wiggly_desc *desc, int sample, real floor);

/// Poles of all samples; in a loop the last are the first.
void textbook_fill_poles(const wiggly_desc *desc, real floor, bool loop, struct textbook_poles *at);

/// The speed by two poles: w′ = P w(0) + Q w(h), forward or (h < 0) backward.
struct textbook_speed {
    number P, Q;
};
struct textbook_speed textbook_speed_of(const struct textbook_poles *at, real h);

/// y before and after a sample, also beyond the domain.
real textbook_y_before(const struct textbook *book, int sample);
real textbook_y_after(const struct textbook *book, int sample);

/// A knot's target w; unspecified parts are 0.
number textbook_knot(const wiggly_desc *desc, const struct textbook *book, const wiggly_knot *knot);

/// u, and the speed of y + Re u: the oscillator's response to the moving equilibrium.
void textbook_forced_response(const wiggly_desc *desc, struct textbook *book);

/// The knots in order of their samples.
void textbook_sorted(const wiggly_desc *desc, const wiggly_knot **knots);

/// Samples of the wind-up before a knot of that natural frequency; infinite at 0.
real textbook_reach(const wiggly_desc *desc, real natural);

/// w of a spline that winds up.
void textbook_wind_up(const wiggly_desc *desc, struct textbook *book);

/// Moves y to where knots settle.
void textbook_settle(const wiggly_desc *desc, struct textbook *book);

/// All rows of the energy, squared, and the fixed unknowns. `level` adds slope 0 at the earliest knot.
void textbook_assemble(const wiggly_desc *desc, struct textbook *book, bool level);

#endif

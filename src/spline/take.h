/// What a take says to those who edit it frame by frame.
#ifndef SPLINE_TAKE_H
#define SPLINE_TAKE_H

#include <wiggly/wiggly.h>

/// What it is made of, with its knots as they are now.
const wiggly_desc *take_desc(const wiggly_take *take);

/// wiggly_take_set_knot() where that touches the rows around the knot alone: not where knots share a node, nor for the first
/// one's time, nor where the tables are full. Elsewhere false, and the take is good for nothing but wiggly_take_destroy().
bool take_patch_knot(wiggly_take *take, int index, wiggly_knot knot);

#endif

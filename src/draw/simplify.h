/// Fewer points for the same picture. Private to draw/.
#ifndef DRAW_SIMPLIFY_H
#define DRAW_SIMPLIFY_H

#include "draw/line.h"

/// Scales points to device pixels and leaves out those that lie within a twentieth of a pixel of the line without them.
/// Reads until `out` (`capacity` points, at least 3) is full; returns how many were written, and in `read` how many
/// input points were looked at: where that is less than `count`, the rest begins at point read − 1. Ends are kept.
int simplify_line(const float *xy, int count, float scale, struct line_point *out, int capacity, int *read);

#endif

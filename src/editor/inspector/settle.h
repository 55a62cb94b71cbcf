/// How long a spline takes to settle: what people feel of damping.
#ifndef EDITOR_INSPECTOR_SETTLE_H
#define EDITOR_INSPECTOR_SETTLE_H

#include "scene/document.h"

enum { SETTLE_LIMIT = 1000 }; ///< seconds; later than that nobody waits for it

enum settle_kind {
    SETTLE_UNKNOWN, ///< a track drives a pole: no number is true for long
    SETTLE_CUBIC,   ///< there is no swing
    SETTLE_NEVER,   ///< it rings forever
    SETTLE_LATE,    ///< after SETTLE_LIMIT
    SETTLE_ALONE,   ///< `seconds` after it is let go
    SETTLE_SEEN,    ///< `seconds` after the last knot
    SETTLE_LEFT,    ///< not before the range ends, when `left` of the swing is left
};

struct settling {
    enum settle_kind kind;
    double seconds, left;
};

/// Looks at the motion behind the last knot, where there is one, in a curve of that spline: the time after which the swing |x|, of which
/// every joint shows a part whatever its lag, stays within 5 % of what it was at that knot (in real mode, of its largest there).
/// A loop, a spline without knots, and one without a swing behind the last tell what their parameters say: how long a swing takes that
/// is let go. Allocates nothing.
struct settling settle_measure(const struct spline *spline, const wiggly_curve *curve, int last_knot);

/// The same from the parameters alone, at this sampling (`step` seconds). An oscillator's is its envelope's; the filter's is run,
/// x_{i+1} = a x_i + b x_{i−1} (eq. 20, 21): in complex mode a swing with both poles alike, in real mode a displacement at standstill.
/// Beyond some 100,000 samples the slower pole's radius answers.
struct settling settle_alone(const struct spline *spline, double step);

#endif

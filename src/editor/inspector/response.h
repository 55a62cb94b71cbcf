/// Effects of frequency and damping: the response of the filter that turns jet-engine force into motion (paper: section 4, eq. 19,
/// Figure 2), and how long a spline takes to settle.
///
/// An analysis view beside the spline: the two-pole real and the four-pole real filter are what the paper compares its
/// two-pole complex one with.
#ifndef EDITOR_INSPECTOR_RESPONSE_H
#define EDITOR_INSPECTOR_RESPONSE_H

#include "scene/document.h"

enum { FILTER_MAX_POLES = 4 };

/// H(z) = ∏ 1/(1 − λ z⁻¹) over its poles λ = exp(s·step).
struct filter {
    int count;
    double s[FILTER_MAX_POLES][2]; ///< continuous poles, real and imaginary part, 1/s
    double step;                   ///< seconds a sample
};

/// Figure 2's rows, top to bottom.
enum filter_kind { FILTER_TWO_REAL, FILTER_FOUR_REAL, FILTER_TWO_COMPLEX, FILTER_KINDS };

/// A filter of a kind around the pole −ζω + jω√(1−ζ²), ω = 2π·hz: real ones have the conjugate poles too, all but the
/// two-pole real one are opened by ±jβω (docs/mathematics.md, Poles). `damping` above 1 gives the two-pole real filter two real
/// poles and counts as 1 for the others.
struct filter filter_of(enum filter_kind kind, double hz, double damping, double bandwidth, double step);

/// 20 log₁₀ |H(e^{2πj·hz·step})|; hz may be negative. Finite also at a pole on the unit circle.
double filter_decibels(const struct filter *filter, double hz);

/// Curves of the figure, at frequencies from 0 to half the sample rate.
struct passband {
    double peak;  ///< dB
    double zero;  ///< response at zero frequency relative to the peak, dB
    double width; ///< Hz between the outermost points 3.01 dB (half the power) below the peak
};

struct passband filter_passband(const struct filter *filter);

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

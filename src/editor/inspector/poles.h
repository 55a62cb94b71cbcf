/// Effects of frequency and damping: the response of the filter from jet-engine force to motion (paper: section 4, eq. 19, Figure 2), and
/// the settling time of a spline. The paper compares its two-pole complex filter with the two real ones.
#ifndef EDITOR_INSPECTOR_POLES_H
#define EDITOR_INSPECTOR_POLES_H

#include "scene/document.h"

enum { FILTER_MAX_POLES = 4 };

/// H(z) = ∏ 1/(1 − λ z⁻¹) over its poles λ = exp(s·step).
struct filter {
    int count;
    double s[FILTER_MAX_POLES][2]; ///< continuous poles, real and imaginary part, 1/s
    double step;                   ///< seconds per sample
};

/// The rows of Figure 2.
enum filter_kind { FILTER_TWO_REAL, FILTER_FOUR_REAL, FILTER_TWO_COMPLEX, FILTER_KINDS };

/// A filter around the pole −ζω + jω√(1−ζ²), ω = 2π·hz. Real filters also have the conjugate poles; all but the two-pole real one are split
/// by ±jβω (docs/mathematics.md, Poles). `damping` above 1 gives the two-pole real filter two real poles and counts as 1 for the others.
struct filter filter_of(enum filter_kind kind, double hz, double damping, double bandwidth, double step);

/// 20 log₁₀ |H(e^{2πj·hz·step})|, for any sign of hz. Finite even at a pole on the unit circle.
double filter_decibels(const struct filter *filter, double hz);

enum { SETTLE_LIMIT = 1000 }; ///< seconds; longer times are not reported

enum settle_kind {
    SETTLE_UNKNOWN, ///< a track changes a pole over time
    SETTLE_CUBIC,   ///< no swing
    SETTLE_NEVER,   ///< it rings forever
    SETTLE_LATE,    ///< after SETTLE_LIMIT
    SETTLE_ALONE,   ///< `seconds` after release
    SETTLE_SEEN,    ///< `seconds` after the last knot
    SETTLE_LEFT,    ///< `left` of the swing remains at the end of the range
};

struct settling {
    enum settle_kind kind;
    double seconds, left;
};

/// Measures the motion after the last knot: when the swing |x| stays within 5 % of its size at that knot (in real mode, of its largest size
/// there). Lags do not change |x|, so the result holds for every joint. A loop, and a spline without knots or without a swing after the
/// last one, give the time from their parameters instead. Allocates nothing.
struct settling settle_measure(const struct spline *spline, const wiggly_curve *curve, int last_knot);

/// Settling time from the parameters alone, at `step` seconds per sample. An oscillator uses its envelope. The filter is run, x_{i+1} = a
/// x_i + b x_{i−1} (eq. 20, 21): in complex mode a swing with both poles alike, in real mode a displacement at rest. Above about 100,000
/// samples the slower pole's radius gives the answer.
struct settling settle_alone(const struct spline *spline, double step);

#endif

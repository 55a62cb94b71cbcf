/// Frequency response of the filter that turns jet-engine force into motion (paper: section 4, eq. 19, Figure 2).
///
/// An analysis view beside the spline: the two-pole real and the four-pole real filter are what the paper compares its
/// two-pole complex one with.
#ifndef EDITOR_INSPECTOR_RESPONSE_H
#define EDITOR_INSPECTOR_RESPONSE_H

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

/// What the figure shows of a response at frequencies from 0 to half the sample rate.
struct passband {
    double peak_hz;
    double peak;  ///< dB
    double zero;  ///< response at zero frequency relative to the peak, dB
    double width; ///< Hz between the outermost points 3.01 dB (half the power) below the peak
};

struct passband filter_passband(const struct filter *filter);

#endif

/// Evaluates the filter's frequency response.
#include "editor/inspector/response.h"
#include <math.h>

enum { SCAN = 512, BISECTIONS = 60 };
static const double half_power = 3.0102999566398120; // dB, 10 log₁₀ 2
static const double least = 1e-24;                   // |1 − λ z⁻¹|² of a pole that is met

static void add_pole(struct filter *filter, double re, double im)
{
    filter->s[filter->count][0] = re;
    filter->s[filter->count][1] = im;
    filter->count++;
}

struct filter filter_of(enum filter_kind kind, double hz, double damping, double bandwidth, double step)
{
    struct filter filter = {.step = step};
    double omega = 2 * M_PI * hz;
    if (kind == FILTER_TWO_REAL && damping > 1) {
        double root = sqrt((damping - 1) * (damping + 1));
        add_pole(&filter, -omega / (damping + root), 0);
        add_pole(&filter, -omega * (damping + root), 0);
        return filter;
    }
    double zeta = fmin(damping, 1), re = -zeta * omega, im = omega * sqrt((1 - zeta) * (1 + zeta));
    double turn = kind == FILTER_TWO_REAL ? 0 : bandwidth * omega;
    add_pole(&filter, re, im + turn);
    if (kind != FILTER_TWO_REAL) add_pole(&filter, re, im - turn);
    if (kind == FILTER_TWO_COMPLEX) return filter;
    for (int i = filter.count; i > 0; i--) add_pole(&filter, filter.s[i - 1][0], -filter.s[i - 1][1]);
    return filter;
}

double filter_decibels(const struct filter *filter, double hz)
{
    double decibels = 0;
    for (int i = 0; i < filter->count; i++) {
        double size = exp(filter->s[i][0] * filter->step);
        double half = 0.5 * (filter->s[i][1] - 2 * M_PI * hz) * filter->step;
        double away = (1 - size) * (1 - size) + 4 * size * sin(half) * sin(half); // |1 − λ z⁻¹|²
        decibels -= 10 * log10(fmax(away, least));
    }
    return decibels;
}

/// The largest response between two frequencies that hold one maximum, by golden section.
static double climb(const struct filter *filter, double low, double high)
{
    const double golden = 0.6180339887498949;
    for (int i = 0; i < BISECTIONS; i++) {
        double a = high - golden * (high - low), b = low + golden * (high - low);
        if (filter_decibels(filter, a) < filter_decibels(filter, b)) {
            low = a;
        } else {
            high = b;
        }
    }
    return 0.5 * (low + high);
}

/// The frequency of the peak: near a pole or between two of them, found on a grid and at the poles themselves.
static double find_peak(const struct filter *filter)
{
    double nyquist = 0.5 / filter->step, spacing = nyquist / SCAN, best = 0;
    for (int i = 1; i <= SCAN; i++) {
        if (filter_decibels(filter, i * spacing) > filter_decibels(filter, best)) best = i * spacing;
    }
    for (int i = 0; i < filter->count; i++) {
        double hz = filter->s[i][1] / (2 * M_PI);
        if (hz < 0 || hz > nyquist || filter_decibels(filter, hz) <= filter_decibels(filter, best)) continue;
        best = hz;
        spacing = fmax(fabs(filter->s[i][0]) / (2 * M_PI), 1e-9 * nyquist);
    }
    double refined = climb(filter, fmax(0, best - spacing), fmin(nyquist, best + spacing));
    return filter_decibels(filter, refined) > filter_decibels(filter, best) ? refined : best;
}

/// Where the response falls below a level on the way from `inside`, which is above it, to `outside`.
static double crossing(const struct filter *filter, double inside, double outside, double level)
{
    if (filter_decibels(filter, outside) >= level) return outside;
    for (int i = 0; i < BISECTIONS; i++) {
        double middle = 0.5 * (inside + outside);
        if (filter_decibels(filter, middle) >= level) {
            inside = middle;
        } else {
            outside = middle;
        }
    }
    return 0.5 * (inside + outside);
}

struct passband filter_passband(const struct filter *filter)
{
    double nyquist = 0.5 / filter->step, low = find_peak(filter), high = low;
    struct passband band = {.peak_hz = low, .peak = filter_decibels(filter, low)};
    band.zero = filter_decibels(filter, 0) - band.peak;
    double level = band.peak - half_power;
    for (int i = 0; i < filter->count; i++) { // a wide opening has a hollow between its poles
        double hz = filter->s[i][1] / (2 * M_PI);
        if (hz < 0 || hz > nyquist || filter_decibels(filter, hz) < level) continue;
        low = fmin(low, hz);
        high = fmax(high, hz);
    }
    band.width = crossing(filter, high, nyquist, level) - crossing(filter, low, 0, level);
    return band;
}

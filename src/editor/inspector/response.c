/// The filter's frequency response, and the settling time of a spline.
#include "editor/inspector/response.h"
#include "maths/maths.h"
#include <complex.h>
#include <math.h>

enum { SCAN = 512, BISECTIONS = 60 };
static const double half_power = 3.0102999566398120; // dB, 10 log₁₀ 2
static const double least = 1e-24;                   // |1 − λ z⁻¹|² at a pole on the circle

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
        double size = maths_exp(filter->s[i][0] * filter->step);
        double half = 0.5 * (filter->s[i][1] - 2 * M_PI * hz) * filter->step;
        double away = (1 - size) * (1 - size) + 4 * size * maths_sin(half) * maths_sin(half); // |1 − λ z⁻¹|²
        decibels -= 10 / M_LN10 * maths_log(fmax(away, least));
    }
    return decibels;
}

/// Golden-section search for the maximum between two frequencies.
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

/// The peak lies near a pole or between two, so a grid and the poles themselves bracket it.
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

/// Where the response falls below a level between `inside` (above it) and `outside`.
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
    struct passband band = {.peak = filter_decibels(filter, low)};
    band.zero = filter_decibels(filter, 0) - band.peak;
    double level = band.peak - half_power;
    for (int i = 0; i < filter->count; i++) { // with a large bandwidth the response dips between the poles
        double hz = filter->s[i][1] / (2 * M_PI);
        if (hz < 0 || hz > nyquist || filter_decibels(filter, hz) < level) continue;
        low = fmin(low, hz);
        high = fmax(high, hz);
    }
    band.width = crossing(filter, high, nyquist, level) - crossing(filter, low, 0, level);
    return band;
}

static const double LEFT = 0.05; ///< of the initial displacement
enum { MAX_SAMPLES = 100000 };

/// false if a track drives a pole.
static bool filter_of_spline(const struct spline *spline, double step, struct filter *filter)
{
    const struct param *p = spline->parameter;
    const bool is_complex = spline_mode(spline) == WIGGLY_COMPLEX;
    if (p[PARAMETER_FREQUENCY].track >= 0 || p[PARAMETER_DAMPING].track >= 0) return false;
    if (is_complex && p[PARAMETER_BANDWIDTH].track >= 0) return false;
    *filter = filter_of(is_complex ? FILTER_TWO_COMPLEX : FILTER_TWO_REAL, p[PARAMETER_FREQUENCY].value,
                        p[PARAMETER_DAMPING].value, p[PARAMETER_BANDWIDTH].value, step);
    return true;
}

/// The sample after which the swing stays within LEFT, of the first `count`, interpolated linearly. Two equal samples count as standstill
/// half-way between them.
static double settled_sample(const struct filter *filter, bool is_complex, int count)
{
    const double(*s)[2] = filter->s;
    double complex l[2];
    for (int k = 0; k < 2; k++) {
        const maths_point turn = maths_turn(s[k][1] * filter->step);
        l[k] = maths_exp(s[k][0] * filter->step) * (turn.cos + I * turn.sin);
    }
    double complex a = l[0] + l[1], b = -l[0] * l[1];
    double complex before = 1, now = is_complex ? a / 2 : 1;
    double size = 1, settled = 0;
    for (int i = 0; i < count; i++) {
        double next_size = is_complex ? maths_hypot(creal(now), cimag(now)) : fabs(creal(now));
        if (size > LEFT) settled = next_size < size ? i + fmin(1, (size - LEFT) / (size - next_size)) : i + 1;
        double complex next = a * now + b * before;
        before = now;
        now = next;
        size = next_size;
    }
    return is_complex ? settled : settled - 0.5;
}

struct settling settle_alone(const struct spline *spline, double step)
{
    struct filter filter;
    if (spline_mode(spline) == WIGGLY_CUBIC) return (struct settling){.kind = SETTLE_CUBIC};
    if (!filter_of_spline(spline, step, &filter)) return (struct settling){.kind = SETTLE_UNKNOWN};
    if (spline->parameter[PARAMETER_FREQUENCY].value == 0) return (struct settling){.kind = SETTLE_CUBIC};
    if (spline->parameter[PARAMETER_DAMPING].value == 0) return (struct settling){.kind = SETTLE_NEVER};
    double rate = fmin(-filter.s[0][0], -filter.s[1][0]); // of the slower pole
    double expected = maths_log(1 / LEFT) / rate;
    if (expected > SETTLE_LIMIT) return (struct settling){.kind = SETTLE_LATE};
    double samples = 3 * expected / step + 8; // a double pole takes 1.6 times as long as its radius suggests
    bool is_complex = spline_mode(spline) == WIGGLY_COMPLEX;
    bool envelope = is_complex && spline->parameter[PARAMETER_PASSIVE].value == WIGGLY_OSCILLATOR;
    if (envelope || samples > MAX_SAMPLES) return (struct settling){.kind = SETTLE_ALONE, .seconds = expected};
    double seconds = step * settled_sample(&filter, is_complex, (int)samples);
    return (struct settling){.kind = SETTLE_ALONE, .seconds = seconds};
}

/// The settling after a sample. `alone` answers if the curve is too long to examine in one frame and still swings at its end.
static struct settling settle_seen(const wiggly_curve *curve, int from, struct settling alone)
{
    int end = (int)fmin(curve->samples, (double)from + MAX_SAMPLES), last = from;
    double size = maths_hypot(curve->re[from], curve->im[from]),
           left = maths_hypot(curve->re[end - 1], curve->im[end - 1]);
    for (int i = from; curve->mode == WIGGLY_REAL && i < end; i++) size = fmax(size, fabs(curve->re[i]));
    for (int i = from; i < end; i++) {
        if (maths_hypot(curve->re[i], curve->im[i]) > LEFT * size) last = i + 1;
    }
    if (last == end && end < curve->samples) return alone;
    if (last == end) return (struct settling){.kind = SETTLE_LEFT, .left = left / size};
    return (struct settling){.kind = SETTLE_SEEN, .seconds = (last - from) * curve->step};
}

/// Whether a swing above rounding error follows the last knot.
static bool swings_behind(const wiggly_curve *curve, int last_knot)
{
    if (curve->mode == WIGGLY_CUBIC || last_knot < 0 || last_knot + 1 >= curve->samples) return false;
    double size = maths_hypot(curve->re[last_knot], curve->im[last_knot]) + fabs(curve->re[last_knot + 1]);
    return size > 1e-9 * fabs(curve->total[last_knot]) && size > 0;
}

struct settling settle_measure(const struct spline *spline, const wiggly_curve *curve, int last_knot)
{
    struct settling alone = settle_alone(spline, curve->step);
    bool dies = alone.kind != SETTLE_CUBIC && alone.kind != SETTLE_NEVER;
    bool open = spline_start(spline) != WIGGLY_LOOP && swings_behind(curve, last_knot);
    return dies && open ? settle_seen(curve, last_knot, alone) : alone;
}

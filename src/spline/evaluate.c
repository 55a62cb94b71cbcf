/// Values between samples (docs/mathematics.md, Phase): Catmull-Rom in a frame that turns with the band's centre,
///     x(t) = e^{jω_c t} · CatmullRom(e^{−jω_c t_i} x_i),
/// so that it follows a free oscillation. In cubic and real mode, and for y, it is plain Catmull-Rom.
#include "maths/maths.h"
#include "spline/poles.h"
#include <float.h>
#include <math.h>

/// Index of a neighbour sample, at most two beyond the curve: wrapped in a loop, else -1.
static int neighbour_of(const wiggly_curve *curve, int i)
{
    if (curve->start == WIGGLY_LOOP) {
        int period = curve->samples - 1;
        return i < 0 ? i + period : i >= period ? i - period : i;
    }
    return i < 0 || i >= curve->samples ? -1 : i;
}

/// Maps a position into the domain: returns sample i, and u beyond it with 0 ≤ u < 1.
static int locate(const wiggly_curve *curve, double position, double *u)
{
    double last = curve->samples - 1;
    if (!(position >= 0 && position < last)) {
        if (curve->start == WIGGLY_LOOP) {
            position -= last * floor(position / last);
            if (!(position < last)) position = 0; // rounded up to the seam
        } else {
            position = fmin(fmax(position, 0), last);
        }
        if (!(position >= 0)) position = 0; // NaN
    }
    int i = (int)position;
    *u = position - i;
    return i;
}

/// A value and its change per sample.
typedef struct bend {
    double at, rate;
} bend;

static bend catmull_rom(double before, double from, double to, double after, double u)
{
    const double c1 = 0.5 * (after - from), c0 = 0.5 * (to - before), step = to - from;
    const double square = 3 * step - 2 * c0 - c1, cube = c0 + c1 - 2 * step;
    return (bend){from + u * (c0 + u * (square + u * cube)), c0 + u * (2 * square + 3 * u * cube)};
}

/// The sample after the next. -1 if there is none, or if a first knot lies between: x is a constant plus the response before it, but not
/// after it.
static int beyond(const wiggly_curve *curve, int i)
{
    return i < curve->first && i + 2 > curve->first ? -1 : neighbour_of(curve, i + 2);
}

/// Interpolates array[i … i+1] at u; a missing neighbour is extrapolated linearly.
static bend interpolate(const wiggly_curve *curve, const double *array, int i, int a, double u)
{
    int b = neighbour_of(curve, i - 1);
    double from = array[i], to = array[i + 1];
    return catmull_rom(b < 0 ? 2 * from - to : array[b], from, to, a < 0 ? 2 * to - from : array[a], u);
}

/// x of a sample minus `base`, turned.
static cplx turned(const wiggly_curve *curve, int i, cplx base, double angle)
{
    const maths_point by = maths_turn(angle);
    return cplx_mul((cplx){by.cos, by.sin}, (cplx){curve->re[i] - base.re, curve->im[i] - base.im});
}

static cplx interpolate_complex(const wiggly_curve *curve, int i, double u, cplx *rate)
{
    int b = neighbour_of(curve, i - 1), a = beyond(curve, i);
    double turn = 0.5 * (curve->omega[i] + curve->omega[i + 1]) * curve->step;
    cplx base = {0, 0};
    if (i < curve->first) base = (cplx){curve->before[0], curve->before[1]};
    cplx from = turned(curve, i, base, 0), to = turned(curve, i + 1, base, -turn);
    cplx before = b < 0 ? (cplx){2 * from.re - to.re, 2 * from.im - to.im} : turned(curve, b, base, turn);
    cplx after = a < 0 ? (cplx){2 * to.re - from.re, 2 * to.im - from.im} : turned(curve, a, base, -2 * turn);
    const bend re = catmull_rom(before.re, from.re, to.re, after.re, u),
               im = catmull_rom(before.im, from.im, to.im, after.im, u);
    const maths_point by = maths_turn(turn * u);
    const cplx frame = {by.cos, by.sin};
    if (rate) *rate = cplx_mul(frame, (cplx){re.rate - turn * im.at, im.rate + turn * re.at});
    return cplx_add(base, cplx_mul(frame, (cplx){re.at, im.at}));
}

/// The value in the interval after sample i; `rate` receives its change per sample, unless it is NULL.
static inline wiggly_value between(const wiggly_curve *curve, int i, double u, wiggly_value *rate)
{
    const bend y = interpolate(curve, curve->y, i, neighbour_of(curve, i + 2), u);
    if (curve->mode != WIGGLY_COMPLEX) {
        const bend re = interpolate(curve, curve->re, i, beyond(curve, i), u);
        if (rate) *rate = (wiggly_value){y.rate, re.rate, 0};
        return (wiggly_value){y.at, re.at, 0};
    }
    cplx moving;
    const cplx x = interpolate_complex(curve, i, u, rate ? &moving : NULL);
    if (rate) *rate = (wiggly_value){y.rate, moving.re, moving.im};
    return (wiggly_value){y.at, x.re, x.im};
}

wiggly_value wiggly_evaluate(const wiggly_curve *curve, double position)
{
    if (curve->samples < 1) return (wiggly_value){0};
    double u;
    int i = locate(curve, position, &u);
    if (u == 0 || i >= curve->samples - 1) return (wiggly_value){curve->y[i], curve->re[i], curve->im[i]};
    return between(curve, i, u, NULL);
}

/// wiggly_evaluate() with the change per second. On a sample it is that of the interval after, on the last that before; beyond the ends 0.
static wiggly_value evaluate_moving(const wiggly_curve *curve, double position, wiggly_value *rate)
{
    const int last = curve->samples - 1;
    const bool outside = curve->start != WIGGLY_LOOP && !(position >= 0 && position <= last);
    if (last < 1 || outside) return wiggly_evaluate(curve, position);
    double u;
    const int i = locate(curve, position, &u);
    const wiggly_value value = between(curve, i < last ? i : last - 1, i < last ? u : 1, rate);
    *rate = (wiggly_value){rate->y / curve->step, rate->re / curve->step, rate->im / curve->step};
    return u == 0 ? (wiggly_value){curve->y[i], curve->re[i], curve->im[i]} : value;
}

static bool has_arrays(const wiggly_curve *curve)
{
    return curve->y && curve->re && curve->im && (curve->mode != WIGGLY_COMPLEX || curve->omega);
}

wiggly_value wiggly_evaluate_at(const wiggly_curve *curve, double seconds, wiggly_value *per_second)
{
    wiggly_value nothing = {0};
    if (curve->samples > 0 && !has_arrays(curve)) nothing = (wiggly_value){NAN, NAN, NAN};
    if (per_second) *per_second = nothing;
    if (curve->samples < 1 || !has_arrays(curve)) return nothing;
    const double exact = seconds / curve->step, sample = round(exact);
    const double position = fabs(exact - sample) <= 4 * DBL_EPSILON * fabs(sample) ? sample : exact;
    return per_second ? evaluate_moving(curve, position, per_second) : wiggly_evaluate(curve, position);
}

double wiggly_lagged(wiggly_value value, double lag)
{
    const maths_point turn = maths_turn(lag);
    return value.y + turn.cos * value.re + turn.sin * value.im;
}

void wiggly_evaluate_float(const wiggly_curve *curve, double from, double by, int count, float *out, size_t stride)
{
    for (int k = 0; k < count; k++) {
        const wiggly_value value = wiggly_evaluate(curve, from + by * k);
        out[(size_t)k * stride] = (float)(value.y + value.re);
    }
}

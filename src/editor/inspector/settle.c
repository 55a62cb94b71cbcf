/// How long a spline takes to settle.
#include "editor/inspector/settle.h"
#include <complex.h>
#include <math.h>

static const double LEFT = 0.05; ///< of the displacement that it was let go from
enum { MAX_SAMPLES = 100000 };

/// ω_n and ζ of a spline (docs/mathematics.md, Poles); false where a track drives one.
static bool swing_of(const struct spline *spline, double *omega, double *zeta)
{
    const struct param *p = spline->parameter;
    if (p[PARAMETER_FREQUENCY].track >= 0 || p[PARAMETER_DAMPING].track >= 0) return false;
    if (spline_mode(spline) == WIGGLY_COMPLEX && p[PARAMETER_BANDWIDTH].track >= 0) return false;
    *omega = 2 * acos(-1.0) * p[PARAMETER_FREQUENCY].value;
    *zeta = p[PARAMETER_DAMPING].value;
    return true;
}

/// The continuous poles s₀, s₁ in 1/s.
static void poles_of(const struct spline *spline, double omega, double zeta, double complex s[2])
{
    double complex root = csqrt(zeta * zeta - 1);
    s[0] = -zeta * omega + omega * root;
    s[1] = -zeta * omega - omega * root;
    if (zeta > 1) s[0] = -omega / (zeta + creal(root)); // without the cancellation
    if (spline_mode(spline) != WIGGLY_COMPLEX) return;
    double turn = spline->parameter[PARAMETER_BANDWIDTH].value * omega;
    double complex centre = -zeta * omega + I * omega * sqrt(fmax(0, 1 - zeta * zeta));
    s[0] = centre + I * turn;
    s[1] = centre - I * turn;
}

/// Samples until the swing stays within LEFT, of the first `count`; between samples by linear interpolation. Two equal
/// samples stand still half-way between them.
static double settled_sample(const double complex s[2], double step, bool is_complex, int count)
{
    double complex l0 = cexp(s[0] * step), l1 = cexp(s[1] * step), a = l0 + l1, b = -l0 * l1;
    double complex before = 1, now = is_complex ? a / 2 : 1;
    double size = 1, settled = 0;
    for (int i = 0; i < count; i++) {
        double next_size = is_complex ? cabs(now) : fabs(creal(now));
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
    double omega, zeta;
    double complex s[2];
    if (spline_mode(spline) == WIGGLY_CUBIC) return (struct settling){.kind = SETTLE_CUBIC};
    if (!swing_of(spline, &omega, &zeta)) return (struct settling){.kind = SETTLE_UNKNOWN};
    if (omega == 0) return (struct settling){.kind = SETTLE_CUBIC};
    if (zeta == 0) return (struct settling){.kind = SETTLE_NEVER};
    poles_of(spline, omega, zeta, s);
    double rate = fmin(-creal(s[0]), -creal(s[1])); // the slower pole's
    double expected = log(1 / LEFT) / rate;
    if (expected > SETTLE_LIMIT) return (struct settling){.kind = SETTLE_LATE};
    double samples = 3 * expected / step + 8; // a double pole takes 1.6 times as long as its radius says
    bool is_complex = spline_mode(spline) == WIGGLY_COMPLEX;
    bool envelope = is_complex && spline->parameter[PARAMETER_PASSIVE].value == WIGGLY_OSCILLATOR;
    if (envelope || samples > MAX_SAMPLES) return (struct settling){.kind = SETTLE_ALONE, .seconds = expected};
    double seconds = step * settled_sample(s, step, is_complex, (int)samples);
    return (struct settling){.kind = SETTLE_ALONE, .seconds = seconds};
}

/// The motion after a sample. Where there is more of it than a frame has time for, and it goes on, `alone` has the answer.
static struct settling settle_seen(const wiggly_curve *curve, int from, struct settling alone)
{
    int end = (int)fmin(curve->samples, (double)from + MAX_SAMPLES), last = from;
    double size = hypot(curve->re[from], curve->im[from]), left = hypot(curve->re[end - 1], curve->im[end - 1]);
    for (int i = from; curve->mode == WIGGLY_REAL && i < end; i++) size = fmax(size, fabs(curve->re[i]));
    for (int i = from; i < end; i++) {
        if (hypot(curve->re[i], curve->im[i]) > LEFT * size) last = i + 1;
    }
    if (last == end && end < curve->samples) return alone;
    if (last == end) return (struct settling){.kind = SETTLE_LEFT, .left = left / size};
    return (struct settling){.kind = SETTLE_SEEN, .seconds = (last - from) * curve->step};
}

/// Whether a swing is to be seen behind the last knot: more than rounding leaves.
static bool swings_behind(const wiggly_curve *curve, int last_knot)
{
    if (curve->mode == WIGGLY_CUBIC || last_knot < 0 || last_knot + 1 >= curve->samples) return false;
    double size = hypot(curve->re[last_knot], curve->im[last_knot]) + fabs(curve->re[last_knot + 1]);
    return size > 1e-9 * fabs(curve->total[last_knot]) && size > 0;
}

struct settling settle_measure(const struct spline *spline, const wiggly_curve *curve, int last_knot)
{
    struct settling alone = settle_alone(spline, curve->step);
    bool dies = alone.kind != SETTLE_CUBIC && alone.kind != SETTLE_NEVER;
    bool open = spline_start(spline) != WIGGLY_LOOP && swings_behind(curve, last_knot);
    return dies && open ? settle_seen(curve, last_knot, alone) : alone;
}

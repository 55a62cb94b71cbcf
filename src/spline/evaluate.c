/// Values between samples (docs/mathematics.md, Phase): Catmull-Rom in a frame that turns with the band's centre,
///     x(t) = e^{jω_c t} · CatmullRom(e^{−jω_c t_i} x_i),
/// so that it follows a free oscillation. In cubic and real mode, and for y, it is plain Catmull-Rom. At a knot with a slope the tangent is that
/// slope, and where x ends it is the solver's.
#include "maths/maths.h"
#include "maths/wide.h"
#include "spline/host.h"
#include "spline/poles.h"
#include "spline/problem.h"
#include <float.h>
#include <math.h>

/// A curve that is read, and e^{jω_c h} of the interval where it was read last, with its square.
typedef struct reading {
    const wiggly_curve *curve;
    double angle;
    cplx turn, twice;
    double per_second; ///< samples
    double rounding;   ///< as near to a sample, relative to the position, a time is on it
} reading;

static reading reading_of(const wiggly_curve *curve, double rounding)
{
    return (reading){curve, 0, {1, 0}, {1, 0}, curve->step > 0 ? 1 / curve->step : 0, rounding};
}

/// Index of a neighbour sample, at most two beyond the curve: wrapped in a loop, else -1.
static inline int neighbour_of(const wiggly_curve *curve, int i)
{
    if (curve->start == WIGGLY_LOOP) {
        int period = curve->samples - 1;
        return i < 0 ? i + period : i >= period ? i - period : i;
    }
    return i < 0 || i >= curve->samples ? -1 : i;
}

/// Two samples and the tangents there.
typedef struct stretch {
    cplx from, to, leaving, arriving;
} stretch;

/// A value and its change per sample.
typedef struct bend {
    double at, rate;
} bend;

static inline bend hermite(double from, double to, double leaving, double arriving, double u)
{
    const double step = to - from, rest = 1 - u, both = u * rest;
    return (bend){from + u * u * (1 + 2 * rest) * step + both * rest * leaving - both * u * arriving,
                  6 * both * step + rest * (1 - 3 * u) * leaving + u * (3 * u - 2) * arriving};
}

/// y goes on straight at an end.
ALWAYS_INLINE stretch stretch_of_y(const wiggly_curve *curve, int i)
{
    const int b = neighbour_of(curve, i - 1), a = neighbour_of(curve, i + 2);
    const double from = curve->y[i], to = curve->y[i + 1], step = to - from;
    return (stretch){{from, 0},
                     {to, 0},
                     {b < 0 ? step : 0.5 * (to - curve->y[b]), 0},
                     {a < 0 ? step : 0.5 * (curve->y[a] - from), 0}};
}

/// x of sample `at` less `base`, back by a turn of the frame.
ALWAYS_INLINE cplx turned(const wiggly_curve *curve, int at, cplx base, cplx turn)
{
    if (curve->mode != WIGGLY_COMPLEX) return (cplx){curve->re[at] - base.re, 0};
    return cplx_mul(cplx_conj(turn), (cplx){curve->re[at] - base.re, curve->im[at] - base.im});
}

/// The sample before `from` or, `by` −1, after it, from up to four in a row until `to`, if their fourth difference is 0: the motion of least
/// energy, so that the tangent at an end is the speed that the solver sees. In the frame of `from`.
static cplx beyond_end(const reading *r, int from, int to, int by, cplx base)
{
    cplx x[4], turn = {1, 0}, one = by > 0 ? r->turn : cplx_conj(r->turn);
    int count = 0;
    for (int at = from; count < 4 && by * (to - at) >= 0; at += by) {
        x[count++] = turned(r->curve, at, base, turn);
        turn = cplx_mul(turn, one);
    }
    const double weights[3][4] = {{2, -1}, {3, -3, 1}, {4, -6, 4, -1}}, *weight = weights[count - 2];
    cplx sum = {0, 0};
    for (int n = 0; n < count; n++) sum = cplx_add(sum, cplx_scale(weight[n], x[n]));
    return sum;
}

/// x is a constant plus the response before the first knot, but not after it: each side ends there.
ALWAYS_INLINE stretch stretch_of_x(const reading *r, int i, cplx base)
{
    const wiggly_curve *curve = r->curve;
    const bool loops = curve->start == WIGGLY_LOOP, moves = i >= curve->first;
    const int low = moves ? curve->first : 0, high = moves ? curve->samples - 1 : curve->first;
    const cplx from = turned(curve, i, base, (cplx){1, 0}), to = turned(curve, i + 1, base, r->turn);
    cplx before, after;
    if (loops || i > low) {
        before = turned(curve, neighbour_of(curve, i - 1), base, cplx_conj(r->turn));
    } else {
        before = beyond_end(r, i, high, 1, base);
    }
    if (loops || i + 1 < high) {
        after = turned(curve, neighbour_of(curve, i + 2), base, r->twice);
    } else {
        after = cplx_mul(cplx_conj(r->turn), beyond_end(r, i + 1, low, -1, base));
    }
    return (stretch){from, to, cplx_scale(0.5, cplx_sub(to, before)), cplx_scale(0.5, cplx_sub(after, from))};
}

/// Takes the slopes of knots at both ends of the interval after sample i.
ALWAYS_INLINE void follow_slopes(const reading *r, int i, double turn, stretch y, stretch *x)
{
    const wiggly_curve *curve = r->curve;
    const double leaving = curve->slope[i] * curve->step - y.leaving.re,
                 arriving = curve->slope[i + 1] * curve->step - y.arriving.re;
    if (!isnan(leaving)) x->leaving.re = leaving + turn * x->from.im;
    if (isnan(arriving)) return;
    const cplx swing = {-turn * x->to.im, turn * x->to.re}; // x' is e^{jω_c t} times the tangent and this
    cplx speed = cplx_mul(cplx_add(x->arriving, swing), r->turn);
    speed.re = arriving;
    x->arriving = cplx_sub(cplx_mul(speed, cplx_conj(r->turn)), swing);
}

/// The value in the interval after sample i; `rate` receives its change per second, unless it is NULL.
ALWAYS_INLINE void read_between(reading *r, int i, double u, wiggly_value *value, wiggly_value *rate)
{
    const wiggly_curve *curve = r->curve;
    const bool is_complex = curve->mode == WIGGLY_COMPLEX;
    const double turn = is_complex ? 0.5 * (curve->omega[i] + curve->omega[i + 1]) * curve->step : 0;
    if (r->angle != turn) {
        const maths_point by = maths_turn(turn);
        r->angle = turn, r->turn = (cplx){by.cos, by.sin}, r->twice = cplx_mul(r->turn, r->turn);
    }
    cplx base = {0, 0};
    if (i < curve->first) base = (cplx){curve->before[0], curve->before[1]};
    const stretch over = stretch_of_y(curve, i);
    stretch x = stretch_of_x(r, i, base);
    if (curve->slope && i >= curve->first) follow_slopes(r, i, turn, over, &x);
    const bend y = hermite(over.from.re, over.to.re, over.leaving.re, over.arriving.re, u),
               re = hermite(x.from.re, x.to.re, x.leaving.re, x.arriving.re, u),
               im = hermite(x.from.im, x.to.im, x.leaving.im, x.arriving.im, u);
    cplx frame = {1, 0};
    if (is_complex) {
        const maths_point by = maths_turn(turn * u);
        frame = (cplx){by.cos, by.sin};
    }
    const cplx at = cplx_add(base, cplx_mul(frame, (cplx){re.at, im.at}));
    value->y = y.at, value->re = at.re, value->im = at.im;
    if (!rate) return;
    const cplx moving =
        cplx_scale(r->per_second, cplx_mul(frame, (cplx){re.rate - turn * im.at, im.rate + turn * re.at}));
    rate->y = r->per_second * y.rate, rate->re = moving.re, rate->im = moving.im;
}

/// On a sample, beyond the ends, or nowhere: NaN, and a loop's infinity. The change on a sample is that of the interval after, on the last that
/// of the one before.
static void read_apart(reading *r, double position, wiggly_value *value, wiggly_value *rate)
{
    const wiggly_curve *curve = r->curve;
    const int last = curve->samples - 1;
    const bool is_loop = curve->start == WIGGLY_LOOP;
    if (isnan(position) || (is_loop && isinf(position))) {
        *value = (wiggly_value){NAN, NAN, NAN};
        if (rate) *rate = *value;
        return;
    }
    if (!isinf(position) && fabs(position - rint(position)) <= r->rounding * fabs(position))
        position = rint(position);
    if (is_loop) position -= last * floor(position / last);
    if (is_loop && position >= last) position = 0; // rounded up to the seam
    const bool is_inside = position >= 0 && position <= last;
    const int i = (int)fmin(fmax(position, 0), last);
    const double u = is_inside ? position - i : 0;
    const wiggly_value sample = {curve->y[i], curve->re[i], curve->im[i]};
    if (rate) *rate = (wiggly_value){0};
    if (last > 0 && is_inside && (rate || u > 0))
        read_between(r, i < last ? i : last - 1, i < last ? u : 1, value, rate);
    if (!(u > 0)) *value = sample;
}

/// `rate` receives the change per second, unless it is NULL.
ALWAYS_INLINE void read_at(reading *r, double position, wiggly_value *value, wiggly_value *rate)
{
    const double last = r->curve->samples - 1, near = r->rounding * last;
    if (position > 0 && position < last) {
        const int i = (int)position;
        const double u = position - i;
        if (u > near && u < 1 - near) {
            read_between(r, i, u, value, rate);
            return;
        }
    }
    read_apart(r, position, value, rate);
}

static bool has_arrays(const wiggly_curve *curve)
{
    return curve->y && curve->re && curve->im && (curve->mode != WIGGLY_COMPLEX || curve->omega);
}

/// The solver's jet at a knot costs (a − v)² 2/h + (v − b)² 2/h, where v is the speed at the knot and a and b are those half a sample after and
/// before it. Beside stiffness (v − slope)², v lies between their mean and the slope. At an end there is one of them.
void evaluate_slopes(const wiggly_desc *desc, wiggly_curve *curve)
{
    for (int i = 0; i < curve->samples; i++) curve->slope[i] = NAN;
    wiggly_curve plain = *curve;
    plain.slope = NULL;
    reading r = reading_of(&plain, 0);
    for (int k = 0; k < desc->knot_count && has_arrays(curve); k++) {
        const wiggly_knot *knot = &desc->knots[k];
        if (!knot->has_slope) continue;
        if (desc->wind_up > 0 && desc->mode != WIGGLY_CUBIC) {
            const poles at = poles_at(desc, knot->sample, 0);
            if (!(at.centre > SLOWEST_SLOPE * at.natural)) continue;
        }
        wiggly_value value, rate;
        read_at(&r, knot->sample, &value, &rate);
        const bool ends =
            curve->start != WIGGLY_LOOP && (knot->sample == curve->first || knot->sample == curve->samples - 1);
        const double mean = rate.y + rate.re, firm = knot_stiffness(knot) * curve->step / (ends ? 2 : 4);
        curve->slope[knot->sample] = knot->slope + (mean - knot->slope) / (1 + firm);
    }
    if (curve->start == WIGGLY_LOOP) curve->slope[curve->samples - 1] = curve->slope[0];
}

wiggly_value wiggly_evaluate(const wiggly_curve *curve, double position)
{
    const host_state host = host_leave();
    wiggly_value value = {0};
    reading r = reading_of(curve, 0);
    if (curve->samples > 0) read_at(&r, position, &value, NULL);
    host_return(&host);
    return value;
}

void wiggly_evaluate_many(const wiggly_curve *curve, const double *seconds, size_t count, wiggly_value *values,
                          wiggly_value *per_second)
{
    const host_state host = host_leave();
    const wiggly_value nothing = curve->samples > 0 ? (wiggly_value){NAN, NAN, NAN} : (wiggly_value){0};
    const bool is_read = curve->samples > 0 && has_arrays(curve);
    reading r = reading_of(curve, 4 * DBL_EPSILON);
    wiggly_value own = {0};
    for (size_t k = 0; k < count; k++) {
        wiggly_value *const value = values ? &values[k] : &own, *const rate = per_second ? &per_second[k] : NULL;
        if (is_read) {
            read_at(&r, seconds[k] * r.per_second, value, rate);
        } else {
            *value = nothing;
            if (rate) *rate = nothing;
        }
    }
    host_return(&host);
}

wiggly_value wiggly_evaluate_at(const wiggly_curve *curve, double seconds, wiggly_value *per_second)
{
    wiggly_value value;
    wiggly_evaluate_many(curve, &seconds, 1, &value, per_second);
    return value;
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

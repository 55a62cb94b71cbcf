/// Solves q'' + 2d q' + k q = −y'' for an equilibrium y that is linear between samples, in closed form from sample to sample.
//
// At a sample q' jumps by −(y_{i+1} − 2 y_i + y_{i−1}) / h; over an interval, with r = √(d² − k) and the mean d, k of its ends,
//
//     q  ← e^{−dh} ((cosh rh + d sinh(rh)/r) q + (sinh(rh)/r) q')
//     q' ← e^{−dh} (−k (sinh(rh)/r) q + (cosh rh − d sinh(rh)/r) q').
//
// u is q with the imaginary part that an oscillation on one side of the axis has, u' = p u: Im u = −(q' + d q)/ω_d.
#include "spline/forced_response.h"
#include "spline/dd.h"
#include "spline/oscillator.h"
#include "spline/problem.h"
#include "spline/wide.h"
#include <float.h>
#include <math.h>
#include <string.h>

static const double blow_up = 1e4;

static oscillator oscillator_at(const wiggly_desc *desc, int sample, double floor)
{
    poles at = poles_at(desc, sample, floor);
    return (oscillator){at.decay, at.natural * at.natural};
}

/// y at a sample. Before the start it is y₀, as if at rest; after the end it continues linearly; a loop wraps.
static double y_beyond(const wiggly_desc *desc, const double *y, int i)
{
    int n = desc->samples;
    if (desc->start == WIGGLY_LOOP) return y[(i + n - 1) % (n - 1)];
    if (i < 0) return y[0];
    return i < n ? y[i] : 2 * y[n - 1] - y[n > 1 ? n - 2 : 0];
}

/// Minus the jump of q' at each sample.
WIDEST static void bends(const double *restrict y, int from, int to, double step, double *restrict out)
{
    for (int i = from; i < to; i++) out[i] = ((y[i] - y[i - 1]) - (y[i + 1] - y[i])) / step;
}

static void set_kicks(const wiggly_desc *desc, const double *y, double *out)
{
    const int last = desc->samples - 1;
    bends(y, 1, last, desc->step, out);
    const int ends[] = {0, last};
    for (int e = 0; e < 2; e++) {
        int i = ends[e];
        double before = y_beyond(desc, y, i - 1), after = y_beyond(desc, y, i + 1);
        out[i] = last > 0 ? ((y[i] - before) - (after - y[i])) / desc->step : 0;
    }
}

/// The steps of the state from sample to sample; constant parameters have a single one.
typedef struct path {
    const wiggly_desc *desc;
    double floor;
    bool constant;
    oscillator here; ///< of the sample before, if they vary
    step_matrix step;
} path;

static path begin(const wiggly_desc *desc, double floor)
{
    path p = {
        .desc = desc, .floor = floor, .constant = poles_are_constant(desc), .here = oscillator_at(desc, 0, floor)};
    p.step = oscillator_step(p.here, desc->step);
    return p;
}

/// The step over the interval after sample i.
static step_matrix next_step(path *p, int i)
{
    if (p->constant) return p->step;
    bool closes = p->desc->start == WIGGLY_LOOP && i + 2 == p->desc->samples;
    oscillator next = oscillator_at(p->desc, closes ? 0 : i + 1, p->floor);
    oscillator mean = {0.5 * (p->here.d + next.d), 0.5 * (p->here.k + next.k)};
    p->here = next;
    return oscillator_step(mean, p->desc->step);
}

/// Writes q to `total`, and q' in the middle of its jumps to `speed`, from a state before sample 0, with the jumps in `im`. Returns the state
/// after the last step.
static void run(const wiggly_desc *desc, double floor, double q, double v, const forced_response *u, double end[2])
{
    path p = begin(desc, floor);
    int n = desc->samples;
    for (int i = 0; i < n; i++) {
        double kick = u->im[i];
        u->total[i] = q;
        u->speed[i] = v + 0.5 * kick;
        if (i + 1 == n) break;
        step_matrix m = p.constant ? p.step : next_step(&p, i);
        v += kick;
        double moved = m.q_q * q + m.q_v * v;
        v = m.v_q * q + m.v_v * v;
        q = moved;
    }
    end[0] = q, end[1] = v;
}

typedef struct wide_matrix {
    dd at[2][2];
} wide_matrix;

/// I − (I − d)(I − e) = d + e − d e.
static inline wide_matrix compose(const wide_matrix *d, const wide_matrix *e)
{
    wide_matrix out;
    for (int r = 0; r < 2; r++) {
        for (int c = 0; c < 2; c++) {
            const dd product = dd_add(dd_multiply(d->at[r][0], e->at[0][c]), dd_multiply(d->at[r][1], e->at[1][c]));
            out.at[r][c] = dd_subtract(dd_add(d->at[r][c], e->at[r][c]), product);
        }
    }
    return out;
}

static wide_matrix less_than_one(step_matrix s)
{
    return (wide_matrix){{{dd_difference(1, s.q_q), dd_from(-s.q_v)}, {dd_from(-s.v_q), dd_difference(1, s.v_v)}}};
}

/// I − the step, in double-double: I − exp(A) of A = h [0 1; −k −2d], halved until a series of ten terms suffices, then composed with itself.
static wide_matrix wide_step(oscillator o, double h)
{
    enum { TERMS = 10 };
    int halvings = 0;
    double time = h;
    while (o.k * time * time + 2 * o.d * time > 0x1p-10 && halvings < 24) time *= 0.5, halvings++;
    if (halvings == 24) return less_than_one(oscillator_step(o, h)); // what it moves fades at once
    // In units in which A = [0 1; spring brake], so A² = spring I + brake A, and each power of A is a I + b A.
    const dd pull = dd_product(-o.k, time), spring = dd_scale(time, pull), brake = dd_product(-2 * o.d, time);
    dd a = {1, 0}, b = {0, 0};
    double c = 1; // TERMS! / j!
    for (int j = TERMS - 1; j >= 0; j--) {
        c *= j > 0 ? j + 1 : 1;
        const dd next = dd_multiply(spring, b);
        b = dd_add(a, dd_multiply(brake, b));
        a = j > 0 ? dd_add(next, dd_from(c)) : next;
    }
    a = dd_divide(dd_negate(a), dd_from(c)), b = dd_divide(dd_negate(b), dd_from(c));
    for (int i = 0; i < halvings; i++) { // D ← 2 D − D²
        const dd b2 = dd_multiply(b, b), ab = dd_multiply(a, b), a2 = dd_multiply(a, a);
        a = dd_subtract(dd_scale(2, a), dd_add(a2, dd_multiply(spring, b2)));
        b = dd_subtract(dd_scale(2, b), dd_add(dd_scale(2, ab), dd_multiply(brake, b2)));
    }
    return (wide_matrix){{{a, dd_scale(time, b)}, {dd_multiply(pull, b), dd_add(a, dd_multiply(brake, b))}}};
}

/// I − the step over the interval after sample i, in extended precision if `wide`; a constant one is computed once, at i = 0.
static void step_of_loop(path *p, int i, bool wide, wide_matrix *s)
{
    if (p->constant && i > 0) return;
    const oscillator here = p->here;
    const step_matrix plain = next_step(p, i);
    const oscillator mean = {0.5 * (here.d + p->here.d), 0.5 * (here.k + p->here.k)};
    *s = wide ? wide_step(mean, p->desc->step) : less_than_one(plain);
}

/// I − the product of a loop's steps, in extended precision, because for slow poles it is a small difference. Equal steps by squaring.
static wide_matrix around(const wiggly_desc *desc, double floor, bool wide)
{
    path p = begin(desc, floor);
    const int period = desc->samples - 1;
    wide_matrix s, a = {0};
    for (int i = 0; !p.constant && i < period; i++) {
        step_of_loop(&p, i, wide, &s);
        a = compose(&s, &a);
    }
    if (!p.constant) return a;
    step_of_loop(&p, 0, wide, &s);
    for (int bit = 1; bit <= period && bit > 0; bit *= 2) {
        if (period & bit) a = compose(&a, &s);
        s = compose(&s, &s);
    }
    return a;
}

/// q and q' in extended precision.
typedef struct wide_state {
    dd q, v;
} wide_state;

/// run() in extended precision, with jumps that are not rounded to double; does not read u's `im`.
static wide_state run_wide(const wiggly_desc *desc, const double *y, double floor, wide_state x,
                           const forced_response *u)
{
    path p = begin(desc, floor);
    const dd rate = dd_divide(dd_from(1), dd_from(desc->step));
    wide_matrix s;
    for (int i = 0;; i++) {
        const dd behind = dd_difference(y[i], y_beyond(desc, y, i - 1)),
                 ahead = dd_difference(y_beyond(desc, y, i + 1), y[i]);
        const dd kick = dd_multiply(rate, dd_subtract(behind, ahead));
        u->total[i] = x.q.hi;
        u->speed[i] = dd_add(x.v, dd_scale(0.5, kick)).hi;
        if (i + 1 == desc->samples) return x;
        step_of_loop(&p, i, true, &s);
        x.v = dd_add(x.v, kick);
        const dd lost_q = dd_add(dd_multiply(s.at[0][0], x.q), dd_multiply(s.at[0][1], x.v));
        const dd lost_v = dd_add(dd_multiply(s.at[1][0], x.q), dd_multiply(s.at[1][1], x.v));
        x = (wide_state){dd_subtract(x.q, lost_q), dd_subtract(x.v, lost_v)};
    }
}

/// A pull that brings q back by less than this per round cannot close a circle.
static const double faint = 1e-12;

/// The effect of a loop's parameters over a whole round: pulling q back, and braking it.
typedef struct forces {
    bool pull, brake;
    double k, d; ///< maxima
} forces;

static forces forces_of(const wiggly_desc *desc, double floor)
{
    forces f = {.pull = false};
    const bool constant = poles_are_constant(desc);
    const double seconds = (desc->samples - 1) * desc->step;
    for (int i = 0; i < (constant ? 1 : desc->samples - 1); i++) {
        oscillator o = oscillator_at(desc, i, floor);
        f.pull = f.pull || o.k > (constant ? faint * 2 * o.d / seconds : 0);
        f.brake = f.brake || o.d > 0;
        f.k = fmax(f.k, o.k), f.d = fmax(f.d, o.d);
    }
    return f;
}

static dd determinant(const wide_matrix *a)
{
    return dd_subtract(dd_multiply(a->at[0][0], a->at[1][1]), dd_multiply(a->at[0][1], a->at[1][0]));
}

/// The state that returns to itself, given the state reached from rest. If nothing pulls back, only q' returns. False if there is no such
/// state.
static bool close_circle(double seconds, forces f, const wide_matrix *a, wide_state end, wide_state *state)
{
    *state = (wide_state){{0, 0}, {0, 0}};
    if (!f.pull) {
        state->v = f.brake ? dd_divide(end.v, a->at[1][1]) : dd_divide(dd_negate(end.q), dd_from(seconds));
        return true;
    }
    const dd det = determinant(a);
    const double terms = fabs(a->at[0][0].hi * a->at[1][1].hi) + fabs(a->at[0][1].hi * a->at[1][0].hi);
    if (!(fabs(det.hi) > 1e-16 * terms)) return false;
    const dd q = dd_subtract(dd_multiply(a->at[1][1], end.q), dd_multiply(a->at[0][1], end.v));
    const dd v = dd_subtract(dd_multiply(a->at[0][0], end.v), dd_multiply(a->at[1][0], end.q));
    *state = (wide_state){dd_divide(q, det), dd_divide(v, det)};
    return true;
}

/// How far the rounding of steps, jumps and parameters (which a resonance amplifies) may change the periodic q.
static double error_of_circle(const forced_response *u, int period, double step, forces f, const wide_matrix *a,
                              double epsilon)
{
    const double seconds = period * step, rounding = 4 * epsilon;
    double q = 0, v = 0;
    for (int i = 0; i < period; i++) q += fabs(u->total[i]), v += fabs(u->speed[i]) + fabs(u->im[i]);
    const double of_q = rounding * q, of_v = rounding * v + 4 * DBL_EPSILON * step * (f.k * q + 2 * f.d * v);
    if (!f.pull) return of_q + seconds * of_v * (1 + (f.brake ? 1 / fabs(a->at[1][1].hi) : 0));
    return (fabs(a->at[1][1].hi) * of_q + fabs(a->at[0][1].hi) * of_v +
            seconds * (fabs(a->at[0][0].hi) * of_v + fabs(a->at[1][0].hi) * of_q)) /
           fabs(determinant(a).hi);
}

/// As a share of y's range: a loop whose error may be larger is solved in extended precision.
static const double narrow = 1e-11;

/// Of extended precision, with what the series leaves out.
static const double finest = 0x1p-74;

/// The periodic q. False if there is none, or only one far too large.
static bool run_loop(const wiggly_desc *desc, const double *y, double floor, forced_response *u)
{
    const forces f = forces_of(desc, floor);
    const int period = desc->samples - 1;
    const extent all = extent_of(y, period);
    const double range = all.high - all.low;
    const double seconds = period * desc->step;
    double end[2];
    wide_state state;
    run(desc, floor, 0, 0, u, end);
    wide_matrix a = around(desc, floor, false);
    if (!close_circle(seconds, f, &a, (wide_state){dd_from(end[0]), dd_from(end[1])}, &state)) return false;
    run(desc, floor, state.q.hi, state.v.hi, u, end);
    u->error = error_of_circle(u, period, desc->step, f, &a, DBL_EPSILON);
    if (u->error > narrow * range) {
        const wide_state rest = {{0, 0}, {0, 0}}, reached = run_wide(desc, y, floor, rest, u);
        a = around(desc, floor, true);
        if (!close_circle(seconds, f, &a, reached, &state)) return false;
        run_wide(desc, y, floor, state, u);
        u->error = error_of_circle(u, period, desc->step, f, &a, finest);
    }
    if (!f.pull) { // it is determined up to a constant: take mean 0
        dd mean = {0, 0};
        for (int i = 0; i < period; i++) mean = dd_add(mean, dd_from(u->total[i]));
        for (int i = 0; i <= period; i++) u->total[i] -= mean.hi / period;
        return true;
    }
    return extent_size(extent_of(u->total, period)) <= blow_up * range;
}

WIDEST static void imaginary_constant(const double *restrict q, const double *restrict speed, double gain, double d,
                                      int count, double *restrict im)
{
    for (int i = 0; i < count; i++) im[i] = gain * (speed[i] + d * q[i]);
}

static void set_imaginary(const wiggly_desc *desc, double floor, const forced_response *u)
{
    double t = (desc->samples - 1) * desc->step;
    if (poles_are_constant(desc)) {
        oscillator o = oscillator_at(desc, 0, floor);
        imaginary_constant(u->total, u->speed, oscillator_turn(o, t), o.d, desc->samples, u->im);
        return;
    }
    for (int i = 0; i < desc->samples; i++) {
        oscillator o = oscillator_at(desc, i, floor);
        u->im[i] = oscillator_turn(o, t) * (u->speed[i] + o.d * u->total[i]);
    }
}

WIDEST static void add(double *restrict total, const double *restrict y, int count)
{
    for (int i = 0; i < count; i++) total[i] += y[i];
}

wiggly_status forced_response_find(const wiggly_desc *desc, const double *y, double calm, forced_response *u)
{
    wiggly_status status = WIGGLY_OK;
    u->error = 0;
    set_kicks(desc, y, u->im);
    double end[2], floor = desc->start == WIGGLY_LOOP ? LEAST_DAMPING * calm : 0;
    if (desc->start != WIGGLY_LOOP) {
        run(desc, floor, 0, 0, u, end);
    } else if (!run_loop(desc, y, floor, u) && calm == 0) {
        floor = LEAST_DAMPING * FALLBACK_CALM;
        run_loop(desc, y, floor, u);
        status = WIGGLY_CALMED;
    }
    if (desc->mode == WIGGLY_COMPLEX) {
        set_imaginary(desc, floor, u);
    } else {
        for (int i = 0; i < desc->samples; i++) u->im[i] = 0;
    }
    add(u->total, y, desc->samples);
    if (desc->start == WIGGLY_LOOP) { // rounding must not make a difference between turns
        u->total[desc->samples - 1] = u->total[0];
        u->im[desc->samples - 1] = u->im[0];
    }
    return status;
}

void forced_response_rest(const wiggly_desc *desc, const double *y, forced_response *u)
{
    const size_t size = sizeof(double) * (size_t)desc->samples;
    u->error = 0;
    memcpy(u->total, y, size);
    memset(u->im, 0, size);
    memset(u->speed, 0, size);
}

double forced_response_speed(const wiggly_desc *desc, const double *y, const forced_response *u, int sample)
{
    int n = desc->samples;
    if (n < 2) return 0;
    return u->speed[sample] + (y_beyond(desc, y, sample + 1) - y_beyond(desc, y, sample - 1)) / (2 * desc->step);
}

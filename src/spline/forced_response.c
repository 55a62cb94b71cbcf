/// Solves q'' + 2d q' + k q = −y'' for an equilibrium y that is linear between samples, in closed form from sample to sample.
//
// At a sample q' jumps by −(y_{i+1} − 2 y_i + y_{i−1}) / h; over an interval, with r = √(d² − k) and the mean d, k of its ends,
//
//     q  ← e^{−dh} ((cosh rh + d sinh(rh)/r) q + (sinh(rh)/r) q')
//     q' ← e^{−dh} (−k (sinh(rh)/r) q + (cosh rh − d sinh(rh)/r) q').
//
// u is q with the imaginary part that an oscillation on one side of the axis has, u' = p u: Im u = −(q' + d q)/ω_d.
#include "spline/forced_response.h"
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

typedef long double wide_matrix[2][2];

/// d ← I − (I − d)(I − e) = d + e − d e.
static void compose(wide_matrix d, const wide_matrix e)
{
    wide_matrix sum;
    for (int r = 0; r < 2; r++) {
        for (int c = 0; c < 2; c++) sum[r][c] = d[r][c] + e[r][c] - (d[r][0] * e[0][c] + d[r][1] * e[1][c]);
    }
    for (int r = 0; r < 2; r++) {
        for (int c = 0; c < 2; c++) d[r][c] = sum[r][c];
    }
}

/// The step in extended precision.
static void wide_step(oscillator o, double h, wide_matrix s)
{
    const long double d = o.d, k = o.k, r2 = d * d - k, r = sqrtl(fabsl(r2)), decay = expl(-d * h);
    const long double slow = r2 > 0 ? expl((r - d) * h) : 0, fast = r2 > 0 ? expl(-(r + d) * h) : 0;
    const long double c = r2 > 0 ? 0.5L * (slow + fast) : decay * cosl(r * h);
    long double sine = r2 > 0 ? 0.5L * (slow - fast) : decay * sinl(r * h); // r s
    sine = r * h < 1e-4L ? decay * h * (1 + r2 * h * h / 6) : sine / r;
    s[0][0] = c + d * sine, s[0][1] = sine;
    s[1][0] = -k * sine, s[1][1] = c - d * sine;
}

/// The step over the interval after sample i, in extended precision if `wide`; a constant one is computed once, at i = 0.
static void step_of_loop(path *p, int i, bool wide, wide_matrix s)
{
    if (p->constant && i > 0) return;
    const oscillator here = p->here;
    const step_matrix plain = next_step(p, i);
    if (wide) {
        wide_step((oscillator){0.5 * (here.d + p->here.d), 0.5 * (here.k + p->here.k)}, p->desc->step, s);
    } else {
        s[0][0] = plain.q_q, s[0][1] = plain.q_v, s[1][0] = plain.v_q, s[1][1] = plain.v_v;
    }
}

/// I − the product of a loop's steps, in extended precision, because for slow poles it is a small difference. Equal steps by squaring.
static void around(const wiggly_desc *desc, double floor, bool wide, wide_matrix a)
{
    path p = begin(desc, floor);
    int period = desc->samples - 1;
    wide_matrix s, step;
    for (int i = 0; i < 4; i++) a[i / 2][i % 2] = 0;
    for (int i = 0; !p.constant && i < period; i++) {
        step_of_loop(&p, i, wide, s);
        wide_matrix whole = {{1 - s[0][0], -s[0][1]}, {-s[1][0], 1 - s[1][1]}};
        compose(whole, (const long double(*)[2])a);
        for (int e = 0; e < 4; e++) a[e / 2][e % 2] = whole[e / 2][e % 2];
    }
    if (!p.constant) return;
    step_of_loop(&p, 0, wide, s);
    step[0][0] = 1 - s[0][0], step[0][1] = -s[0][1], step[1][0] = -s[1][0], step[1][1] = 1 - s[1][1];
    for (int bit = 1; bit <= period && bit > 0; bit *= 2) {
        if (period & bit) compose(a, (const long double(*)[2])step);
        wide_matrix same = {{step[0][0], step[0][1]}, {step[1][0], step[1][1]}};
        compose(step, (const long double(*)[2])same);
    }
}

/// run() in extended precision, with jumps that are not rounded to double; does not read u's `im`.
static void run_wide(const wiggly_desc *desc, const double *y, double floor, const long double from[2],
                     const forced_response *u, long double end[2])
{
    path p = begin(desc, floor);
    wide_matrix s;
    long double q = from[0], v = from[1];
    for (int i = 0;; i++) {
        const long double here = y[i],
                          kick = ((here - y_beyond(desc, y, i - 1)) - (y_beyond(desc, y, i + 1) - here)) / desc->step;
        u->total[i] = (double)q;
        u->speed[i] = (double)(v + 0.5L * kick);
        if (i + 1 == desc->samples) break;
        step_of_loop(&p, i, true, s);
        v += kick;
        const long double moved = s[0][0] * q + s[0][1] * v;
        v = s[1][0] * q + s[1][1] * v;
        q = moved;
    }
    end[0] = q, end[1] = v;
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

/// The state that returns to itself, given the state reached from rest. If nothing pulls back, only q' returns. False if there is no such
/// state.
static bool close_circle(double seconds, forces f, const wide_matrix a, const long double end[2],
                         long double state[2])
{
    if (!f.pull) {
        state[0] = 0, state[1] = f.brake ? end[1] / a[1][1] : -end[0] / seconds;
        return true;
    }
    const long double det = a[0][0] * a[1][1] - a[0][1] * a[1][0];
    if (!(fabsl(det) > 1e-16L * (fabsl(a[0][0] * a[1][1]) + fabsl(a[0][1] * a[1][0])))) return false;
    state[0] = (a[1][1] * end[0] - a[0][1] * end[1]) / det;
    state[1] = (a[0][0] * end[1] - a[1][0] * end[0]) / det;
    return true;
}

/// How far the rounding of steps, jumps and parameters (which a resonance amplifies) may change the periodic q.
static double error_of_circle(const forced_response *u, int period, double step, forces f, const wide_matrix a,
                              long double epsilon)
{
    const long double seconds = period * (long double)step, rounding = 4 * epsilon;
    long double q = 0, v = 0;
    for (int i = 0; i < period; i++) q += fabsl(u->total[i]), v += fabsl(u->speed[i]) + fabsl(u->im[i]);
    const long double of_q = rounding * q, of_v = rounding * v + 4 * DBL_EPSILON * step * (f.k * q + 2 * f.d * v);
    if (!f.pull) return (double)(of_q + seconds * of_v * (1 + (f.brake ? 1 / fabsl(a[1][1]) : 0)));
    const long double det = a[0][0] * a[1][1] - a[0][1] * a[1][0];
    return (double)((fabsl(a[1][1]) * of_q + fabsl(a[0][1]) * of_v +
                     seconds * (fabsl(a[0][0]) * of_v + fabsl(a[1][0]) * of_q)) /
                    fabsl(det));
}

/// As a share of y's range: a loop whose error may be larger is solved in extended precision.
static const double narrow = 1e-11;

/// The periodic q. False if there is none, or only one far too large.
static bool run_loop(const wiggly_desc *desc, const double *y, double floor, forced_response *u)
{
    const forces f = forces_of(desc, floor);
    const int period = desc->samples - 1;
    const extent all = extent_of(y, period);
    const double range = all.high - all.low;
    const double seconds = period * desc->step;
    double end[2];
    long double wide_end[2], state[2] = {0, 0};
    wide_matrix a;
    run(desc, floor, 0, 0, u, end);
    around(desc, floor, false, a);
    wide_end[0] = end[0], wide_end[1] = end[1];
    if (!close_circle(seconds, f, a, wide_end, state)) return false;
    run(desc, floor, (double)state[0], (double)state[1], u, end);
    u->error = error_of_circle(u, period, desc->step, f, a, DBL_EPSILON);
    if (u->error > narrow * range) {
        const long double rest[2] = {0, 0};
        run_wide(desc, y, floor, rest, u, wide_end);
        around(desc, floor, true, a);
        if (!close_circle(seconds, f, a, wide_end, state)) return false;
        run_wide(desc, y, floor, state, u, wide_end);
        u->error = error_of_circle(u, period, desc->step, f, a, LDBL_EPSILON);
    }
    if (!f.pull) { // it is determined up to a constant: take mean 0
        long double mean = 0;
        for (int i = 0; i < period; i++) mean += u->total[i];
        for (int i = 0; i <= period; i++) u->total[i] -= (double)(mean / period);
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

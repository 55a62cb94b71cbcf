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
    step_matrix step, loss;
} path;

static path begin(const wiggly_desc *desc, double floor)
{
    path p = {
        .desc = desc, .floor = floor, .constant = poles_are_constant(desc), .here = oscillator_at(desc, 0, floor)};
    p.step = oscillator_step(p.here, desc->step);
    return p;
}

/// The mean parameters of the interval after sample i.
static oscillator mean_over(path *p, int i)
{
    if (p->constant) return p->here;
    bool closes = p->desc->start == WIGGLY_LOOP && i + 2 == p->desc->samples;
    oscillator next = oscillator_at(p->desc, closes ? 0 : i + 1, p->floor);
    oscillator mean = {0.5 * (p->here.d + next.d), 0.5 * (p->here.k + next.k)};
    p->here = next;
    return mean;
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
        step_matrix m = p.constant ? p.step : oscillator_step(mean_over(&p, i), desc->step);
        v += kick;
        double moved = m.q_q * q + m.q_v * v;
        v = m.v_q * q + m.v_v * v;
        q = moved;
    }
    end[0] = q, end[1] = v;
}

/// What the step over the interval after sample i takes from the state; a constant one is computed once.
static step_matrix next_loss(path *p, int i)
{
    if (!p->constant || i == 0) p->loss = oscillator_loss(mean_over(p, i), p->desc->step);
    return p->loss;
}

/// I − (I − d)(I − e) = d + e − d e.
static step_matrix compose(step_matrix d, step_matrix e)
{
    return (step_matrix){
        .q_q = d.q_q + e.q_q - (d.q_q * e.q_q + d.q_v * e.v_q),
        .q_v = d.q_v + e.q_v - (d.q_q * e.q_v + d.q_v * e.v_v),
        .v_q = d.v_q + e.v_q - (d.v_q * e.q_q + d.v_v * e.v_q),
        .v_v = d.v_v + e.v_v - (d.v_q * e.q_v + d.v_v * e.v_v),
    };
}

/// I − the product of a loop's steps, which for slow poles is a small difference. Equal steps by squaring.
static step_matrix around(const wiggly_desc *desc, double floor)
{
    path p = begin(desc, floor);
    const int period = desc->samples - 1;
    step_matrix all = {0};
    if (!p.constant) {
        for (int i = 0; i < period; i++) all = compose(next_loss(&p, i), all);
        return all;
    }
    step_matrix some = next_loss(&p, 0);
    for (int bit = 1; bit <= period && bit > 0; bit *= 2) {
        if (period & bit) all = compose(all, some);
        some = compose(some, some);
    }
    return all;
}

/// run() of a loop, with sums and jumps in double-double, and h q' in place of q'. Does not read u's `im`. `missed` receives the change of the
/// state over the round.
static void run_exactly(const wiggly_desc *desc, const double *y, double floor, const double from[2],
                        const forced_response *u, double missed[2])
{
    path p = begin(desc, floor);
    const int last = desc->samples - 1;
    const double h = desc->step;
    const dd q0 = dd_from(from[0]), v0 = dd_product(h, from[1]);
    dd q = q0, v = v0, behind = dd_difference(y[0], y[last - 1]);
    for (int i = 0;; i++) {
        const dd ahead = dd_difference(y[i < last ? i + 1 : 1], y[i]), kick = dd_subtract(behind, ahead);
        u->total[i] = q.hi;
        u->speed[i] = (v.hi + 0.5 * kick.hi) / h;
        if (i == last) break;
        const step_matrix loss = next_loss(&p, i);
        behind = ahead;
        v = dd_add(v, kick);
        const double of_q = loss.q_q * q.hi + loss.q_v / h * v.hi, of_v = loss.v_q * h * q.hi + loss.v_v * v.hi;
        q = dd_subtract(q, dd_from(of_q));
        v = dd_subtract(v, dd_from(of_v));
    }
    missed[0] = dd_subtract(q, q0).hi, missed[1] = dd_subtract(v, v0).hi / h;
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

static double determinant(const step_matrix *a) { return a->q_q * a->v_v - a->q_v * a->v_q; }

/// The state that is `missed` more after a round without y. If nothing pulls back, only q' returns. False if there is no such state.
static bool close_circle(double seconds, forces f, const step_matrix *a, const double missed[2], double state[2])
{
    if (!f.pull) {
        state[0] = 0, state[1] = f.brake ? missed[1] / a->v_v : -missed[0] / seconds;
        return true;
    }
    const double det = determinant(a);
    if (!(fabs(det) > 1e-16 * (fabs(a->q_q * a->v_v) + fabs(a->q_v * a->v_q)))) return false;
    state[0] = (a->v_v * missed[0] - a->q_v * missed[1]) / det;
    state[1] = (a->q_q * missed[1] - a->v_q * missed[0]) / det;
    return true;
}

/// How far the rounding of steps, jumps and parameters (which a resonance amplifies) may change the periodic q. `rounding`: of its sums.
static double error_of_circle(const forced_response *u, int period, double step, forces f, const step_matrix *a,
                              double rounding)
{
    const double seconds = period * step, small = 4 * DBL_EPSILON * step;
    double q = 0, v = 0;
    for (int i = 0; i < period; i++) q += fabs(u->total[i]), v += fabs(u->speed[i]) + fabs(u->im[i]);
    const double of_q = rounding * q + small * v, of_v = rounding * v + small * (f.k * q + 2 * f.d * v);
    if (!f.pull) return of_q + seconds * of_v * (1 + (f.brake ? 1 / fabs(a->v_v) : 0));
    return (fabs(a->v_v) * of_q + fabs(a->q_v) * of_v + seconds * (fabs(a->q_q) * of_v + fabs(a->v_q) * of_q)) /
           fabs(determinant(a));
}

/// As a share of y's range: a loop whose error may be larger is refined.
static const double narrow = 1e-11;

/// The periodic q. False if there is none, or only one far too large.
static bool run_loop(const wiggly_desc *desc, const double *y, double floor, forced_response *u)
{
    const forces f = forces_of(desc, floor);
    const int period = desc->samples - 1;
    const extent all = extent_of(y, period);
    const double range = all.high - all.low;
    const double seconds = period * desc->step;
    const step_matrix a = around(desc, floor);
    double end[2], state[2], more[2];
    run(desc, floor, 0, 0, u, end);
    if (!close_circle(seconds, f, &a, end, state)) return false;
    run(desc, floor, state[0], state[1], u, end);
    u->error = error_of_circle(u, period, desc->step, f, &a, 4 * DBL_EPSILON);
    if (u->error > narrow * range) {
        run_exactly(desc, y, floor, state, u, end);
        close_circle(seconds, f, &a, end, more);
        state[0] += more[0], state[1] += more[1];
        run_exactly(desc, y, floor, state, u, end);
        u->error = error_of_circle(u, period, desc->step, f, &a, 0);
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

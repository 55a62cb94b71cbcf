/// Solves q'' + 2d q' + k q = −y'' for an equilibrium y that is linear between samples, in closed form from sample to sample.
//
// At a sample q' jumps by −(y_{i+1} − 2 y_i + y_{i−1}) / h; over an interval, with r = √(d² − k) and the mean d, k of its ends,
//
//     q  ← e^{−dh} ((cosh rh + d sinh(rh)/r) q + (sinh(rh)/r) q')
//     q' ← e^{−dh} (−k (sinh(rh)/r) q + (cosh rh − d sinh(rh)/r) q').
//
// Run forward round a loop whose frequency varies, an error may grow as fast as a swing that the frequency pumps up: such a loop's states are
// solved for together.
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
    const double seconds = period * step, small = 2 * DBL_EPSILON * step;
    double q = 0, v = 0;
    for (int i = 0; i < period; i++) q += fabs(u->total[i]), v += fabs(u->speed[i]) + fabs(u->im[i]);
    const double of_q = rounding * q + small * v, of_v = rounding * v + small * (f.k * q + 2 * f.d * v);
    if (!f.pull) return of_q + seconds * of_v * (1 + (f.brake ? 1 / fabs(a->v_v) : 0));
    return (fabs(a->v_v) * of_q + fabs(a->q_v) * of_v + seconds * (fabs(a->q_q) * of_v + fabs(a->v_q) * of_q)) /
           fabs(determinant(a));
}

// --- a loop of varying parameters: all states together ---
//
// With s_i = (q, h q') before the jump of sample i, each interval is an equation s_{i+1} − M_i s_i = f_i. Rotations of two neighbouring equations
// eliminate s_1, s_2, … in turn, until one equation is left, for s_0. The rows that they set aside give the other states, from the last on:
//
//     s_i  s_0  s_{i+1}             s_i  s_0  s_{i+1}
//     | B    A    0   |     →      | R    U    V  |         R s_i = c − U s_0 − V s_{i+1}
//     | −M_i 0    I   |            | 0    A'   B' |
//
// No number grows on the way, however fast the states would. Residuals in double-double refine them.

enum { OF_ITSELF = 0, OF_FIRST = 2, OF_NEXT = 4, RIGHT = 6, ENTRIES };

/// A sample's interval, and its state.
typedef struct waypoint {
    step_matrix loss;  ///< of q and h q'
    double root[3];    ///< R
    double kept[2][5]; ///< U, V and c
    double state[2];   ///< the equation's right side, then the solution
} waypoint;

_Static_assert(sizeof(waypoint) == RESPONSE_ROOM * sizeof(double), "the room for a loop");

/// Turns two rows so that the second one begins with 0, from a column on.
static void rotate(double *a, double *b, int column)
{
    if (b[column] == 0) return;
    const double size = fmax(fabs(a[column]), fabs(b[column])), x = a[column] / size, y = b[column] / size;
    const double length = sqrt(x * x + y * y), c = x / length, s = y / length;
    for (int k = column; k < ENTRIES; k++) {
        const double above = c * a[k] + s * b[k];
        b[k] = c * b[k] - s * a[k];
        a[k] = above;
    }
}

/// The equation of a sample's interval as two rows, with −M_i at a column.
static void set_equation(const waypoint *at, int column, double row[2][ENTRIES])
{
    memset(row, 0, 2 * sizeof *row);
    row[0][column] = at->loss.q_q - 1, row[0][column + 1] = at->loss.q_v;
    row[1][column] = at->loss.v_q, row[1][column + 1] = at->loss.v_v - 1;
    for (int k = 0; k < 2; k++) row[k][RIGHT] = at->state[k];
}

/// Solves R s = right.
static bool solve_root(const double root[3], const double right[2], double s[2])
{
    if (root[0] == 0 || root[2] == 0) return false;
    s[1] = right[1] / root[2];
    s[0] = (right[0] - root[1] * s[1]) / root[0];
    return isfinite(s[0]) && isfinite(s[1]);
}

/// Solves for all states. False if no state, or more than one, returns to itself.
static bool solve_round(waypoint *way, int period)
{
    double row[4][ENTRIES]; // the equation that is left, and the next one
    set_equation(&way[0], OF_FIRST, row);
    row[0][0] = row[1][1] = 1;
    for (int i = 1; i < period; i++) {
        set_equation(&way[i], OF_ITSELF, row + 2);
        row[2][OF_NEXT] = row[3][OF_NEXT + 1] = 1;
        for (int column = 0; column < 2; column++) {
            for (int k = column + 1; k < 4; k++) rotate(row[column], row[k], column);
        }
        way[i].root[0] = row[0][0], way[i].root[1] = row[0][1], way[i].root[2] = row[1][1];
        for (int k = 0; k < 2; k++) {
            const double *left = row[2 + k];
            const double moved[ENTRIES] = {left[4], left[5], left[2], left[3], 0, 0, left[RIGHT]};
            memcpy(way[i].kept[k], row[k] + OF_FIRST, sizeof way[i].kept[k]);
            memcpy(row[k], moved, sizeof moved);
        }
    }
    for (int k = 0; k < 4; k++) row[k / 2][k % 2] += row[k / 2][OF_FIRST + k % 2]; // s_P is s_0
    rotate(row[0], row[1], 0);
    const double last[3] = {row[0][0], row[0][1], row[1][1]}, right[2] = {row[0][RIGHT], row[1][RIGHT]};
    double *first = way[0].state;
    if (!solve_root(last, right, first)) return false;
    for (int i = period - 1; i > 0; i--) {
        const double *next = i + 1 < period ? way[i + 1].state : first;
        double rest[2];
        for (int k = 0; k < 2; k++) {
            const double *r = way[i].kept[k];
            rest[k] = r[4] - (r[0] * first[0] + r[1] * first[1]) - (r[2] * next[0] + r[3] * next[1]);
        }
        if (!solve_root(way[i].root, rest, way[i].state)) return false;
    }
    return true;
}

/// What each equation misses at q and h q', with the jumps in double-double.
static void find_missed(waypoint *way, const double *y, int period, const double *q, const double *v)
{
    dd behind = dd_difference(y[0], y[period - 1]);
    for (int i = 0; i < period; i++) {
        const int next = i + 1 < period ? i + 1 : 0;
        const step_matrix *loss = &way[i].loss;
        const dd ahead = dd_difference(y[i + 1], y[i]), moved = dd_add(dd_subtract(behind, ahead), dd_from(v[i]));
        const dd of_q = dd_add(dd_product(loss->q_q, q[i]), dd_scale(loss->q_v, moved)),
                 of_v = dd_add(dd_product(loss->v_q, q[i]), dd_scale(loss->v_v, moved));
        way[i].state[0] = dd_subtract(dd_difference(q[i], q[next]), of_q).hi;
        way[i].state[1] = dd_subtract(dd_subtract(moved, dd_from(v[next])), of_v).hi;
        behind = ahead;
    }
}

/// How far q and Im u move if the steps are rounded differently, each by this share: all alike, or each in its own direction.
static double error_of_round(const wiggly_desc *desc, double floor, waypoint *way, const forced_response *u,
                             double share)
{
    const int period = desc->samples - 1;
    double largest = 0;
    for (int alike = 0; alike < 2; alike++) {
        for (int i = 0; i < period; i++) {
            const step_matrix *l = &way[i].loss;
            const double q = u->total[i], v = u->speed[i], sign = i * 7 % 5 < 2 ? -share : share;
            way[i].state[0] =
                alike ? share * (l->q_q * q + l->q_v * v) : sign * (fabs(l->q_q * q) + fabs(l->q_v * v));
            way[i].state[1] =
                alike ? share * (l->v_q * q + l->v_v * v) : -sign * (fabs(l->v_q * q) + fabs(l->v_v * v));
        }
        if (!solve_round(way, period)) return INFINITY;
        double most = 0;
        for (int i = 0; i < period; i++) {
            const oscillator o = oscillator_at(desc, i, floor);
            const double q = fabs(way[i].state[0]), v = fabs(way[i].state[1]) / desc->step;
            const double turn = desc->mode == WIGGLY_COMPLEX ? fabs(oscillator_turn(o, period * desc->step)) : 0;
            most = fmax(most, q + turn * (v + o.d * q));
        }
        largest += most;
    }
    return largest;
}

/// If corrections stop at a larger share of q, the rotations lost the pull: then it is too slow for a swing to grow.
static const double lost = 1e-10;

/// q to `total` and q', in the middle of its jumps, to `speed`. False if there is none, or the rotations cannot find it.
static bool run_round(const wiggly_desc *desc, const double *y, double floor, double fastest, forced_response *u)
{
    enum { SWEEPS = 8 };
    const int period = desc->samples - 1;
    const double h = desc->step;
    waypoint *way = (waypoint *)(void *)u->room;
    path p = begin(desc, floor);
    for (int i = 0; i < period; i++) {
        way[i].loss = next_loss(&p, i);
        way[i].loss.q_v /= h, way[i].loss.v_q *= h;
        u->total[i] = u->speed[i] = 0;
    }
    double before = INFINITY, change = 0, size = 0;
    for (int sweep = 0; sweep < SWEEPS; sweep++) {
        find_missed(way, y, period, u->total, u->speed);
        if (!solve_round(way, period)) return false;
        change = 0;
        for (int i = 0; i < period; i++) change = fmax(change, fmax(fabs(way[i].state[0]), fabs(way[i].state[1])));
        if (change > 0.5 * before) break; // in the last digits
        for (int i = 0; i < period; i++) {
            u->total[i] += way[i].state[0], u->speed[i] += way[i].state[1];
            size = fmax(size, fmax(fabs(u->total[i]), fabs(u->speed[i])));
        }
        before = change;
        if (change <= DBL_EPSILON * size) break;
    }
    if (change > lost * size) return false;
    u->error = 4 * change + 8 * error_of_round(desc, floor, way, u, 4 * DBL_EPSILON * (1 + fastest * h));
    u->total[period] = u->total[0], u->speed[period] = u->speed[0];
    for (int i = 0; i <= period; i++) u->speed[i] = u->speed[i] / h + 0.5 * u->im[i];
    return true;
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
    if (f.pull && !poles_are_constant(desc) && run_round(desc, y, floor, sqrt(f.k), u))
        return extent_size(extent_of(u->total, period)) <= blow_up * range;
    const step_matrix a = around(desc, floor);
    double end[2], state[2], more[2];
    run(desc, floor, 0, 0, u, end);
    u->error = INFINITY;
    if (!close_circle(seconds, f, &a, end, state)) return false;
    run(desc, floor, state[0], state[1], u, end);
    u->error = error_of_circle(u, period, desc->step, f, &a, 2 * DBL_EPSILON);
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

/// Lets Im u see the offset's speed: a part that lags follows a move later, and does not see the mass that stays behind.
static void add_offset(const wiggly_desc *desc, double floor, const forced_response *u)
{
    const double *o = u->offset, t = (desc->samples - 1) * desc->step;
    const int last = desc->samples - 1;
    const bool loops = desc->start == WIGGLY_LOOP;
    for (int i = 0; i <= last; i++) {
        const int before = i > 0 ? i - 1 : loops ? last - 1 : 0, after = i < last ? i + 1 : loops ? 1 : last;
        if (o[after] == o[before]) continue;
        u->im[i] += oscillator_turn(oscillator_at(desc, i, floor), t) * (o[after] - o[before]) / (2 * desc->step);
    }
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

/// A bound of what rounding has done to q and to Im u on the way from rest. The free motion of an error never grows in the norm of its energy,
/// k q² + q'²; where k is constant and swings, (ω_d q)² + (q' + d q)² falls with the damping. To that each step adds its own rounding.
static double error_of_run(const wiggly_desc *desc, const forced_response *u)
{
    const bool constant = poles_are_constant(desc);
    const double h = desc->step, t = (desc->samples - 1) * h, unit = 2 * DBL_EPSILON;
    oscillator o = oscillator_at(desc, 0, 0);
    const double swing = o.k - o.d * o.d;
    const bool falls = constant && swing > 0.5 * o.k;
    double decay = falls ? maths_exp(-o.d * h) : 1, size = falls ? swing : o.k, turn = fabs(oscillator_turn(o, t));
    double norm = 0, of_q = 0, most = 0;
    if (desc->mode != WIGGLY_COMPLEX) turn = 0;
    for (int i = 0; i < desc->samples; i++) {
        const double q = fabs(u->total[i]), v = fabs(u->speed[i]);
        if (!constant && i > 0) {
            o = oscillator_at(desc, i, 0);
            if (o.k > size) norm = sqrt(norm * norm + (o.k - size) * of_q * of_q);
            size = o.k;
            if (desc->mode == WIGGLY_COMPLEX) turn = fabs(oscillator_turn(o, t));
        }
        const double root = sqrt(size), own = unit * (v + (o.k * h + o.d) * q);
        norm = decay * norm + own + unit * root * q;
        const double held = root > 0 ? norm / root : INFINITY, run = of_q + h * norm + unit * q;
        of_q = held < run ? held : run;
        const double im = turn * (norm + (falls ? 0 : o.d * of_q)) + (turn > 0 ? unit * turn * (v + o.d * q) : 0);
        most = fmax(most, fmax(of_q, im));
    }
    return most;
}

wiggly_status forced_response_find(const wiggly_desc *desc, const double *y, double calm, forced_response *u)
{
    wiggly_status status = WIGGLY_OK;
    u->error = 0;
    set_kicks(desc, y, u->im);
    double end[2], floor = desc->start == WIGGLY_LOOP ? LEAST_DAMPING * calm : 0;
    if (desc->start != WIGGLY_LOOP) {
        run(desc, floor, 0, 0, u, end);
        u->error = error_of_run(desc, u);
    } else if (!run_loop(desc, y, floor, u) && calm == 0) {
        floor = LEAST_DAMPING * FALLBACK_CALM;
        run_loop(desc, y, floor, u);
        status = WIGGLY_CALMED;
    }
    if (desc->mode == WIGGLY_COMPLEX) {
        set_imaginary(desc, floor, u);
        if (u->offset) add_offset(desc, floor, u);
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

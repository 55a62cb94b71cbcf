/// Solves q'' + 2d q' + k q = −y'' for an equilibrium y that is linear between samples, in closed form from sample to sample.
//
// In place of q' it runs z = h (y + q)', which does not jump where y bends. Over an interval in which y moves by g, with the mean d, k of its ends,
//
//     q ← q − L_qq q − L_qv (z − g),      z ← z − L_vq q − L_vv (z − g),      L = I − exp [0 1; −kh² −2dh].
//
// What is small, L and the differences from sample to sample, keeps its own digits. So what rounding makes each interval miss, Δ, is of the order of
// ε times the motion over it. From rest the errors spread by C ← M C M' + diag Δ², M = I − L, and after i steps √(2i C_qq) bounds that of q (Cauchy
// and Schwarz). Round a loop all states are solved for together, and bounded likewise; see below.
//
// u is q with the imaginary part that an oscillation on one side of the axis has, u' = p u: Im u = −(q' + d q)/ω_d.
#include "spline/forced_response.h"
#include "spline/oscillator.h"
#include "spline/problem.h"
#include <float.h>
#include <math.h>
#include <string.h>

/// Rounding of L, of d and k, and of a step's sums: shares of what they are of.
static const double unit = 4 * DBL_EPSILON;

/// A loop whose response is as many times larger than y has none.
static const double blow_up = 1e4;

/// A pull that moves q back by a smaller share per round, against a constant brake, is none.
static const double faint = 1e-12;

/// A number for q and one for z.
typedef struct pair {
    double q, z;
} pair;

/// A symmetric matrix of q and z.
typedef struct spread {
    double qq, qz, zz;
} spread;

/// From a sample to the next: L, and ω_n h and d h.
typedef struct interval {
    step_matrix loss;
    double rate, brake;
} interval;

/// The intervals one after the other; constant parameters have a single one.
typedef struct path {
    const wiggly_desc *desc;
    double floor;
    bool constant;
    oscillator here; ///< of the sample before
    interval now;
} path;

static oscillator oscillator_at(const wiggly_desc *desc, int sample, double floor)
{
    poles at = poles_at(desc, sample, floor);
    return (oscillator){at.decay, at.natural * at.natural};
}

static interval interval_of(oscillator o, double h)
{
    interval m = {oscillator_loss(o, h), sqrt(o.k) * h, o.d * h};
    m.loss.q_v /= h, m.loss.v_q *= h;
    return m;
}

static path begin(const wiggly_desc *desc, double floor)
{
    const oscillator first = oscillator_at(desc, 0, floor);
    return (path){desc, floor, poles_are_constant(desc), first, interval_of(first, desc->step)};
}

/// The interval after sample i, in order.
static const interval *next(path *p, int i)
{
    if (p->constant) return &p->now;
    const bool closes = p->desc->start == WIGGLY_LOOP && i + 2 == p->desc->samples;
    const oscillator after = oscillator_at(p->desc, closes ? 0 : i + 1, p->floor);
    p->now = interval_of((oscillator){0.5 * (p->here.d + after.d), 0.5 * (p->here.k + after.k)}, p->desc->step);
    p->here = after;
    return &p->now;
}

static inline pair times(const step_matrix *m, pair s)
{
    return (pair){m->q_q * s.q + m->q_v * s.z, m->v_q * s.q + m->v_v * s.z};
}

/// What rounding may make a step miss, in `unit`: of its sums and of L, and of k and d, which act as a force. A fast brake stops that force's motion.
static inline pair rounding(const interval *m, pair s, pair t, double g)
{
    const double q = fabs(s.q), v = fabs(s.z - g), moved = v + fabs(g);
    const double force = 2 * (m->rate * m->rate * (q + v) + m->brake * (v + m->rate * q));
    const double felt = m->brake > 2 ? force * 2 / m->brake : force;
    return (pair){fabs(t.q - s.q) + fabs(m->loss.q_q) * q + fabs(m->loss.q_v) * moved + felt,
                  fabs(t.z - s.z) + fabs(m->loss.v_q) * q + fabs(m->loss.v_v) * moved + felt};
}

/// M C Mᵀ.
static inline spread spread_by(const step_matrix *m, spread c)
{
    const pair q = times(m, (pair){c.qq, c.qz}), z = times(m, (pair){c.qz, c.zz}); // M C
    const pair of_q = times(m, (pair){q.q, z.q}), of_z = times(m, (pair){q.z, z.z});
    return (spread){of_q.q, of_q.z, of_z.z};
}

/// q from rest to `total`, z to `speed`, and a bound of z's error to `im`.
static void run(const wiggly_desc *desc, const double *y, double range, forced_response *u)
{
    path p = begin(desc, 0);
    const int last = desc->samples - 1;
    const double in_range = 1 / range, share = unit * range * sqrt(2);
    pair s = {0, 0};
    spread c = {0, 0, 0};
    double most = 0, missed[2] = {0};
    for (int i = 0;; i++) {
        u->total[i] = s.q;
        u->speed[i] = s.z;
        u->im[i] = share * sqrt(i * (c.zz > 0 ? c.zz : 0));
        if (i * c.qq > most) most = i * c.qq;
        if (i == last) break;
        const interval *m = next(&p, i);
        const double g = y[i + 1] - y[i];
        const pair by = times(&m->loss, (pair){s.q, s.z - g}), t = {s.q - by.q, s.z - by.z};
        const pair off = rounding(m, s, t, g);
        const double of_q = (off.q + fabs(t.q)) * in_range, of_z = (off.z + fabs(t.z)) * in_range;
        const step_matrix step = {1 - m->loss.q_q, -m->loss.q_v, -m->loss.v_q, 1 - m->loss.v_v};
        c = spread_by(&step, c);
        c.qq += of_q * of_q, c.zz += of_z * of_z;
        missed[0] = fmax(missed[0], of_q), missed[1] = fmax(missed[1], of_z);
        s = t;
    }
    u->error = share * sqrt(most);
    for (int k = 0; k < 2; k++) u->missed[k] = unit * range * sqrt(last) * missed[k];
}

// --- a loop: all states together ---
//
// With s = (q, z) and σ_i = s_i − s_0, each interval is an equation σ_{i+1} − (I − L_i) σ_i + L_i s_0 = r_i; a pull that is faint beside 1 has a column
// of its own. Each is divided by what rounding may be of it. Reflections of two neighbouring equations eliminate σ_1, σ_2, … in turn, until one
// equation is left, for s_0. The rows that they set aside give the other states, from the last on:
//
//     σ_i  s_0  σ_{i+1}             σ_i  s_0  σ_{i+1}
//     | A    B    0   |     →      | R    U    V  |         R σ_i = c − U s_0 − V σ_{i+1}
//     | L−I  L    I   |            | 0    B'   A' |
//
// No number grows on the way, however fast a swing would that a varying frequency pumps up. The second solution corrects the first by what the
// equations then miss, r. With D = diag (AᵀA)⁻¹ by the same rows, each state is within √D (ρ ‖r‖ + ‖Δ‖) / (1 − ρ), where ρ bounds the
// reflections' own rounding.

enum { FIRST = 2, NEXT = 4, RIGHT = 6, ENTRIES };

/// A sample of a loop.
typedef struct waypoint {
    interval after;
    step_matrix root, first, next; ///< R, U, V
    pair right;                    ///< c
} waypoint;

_Static_assert(sizeof(waypoint) == RESPONSE_ROOM * sizeof(double), "the room for a loop");

/// Reflects rows from `column` on so that all but the first begin with 0 there (Householder); the zeros are not written.
static inline void reflect(double row[4][ENTRIES], int column)
{
    double square = 0;
    for (int k = column; k < 4; k++) square += row[k][column] * row[k][column];
    if (square == 0) return;
    const double size = copysign(sqrt(square), row[column][column]), pivot = row[column][column] + size,
                 share = 1 / (pivot * size);
    for (int j = column + 1; j < ENTRIES; j++) {
        double sum = pivot * row[column][j];
        for (int k = column + 1; k < 4; k++) sum += row[k][column] * row[k][j];
        sum *= share;
        row[column][j] -= sum * pivot;
        for (int k = column + 1; k < 4; k++) row[k][j] -= sum * row[k][column];
    }
    row[column][column] = -size;
}

/// Eliminates the first two unknowns of four rows; the first two rows are then the waypoint's.
static inline void eliminate(double row[4][ENTRIES], waypoint *at)
{
    reflect(row, 0);
    reflect(row, 1);
    at->root = (step_matrix){row[0][0], row[0][1], 0, row[1][1]};
    at->first = (step_matrix){row[0][FIRST], row[0][FIRST + 1], row[1][FIRST], row[1][FIRST + 1]};
    at->next = (step_matrix){row[0][NEXT], row[0][NEXT + 1], row[1][NEXT], row[1][NEXT + 1]};
    at->right = (pair){row[0][RIGHT], row[1][RIGHT]};
}

/// Factors the equations of q in `total` and z in `speed`. `least`: what z's rounding is at least, as a share of q's; 0: all equations weigh alike.
/// Returns ‖r‖; u's `missed` receives the inverse of the least weights.
static double factor(waypoint *way, const double *y, int period, double range, double least, bool pulled,
                     forced_response *u)
{
    double row[4][ENTRIES] = {{0}}, square = 0;
    u->missed[0] = u->missed[1] = 0;
    for (int i = 0; i < period; i++) {
        const interval *m = &way[i].after;
        const step_matrix *l = &m->loss;
        const int next = i + 1 < period ? i + 1 : 0;
        const pair s = {u->total[i], u->speed[i]}, t = {u->total[next], u->speed[next]};
        const double g = y[i + 1] - y[i];
        const pair by = times(l, (pair){s.q, s.z - g}), off = rounding(m, s, t, g);
        const double of_q = off.q + 0x1p-10 * range, of_z = off.z + least * of_q; // none is 0
        const double a = least > 0 ? range / of_q : 1, b = least > 0 ? range / of_z : 1;
        u->missed[0] = fmax(u->missed[0], 1 / a), u->missed[1] = fmax(u->missed[1], 1 / b);
        const double equation[2][ENTRIES] = {
            {a * (l->q_q - 1), a * l->q_v, a * l->q_q, a * l->q_v, a, 0, a * (s.q - t.q - by.q)},
            {b * l->v_q, b * (l->v_v - 1), b * l->v_q, b * l->v_v, 0, b, b * (s.z - t.z - by.z)}};
        memcpy(row[2], equation, sizeof equation);
        square += row[2][RIGHT] * row[2][RIGHT] + row[3][RIGHT] * row[3][RIGHT];
        if (i > 0) eliminate(row, &way[i]);
        for (int k = 0; k < 2; k++) {
            const double *r = row[k + 2];
            const double left[ENTRIES] = {r[NEXT], r[NEXT + 1], r[FIRST], r[FIRST + 1], 0, 0, r[RIGHT]};
            memcpy(row[k], left, sizeof left);
        }
    }
    for (int k = 0; k < 2; k++) { // σ_P is 0
        const double last[ENTRIES] = {row[k][FIRST], row[k][FIRST + 1], [RIGHT] = row[k][RIGHT]};
        memcpy(row[k], last, sizeof last);
    }
    memset(row[2], 0, 2 * sizeof row[2]);
    row[2][0] = pulled ? 0 : 1; // any q₀ will do
    eliminate(row, &way[0]);
    return sqrt(square);
}

/// The squares of a matrix's columns.
static pair columns(const step_matrix *m)
{
    return (pair){m->q_q * m->q_q + m->v_q * m->v_q, m->q_v * m->q_v + m->v_v * m->v_v};
}

/// C's diagonal, with two columns of its factor apart.
static pair diagonal(const pair column[2], spread c)
{
    return (pair){column[0].q * column[0].q + column[1].q * column[1].q + c.qq,
                  column[0].z * column[0].z + column[1].z * column[1].z + c.zz};
}

/// Adds the solution to `total` and `speed`. √D of z goes to `im`, the largest of q to `error`. Returns ρ, infinite if there is no solution.
static double solve(const waypoint *way, int period, forced_response *u)
{
    enum { SOLUTION = 2 }; // behind two columns that are what the last equation's own noise does
    pair first[3] = {{0}}, s[3] = {{0}}, of_first = columns(&way[0].root);
    spread c = {0, 0, 0}; // of the noise of all others
    double sum = 0, most = 0;
    for (int n = 0; n < period; n++) {
        const int i = n > 0 ? period - n : 0;
        const waypoint *at = &way[i];
        const step_matrix *r = &at->root, inverse = {1 / r->q_q, -r->q_v / (r->q_q * r->v_v), 0, 1 / r->v_v};
        for (int k = 0; k <= SOLUTION; k++) {
            const pair right = k == SOLUTION ? at->right : (pair){k == 0 && i == 0, k == 1 && i == 0};
            const pair a = times(&at->first, first[k]), b = times(&at->next, s[k]);
            s[k] = times(&inverse, (pair){right.q - a.q - b.q, right.z - a.z - b.z});
        }
        if (i == 0) {
            memcpy(first, s, sizeof s);
            memset(s, 0, sizeof s);
        } else {
            c = spread_by(&at->next, c);
            c.qq += 1, c.zz += 1;
            c = spread_by(&inverse, c);
            const pair of_this = columns(&at->root), of_s0 = columns(&at->first), d = diagonal(s, c);
            const pair of_before = i > 1 ? columns(&way[i - 1].next) : (pair){0, 0};
            sum += d.q * (of_this.q + of_before.q) + d.z * (of_this.z + of_before.z);
            of_first.q += of_s0.q, of_first.z += of_s0.z;
        }
        pair state[3];
        for (int k = 0; k <= SOLUTION; k++) state[k] = (pair){first[k].q + s[k].q, first[k].z + s[k].z};
        const pair d = diagonal(state, c);
        if (d.q > most) most = d.q;
        u->im[i] = sqrt(d.z);
        u->total[i] += state[SOLUTION].q;
        u->speed[i] += state[SOLUTION].z;
    }
    const pair d = diagonal(first, (spread){0, 0, 0});
    sum += d.q * of_first.q + d.z * of_first.z;
    u->error = sqrt(most);
    return 10 * DBL_EPSILON * (period + 2) * (1 + sqrt(sum));
}

/// The periodic q to `total`, z to `speed` and a bound of z's error to `im`. False if there is none, or only one far too large.
static bool close_loop(const wiggly_desc *desc, const double *y, double floor, double range, forced_response *u)
{
    enum { SWEEPS = 4 };
    const int period = desc->samples - 1;
    const double own = unit * range * sqrt(2.0 * period); // ‖Δ‖
    waypoint *way = (waypoint *)(void *)u->room;
    path p = begin(desc, floor);
    bool pulled = false;
    for (int i = 0; i < period; i++) {
        const interval *m = next(&p, i);
        pulled = pulled || period * m->rate * m->rate > (p.constant ? faint * m->brake : 0);
        way[i].after = *m;
        u->total[i] = u->speed[i] = 0;
    }
    double error = INFINITY, least = 0;
    for (int sweep = 0; sweep < SWEEPS && !(error < 2 * own); sweep++) {
        const double missed = factor(way, y, period, range, least, pulled, u), share = solve(way, period, u);
        if (sweep > 0) error = share < 0.5 ? (share * missed + own) / (1 - share) : INFINITY;
        least = sweep > 0 ? least * 0x1p12 : 0x1p-40;
    }
    double mean = 0;
    for (int i = 0; i < period; i++) {
        if (!isfinite(u->total[i]) || !isfinite(u->speed[i])) u->total[i] = u->speed[i] = 0, error = INFINITY;
        mean += u->total[i] / period;
        u->im[i] = error * u->im[i] + DBL_EPSILON * fabs(u->speed[i]);
    }
    for (int i = 0; i < period && !pulled; i++) u->total[i] -= mean; // determined up to a constant
    u->total[period] = u->total[0], u->speed[period] = u->speed[0], u->im[period] = u->im[0];
    const double largest = extent_size(extent_of(u->total, period));
    const double sums = pulled ? DBL_EPSILON : period * DBL_EPSILON + faint;
    u->error = error < INFINITY ? error * u->error + sums * largest : INFINITY;
    u->missed[0] *= error, u->missed[1] *= error;
    return error < INFINITY && (!pulled || largest <= blow_up * range);
}

/// Half the change from the sample before to the one after. A loop wraps; an end is level.
static double half_change(const wiggly_desc *desc, const double *a, int i)
{
    const int last = desc->samples - 1;
    const bool loops = desc->start == WIGGLY_LOOP && last > 0;
    return 0.5 * (a[i < last ? i + 1 : loops ? 1 : last] - a[i > 0 ? i - 1 : loops ? last - 1 : 0]);
}

/// The same of y, which goes on as it ends.
static double half_change_of_y(const wiggly_desc *desc, const double *y, int i)
{
    return half_change(desc, y, i) * (i + 1 == desc->samples && desc->start != WIGGLY_LOOP ? 2 : 1);
}

/// u from q and z, and a bound of both its parts. Im u sees the offset's speed, too: a part that lags follows a move later, and does not see the
/// mass that stays behind.
static void finish(const wiggly_desc *desc, const double *y, double floor, forced_response *u)
{
    const bool constant = poles_are_constant(desc);
    const double h = desc->step, seconds = (desc->samples - 1) * h;
    oscillator o = {0};
    double turn = 0, loss = 0;
    u->state[0] = u->error, u->state[1] = 0;
    u->rounding = 0;
    for (int i = 0; i < desc->samples; i++) {
        const double q = u->total[i], z = u->speed[i], moved = half_change_of_y(desc, y, i);
        u->total[i] = q + y[i];
        u->speed[i] = z / h;
        u->state[1] = fmax(u->state[1], u->im[i]);
        u->rounding = fmax(u->rounding, DBL_EPSILON * fabs(q));
        if (desc->mode != WIGGLY_COMPLEX) {
            u->im[i] = 0;
            continue;
        }
        if (i == 0 || !constant) {
            o = oscillator_at(desc, i, floor);
            turn = oscillator_turn(o, seconds);
            loss = turn < 0 ? 8 * unit * o.k / (o.k - o.d * o.d) : 0;
        }
        const double of_state = -turn * (u->im[i] / h + o.d * u->state[0]);
        const double speed = ((z - moved) + (u->offset ? half_change(desc, u->offset, i) : 0)) / h;
        u->im[i] = turn * (speed + o.d * q);
        const double own = -turn * (DBL_EPSILON * (fabs(z) + 2 * fabs(moved)) / h + o.d * unit * fabs(q));
        const double rounding = own + loss * fabs(u->im[i]);
        u->rounding = fmax(u->rounding, rounding);
        u->error = fmax(u->error, of_state + rounding);
    }
}

wiggly_status forced_response_find(const wiggly_desc *desc, const double *y, double calm, forced_response *u)
{
    const bool loops = desc->start == WIGGLY_LOOP;
    const extent all = extent_of(y, desc->samples);
    const double range = all.high - all.low;
    if (!(range > 0)) {
        forced_response_rest(desc, y, u);
        return WIGGLY_OK;
    }
    double floor = loops ? LEAST_DAMPING * calm : 0;
    wiggly_status status = WIGGLY_OK;
    if (!loops) {
        run(desc, y, range, u);
    } else if (!close_loop(desc, y, floor, range, u) && calm == 0) {
        floor = LEAST_DAMPING * FALLBACK_CALM;
        close_loop(desc, y, floor, range, u);
        status = WIGGLY_CALMED;
    }
    u->floor = floor;
    finish(desc, y, floor, u);
    if (loops) u->total[desc->samples - 1] = u->total[0], u->im[desc->samples - 1] = u->im[0];
    return status;
}

void forced_response_rest(const wiggly_desc *desc, const double *y, forced_response *u)
{
    u->error = u->rounding = 0;
    for (int i = 0; i < desc->samples; i++) {
        u->total[i] = y[i];
        u->im[i] = 0;
        u->speed[i] = half_change_of_y(desc, y, i) / desc->step;
    }
}

// --- what the rows of w see of u's error ---
//
// The error of a state is e_{i+1} = (I − L_i) e_i + Δ_i. So a row on three samples of u sees e of the first of them, and two Δ. Of a free motion,
// e without Δ, it sees nothing or next to nothing.

/// Three samples, with what gives Im u there, and the intervals between them.
typedef struct window {
    double turn[3], brake[3]; ///< Im u is turn (z + brake q)
    step_matrix loss[2];
} window;

/// The most that a row with these coefficients sees of an error that enters at a sample. A slope sees its real part, less the speed there.
static double look(const window *w, const cplx c[3], bool is_slope, int from, const double error[2])
{
    double sum = 0;
    for (int part = 0; part < 2; part++) {
        pair e = {part == 0, part == 1};
        cplx seen = {0, 0};
        for (int n = from;; n++) {
            seen = cplx_add(seen, cplx_mul(c[n], (cplx){e.q, w->turn[n] * (e.z + w->brake[n] * e.q)}));
            if (is_slope && n == 1) seen.re -= e.z;
            if (n == 2) break;
            const pair by = times(&w->loss[n], e);
            e.q -= by.q, e.z -= by.z;
        }
        sum += error[part] * (is_slope ? fabs(seen.re) : cplx_size(seen));
    }
    return sum;
}

double forced_response_slip(const wiggly_desc *desc, const forced_response *u, const system_rows *rows)
{
    const int count = rows->count, last = desc->samples - 1;
    const bool constant = poles_are_constant(desc);
    const double h = desc->step;
    window w = {.turn = {0}};
    oscillator o = {0};
    const double none[2] = {0, 0};
    double sum = 0, most[2] = {0}, jet[3] = {0};
    for (int k = -2, slope = 0; k < count; k++) {
        if (k < 1 || !constant) {
            const int ahead = rows->loop ? (k + 1 + count) % count : rows->first + k + 1;
            const oscillator here = o;
            o = oscillator_at(desc, ahead < 0 ? 0 : ahead < last ? ahead : last, u->floor);
            for (int n = 0; n < 2; n++) w.turn[n] = w.turn[n + 1], w.brake[n] = w.brake[n + 1];
            w.turn[2] = desc->mode == WIGGLY_COMPLEX ? oscillator_turn(o, last * h) / h : 0, w.brake[2] = o.d * h;
            w.loss[0] = w.loss[1];
            w.loss[1] = interval_of((oscillator){0.5 * (here.d + o.d), 0.5 * (here.k + o.k)}, h).loss;
        }
        if (k < 0) continue;
        const bool begins = k == 0 && !rows->loop, ends = k == count - 1 && !rows->loop;
        const double *const missed = begins ? none : u->missed;
        const double *const state = begins && rows->first == 0 ? none : u->state; // u is 0 at sample 0
        const jet_row row = system_jet(rows, k);
        if (row.weight > 0) {
            const cplx c[3] = {row.before, row.own, {ends ? 0 : 1, 0}};
            if (!constant || k < 2 || ends) { // else it is the one before
                jet[0] = look(&w, c, false, begins, state);
                jet[1] = look(&w, c, false, 1, missed);
                jet[2] = look(&w, c, false, 2, u->missed);
            }
            sum += row.weight * (jet[0] * jet[0]);
            for (int n = 0; n < 2; n++) most[n] = fmax(most[n], sqrt(row.weight) * jet[n + 1]);
        }
        if (rows->is_complex) {
            const double im = fabs(w.turn[1]) * (u->state[1] + w.brake[1] * u->state[0]);
            sum += (rows->is_constant ? rows->own_im : rows->im_weight[k]) * (im * im);
        }
        for (; slope < rows->slope_count && rows->slopes[slope].sample == k; slope++) {
            stencil s = system_slope_stencil(rows, &rows->slopes[slope]);
            if (ends) s.c[2] = (cplx){0, 0};
            const double off = look(&w, s.c, true, begins, state) + look(&w, s.c, true, 1, missed) +
                               look(&w, s.c, true, 2, u->missed);
            sum += rows->slopes[slope].weight * (off * off);
        }
        for (int i = 0; i < 2 && k == 0; i++) {
            const struct start_row *start = &rows->start.row[i];
            const cplx on_e = ends ? (cplx){0, 0} : start->on_e, by_tail = cplx_mul(rows->tail, start->on_e);
            const cplx c[3] = {{0, 0}, ends ? cplx_add(start->on_x, by_tail) : cplx_sub(start->on_x, on_e), on_e};
            const double off = look(&w, c, false, 1, state) + look(&w, c, false, 2, u->missed);
            sum += start->weight * (off * off);
        }
    }
    return sqrt(sum) + most[0] + most[1];
}

// --- the slope of a solved curve at a sample

/// x without the response to the equilibrium's motion, of which `response` has total and Im, N numbers each; NULL: none.
static cplx made_by_knots(const wiggly_curve *curve, const double *response, int sample)
{
    if (!response) return (cplx){curve->re[sample], curve->im[sample]};
    const double *total = response, *im = total + curve->samples;
    return (cplx){curve->re[sample] - (total[sample] - curve->y[sample]), curve->im[sample] - im[sample]};
}

double curve_slope(const wiggly_desc *desc, const wiggly_curve *curve, int sample, double *room)
{
    const int last = curve->samples - 1;
    const bool loop = desc->start == WIGGLY_LOOP, behind = sample > curve->first || loop, ahead = sample < last;
    if (desc->passive ==
        WIGGLY_FILTER) { // the paper's slope: the step to the next sample; at the last, from the one before
        const int from = ahead ? sample : sample - 1;
        return from < 0 ? 0 : (curve->total[from + 1] - curve->total[from]) / desc->step;
    }

    // The speed of the equilibrium and its response, which knots do not change.
    const double *response = NULL;
    double known = 0;
    if (desc->equilibrium.track && last > 0) {
        const size_t n = (size_t)curve->samples;
        forced_response u = {.total = room, .im = room + n, .speed = room + 2 * n, .room = room + 3 * n};
        response = room;
        memset(room, 0, CURVE_SLOPE_ROOM * n * sizeof *room);
        if (desc->mode == WIGGLY_CUBIC) {
            forced_response_rest(desc, curve->y, &u);
        } else {
            forced_response_find(desc, curve->y, desc->calm, &u);
        }
        known = u.speed[sample];
    }

    // As in the solver's slope rows (rows.c): the speed from both sides, at an end from one; after the last knot, which alone moves it, its own.
    const poles at = poles_at(desc, sample, loop ? LEAST_DAMPING * desc->calm : 0);
    const cplx here = made_by_knots(curve, response, sample);
    if (desc->mode == WIGGLY_COMPLEX && !loop && desc->knot_count > 0 &&
        sample >= desc->knots[desc->knot_count - 1].sample)
        return known + cplx_mul(poles_passive(&at), here).re;
    double sum = 0;
    if (ahead) {
        const speed_form form = poles_speed(&at, desc->step, false);
        const cplx change = cplx_sub(made_by_knots(curve, response, sample + 1), here);
        sum += cplx_mul(form.on_x, here).re + cplx_mul(form.on_e, change).re;
    }
    if (behind) {
        const speed_form form = poles_speed(&at, desc->step, true);
        const cplx change = cplx_sub(here, made_by_knots(curve, response, sample > 0 ? sample - 1 : last - 1));
        sum += cplx_mul(form.on_x, here).re + cplx_mul(form.on_e, change).re;
    }
    return known + (ahead || behind ? sum / ((ahead + behind) * desc->step) : 0);
}

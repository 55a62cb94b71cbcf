/// The matrix that the search for held samples uses: a limited spline and the motion after its last knot, as one band.
//
// Let d be the change that limits cause. Up to the last knot L its energy is that of the spline's rows. After it, the change of e is d minus
// the change of the free motion, φ v, where Im w_L changes by v:
//
//     row i of the tail: d_{i+1} − a_i d_i − b_i d_{i−1} − c_i v, c_i = φ_{i+1} − a_i φ_i − b_i φ_{i−1}        (d₀ = φ₀ = 0)
//
// With constant poles all c_i but c₀ are rounding. A stiff spring passes v from block to block, as each block's second number.
#include "spline/bound_tail.h"
#include "spline/limits.h"
#include <string.h>

enum { SWEEPS = 2 };

static const double lossy = 1e8;    ///< from this loss of digits in a complex factor on, its solutions are refined
static const double stiffest = 1e8; ///< of what holds a sample, relative to its row
static const double stiff = 1e6;    ///< that spring's weight, relative to the first row

static double on_own(const coefficients *at) { return -2 - at->m.re; }
static double on_before(const coefficients *at) { return 1 + at->m.re + at->p.re; }

/// The tail's rows, at their place after `body` blocks, with c_i among the drives.
static void set_tail(limits_work *w, int body)
{
    system_rows *rows = &w->solver->rows;
    const int count = w->tail.to - w->tail.begin;
    limits_set_tail_rows(w);
    memmove(rows->at + body, rows->at, sizeof *rows->at * (size_t)count);
    memmove(rows->jet_weight + body, rows->jet_weight, sizeof *rows->jet_weight * (size_t)count);
    const double *turned = w->solver->limits.free[1] + w->tail.begin; // φ
    for (int i = 0; i < count; i++) {
        const coefficients *at = &rows->at[body + i];
        rows->jet_weight[body + i] *= w->p->unit / w->tail.p.unit;
        rows->drive[body + i].re =
            turned[i + 1] + on_own(at) * turned[i] + (i > 0 ? on_before(at) * turned[i - 1] : 0);
    }
}

/// Without a knot, a single sample at rest replaces the rows up to the last knot.
static void set_rest(system_rows *rows)
{
    rows->count = 1;
    rows->is_complex = true, rows->loop = false;
    rows->jet_to = -1;
    rows->slope_count = 0;
    rows->start = (start_cost){0};
    rows->fixed[0] = FIXED_RE | FIXED_IM;
}

/// Prepares the solver's rows for set_matrix().
static void set_system(limits_work *w)
{
    const bool alone = w->p->latest < 0 && limits_has_tail(w);
    if (limits_has_tail(w)) set_tail(w, alone ? 1 : problem_rows(w->p));
    w->first = alone ? w->tail.begin : w->p->first;
    if (alone) {
        set_rest(&w->solver->rows);
    } else {
        problem_set_rows(w->solver, w->p);
    }
    system_forget_known(&w->solver->rows);
}

static void add_tail(const limits_work *w)
{
    const system_rows *rows = &w->solver->rows;
    pentadiagonal *m = &w->solver->matrix;
    const int last = rows->count - 1, count = w->tail.to - w->tail.begin;
    const coefficients *at = rows->at + last + 1;
    const double *weight = rows->jet_weight + last + 1, spring = stiff * weight[0];
    const cplx *turn = rows->drive + last + 1; // c
    m->count += count;
    if (!(rows->fixed[last] & FIXED_IM)) {
        m->diagonal[3 * last + 2] += weight[0] * (turn[0].re * turn[0].re) + spring;
        m->below[4 * last + 1] = -weight[0] * turn[0].re, m->below[4 * last + 3] = -spring;
    }
    memset(m->below + 4 * (last + 1), 0, sizeof *m->below * 4 * (size_t)count);
    memset(m->below2 + 4 * (last + 1), 0, sizeof *m->below2 * 4 * (size_t)count);
    for (int i = 1; i <= count; i++) {
        double *diagonal = m->diagonal + 3 * (last + i), *below = m->below + 4 * (last + i);
        diagonal[0] = weight[i - 1], diagonal[1] = 0, diagonal[2] = spring;
        if (i < count) {
            const double own = on_own(&at[i]), c = turn[i].re;
            diagonal[0] += weight[i] * (own * own), diagonal[1] -= weight[i] * (own * c);
            diagonal[2] += weight[i] * (c * c) + spring;
            below[0] += weight[i] * own, below[1] -= weight[i] * c, below[3] = -spring;
        }
        if (i + 1 < count) {
            const double own = on_own(&at[i + 1]), before = on_before(&at[i + 1]);
            diagonal[0] += weight[i + 1] * (before * before);
            below[0] += weight[i + 1] * (own * before), below[2] -= weight[i + 1] * (turn[i + 1].re * before);
            m->below2[4 * (last + i)] = weight[i + 1] * before;
        }
    }
}

/// The matrix with nothing held, for the change of the total; a block's first number is Re of its sample.
static void set_matrix(const limits_work *w)
{
    system_matrix(&w->solver->rows, &w->solver->matrix);
    if (limits_has_tail(w)) add_tail(w);
}

static bool factor(void *user, const double *stiffness)
{
    limits_work *w = user;
    pentadiagonal *m = &w->solver->matrix;
    double *kept = w->solver->limits.stiffness;
    if (w->fresh) set_system(w);
    w->fresh = false;
    set_matrix(w);
    double *at = m->diagonal + 3 * (w->from - w->first);
    for (int i = 0; i < w->search.count; i++) kept[i] = stiffness ? stiffness[i] : 0;
    for (int i = 0; i < w->search.count; i++) at[3 * i] += kept[i];
    return pentadiagonal_factor(m) != RANK_BROKEN;
}

/// Subtracts the contribution of the tail's rows and the spring at x from the gradient.
static void pull_tail(const limits_work *w)
{
    const system_rows *rows = &w->solver->rows;
    const int last = rows->count - 1, count = w->tail.to - w->tail.begin;
    const double *weight = rows->jet_weight + last + 1, spring = stiff * weight[0];
    const double *d = rows->x + 2 * last; // d₀ = 0, v₀, d₁, …
    double *g = rows->gradient + 2 * last;
    const bool turns = !(rows->fixed[last] & FIXED_IM);
    memset(g + 2, 0, sizeof *g * 2 * (size_t)count);
    for (int i = 0; i < count; i++) {
        const coefficients *at = &rows->at[last + 1 + i];
        const double own = on_own(at), before = on_before(at), c = rows->drive[last + 1 + i].re;
        const double here = i > 0 ? d[2 * i] : 0, back = i > 1 ? d[2 * i - 2] : 0;
        const double r = weight[i] * (d[2 * i + 2] + own * here + before * back - c * d[2 * i + 1]);
        g[2 * i + 2] -= r;
        if (i > 0) g[2 * i] -= own * r;
        if (i > 1) g[2 * i - 2] -= before * r;
        if (i > 0 || turns) g[2 * i + 1] += c * r;
        const double apart = spring * (d[2 * i + 3] - d[2 * i + 1]);
        g[2 * i + 3] -= apart;
        if (i > 0 || turns) g[2 * i + 1] += apart;
    }
}

/// The force minus (H + stiffness) x, by the unsquared rows.
static void find_residual(limits_work *w, const double *force)
{
    const system_rows *rows = &w->solver->rows;
    const int shift = w->from - w->first;
    const double *kept = w->solver->limits.stiffness;
    system_right_side(rows);
    if (limits_has_tail(w)) pull_tail(w);
    for (int i = 0; i < w->search.count; i++) {
        const int k = shift + i;
        if (k < rows->count && rows->fixed[k] & FIXED_RE) continue;
        rows->gradient[2 * k] += force[i] - kept[i] * rows->x[2 * k];
    }
}

static void solve(void *user, double *force)
{
    limits_work *w = user;
    const pentadiagonal *m = &w->solver->matrix;
    const int unknowns = 2 * m->count, from = 2 * (w->from - w->first);
    double *all = w->solver->rows.gradient, *x = w->solver->rows.x;
    memset(all, 0, sizeof *all * (size_t)unknowns);
    for (int i = 0; i < w->search.count; i++) all[from + 2 * i] = force[i];
    pentadiagonal_solve(m, all);
    memcpy(x, all, sizeof *x * (size_t)unknowns);
    for (int sweep = 0; sweep < SWEEPS && m->is_complex && m->lost > lossy; sweep++) {
        find_residual(w, force);
        pentadiagonal_solve(m, all);
        for (int i = 0; i < unknowns; i++) x[i] += all[i];
    }
    for (int i = 0; i < w->search.count; i++) force[i] = x[from + 2 * i];
}

/// The largest change of x, both parts, that forces make with the present factor. After the last knot Im x follows from Re x.
static double largest_move(limits_work *w, double *force)
{
    static const double im[2] = {0, 1};
    const double *x = w->solver->rows.x;
    double most = 0, *e = w->solver->limits.pushed[0];
    solve(w, force);
    for (int i = 0; i < 2 * w->solver->matrix.count; i++) most = fmax(most, fabs(x[i]));
    const bound_tail tail = bound_tail_of(w->p, 1);
    for (int i = tail.begin + 1; i < tail.end && tail.is_complex; i++) e[i] = x[2 * (i - w->first)];
    for (int i = tail.begin + 1; i < tail.end && tail.is_complex; i++) {
        const tail_row row = bound_tail_row(&tail, i, im);
        most = fmax(most, fabs(bound_tail_see(&tail, &row, e)));
    }
    return most;
}

double limits_release(limits_work *w)
{
    const limit_memory *m = &w->solver->limits;
    double *force = w->search.move;
    bool any = false;
    for (int i = 0; i < w->search.count; i++) {
        const int sample = w->from + i;
        const bool pulls = limits_hold(w, sample) && m->held[sample] * m->pull[sample] < 0;
        force[i] = pulls ? m->pull[sample] : 0;
        any = any || pulls;
    }
    if (!any) return 0;
    w->fresh = true;
    if (!factor(w, NULL)) return INFINITY;
    return largest_move(w, force);
}

double limits_catch(limits_work *w, double slack)
{
    const limit_memory *m = &w->solver->limits;
    double *force = w->search.move;
    bool any = false;
    for (int i = 0; i < w->search.count; i++) {
        force[i] = m->held[w->from + i] == LIMITS_FREE ? limits_excess(w, w->from + i, slack) : 0;
        any = any || force[i] != 0;
    }
    if (!any) return 0;
    set_system(w);
    w->fresh = false;
    for (int i = 0; i < w->search.count; i++) {
        const bool stays = limits_hold(w, w->from + i) || force[i] != 0;
        m->stiffness[i] = stays ? stiffest * w->solver->rows.jet_weight[w->from - w->first + i] : 0;
        force[i] *= m->stiffness[i];
    }
    if (!factor(w, m->stiffness)) return INFINITY;
    return largest_move(w, force);
}

void limits_measure(limits_work *w)
{
    w->fresh = true;
    const limit_memory *m = &w->solver->limits;
    one_sided *o = &w->search;
    for (int i = 0; i < o->count; i++) {
        o->value[i] = limits_total(w, w->from + i);
        o->is_open[i] = m->held[w->from + i] != LIMITS_KEYED;
    }
    for (int s = 0; s < o->limits; s++) o->limit[s].at = o->limit[s].sign > 0 ? w->p->desc->low : w->p->desc->high;
}

void limits_set_search(limits_work *w)
{
    const wiggly_solver *solver = w->solver;
    const limit_memory *m = &solver->limits;
    const wiggly_desc *desc = w->p->desc;
    const size_t n = (size_t)solver->samples;
    double *jet = solver->rows.jet, *x = m->by_push;
    w->from = limits_has_body(w) ? w->body.from : w->tail.from;
    one_sided *o = &w->search;
    *o = (one_sided){.value = jet,
                     .move = jet + n,
                     .is_open = jet + 2 * n,
                     .lack = jet + 3 * n,
                     .count = (limits_has_tail(w) ? w->tail.to : w->body.to) - w->from + 1,
                     .user = w,
                     .factor = factor,
                     .solve = solve};
    const one_sided_limit low = {.sign = 1, .gap = m->free[0], .push = m->pushed[0], .by_gap = m->pull, .by_push = x};
    const one_sided_limit high = {
        .sign = -1, .gap = m->free[1], .push = m->pushed[1], .by_gap = m->spare, .by_push = x + n};
    if (desc->low > -INFINITY) o->limit[o->limits++] = low;
    if (desc->high < INFINITY) o->limit[o->limits++] = high;
}

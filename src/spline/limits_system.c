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

static const double lossy = 1e-4;   ///< from this rounding of a factor on, its solutions are corrected
static const double stiffest = 1e8; ///< of what holds a sample, relative to its row
static const double stiff = 1e6;    ///< that spring's weight, relative to the first row

/// A row of the tail: its weight and its coefficients on d of its own sample and of the one before, and on v.
typedef struct tail_jet {
    double weight, own, before, turn;
} tail_jet;

static tail_jet tail_jet_at(const limits_work *w, int i)
{
    const system_rows *rows = &w->solver->rows;
    const int at = rows->count + i;
    return (tail_jet){rows->jet_weight[at], -2 - rows->m_re[at], 1 + rows->m_re[at] + rows->p_re[at],
                      rows->drive[at].re};
}

/// The tail's rows, at their place after `body` samples, with c_i among the drives.
static void set_tail(limits_work *w, int body)
{
    system_rows *rows = &w->solver->rows;
    const int count = w->tail.to - w->tail.begin;
    limits_set_tail_rows(w);
    const double *turned = w->solver->limits.free[1] + w->tail.begin; // φ
    for (int i = count - 1; i >= 0; i--) {
        const coefficients at = system_coefficients(rows, i);
        const double own = -2 - at.m.re, before = 1 + at.m.re + at.p.re;
        const double weight = (rows->is_constant ? 1 : rows->jet_weight[i]) * (rows->fixed[i] & JET_TWICE ? 2 : 1);
        rows->m_re[body + i] = at.m.re, rows->p_re[body + i] = at.p.re;
        rows->jet_weight[body + i] = weight * (w->p->unit / w->tail.p.unit);
        rows->drive[body + i].re = turned[i + 1] + own * turned[i] + (i > 0 ? before * turned[i - 1] : 0);
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
    rows->is_constant = true, rows->fast = false;
    rows->own_im = 0;
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
    band_matrix *m = &w->solver->band;
    const int last = rows->count - 1, count = w->tail.to - w->tail.begin;
    const tail_jet first = tail_jet_at(w, 0);
    const double spring = stiff * first.weight;
    m->count += count;
    memset(m->marks + last + 1, BAND_OWN | BAND_BESIDE, (size_t)count);
    memset(m->own + last + 1, 0, sizeof *m->own * (size_t)count);
    band_block *end = band_own(m, last);
    if (!(rows->fixed[last] & FIXED_IM)) {
        end->d[2] += first.weight * (first.turn * first.turn) + spring;
        end->e[1] = -first.weight * first.turn, end->e[3] = -spring;
    }
    for (int i = 1; i <= count; i++) {
        band_block *at = &m->own[last + i];
        at->d[0] = tail_jet_at(w, i - 1).weight, at->d[2] = spring;
        if (i < count) {
            const tail_jet jet = tail_jet_at(w, i);
            at->d[0] += jet.weight * (jet.own * jet.own), at->d[1] -= jet.weight * (jet.own * jet.turn);
            at->d[2] += jet.weight * (jet.turn * jet.turn) + spring;
            at->e[0] += jet.weight * jet.own, at->e[1] -= jet.weight * jet.turn, at->e[3] = -spring;
        }
        if (i + 1 < count) {
            const tail_jet jet = tail_jet_at(w, i + 1);
            at->d[0] += jet.weight * (jet.before * jet.before);
            at->e[0] += jet.weight * (jet.own * jet.before), at->e[2] -= jet.weight * (jet.turn * jet.before);
            at->f[0] = jet.weight * jet.before;
        }
    }
}

/// The matrix with nothing held, for the change of the total; a block's first number is Re of its sample.
static void set_matrix(const limits_work *w)
{
    system_matrix(&w->solver->rows, &w->solver->band);
    if (limits_has_tail(w)) add_tail(w);
}

static bool factor(void *user, const double *stiffness)
{
    limits_work *w = user;
    band_matrix *m = &w->solver->band;
    const int shift = w->from - w->first;
    double *kept = w->solver->limits.stiffness;
    if (w->fresh) {
        set_system(w);
        set_matrix(w);
    }
    memset(kept, 0, sizeof *kept * (size_t)m->count);
    if (stiffness) memcpy(kept + shift, stiffness, sizeof *kept * (size_t)w->search.count);
    m->stiffness = kept;
    return band_factor(m);
}

/// Subtracts the contribution of the tail's rows and the spring at x from the gradient.
static void pull_tail(const limits_work *w)
{
    const system_rows *rows = &w->solver->rows;
    const int last = rows->count - 1, count = w->tail.to - w->tail.begin;
    const double spring = stiff * tail_jet_at(w, 0).weight;
    const double *d = rows->x + 2 * last; // d₀ = 0, v₀, d₁, …
    double *g = rows->gradient + 2 * last;
    const bool turns = !(rows->fixed[last] & FIXED_IM);
    memset(g + 2, 0, sizeof *g * 2 * (size_t)count);
    for (int i = 0; i < count; i++) {
        const tail_jet jet = tail_jet_at(w, i);
        const double own = jet.own, before = jet.before, c = jet.turn;
        const double here = i > 0 ? d[2 * i] : 0, back = i > 1 ? d[2 * i - 2] : 0;
        const double r = jet.weight * (d[2 * i + 2] + own * here + before * back - c * d[2 * i + 1]);
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
    system_gradient(rows, NULL, NULL);
    if (limits_has_tail(w)) pull_tail(w);
    for (int i = 0; i < w->search.count; i++) {
        const int k = shift + i;
        if (k < rows->count && rows->fixed[k] & FIXED_RE) continue;
        rows->gradient[2 * k] += force[i] - kept[k] * rows->x[2 * k];
    }
}

static void solve(void *user, double *force)
{
    limits_work *w = user;
    band_matrix *m = &w->solver->band;
    const int unknowns = 2 * m->count, from = 2 * (w->from - w->first);
    double *all = w->solver->rows.gradient, *x = w->solver->rows.x;
    memset(x, 0, sizeof *x * (size_t)unknowns);
    for (int i = 0; i < w->search.count; i++) {
        const bool known = m->marks[from / 2 + i] & FIXED_RE;
        x[from + 2 * i] = known ? 0 : force[i];
    }
    if (w->fresh) {
        band_solve_spread(m, x);
        w->is_lossy = m->is_complex && !(m->rounding < lossy);
        w->fresh = false;
    } else {
        band_solve(m, x);
    }
    if (w->is_lossy) {
        find_residual(w, force);
        band_solve(m, all);
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
    for (int i = 0; i < 2 * w->solver->band.count; i++) most = fmax(most, fabs(x[i]));
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
    double *force = w->search.move, *stiffness = w->search.lack;
    bool any = false;
    for (int i = 0; i < w->search.count; i++) {
        force[i] = m->held[w->from + i] == LIMITS_FREE ? limits_excess(w, w->from + i, slack) : 0;
        any = any || force[i] != 0;
    }
    if (!any) return 0;
    w->fresh = true;
    if (!factor(w, NULL)) return INFINITY; // sets the rows
    for (int i = 0; i < w->search.count; i++) {
        const bool stays = limits_hold(w, w->from + i) || force[i] != 0;
        const int k = w->from - w->first + i;
        const bool usual = k < w->solver->rows.count && w->solver->rows.is_constant;
        stiffness[i] = stays ? stiffest * (usual ? 1 : w->solver->rows.jet_weight[k]) : 0;
        force[i] *= stiffness[i];
    }
    w->fresh = false;
    w->is_lossy = true;
    if (!factor(w, stiffness)) return INFINITY;
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
    double *own = m->search, *x = m->by_push;
    w->from = limits_has_body(w) ? w->body.from : w->tail.from;
    one_sided *o = &w->search;
    *o = (one_sided){.value = own,
                     .move = own + n,
                     .is_open = own + 2 * n,
                     .lack = own + 3 * n,
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

/// Limits: min E subject to low ≤ total ≤ high (docs/mathematics.md, Limits). Finds which samples are held at a limit, and the curve with
/// them held.
//
// Held samples are solved as additional knots; the multipliers are the gradient there. Most curves touch a limit here and there: the farthest
// samples beyond it are held, and a few exchanges find the right ones. Else an interior-point method finds them (one_sided.c), on the band's
// matrix with the motion after the last knot. Each solve starts from the description alone, so the same samples are held and the curve has
// the same bits, whatever was solved before.
//
// After the last knot w is free, w = e^{p…} w_L, until a limit pushes it: w = e^{p…} w_L + e, where Re e is the real oscillator's spline from
// rest at L, through the held samples' remaining distances. These are linear in v = Im w_L, so its energy is quadratic:
// E(v) = E₀ + D₀ v + ½ D₁ v², and D = dE/dv follows from the pulls at the held samples. For the part up to the last knot this is a slope there
// (its speed Re(p w_L) is linear in v, too), with stiffness ½ D₁ / (Im p)² and target v = −D₀ / D₁.
//
// The matrix: let d be the change that limits cause. Up to the last knot L its energy is that of the spline's rows. After it, the change of e
// is d minus the change of the free motion, φ v, where Im w_L changes by v:
//
//     row i of the tail: d_{i+1} − a_i d_i − b_i d_{i−1} − c_i v, c_i = φ_{i+1} − a_i φ_i − b_i φ_{i−1}        (d₀ = φ₀ = 0)
//
// With constant poles all c_i but c₀ are rounding. A stiff spring passes v from block to block, as each block's second number.
#include "maths/maths.h"
#include "spline/bound_tail.h"
#include "spline/one_sided.h"
#include <math.h>
#include <string.h>

enum { EXCHANGES = 8 };

static const double beyond = 1e-10; ///< share of the total's size by which a sample may miss a limit
static const double rounded = 1e-5; ///< share of that which is rounding
static const double faint = 1e-3;   ///< share of the strongest pull; weaker ones are ignored
static const double reach = 10;     ///< how many times its excess the curve may be off
static const double lossy = 1e-4;   ///< from this rounding of a factor on, its solutions are corrected
static const double stiffest = 1e8; ///< of what holds a sample, relative to its row
static const double stiff = 1e6;    ///< the spring's weight, relative to the first row

/// The state of a sample: free, held at a limit, or keyed.
enum { LIMITS_FREE = 0, LIMITS_LOW = -1, LIMITS_HIGH = 1, LIMITS_KEYED = 2 };

/// A part of a limited spline: up to the last knot, or the motion that limits add after it.
typedef struct limits_part {
    problem p; ///< with held samples as knots
    wiggly_desc desc;
    int begin;    ///< the spline's sample that is sample 0 here
    int from, to; ///< samples that may be held, as the spline counts them; to < from: none
} limits_part;

/// A limited spline being solved.
typedef struct limits_work {
    wiggly_solver *solver;
    problem *p; ///< with its knots alone
    wiggly_curve *curve;
    minimum *result;
    wiggly_status status;
    limits_part body, tail;
    double tail_error; ///< of the motion that limits add after the last knot
    one_sided search;  ///< of the samples that may be held
    int from, to;      ///< these samples, of both parts
    int first;         ///< sample of the first block of the matrix
    int attempts;      ///< of the search
    double missed;     ///< how far x is off for held samples that are not right
    bool fresh;        ///< the matrix must be set
    bool is_lossy;     ///< solutions of the factor are corrected
    bool has_room;     ///< for all samples that are to be held
} limits_work;

static bool has_body(const limits_work *w) { return w->body.to >= w->body.from; }
static bool has_tail(const limits_work *w) { return w->tail.to >= w->tail.from; }

static bool is_held(const limits_work *w, int sample) { return w->solver->limits.held[sample] & 1; }

static double total_of(const limits_work *w, int sample)
{
    return problem_about(w->p, sample) + w->curve->re[sample];
}

/// How far a sample is above the high limit (positive) or below the low one (negative); 0: within, or no farther beyond than `slack`.
static double excess_of(const limits_work *w, int sample, double slack)
{
    const wiggly_desc *desc = w->p->desc;
    const double total = total_of(w, sample);
    return total > desc->high + slack ? total - desc->high : total < desc->low - slack ? total - desc->low : 0;
}

// --- the curve with given samples held -------------------------------------------------------------------------------

/// What held samples must reach.
enum what { REACH_NOTHING, REACH_BOUND, PUSH_FREE, PUSH_TURN };

static int count_held(const limits_work *w, const limits_part *part)
{
    int count = 0;
    for (int i = part->from; i <= part->to; i++) count += is_held(w, i);
    return count;
}

/// Gives a part its knots and its held samples, in order. The tail has one at rest; its stiffness makes the force there, e₁ of its row, count
/// like any other. False: no room.
static bool take_knots(limits_work *w, limits_part *part, enum what what)
{
    wiggly_solver *solver = w->solver;
    const limit_memory *m = &solver->limits;
    const wiggly_knot *own = m->own;
    wiggly_knot rest = {.has_slope = true};
    const int held = what == REACH_NOTHING ? 0 : count_held(w, part);
    int count = 0, next = 0, knots = w->p->desc->knot_count;
    if (part == &w->tail) {
        const poles at = poles_at(&part->desc, 0, 0);
        const double seen = poles_speed(&at, part->desc.step, false).on_e.re;
        const double weight = maths_exp(poles_weight_exponent(&at, part->desc.step)) / (seen * seen);
        rest.stiffness = weight / (1 - 0.5 * weight) / part->desc.step;
        own = &rest, knots = 1;
    }
    if (held > 0 && knots + held > solver->knots) return false;
    for (int i = part->from; count < knots + held; i++) {
        for (; next < knots && (i > part->to || own[next].sample + part->begin <= i); next++)
            m->all[count++] = own[next];
        if (held == 0 || i > part->to || !is_held(w, i)) continue;
        double value = m->held[i] > 0 ? w->p->desc->high : w->p->desc->low;
        if (what == PUSH_FREE) value = value - problem_about(w->p, i) - m->free[0][i];
        if (what == PUSH_TURN) value = -m->free[1][i];
        m->all[count++] = (wiggly_knot){.sample = i - part->begin, .value = value};
    }
    part->desc.knots = m->all;
    part->desc.knot_count = count;
    part->p.desc = &part->desc;
    for (int k = 0; k < count; k++) solver->order[k] = k;
    return true;
}

/// −½ of the energy's gradient at a part's held samples, times `unit`, for a curve from its first row on; `im` may be NULL in a real one.
static void find_pulls(limits_work *w, const limits_part *part, const double *re, const double *im, double unit)
{
    const system_rows *rows = &w->solver->rows;
    problem_set_rows(w->solver, &part->p);
    for (int k = 0; k < rows->count; k++)
        rows->x[2 * k] = re[k], rows->x[2 * k + 1] = im && rows->is_complex ? im[k] : 0;
    system_gradient(rows, NULL, NULL);
    for (int i = part->from; i <= part->to; i++) {
        if (is_held(w, i)) w->solver->limits.pull[i] = unit * rows->gradient[2 * (i - part->begin - part->p.first)];
    }
}

/// The free w after the last knot, for Re w there and for an Im w of 1.
static void set_free(const limits_work *w)
{
    const problem *p = w->p;
    const limit_memory *m = &w->solver->limits;
    const int L = w->tail.begin, count = p->desc->samples - L - 1;
    m->free[0][L] = m->free[1][L] = 0;
    if (p->latest < 0) {
        for (int k = 0; k < 2; k++) memset(m->free[k] + L, 0, sizeof(double) * (size_t)(count + 1));
        return;
    }
    const wiggly_knot *last = &m->own[p->desc->knot_count - 1];
    const cplx known = {problem_knot_re(p, last), problem_is_whole(p, last) ? problem_knot_im(p, last) : 0};
    problem_fill_tail(w->solver, p, known, 1, count, m->free[0] + L + 1, m->pushed[0] + L + 1);
    problem_fill_tail(w->solver, p, (cplx){0, 1}, 1, count, m->free[1] + L + 1, m->pushed[0] + L + 1);
}

/// Re e of a part of the tail; `along_turn` receives Σ pull · free[1] over the held samples in units of E. False: no room.
static bool push(limits_work *w, enum what what, double *along_turn)
{
    wiggly_solver *solver = w->solver;
    const limit_memory *m = &solver->limits;
    limits_part *tail = &w->tail;
    double *re = m->pushed[what == PUSH_TURN] + tail->begin;
    if (!take_knots(w, tail, what)) return false;
    problem_pose(solver, &tail->desc, NULL, &tail->p);
    wiggly_curve curve = {.re = re, .im = re};
    minimum result;
    problem_find(solver, &tail->p, &curve, &result);
    w->tail_error += result.error;
    find_pulls(w, tail, re, NULL, 1);
    const double h = tail->desc.step, unit = h * h * h * tail->p.unit;
    for (int i = tail->from; i <= tail->to; i++) {
        if (is_held(w, i)) *along_turn += 2 * m->pull[i] * m->free[1][i] / unit;
    }
    return true;
}

/// Adds the slope at the last knot that stands for the tail's cost, merged with the knot's own slope.
static void add_slope(const limits_work *w, wiggly_knot *last, const double on_turn[2])
{
    const problem *p = w->p;
    const poles at = poles_at(p->desc, p->latest, 0);
    const cplx pole = poles_passive(&at);
    const double stiffness = 0.5 * on_turn[1] / (pole.im * pole.im), w_re = last->value - problem_about(p, p->latest);
    if (!(stiffness > 0 && stiffness < INFINITY)) return;
    double speed = pole.re * w_re + pole.im * on_turn[0] / on_turn[1];
    if (p->response.speed) speed += p->response.speed[p->latest];
    const double own = last->has_slope ? knot_stiffness(last) : 0;
    last->slope = (own * (last->has_slope ? last->slope : 0) + stiffness * speed) / (own + stiffness);
    last->stiffness = own + stiffness;
    last->has_slope = true;
}

/// Solves with the held samples, and finds their pulls. False: there is no room for so many.
static bool solve_held(limits_work *w)
{
    wiggly_solver *solver = w->solver;
    limit_memory *m = &solver->limits;
    limits_part *body = &w->body, *tail = &w->tail;
    wiggly_curve *curve = w->curve;
    const int knots = w->p->desc->knot_count, samples = w->p->desc->samples;
    const bool is_pushed = count_held(w, tail) > 0;
    const bool turns = knots > 0 && !problem_is_whole(w->p, &m->own[knots - 1]); // Im w at the last knot is free
    double on_turn[2] = {0, 0};
    w->tail_error = 0;
    m->solves++;
    if (is_pushed) {
        set_free(w);
        if (!push(w, PUSH_FREE, &on_turn[0]) || (turns && !push(w, PUSH_TURN, &on_turn[1]))) return false;
    }
    if (has_body(w) || knots > 0) {
        body->p = *w->p;
        body->p.level_slope = problem_implies_slope(w->p);
        body->desc = *w->p->desc;
        if (!take_knots(w, body, REACH_BOUND)) return false;
        const int count = body->desc.knot_count;
        if (on_turn[1] > 0) add_slope(w, &m->all[count - 1], on_turn);
        if (!problem_is_asked(&body->p) && count > 0) { // the held samples do
            body->p.earliest = m->all[0].sample;
            body->p.latest = m->all[count - 1].sample;
        }
        const wiggly_status status = problem_find(solver, &body->p, curve, w->result);
        w->status = status > w->status ? status : w->status;
        const int first = body->p.first;
        if (count > knots) find_pulls(w, body, curve->re + first, curve->im + first, 1);
    } else {
        memset(curve->re, 0, sizeof *curve->re * (size_t)samples);
        memset(curve->im, 0, sizeof *curve->im * (size_t)samples);
        *w->result = (minimum){.solved = true, .error = w->p->response.error};
    }
    w->result->error += w->tail_error;
    if (!is_pushed) return true;
    double *e = m->pushed[0];
    for (int i = tail->begin; turns && i < samples; i++) e[i] += curve->im[tail->begin] * m->pushed[1][i];
    take_knots(w, tail, REACH_NOTHING); // their memory held the body's
    find_pulls(w, tail, e + tail->begin, NULL, w->p->unit / tail->p.unit);
    const bound_tail moved = bound_tail_of(w->p, 1);
    bound_tail_add(&moved, e, curve);
    return true;
}

// --- the matrix ------------------------------------------------------------------------------------------------------

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

/// Adds the tail's rows, which lie after the body's.
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
static void set_matrix(limits_work *w)
{
    wiggly_solver *solver = w->solver;
    system_rows *rows = &solver->rows;
    limits_part *tail = &w->tail;
    const bool is_alone = w->p->latest < 0 && has_tail(w);
    w->first = is_alone ? tail->begin : w->p->first;
    if (has_tail(w)) { // its rows to their place after the body's, with c_i among the drives
        const int body = is_alone ? 1 : problem_rows(w->p);
        const double *turned = solver->limits.free[1] + tail->begin; // φ
        set_free(w);
        take_knots(w, tail, REACH_NOTHING);
        problem_pose(solver, &tail->desc, NULL, &tail->p);
        problem_set_rows(solver, &tail->p);
        for (int i = tail->to - tail->begin - 1; i >= 0; i--) {
            const coefficients at = system_coefficients(rows, i);
            const double own = -2 - at.m.re, before = 1 + at.m.re + at.p.re;
            const double weight =
                (rows->is_constant ? 1 : rows->jet_weight[i]) * (rows->fixed[i] & JET_TWICE ? 2 : 1);
            rows->m_re[body + i] = at.m.re, rows->p_re[body + i] = at.p.re;
            rows->jet_weight[body + i] = weight * (w->p->unit / tail->p.unit);
            rows->drive[body + i].re = turned[i + 1] + own * turned[i] + (i > 0 ? before * turned[i - 1] : 0);
        }
    }
    if (is_alone) { // without a knot, a single sample at rest replaces the rows up to the last one
        rows->count = 1;
        rows->is_complex = true, rows->loop = false;
        rows->jet_to = -1;
        rows->slope_count = 0;
        rows->start = (start_cost){0};
        rows->fixed[0] = FIXED_RE | FIXED_IM;
        rows->is_constant = true, rows->fast = false;
        rows->own_im = 0;
    } else {
        problem_set_rows(solver, w->p);
    }
    system_forget_known(rows);
    system_matrix(rows, &solver->band);
    if (has_tail(w)) add_tail(w);
}

static bool limits_factor(void *user, const double *stiffness)
{
    limits_work *w = user;
    band_matrix *m = &w->solver->band;
    double *kept = w->solver->limits.stiffness;
    if (w->fresh) set_matrix(w);
    memset(kept, 0, sizeof *kept * (size_t)m->count);
    if (stiffness) memcpy(kept + (w->from - w->first), stiffness, sizeof *kept * (size_t)w->search.count);
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

static void limits_solve(void *user, double *force)
{
    limits_work *w = user;
    band_matrix *m = &w->solver->band;
    const system_rows *rows = &w->solver->rows;
    const int unknowns = 2 * m->count, shift = w->from - w->first;
    double *residual = rows->gradient, *x = rows->x;
    memset(x, 0, sizeof *x * (size_t)unknowns);
    for (int i = 0; i < w->search.count; i++) x[2 * (shift + i)] = m->marks[shift + i] & FIXED_RE ? 0 : force[i];
    band_solve(m, x, w->fresh);
    if (w->fresh) w->is_lossy = m->is_complex && !(m->rounding < lossy);
    w->fresh = false;
    if (w->is_lossy) { // force − (H + stiffness) x, by the unsquared rows
        system_gradient(rows, NULL, NULL);
        if (has_tail(w)) pull_tail(w);
        for (int i = 0; i < w->search.count; i++) {
            const int k = shift + i;
            if (k < rows->count && rows->fixed[k] & FIXED_RE) continue;
            residual[2 * k] += force[i] - m->stiffness[k] * x[2 * k];
        }
        band_solve(m, residual, false);
        for (int i = 0; i < unknowns; i++) x[i] += residual[i];
    }
    for (int i = 0; i < w->search.count; i++) force[i] = x[2 * (shift + i)];
}

/// The largest change of x, both parts, that forces make with the present factor. After the last knot Im x follows from Re x.
static double largest_move(limits_work *w, double *force)
{
    static const double im[2] = {0, 1};
    const double *x = w->solver->rows.x;
    double most = 0, *e = w->solver->limits.pushed[0];
    limits_solve(w, force);
    for (int i = 0; i < 2 * w->solver->band.count; i++) most = fmax(most, fabs(x[i]));
    const bound_tail tail = bound_tail_of(w->p, 1);
    for (int i = tail.begin + 1; i < tail.end && tail.is_complex; i++) e[i] = x[2 * (i - w->first)];
    for (int i = tail.begin + 1; i < tail.end && tail.is_complex; i++) {
        const tail_row row = bound_tail_row(&tail, i, im);
        most = fmax(most, fabs(bound_tail_see(&tail, &row, e)));
    }
    return most;
}

// --- the search ------------------------------------------------------------------------------------------------------

/// How strongly a held sample is pulled to the limit instead of pushed.
static double pull_of(const limits_work *w, int sample)
{
    const limit_memory *m = &w->solver->limits;
    const double push = is_held(w, sample) ? m->held[sample] * m->pull[sample] : 0;
    return push < 0 ? -push : 0;
}

/// How far x would move if samples pulled by limits were freed; 0 if none is.
static double moved_if_freed(limits_work *w)
{
    double *force = w->search.move;
    bool any = false;
    for (int i = 0; i < w->search.count; i++) {
        const bool pulls = pull_of(w, w->from + i) > 0;
        force[i] = pulls ? w->solver->limits.pull[w->from + i] : 0;
        any = any || pulls;
    }
    if (!any) return 0;
    w->fresh = true;
    return limits_factor(w, NULL) ? largest_move(w, force) : INFINITY;
}

/// How far x would move if free samples beyond a limit by more than `slack` were held there; 0 if none is.
static double moved_if_held(limits_work *w, double slack)
{
    double *force = w->search.move, *stiffness = w->search.lack;
    bool any = false;
    for (int i = 0; i < w->search.count; i++) {
        const bool is_free = w->solver->limits.held[w->from + i] == LIMITS_FREE;
        force[i] = is_free ? excess_of(w, w->from + i, slack) : 0;
        any = any || force[i] != 0;
    }
    if (!any) return 0;
    set_matrix(w);
    for (int i = 0; i < w->search.count; i++) {
        const bool stays = is_held(w, w->from + i) || force[i] != 0;
        const int k = w->from - w->first + i;
        const bool usual = k < w->solver->rows.count && w->solver->rows.is_constant;
        stiffness[i] = stays ? stiffest * (usual ? 1 : w->solver->rows.jet_weight[k]) : 0;
        force[i] *= stiffness[i];
    }
    w->fresh = false;
    w->is_lossy = true;
    return limits_factor(w, stiffness) ? largest_move(w, force) : INFINITY;
}

/// How far a sample may miss a limit.
static double find_slack(const limits_work *w)
{
    double most = 0;
    for (int i = w->from; i <= w->to; i++) most = fmax(most, fabs(total_of(w, i)));
    return beyond * most;
}

/// The largest excess of a free sample.
static double find_excess(const limits_work *w)
{
    double most = 0;
    for (int i = w->from; i <= w->to; i++) most = fmax(most, is_held(w, i) ? 0 : fabs(excess_of(w, i, 0)));
    return most;
}

static void hold_nothing(limits_work *w)
{
    const limit_memory *m = &w->solver->limits;
    memset(m->held, LIMITS_FREE, (size_t)w->p->desc->samples);
    for (int k = 0; k < w->p->desc->knot_count; k++) m->held[m->own[k].sample] = LIMITS_KEYED;
}

/// The search's values with nothing held, and its limits.
static bool limits_begin(void *user)
{
    limits_work *w = user;
    one_sided *o = &w->search;
    hold_nothing(w);
    if (w->attempts++ > 0 && !solve_held(w)) return false;
    w->fresh = true;
    for (int i = 0; i < o->count; i++) {
        o->value[i] = total_of(w, w->from + i);
        o->is_open[i] = w->solver->limits.held[w->from + i] != LIMITS_KEYED;
    }
    for (int s = 0; s < o->limits; s++) o->limit[s].at = o->limit[s].sign > 0 ? w->p->desc->low : w->p->desc->high;
    return true;
}

/// Frees samples that are pulled, and holds the farthest sample beyond a limit of each gap between knots.
static void exchange(limits_work *w, double slack)
{
    signed char *held = w->solver->limits.held;
    double hardest = 0, most = 0;
    int farthest = -1;
    for (int i = w->from; i <= w->to; i++) hardest = fmax(hardest, pull_of(w, i));
    for (int i = w->from; i <= w->to; i++) {
        const double by = held[i] == LIMITS_FREE ? excess_of(w, i, slack) : 0;
        if (fabs(by) > fabs(most)) most = by, farthest = i;
        if (pull_of(w, i) > faint * hardest) held[i] = LIMITS_FREE;
        if (farthest >= 0 && (held[i] == LIMITS_KEYED || i == w->to)) {
            held[farthest] = most > 0 ? LIMITS_HIGH : LIMITS_LOW;
            most = 0, farthest = -1;
        }
    }
}

/// Exchanges a few held samples until the curve is right, or there is no room. It is if no sample exceeds a limit and no limit pulls.
static bool settle_held(limits_work *w)
{
    for (int n = 0; w->has_room; n++) {
        const double slack = find_slack(w), excess = find_excess(w);
        const bool is_within = excess <= slack;
        if (is_within || n == EXCHANGES) w->missed = fmax(excess, moved_if_freed(w));
        const bool is_right = is_within && w->missed <= slack;
        if (is_right && (n == EXCHANGES || moved_if_held(w, rounded * slack) <= slack)) return true;
        if (n == EXCHANGES) return false;
        exchange(w, is_right ? rounded * slack : slack);
        w->has_room = solve_held(w);
    }
    return true;
}

static int count_beyond(const limits_work *w, double slack)
{
    int count = 0;
    for (int i = w->from; i <= w->to; i++) count += !is_held(w, i) && excess_of(w, i, slack) != 0;
    return count;
}

/// Most curves touch a limit here and there, and exchanges alone find where. If a first one leaves half of what was beyond the limits, the curve
/// runs along them, and only the search finds how far.
static bool touches(limits_work *w)
{
    const double slack = find_slack(w);
    const int before = count_beyond(w, slack);
    if (before == 0) return true;
    exchange(w, slack);
    w->attempts++; // the search frees what is held
    w->has_room = solve_held(w);
    const bool found = w->has_room && 2 * count_beyond(w, slack) <= before && settle_held(w) && w->has_room;
    w->has_room = true;
    return found;
}

/// Solves with the samples that the search holds.
static bool limits_finish(void *user)
{
    limits_work *w = user;
    for (int i = 0; i < w->search.count; i++) {
        const double sign = one_sided_holds(&w->search, i);
        if (sign != 0) w->solver->limits.held[w->from + i] = sign < 0 ? LIMITS_HIGH : LIMITS_LOW;
    }
    w->has_room = solve_held(w);
    return settle_held(w);
}

int limits_prepare(wiggly_solver *solver, problem *p, wiggly_desc *ordered)
{
    limit_memory *m = &solver->limits;
    for (int k = 0; k < p->desc->knot_count; k++) {
        const wiggly_knot *knot = &p->desc->knots[solver->order[k]];
        const double total = p->about ? p->about[knot->sample] : problem_y(p, knot->sample);
        if (knot->still && !(total >= p->desc->low && total <= p->desc->high)) return solver->order[k];
        m->own[k] = *knot;
    }
    for (int k = 0; k < p->desc->knot_count; k++) solver->order[k] = k;
    *ordered = *p->desc;
    ordered->knots = m->own;
    p->desc = ordered;
    return -1;
}

wiggly_status limits_find(wiggly_solver *solver, problem *p, wiggly_curve *curve, minimum *result)
{
    limit_memory *m = &solver->limits;
    limits_work w = {.solver = solver, .p = p, .curve = curve, .result = result, .has_room = true};

    // The parts up to the last knot, or to the end if nothing moves freely after it, and after that, if it swings.
    const wiggly_desc *desc = p->desc;
    const bool oscillates = problem_oscillates(p), is_loop = p->start == WIGGLY_LOOP;
    const bool is_alone = desc->knot_count == 0 && oscillates && !is_loop;
    limits_part *body = &w.body, *tail = &w.tail;
    body->from = p->first + (p->start != WIGGLY_REST ? 0 : oscillates ? 1 : 2);
    body->to = p->settles ? p->latest : p->first + p->count - 1;
    if (p->count < 3 || !(desc->knot_count > 0 || is_loop || (p->start == WIGGLY_REST && !oscillates))) body->to = -1;
    tail->begin = is_alone ? 0 : p->latest;
    tail->from = tail->begin + 1;
    tail->to = desc->mode != WIGGLY_CUBIC && (is_alone || p->settles) ? desc->samples - 1 : -1;
    tail->desc = *desc;
    tail->desc.mode = WIGGLY_REAL;
    tail->desc.start = WIGGLY_FREE;
    tail->desc.calm = tail->desc.variation = 0;
    tail->desc.samples = desc->samples - tail->begin;
    tail->desc.low = -INFINITY, tail->desc.high = INFINITY;
    tail->desc.equilibrium = (wiggly_param){0};
    if (tail->desc.frequency.track) tail->desc.frequency.track += tail->begin;
    if (tail->desc.damping.track) tail->desc.damping.track += tail->begin;
    w.from = has_body(&w) ? body->from : tail->from;
    w.to = has_tail(&w) ? tail->to : body->to;

    m->solves = 0, m->from = w.from, m->to = w.to;
    hold_nothing(&w);
    w.status = problem_find(solver, p, curve, result);
    if (w.status == WIGGLY_SINGULAR) return w.status;
    const size_t n = (size_t)solver->samples;
    double *own = m->search, *x = m->by_push;
    w.search = (one_sided){.value = own,
                           .move = own + n,
                           .is_open = own + 2 * n,
                           .lack = own + 3 * n,
                           .count = w.to - w.from + 1,
                           .user = &w,
                           .begin = limits_begin,
                           .factor = limits_factor,
                           .solve = limits_solve,
                           .finish = limits_finish};
    const one_sided_limit low = {.sign = 1, .gap = m->free[0], .push = m->pushed[0], .by_gap = m->pull, .by_push = x};
    const one_sided_limit high = {
        .sign = -1, .gap = m->free[1], .push = m->pushed[1], .by_gap = m->spare, .by_push = x + n};
    if (p->desc->low > -INFINITY) w.search.limit[w.search.limits++] = low;
    if (p->desc->high < INFINITY) w.search.limit[w.search.limits++] = high;
    const bool found = touches(&w) || one_sided_solve(&w.search, find_slack(&w));
    if (!w.has_room) return WIGGLY_ERROR_CAPACITY;
    result->error +=
        found ? 2 * moved_if_held(&w, rounded * find_slack(&w)) : reach * fmax(w.missed, find_excess(&w));
    return w.status;
}

void limits_clamp(const wiggly_solver *solver, const problem *p, wiggly_curve *curve)
{
    const limit_memory *m = &solver->limits;
    double *total = curve->total;
    for (int i = m->from; i <= m->to; i++) {
        if (m->held[i] == LIMITS_LOW || total[i] < p->desc->low) total[i] = p->desc->low;
        if (m->held[i] == LIMITS_HIGH || total[i] > p->desc->high) total[i] = p->desc->high;
    }
    if (p->start == WIGGLY_LOOP) total[p->count] = total[0];
}

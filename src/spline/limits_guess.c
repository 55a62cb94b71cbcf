/// Guesses which samples a limit holds: a primal-dual interior-point method (Mehrotra's predictor and corrector).
//
// Let d be what limits change of the total x, H the band's matrix, and of each sample and limit g its gap, how far x is inside, and q how
// hard the limit pushes. Then
//
//     H d = Σ ± q,      g = ± (x + d − limit),      g q = μ,      g, q > 0,
//
// for a μ that goes from large to next to nothing. Each step is Newton's: H + Σ q/g on the diagonal is factored once and solved with
// twice, for what μ = 0 would ask for, and for the step itself, with what the first one tells of the second order. Six or so, however
// many samples are held, tell which: in the last one their gaps vanish, and the pushes on all others.
//
// It is as exact as the squared matrix. What is found is solved as what it is, and the dual method goes on from there (limits.c).
#include "spline/limits.h"
#include "spline/wide.h"
#include <math.h>
#include <string.h>

enum { STEPS = 40, LANES = 8 };

static const double short_of = 0.995;   ///< of the way to where a gap or a push is 0
static const double least_mean = 1e-12; ///< of the first μ: what is not clear by then has neither gap nor push
static const double clear = 3;          ///< where one of the two falls so much faster, the other is there to stay
static const double balanced = 1e-3;    ///< part of what H d lacked at first

/// One limit at all samples. Lengths are parts of the farthest that a sample is beyond a limit, pushes of what moves that one as far. At
/// knots, which are not held, gap and push are 1 and stay so.
typedef struct side {
    double sign, limit; ///< sign: of a push
    double *gap, *push;
    double *
        second; ///< product of the changes that μ = 0 would ask for; after a step above 0 where the push stays and the gap goes
} side;

typedef struct guess {
    limits_work *w;
    int from, count, sides;
    side side[2];
    double *total, *move; ///< move: of a step
    double *is_open;      ///< 0 at knots, else 1
    double *lack;         ///< of H d at first
    double lack_left;     ///< part of that
    double soft;          ///< what a push of 1 does to the sample that is farthest beyond a limit
    int pairs;            ///< of gap and push
    double mean;          ///< of gap times push
} guess;

/// How gap and push of a sample change, as parts of them, where their product is to be `aim`.
typedef struct change {
    double gap, push;
} change;

static inline change change_of(double sign, double limit, double gap, double push, double aim, double total,
                               double move, double is_open)
{
    const double miss = sign * (total - limit) - gap, part = (sign * move + is_open * miss) / gap;
    return (change){part, aim / (gap * push) - 1 - part};
}

/// What the product of gap and push is to be: μ less the second order; 1 at knots.
static inline double aim_of(double mean, double second, double is_open)
{
    return is_open * (mean - second) + (1 - is_open);
}

/// Adds a side's part of Newton's right-hand side, with or without the second order.
WIDEST static void add_force(const guess *g, const side *s, double mean, double part, double *restrict force)
{
    const double *restrict gap = s->gap, *restrict push = s->push, *restrict second = s->second,
                           *restrict total = g->total, *restrict is_open = g->is_open;
    for (int i = 0; i < g->count; i++) {
        const double miss = is_open[i] * (s->sign * (total[i] - s->limit) - gap[i]);
        const double aim = aim_of(mean, part * second[i], is_open[i]);
        force[i] += s->sign * ((aim - push[i] * miss) / gap[i] - push[i]);
    }
}

WIDEST static void add_stiffness(const side *s, int count, double *restrict stiffness)
{
    for (int i = 0; i < count; i++) stiffness[i] += s->push[i] / s->gap[i];
}

/// The second order of a step to where μ = 0 would be; its sum. `fall`: the largest part by which a gap or a push falls.
WIDEST static double look_ahead(const guess *g, const side *s, double *fall)
{
    const double *restrict gap = s->gap, *restrict push = s->push, *restrict total = g->total,
                           *restrict move = g->move, *restrict is_open = g->is_open;
    double *restrict second = s->second;
    double most[LANES] = {0}, sum[LANES] = {0}, all = 0;
    for (int i = 0; i < g->count; i += LANES) {
        const int lanes = g->count - i < LANES ? g->count - i : LANES;
        for (int n = 0; n < lanes; n++) {
            const int k = i + n;
            const change c = change_of(s->sign, s->limit, gap[k], push[k], 0, total[k], move[k], is_open[k]);
            const double by = -c.gap > -c.push ? -c.gap : -c.push;
            second[k] = is_open[k] * (c.gap * c.push * gap[k] * push[k]);
            sum[n] += second[k];
            most[n] = by > most[n] ? by : most[n];
        }
    }
    for (int n = 0; n < LANES; n++) *fall = fmax(*fall, most[n]), all += sum[n];
    return all;
}

/// The largest part by which a gap or a push falls in the step itself.
WIDEST static double find_fall(const guess *g, const side *s, double mean)
{
    const double *restrict gap = s->gap, *restrict push = s->push, *restrict second = s->second,
                           *restrict total = g->total, *restrict move = g->move, *restrict is_open = g->is_open;
    double most[LANES] = {0}, all = 0;
    for (int i = 0; i < g->count; i += LANES) {
        const int lanes = g->count - i < LANES ? g->count - i : LANES;
        for (int n = 0; n < lanes; n++) {
            const int k = i + n;
            const double aim = aim_of(mean, second[k], is_open[k]);
            const change c = change_of(s->sign, s->limit, gap[k], push[k], aim, total[k], move[k], is_open[k]);
            const double by = -c.gap > -c.push ? -c.gap : -c.push;
            most[n] = by > most[n] ? by : most[n];
        }
    }
    for (int n = 0; n < LANES; n++) all = fmax(all, most[n]);
    return all;
}

/// Goes that part of a step; the sum of gap times push. `unclear` gets how many fall so alike that neither is there to stay.
WIDEST static double advance(const guess *g, const side *s, double mean, double way, double *unclear)
{
    double *restrict gap = s->gap, *restrict push = s->push, *restrict second = s->second;
    const double *restrict total = g->total, *restrict move = g->move, *restrict is_open = g->is_open;
    double sum[LANES] = {0}, alike[LANES] = {0}, all = 0;
    for (int i = 0; i < g->count; i += LANES) {
        const int lanes = g->count - i < LANES ? g->count - i : LANES;
        for (int n = 0; n < lanes; n++) {
            const int k = i + n;
            const double aim = aim_of(mean, second[k], is_open[k]);
            const change c = change_of(s->sign, s->limit, gap[k], push[k], aim, total[k], move[k], is_open[k]);
            const double of_gap = 1 + way * c.gap, of_push = 1 + way * c.push;
            gap[k] *= of_gap, push[k] *= of_push;
            second[k] = is_open[k] * (of_push - of_gap);
            sum[n] += is_open[k] * (gap[k] * push[k]);
            alike[n] += of_push < clear * of_gap && of_gap < clear * of_push ? is_open[k] : 0;
        }
    }
    for (int n = 0; n < LANES; n++) *unclear += alike[n], all += sum[n];
    return all;
}

static double *place(const guess *g, int i)
{
    return g->w->solver->rows.gradient + (g->w->solver->matrix.width * (g->from + i - g->w->first));
}

/// Newton's move for products of `mean`, with or without the second order.
static void solve(const guess *g, double mean, double part)
{
    const wiggly_solver *solver = g->w->solver;
    const pentadiagonal *m = &solver->matrix;
    for (int i = 0; i < g->count; i++) g->move[i] = g->lack_left * g->lack[i];
    for (int s = 0; s < g->sides; s++) add_force(g, &g->side[s], mean, part, g->move);
    memset(solver->rows.gradient, 0, sizeof(double) * (size_t)(m->width * m->count));
    for (int i = 0; i < g->count; i++) *place(g, i) = g->move[i] / g->soft;
    pentadiagonal_solve(m, solver->rows.gradient);
    for (int i = 0; i < g->count; i++) g->move[i] = *place(g, i);
}

static bool factor(const guess *g)
{
    pentadiagonal *m = &g->w->solver->matrix;
    const int stride = m->width == 2 ? 3 : 1;
    limits_set_matrix(g->w);
    memset(g->move, 0, sizeof *g->move * (size_t)g->count);
    for (int s = 0; s < g->sides; s++) add_stiffness(&g->side[s], g->count, g->move);
    for (int i = 0; i < g->count; i++) m->diagonal[stride * (g->from + i - g->w->first)] += g->move[i] / g->soft;
    return pentadiagonal_factor(m) != RANK_BROKEN;
}

/// One step; how many samples and limits it leaves unclear. false where numbers fail.
static bool go_on(guess *g, double *unclear)
{
    double fall = 1, ahead = 0, sum = 0;
    if (!factor(g)) return false;
    solve(g, 0, 0);
    for (int s = 0; s < g->sides; s++) ahead += look_ahead(g, &g->side[s], &fall);
    double way = 1 / fall;
    const double left = (1 - way) + way * way * ahead / (g->pairs * g->mean), aim = left * left * left * g->mean;
    solve(g, aim, 1);
    fall = short_of;
    for (int s = 0; s < g->sides; s++) fall = fmax(fall, find_fall(g, &g->side[s], aim));
    way = short_of / fall;
    *unclear = 0;
    for (int s = 0; s < g->sides; s++) sum += advance(g, &g->side[s], aim, way, unclear);
    for (int i = 0; i < g->count; i++) g->total[i] += way * g->move[i];
    g->lack_left *= 1 - way;
    g->mean = sum / g->pairs;
    return g->mean > 0 && g->mean < INFINITY;
}

/// Where it begins: every gap at least 1, every product of gap and push 1.
static void begin_side(guess *g, side *s)
{
    for (int i = 0; i < g->count; i++) {
        const bool is_open = g->is_open[i] > 0;
        s->gap[i] = is_open ? fmax(s->sign * (g->total[i] - s->limit), 1) : 1;
        s->push[i] = 1 / s->gap[i];
        if (is_open) g->lack[i] += s->sign * s->push[i];
    }
}

/// What a push of 1 does to a sample; 0 where that is not known.
static double find_soft(const guess *g, int sample)
{
    const wiggly_solver *solver = g->w->solver;
    limits_set_matrix(g->w);
    memset(solver->rows.gradient, 0, sizeof(double) * (size_t)(solver->matrix.width * solver->matrix.count));
    if (pentadiagonal_factor(&g->w->solver->matrix) == RANK_BROKEN) return 0;
    *place(g, sample) = 1;
    pentadiagonal_solve(&solver->matrix, solver->rows.gradient);
    return *place(g, sample);
}

/// Holds what the last step found.
static void hold_found(const guess *g)
{
    limits_work *w = g->w;
    for (int s = 0; s < g->sides; s++) {
        for (int i = 0; i < g->count; i++) {
            if (g->side[s].second[i] > 0) limits_take(w, g->from + i, g->side[s].sign < 0);
        }
    }
}

static guess guess_of(limits_work *w)
{
    const wiggly_solver *solver = w->solver;
    const limit_memory *m = &solver->limits;
    const wiggly_desc *desc = w->p->desc;
    const limits_part *first = w->body.to >= w->body.from ? &w->body : &w->tail;
    const size_t n = (size_t)solver->samples;
    double *jet = solver->rows.jet;
    guess g = {.w = w, .from = first->from, .lack_left = 1, .mean = 1};
    g.count = (limits_has_tail(w) ? w->tail.to : w->body.to) - g.from + 1;
    g.total = jet, g.move = jet + n, g.is_open = jet + 2 * n, g.lack = jet + 3 * n;
    if (desc->low > -INFINITY) g.side[g.sides++] = (side){1, desc->low, m->free[0], m->pushed[0], m->pull};
    if (desc->high < INFINITY) g.side[g.sides++] = (side){-1, desc->high, m->free[1], m->pushed[1], m->now};
    return g;
}

/// The farthest that a sample is beyond a limit, from `slack` on; at: which.
static double find_farthest(const guess *g, double slack, int *at)
{
    *at = -1;
    for (int s = 0; s < g->sides; s++) {
        for (int i = 0; i < g->count; i++) {
            const double by = g->is_open[i] * (g->side[s].sign * (g->side[s].limit - g->total[i]));
            if (by > slack) slack = by, *at = i;
        }
    }
    return slack;
}

void limits_guess(limits_work *w, double slack)
{
    guess g = guess_of(w);
    int farthest;
    for (int i = 0; i < g.count; i++) {
        g.is_open[i] = w->solver->limits.held[g.from + i] != LIMITS_KEYED;
        g.total[i] = limits_total(w, g.from + i);
        g.lack[i] = 0;
        g.pairs += g.sides * (g.is_open[i] > 0);
    }
    const double size = find_farthest(&g, slack, &farthest);
    if (farthest < 0) return;
    limits_set_system(w);
    g.soft = find_soft(&g, farthest);
    if (!(g.soft > 0)) return;
    for (int i = 0; i < g.count; i++) g.total[i] /= size;
    for (int s = 0; s < g.sides; s++) {
        g.side[s].limit /= size;
        begin_side(&g, &g.side[s]);
    }
    double unclear = 1;
    for (int step = 0; step < STEPS && unclear > 0 && g.mean > least_mean; step++) {
        if (!go_on(&g, &unclear)) return;
        if (g.lack_left > balanced) unclear = 1;
    }
    hold_found(&g);
}

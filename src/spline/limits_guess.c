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

static const double short_of = 0.995; ///< of the way to where a gap or a push is 0
static const double good = 0.2;       ///< a step that leaves so little of μ shows which of the two stays
static const double apart = 0.5;      ///< part of itself that the other one falls by more
static const double sure = 1e-3;      ///< of the first μ, of limits that are not narrow: from here on it is believed
static const double least = 1e-10;    ///< what does not show it by then has neither gap nor push
static const double balanced = 1e-3;  ///< part of what H d lacked at first

/// One limit at all samples. Lengths are parts of the farthest that a sample is beyond a limit, pushes of what moves that one as far. At
/// knots, which are not held, gap and push are 1 and stay so.
typedef struct side {
    double sign, limit; ///< sign: of a push
    double *gap, *push;
    double *by_gap;  ///< part of it that a step adds
    double *by_push; ///< the same; before that the product of what μ = 0 would add to both
} side;

typedef struct guess {
    limits_work *w;
    int from, count, sides; ///< samples that may be held, and knots between them
    side side[2];
    double *total, *move; ///< move: of a step
    double *is_open;      ///< 0 at knots, else 1
    double *lack;         ///< of H d at first
    double lack_left;     ///< part of that
    double soft;          ///< what a push of 1 does to the sample that is farthest beyond a limit
    int pairs;            ///< of gap and push
    double mean;          ///< of gap times push
    double narrow;        ///< how far the limits are apart, up to 1
    double way;           ///< part of the last step that was gone
} guess;

/// How gap and push of a sample change, as parts of them, where their product is to be `aim`.
typedef struct change {
    double gap, push;
} change;

static inline change change_of(const side *s, double gap, double push, double aim, double total, double move,
                               double is_open)
{
    const double miss = s->sign * (total - s->limit) - gap, part = (s->sign * move + is_open * miss) / gap;
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
    const double *restrict gap = s->gap, *restrict push = s->push, *restrict second = s->by_push,
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

/// The second order of a step to where μ = 0 would be, into `by_push`; its sum. `fall`: the largest part by which a gap or a push falls.
WIDEST static double look_ahead(const guess *g, const side *s, double *fall)
{
    const double *restrict gap = s->gap, *restrict push = s->push, *restrict total = g->total,
                           *restrict move = g->move, *restrict is_open = g->is_open;
    double *restrict second = s->by_push;
    double most[LANES] = {0}, sum[LANES] = {0}, all = 0;
    for (int i = 0; i < g->count; i += LANES) {
        const int lanes = g->count - i < LANES ? g->count - i : LANES;
        for (int n = 0; n < lanes; n++) {
            const int k = i + n;
            const change c = change_of(s, gap[k], push[k], 0, total[k], move[k], is_open[k]);
            const double by = -c.gap > -c.push ? -c.gap : -c.push;
            second[k] = is_open[k] * (c.gap * c.push * gap[k] * push[k]);
            sum[n] += second[k];
            most[n] = by > most[n] ? by : most[n];
        }
    }
    for (int n = 0; n < LANES; n++) *fall = fmax(*fall, most[n]), all += sum[n];
    return all;
}

/// The step itself, from the second order; the largest part by which a gap or a push falls.
WIDEST static double find_changes(const guess *g, const side *s, double mean)
{
    const double *restrict gap = s->gap, *restrict push = s->push, *restrict total = g->total,
                           *restrict move = g->move, *restrict is_open = g->is_open;
    double *restrict by_gap = s->by_gap, *restrict by_push = s->by_push;
    double most[LANES] = {0}, all = 0;
    for (int i = 0; i < g->count; i += LANES) {
        const int lanes = g->count - i < LANES ? g->count - i : LANES;
        for (int n = 0; n < lanes; n++) {
            const int k = i + n;
            const double aim = aim_of(mean, by_push[k], is_open[k]);
            const change c = change_of(s, gap[k], push[k], aim, total[k], move[k], is_open[k]);
            const double by = -c.gap > -c.push ? -c.gap : -c.push;
            most[n] = by > most[n] ? by : most[n];
            by_gap[k] = c.gap, by_push[k] = c.push;
        }
    }
    for (int n = 0; n < LANES; n++) all = fmax(all, most[n]);
    return all;
}

/// Goes that part of a step; the sum of gap times push. `unclear`: adds how many fall so alike that neither is there to stay.
WIDEST static double advance(const guess *g, const side *s, double way, double *unclear)
{
    const double *restrict by_gap = s->by_gap, *restrict by_push = s->by_push, *restrict is_open = g->is_open;
    double *restrict gap = s->gap, *restrict push = s->push;
    double sum[LANES] = {0}, alike[LANES] = {0}, all = 0;
    for (int i = 0; i < g->count; i += LANES) {
        const int lanes = g->count - i < LANES ? g->count - i : LANES;
        for (int n = 0; n < lanes; n++) {
            const int k = i + n;
            gap[k] += way * by_gap[k] * gap[k], push[k] += way * by_push[k] * push[k];
            sum[n] += is_open[k] * (gap[k] * push[k]);
            alike[n] += fabs(way * (by_push[k] - by_gap[k])) < apart ? is_open[k] : 0;
        }
    }
    for (int n = 0; n < LANES; n++) *unclear += alike[n], all += sum[n];
    return all;
}

static double *place(const guess *g, int i)
{
    return g->w->solver->rows.gradient + (g->w->solver->matrix.width * (g->from + i - g->w->first));
}

static void clear_right_side(const guess *g)
{
    const wiggly_solver *solver = g->w->solver;
    memset(solver->rows.gradient, 0, sizeof(double) * (size_t)(solver->matrix.width * solver->matrix.count));
}

/// Newton's move for products of `mean`, with or without the second order.
static void find_move(const guess *g, double mean, double part)
{
    for (int i = 0; i < g->count; i++) g->move[i] = g->lack_left * g->lack[i];
    for (int s = 0; s < g->sides; s++) add_force(g, &g->side[s], mean, part, g->move);
    clear_right_side(g);
    for (int i = 0; i < g->count; i++) *place(g, i) = g->move[i] / g->soft;
    pentadiagonal_solve(&g->w->solver->matrix, g->w->solver->rows.gradient);
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

/// Where it begins: every gap at least 1, every product of gap and push 1.
static void begin(guess *g)
{
    memset(g->lack, 0, sizeof *g->lack * (size_t)g->count);
    for (int n = 0; n < g->sides; n++) {
        const side *s = &g->side[n];
        for (int i = 0; i < g->count; i++) {
            const bool is_open = g->is_open[i] > 0;
            s->gap[i] = is_open ? fmax(s->sign * (g->total[i] - s->limit), 1) : 1;
            s->push[i] = 1 / s->gap[i];
            s->by_push[i] = 0;
            if (is_open) g->lack[i] += s->sign * s->push[i];
        }
    }
    g->lack_left = g->mean = 1;
}

/// One step; how many samples and limits it leaves unclear. false where numbers fail.
static bool go_on(guess *g, double *unclear)
{
    double fall = 1, ahead = 0, sum = 0;
    if (!factor(g)) return false;
    find_move(g, 0, 0);
    for (int s = 0; s < g->sides; s++) ahead += look_ahead(g, &g->side[s], &fall);
    const double left = (1 - 1 / fall) + ahead / (fall * fall) / (g->pairs * g->mean);
    const double aim = left * left * left * g->mean;
    find_move(g, aim, 1);
    fall = short_of;
    for (int s = 0; s < g->sides; s++) fall = fmax(fall, find_changes(g, &g->side[s], aim));
    g->way = short_of / fall;
    *unclear = 0;
    for (int s = 0; s < g->sides; s++) sum += advance(g, &g->side[s], g->way, unclear);
    for (int i = 0; i < g->count; i++) g->total[i] += g->way * g->move[i];
    g->lack_left *= 1 - g->way;
    g->mean = sum / g->pairs;
    return g->mean > 0 && g->mean < INFINITY;
}

/// Steps until one shows what stays. false where numbers fail.
static bool find_what_stays(guess *g)
{
    for (int step = 0; step < STEPS; step++) {
        const double before = g->mean;
        double unclear;
        if (!go_on(g, &unclear)) return false;
        const bool shows = g->mean < good * before && g->lack_left < balanced;
        if (shows && (g->mean < least * g->narrow || (unclear == 0 && g->mean < sure * g->narrow))) break;
    }
    return true;
}

static void hold_what_stays(const guess *g)
{
    for (int n = 0; n < g->sides; n++) {
        const side *s = &g->side[n];
        for (int i = 0; i < g->count; i++) {
            const int sample = g->from + i;
            const bool stays = g->way * (s->by_push[i] - s->by_gap[i]) > apart;
            if (stays && g->w->solver->limits.held[sample] == LIMITS_FREE) limits_take(g->w, sample, s->sign < 0);
        }
    }
}

/// The total in the solver's memory, and room there for the rest.
static guess guess_of(limits_work *w)
{
    const wiggly_solver *solver = w->solver;
    const limit_memory *m = &solver->limits;
    const wiggly_desc *desc = w->p->desc;
    const size_t n = (size_t)solver->samples;
    double *jet = solver->rows.jet, *x = solver->rows.x;
    guess g = {.w = w, .total = jet, .move = jet + n, .is_open = jet + 2 * n, .lack = jet + 3 * n};
    g.from = limits_has_body(w) ? w->body.from : w->tail.from;
    g.count = (limits_has_tail(w) ? w->tail.to : w->body.to) - g.from + 1;
    if (desc->low > -INFINITY) g.side[g.sides++] = (side){1, desc->low, m->free[0], m->pushed[0], m->pull, x};
    if (desc->high < INFINITY) g.side[g.sides++] = (side){-1, desc->high, m->free[1], m->pushed[1], m->now, x + n};
    for (int i = 0; i < g.count; i++) {
        g.total[i] = limits_total(w, g.from + i);
        g.is_open[i] = m->held[g.from + i] != LIMITS_KEYED;
        g.pairs += g.sides * (g.is_open[i] > 0);
    }
    return g;
}

/// The farthest that a sample is beyond a limit, from `slack` on; `at`: which one.
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

/// What a push of 1 does to a sample; 0 where nothing holds the spline.
static double find_soft(const guess *g, int sample)
{
    limits_set_matrix(g->w);
    if (pentadiagonal_factor(&g->w->solver->matrix) == RANK_BROKEN) return 0;
    clear_right_side(g);
    *place(g, sample) = 1;
    pentadiagonal_solve(&g->w->solver->matrix, g->w->solver->rows.gradient);
    return *place(g, sample);
}

void limits_guess(limits_work *w, double slack)
{
    const wiggly_desc *desc = w->p->desc;
    guess g = guess_of(w);
    int farthest;
    const double size = find_farthest(&g, slack, &farthest);
    if (farthest < 0) return;
    limits_set_system(w);
    g.soft = find_soft(&g, farthest);
    if (!(g.soft > 0)) return;
    for (int i = 0; i < g.count; i++) g.total[i] /= size;
    for (int s = 0; s < g.sides; s++) g.side[s].limit /= size;
    g.narrow = fmin(1, (desc->high - desc->low) / size);
    begin(&g);
    if (find_what_stays(&g)) hold_what_stays(&g);
}

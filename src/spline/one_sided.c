/// A primal-dual interior-point method (Mehrotra's predictor and corrector).
//
// Values x move by d under pushes, S⁻¹ d = Σ ± q. For each value and limit let g be the gap, the distance of x inside the limit, and q the
// limit's push. Then
//
//     S⁻¹ d = Σ ± q,      g = ± (x + d − limit),      g q = μ,      g, q > 0,
//
// for a μ that goes from large to almost 0. Each step is Newton's: S⁻¹ + Σ q/g on the diagonal is factored once and solved twice, first with
// μ = 0 and then for the step itself, with the second-order term that the first solve gives. About six steps, however many values are held,
// show which are: in the last step their gaps vanish, and the pushes on all others.
//
// These are then solved as equalities. If a push turns out to be a pull, or a free value exceeds a limit, the steps stopped too early, and
// everything is repeated to a smaller μ. So it ends with the answer, or with the certainty that it has none.
#include "spline/one_sided.h"
#include "spline/wide.h"
#include <math.h>
#include <string.h>

enum { STEPS = 100, LANES = 8, ATTEMPTS = 4 };

static const double short_of = 0.995; ///< share of the way to a zero gap or push
static const double at_first = 10; ///< first products, relative to the farthest excess and the push that moves as far
static const double tiny_step = 0.1; ///< the next step only evens out the products, without second order
static const double together = 0.3;  ///< then μ falls no lower
static const double good = 0.2;    ///< a step that leaves this share of μ or less shows which of gap and push stays
static const double apart = 0.5;   ///< difference in relative fall of gap and push that decides
static const double sure = 1e-4;   ///< share of the first μ at which this is trusted, if limits are not narrow
static const double surer = 1e-4;  ///< factor of that at the next attempt
static const double least = 1e-10; ///< undecided at this share: neither gap nor push
static const double balanced = 1e-3; ///< share of the initial error in S⁻¹ d

/// The relative change of a value's gap and push when their product is to become `aim`. Lengths are relative to the farthest excess over a
/// limit, pushes to the push that moves that value as far.
typedef struct change {
    double gap, push;
} change;

static inline change change_of(const one_sided_limit *s, double gap, double push, double aim, double value,
                               double move, double is_open)
{
    const double miss = s->sign * (value - s->at) - gap, part = (s->sign * move + is_open * miss) / gap;
    return (change){part, aim / (gap * push) - 1 - part};
}

/// The target of gap times push: μ minus the second order; 1 if there is no limit.
static inline double aim_of(double mean, double second, double is_open)
{
    return is_open * (mean - second) + (1 - is_open);
}

/// Adds a limit's part to Newton's right-hand side, with or without the second order.
WIDEST static void add_force(const one_sided *o, const one_sided_limit *s, double mean, double part,
                             double *restrict force)
{
    const double *restrict gap = s->gap, *restrict push = s->push, *restrict second = s->by_push,
                           *restrict value = o->value, *restrict is_open = o->is_open;
    for (int i = 0; i < o->count; i++) {
        const double miss = is_open[i] * (s->sign * (value[i] - s->at) - gap[i]);
        const double aim = aim_of(mean, part * second[i], is_open[i]);
        force[i] += s->sign * ((aim - push[i] * miss) / gap[i] - push[i]);
    }
}

WIDEST static void add_stiffness(const one_sided_limit *s, int count, double *restrict stiffness)
{
    for (int i = 0; i < count; i++) stiffness[i] += s->push[i] / s->gap[i];
}

WIDEST static void scale(double *restrict x, int count, double by)
{
    for (int i = 0; i < count; i++) x[i] *= by;
}

/// Writes the second order of a step towards μ = 0 to `by_push` and returns its sum. `fall`: the largest relative fall of a gap or push.
WIDEST static double look_ahead(const one_sided *o, const one_sided_limit *s, double *fall)
{
    const double *restrict gap = s->gap, *restrict push = s->push, *restrict value = o->value,
                           *restrict move = o->move, *restrict is_open = o->is_open;
    double *restrict second = s->by_push;
    double most[LANES] = {0}, sum[LANES] = {0}, all = 0;
    for (int i = 0; i < o->count; i += LANES) {
        const int lanes = o->count - i < LANES ? o->count - i : LANES;
        for (int n = 0; n < lanes; n++) {
            const int k = i + n;
            const change c = change_of(s, gap[k], push[k], 0, value[k], move[k], is_open[k]);
            const double by = -c.gap > -c.push ? -c.gap : -c.push;
            second[k] = is_open[k] * (c.gap * c.push * gap[k] * push[k]);
            sum[n] += second[k];
            most[n] = by > most[n] ? by : most[n];
        }
    }
    for (int n = 0; n < LANES; n++) *fall = fmax(*fall, most[n]), all += sum[n];
    return all;
}

/// Computes the step; returns the largest relative fall of a gap or push.
WIDEST static double find_changes(const one_sided *o, const one_sided_limit *s, double mean, double part)
{
    const double *restrict gap = s->gap, *restrict push = s->push, *restrict value = o->value,
                           *restrict move = o->move, *restrict is_open = o->is_open;
    double *restrict by_gap = s->by_gap, *restrict by_push = s->by_push;
    double most[LANES] = {0}, all = 0;
    for (int i = 0; i < o->count; i += LANES) {
        const int lanes = o->count - i < LANES ? o->count - i : LANES;
        for (int n = 0; n < lanes; n++) {
            const int k = i + n;
            const double aim = aim_of(mean, part * by_push[k], is_open[k]);
            const change c = change_of(s, gap[k], push[k], aim, value[k], move[k], is_open[k]);
            const double by = -c.gap > -c.push ? -c.gap : -c.push;
            most[n] = by > most[n] ? by : most[n];
            by_gap[k] = c.gap, by_push[k] = c.push;
        }
    }
    for (int n = 0; n < LANES; n++) all = fmax(all, most[n]);
    return all;
}

/// Takes that share of a step; returns Σ gap · push. `unclear`: adds the pairs whose gap and push fall too similarly to decide.
WIDEST static double advance(const one_sided *o, const one_sided_limit *s, double way, double *unclear)
{
    const double *restrict by_gap = s->by_gap, *restrict by_push = s->by_push, *restrict is_open = o->is_open;
    double *restrict gap = s->gap, *restrict push = s->push;
    double sum[LANES] = {0}, alike[LANES] = {0}, all = 0;
    for (int i = 0; i < o->count; i += LANES) {
        const int lanes = o->count - i < LANES ? o->count - i : LANES;
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

/// Newton's step for products of `mean`, with or without the second order.
static void find_move(one_sided *o, double mean, double part)
{
    for (int i = 0; i < o->count; i++) o->move[i] = o->lack_left * o->lack[i];
    for (int s = 0; s < o->limits; s++) add_force(o, &o->limit[s], mean, part, o->move);
    scale(o->move, o->count, 1 / o->soft);
    o->solve(o->user, o->move);
}

static bool factor(one_sided *o)
{
    memset(o->move, 0, sizeof *o->move * (size_t)o->count);
    for (int s = 0; s < o->limits; s++) add_stiffness(&o->limit[s], o->count, o->move);
    scale(o->move, o->count, 1 / o->soft);
    return o->factor(o->user, o->move);
}

/// One step. `unclear` receives the number of undecided values and limits. False if numbers overflow.
static bool go_on(one_sided *o, double *unclear)
{
    const bool bold = o->way > tiny_step || !o->bold;
    o->bold = bold;
    double fall = 1, ahead = 0, sum = 0;
    if (!factor(o)) return false;
    find_move(o, 0, 0);
    for (int s = 0; s < o->limits; s++) ahead += look_ahead(o, &o->limit[s], &fall);
    const double left = (1 - 1 / fall) + ahead / (fall * fall) / (o->pairs * o->mean), left3 = left * left * left;
    const double aim = (bold ? left3 : fmax(left3, together)) * o->mean;
    find_move(o, aim, bold);
    fall = short_of;
    for (int s = 0; s < o->limits; s++) fall = fmax(fall, find_changes(o, &o->limit[s], aim, bold));
    o->way = short_of / fall;
    *unclear = 0;
    for (int s = 0; s < o->limits; s++) sum += advance(o, &o->limit[s], o->way, unclear);
    for (int i = 0; i < o->count; i++) o->value[i] += o->way * o->move[i];
    o->lack_left *= 1 - o->way;
    o->mean = sum / o->pairs;
    return o->mean > 0 && o->mean < INFINITY;
}

/// Takes steps until it is clear which gaps and pushes stay. False if numbers overflow.
static bool find_what_stays(one_sided *o, double until)
{
    for (int step = 0; step < STEPS; step++) {
        const double before = o->mean;
        double unclear;
        if (!go_on(o, &unclear)) return false;
        const bool shows = o->mean < good * before && o->lack_left < balanced;
        if (shows && (o->mean < fmin(least, until) * o->narrow || (unclear == 0 && o->mean < until * o->narrow)))
            break;
    }
    return true;
}

/// The value farthest beyond a limit, by more than `slack`; -1: none.
static int find_farthest(const one_sided *o, double slack, double *by)
{
    int at = -1;
    *by = slack;
    for (int s = 0; s < o->limits; s++) {
        for (int i = 0; i < o->count; i++) {
            const double beyond = o->is_open[i] * (o->limit[s].sign * (o->limit[s].at - o->value[i]));
            if (beyond > *by) *by = beyond, at = i;
        }
    }
    return at;
}

/// How far a force of 1 moves a value; it is held slightly if there is no factor otherwise. 0 if there is none then, either.
static double find_soft(one_sided *o, int at)
{
    memset(o->move, 0, sizeof *o->move * (size_t)o->count);
    for (double held = 1e-14; !o->factor(o->user, o->move); held *= 100) {
        if (held > 1) return 0;
        for (int i = 0; i < o->count; i++) o->move[i] = held;
    }
    memset(o->move, 0, sizeof *o->move * (size_t)o->count);
    o->move[at] = 1;
    o->solve(o->user, o->move);
    return o->move[at];
}

/// Starts with lengths in units of `size` and every gap at least 1.
static void start(one_sided *o, double size)
{
    o->pairs = 0;
    for (int i = 0; i < o->count; i++) o->value[i] /= size, o->pairs += o->limits * (o->is_open[i] > 0);
    o->narrow = o->limits < 2 ? 1 : fmin(1, fabs(o->limit[1].at - o->limit[0].at) / size);
    memset(o->lack, 0, sizeof *o->lack * (size_t)o->count);
    for (int n = 0; n < o->limits; n++) {
        one_sided_limit *s = &o->limit[n];
        s->at /= size;
        for (int i = 0; i < o->count; i++) {
            const bool is_open = o->is_open[i] > 0;
            s->gap[i] = is_open ? fmax(s->sign * (o->value[i] - s->at), 1) : 1;
            s->push[i] = is_open ? at_first / s->gap[i] : 1;
            s->by_push[i] = 0;
            if (is_open) o->lack[i] += s->sign * s->push[i];
        }
    }
    o->bold = true;
    o->lack_left = o->way = 1;
    o->mean = at_first;
}

double one_sided_holds(const one_sided *o, int i)
{
    double sign = 0;
    for (int n = 0; n < o->limits && o->is_open[i] > 0; n++) {
        const one_sided_limit *s = &o->limit[n];
        if (o->way * (s->by_push[i] - s->by_gap[i]) > apart && sign == 0) sign = s->sign;
    }
    return sign;
}

bool one_sided_solve(one_sided *o, double slack)
{
    double until = sure, size;
    for (int n = 0; n < ATTEMPTS; n++, until *= surer) {
        if (!o->begin(o->user)) return false;
        const int farthest = find_farthest(o, slack, &size);
        if (farthest < 0) return true;
        o->soft = find_soft(o, farthest);
        if (!(o->soft > 0)) return false;
        start(o, size);
        if (!find_what_stays(o, until)) return false;
        if (o->finish(o->user)) return true;
    }
    return false;
}

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
#include "maths/maths.h"
#include "maths/wide.h"
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

/// The target of gap times push: μ minus the second order; 1 if there is no limit.
static inline double aim_of(double mean, double second, double is_open)
{
    return is_open * (mean - second) + (1 - is_open);
}

/// S⁻¹ + Σ q/g.
WIDEST static bool factor(const one_sided *o)
{
    double *restrict stiffness = o->move;
    for (int i = 0; i < o->count; i++) stiffness[i] = 0;
    for (int n = 0; n < o->limits; n++) {
        const double *restrict gap = o->limit[n].gap, *restrict push = o->limit[n].push;
        for (int i = 0; i < o->count; i++) stiffness[i] += push[i] / gap[i];
    }
    for (int i = 0; i < o->count; i++) stiffness[i] *= 1 / o->soft;
    return o->factor(o->user, stiffness);
}

/// Newton's step for products of `mean`, less `part` of the second order.
WIDEST static void find_move(const one_sided *o, double mean, double part)
{
    const double *restrict value = o->value, *restrict is_open = o->is_open;
    double *restrict force = o->move;
    for (int i = 0; i < o->count; i++) force[i] = o->lack_left * o->lack[i];
    for (int n = 0; n < o->limits; n++) {
        const one_sided_limit *s = &o->limit[n];
        const double *restrict gap = s->gap, *restrict push = s->push, *restrict second = s->by_push;
        for (int i = 0; i < o->count; i++) {
            const double miss = is_open[i] * (s->sign * (value[i] - s->at) - gap[i]);
            const double aim = aim_of(mean, part * second[i], is_open[i]);
            force[i] += s->sign * ((aim - push[i] * miss) / gap[i] - push[i]);
        }
    }
    for (int i = 0; i < o->count; i++) force[i] *= 1 / o->soft;
    o->solve(o->user, force);
}

/// The relative changes of a limit's gaps and pushes in that step, with lengths relative to the farthest excess over a limit, and pushes to the
/// push that moves that value as far. Returns the largest fall.
WIDEST static double find_changes(const one_sided *o, const one_sided_limit *s, double mean, double part)
{
    const double *restrict gap = s->gap, *restrict push = s->push, *restrict value = o->value,
                           *restrict move = o->move, *restrict is_open = o->is_open;
    double *restrict by_gap = s->by_gap, *restrict by_push = s->by_push;
    const double sign = s->sign, at = s->at;
    for (int i = 0; i < o->count; i++) {
        const double miss = sign * (value[i] - at) - gap[i];
        by_gap[i] = (sign * move[i] + is_open[i] * miss) / gap[i];
    }
    for (int i = 0; i < o->count; i++) {
        const double aim = aim_of(mean, part * by_push[i], is_open[i]);
        by_push[i] = aim / (gap[i] * push[i]) - 1 - by_gap[i];
    }
    double most[LANES] = {0}, all = 0;
    for (int i = 0; i < o->count; i += LANES) {
        const int lanes = o->count - i < LANES ? o->count - i : LANES;
        for (int n = 0; n < lanes; n++) {
            const double by = by_gap[i + n] < by_push[i + n] ? by_gap[i + n] : by_push[i + n];
            most[n] = -by > most[n] ? -by : most[n];
        }
    }
    for (int n = 0; n < LANES; n++) all = fmax(all, most[n]);
    return all;
}

/// Replaces the changes of pushes by the second order of the step, and returns its sum.
WIDEST static double find_second(const one_sided *o, const one_sided_limit *s)
{
    const double *restrict gap = s->gap, *restrict push = s->push, *restrict by_gap = s->by_gap,
                           *restrict is_open = o->is_open;
    double *restrict second = s->by_push;
    for (int i = 0; i < o->count; i++) second[i] = is_open[i] * (by_gap[i] * second[i] * gap[i] * push[i]);
    return maths_dot(second, is_open, o->count);
}

/// Takes a share of the step; returns Σ gap · push.
WIDEST static double advance(const one_sided *o, const one_sided_limit *s)
{
    const double *restrict by_gap = s->by_gap, *restrict by_push = s->by_push, *restrict is_open = o->is_open;
    double *restrict gap = s->gap, *restrict push = s->push, *restrict product = o->move; // the move is done
    const double way = o->way;
    for (int i = 0; i < o->count; i++) {
        gap[i] += way * by_gap[i] * gap[i], push[i] += way * by_push[i] * push[i];
        product[i] = is_open[i] * gap[i];
    }
    return maths_dot(product, push, o->count);
}

/// Whether no gap and push fell too similarly to decide which of them stays.
static bool is_clear(const one_sided *o)
{
    for (int n = 0; n < o->limits; n++) {
        const one_sided_limit *s = &o->limit[n];
        for (int i = 0; i < o->count; i++) {
            if (o->is_open[i] > 0 && fabs(o->way * (s->by_push[i] - s->by_gap[i])) < apart) return false;
        }
    }
    return true;
}

/// One step. False if numbers overflow.
static bool go_on(one_sided *o)
{
    const bool bold = o->way > tiny_step || !o->bold;
    o->bold = bold;
    double fall = 1, ahead = 0, sum = 0;
    if (!factor(o)) return false;
    find_move(o, 0, 0);
    for (int s = 0; s < o->limits; s++) {
        fall = fmax(fall, find_changes(o, &o->limit[s], 0, 0));
        ahead += find_second(o, &o->limit[s]);
    }
    const double left = (1 - 1 / fall) + ahead / (fall * fall) / (o->pairs * o->mean), left3 = left * left * left;
    const double aim = (bold ? left3 : fmax(left3, together)) * o->mean;
    find_move(o, aim, bold);
    fall = short_of;
    for (int s = 0; s < o->limits; s++) fall = fmax(fall, find_changes(o, &o->limit[s], aim, bold));
    o->way = short_of / fall;
    for (int i = 0; i < o->count; i++) o->value[i] += o->way * o->move[i];
    for (int s = 0; s < o->limits; s++) sum += advance(o, &o->limit[s]);
    o->lack_left *= 1 - o->way;
    o->mean = sum / o->pairs;
    return o->mean > 0 && o->mean < INFINITY;
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

double one_sided_holds(const one_sided *o, int i)
{
    double sign = 0;
    for (int n = 0; n < o->limits && o->is_open[i] > 0; n++) {
        const one_sided_limit *s = &o->limit[n];
        if (o->way * (s->by_push[i] - s->by_gap[i]) > apart && sign == 0) sign = s->sign;
    }
    return sign;
}

/// Takes steps until it is clear which gaps and pushes stay, with lengths in units of `size` and every gap at least 1 at first. False if numbers
/// overflow.
static bool find_what_stays(one_sided *o, double size, double until)
{
    o->pairs = 0;
    for (int i = 0; i < o->count; i++) o->value[i] /= size, o->pairs += o->limits * (o->is_open[i] > 0);
    const double narrow = o->limits < 2 ? 1 : fmin(1, fabs(o->limit[1].at - o->limit[0].at) / size);
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
    for (int step = 0; step < STEPS; step++) {
        const double before = o->mean;
        if (!go_on(o)) return false;
        const bool shows = o->mean < good * before && o->lack_left < balanced;
        if (shows && (o->mean < fmin(least, until) * narrow || (o->mean < until * narrow && is_clear(o)))) break;
    }
    return true;
}

bool one_sided_solve(one_sided *o, double slack)
{
    double until = sure, size;
    for (int n = 0; n < ATTEMPTS; n++, until *= surer) {
        if (!o->begin(o->user)) return false;
        const int farthest = find_farthest(o, slack, &size);
        if (farthest < 0) return true;
        o->soft = find_soft(o, farthest);
        if (!(o->soft > 0) || !find_what_stays(o, size, until)) return false;
        if (o->finish(o->user)) return true;
    }
    return false;
}

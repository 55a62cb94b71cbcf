/// Finds which samples of a limited spline are held at a limit, and the curve with them held.
//
// An interior-point method finds them (one_sided.c), on the band's matrix with the motion after the last knot (limits_system.c). They are
// then solved as additional knots (limits_solve.c); the multipliers are the gradient at the held samples. Each solve starts from the
// description alone, so the same samples are held and the curve has the same bits, whatever was solved before.
#include "spline/limits.h"
#include <math.h>
#include <string.h>

enum { EXCHANGES = 6 };

static const double beyond = 1e-10; ///< share of the total's size by which a sample may miss a limit
static const double rounded = 1e-5; ///< share of that which is rounding
static const double faint = 1e-3;   ///< share of the strongest pull; weaker ones are ignored
static const double reach = 10;     ///< how many times its excess the curve may be off

int limits_begin(wiggly_solver *solver, problem *p, wiggly_desc *ordered, const wiggly_curve *curve,
                 wiggly_curve *all)
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
    if (!curve->re) all->re = m->re;
    if (!curve->im) all->im = m->im;
    return -1;
}

/// The part up to the last knot, or to the end if nothing moves freely after it.
static limits_part body_of(const problem *p)
{
    const bool oscillates = problem_oscillates(p);
    limits_part body = {.to = p->settles ? p->latest : p->first + p->count - 1, .from = p->first};
    if (p->start == WIGGLY_REST) body.from += oscillates ? 1 : 2;
    bool moves = p->desc->knot_count > 0 || p->start == WIGGLY_LOOP || (p->start == WIGGLY_REST && !oscillates);
    if (p->count < 3 || !moves) body.to = -1;
    return body;
}

/// The part that moves freely, if it swings.
static limits_part tail_of(const problem *p)
{
    const wiggly_desc *desc = p->desc;
    const bool alone = desc->knot_count == 0 && problem_oscillates(p) && p->start != WIGGLY_LOOP;
    limits_part tail = {.begin = alone ? 0 : p->latest, .to = desc->samples - 1};
    tail.from = tail.begin + 1;
    if (desc->mode == WIGGLY_CUBIC || !(alone || p->settles)) tail.to = -1;
    tail.desc = *desc;
    tail.desc.mode = WIGGLY_REAL;
    tail.desc.start = WIGGLY_FREE;
    tail.desc.calm = 0;
    tail.desc.samples = desc->samples - tail.begin;
    tail.desc.low = -INFINITY, tail.desc.high = INFINITY;
    tail.desc.equilibrium = (wiggly_param){0};
    tail.desc.variation = 0;
    wiggly_param *const tracks[] = {&tail.desc.frequency, &tail.desc.damping};
    for (int i = 0; i < 2; i++) {
        if (tracks[i]->track) tracks[i]->track += tail.begin;
    }
    return tail;
}

static void hold_nothing(limits_work *w)
{
    const problem *p = w->p;
    limit_memory *m = &w->solver->limits;
    memset(m->held, LIMITS_FREE, (size_t)p->desc->samples);
    for (int k = 0; k < p->desc->knot_count; k++) m->held[m->own[k].sample] = LIMITS_KEYED;
    w->body.held = w->tail.held = 0;
}

/// How far a sample may miss a limit.
static double find_slack(const limits_work *w)
{
    const limits_part *parts[] = {&w->body, &w->tail};
    double most = 0;
    for (int n = 0; n < 2; n++) {
        for (int i = parts[n]->from; i <= parts[n]->to; i++) most = fmax(most, fabs(limits_total(w, i)));
    }
    return beyond * most;
}

/// The largest excess of a free sample.
static double find_excess(const limits_work *w)
{
    const limits_part *parts[] = {&w->body, &w->tail};
    double most = 0;
    for (int n = 0; n < 2; n++) {
        for (int i = parts[n]->from; i <= parts[n]->to; i++)
            most = fmax(most, limits_hold(w, i) ? 0 : fabs(limits_excess(w, i, 0)));
    }
    return most;
}

static bool begin(void *user)
{
    limits_work *w = user;
    const bool again = w->attempts++ > 0;
    hold_nothing(w);
    if (again && !limits_solve(w)) return false;
    limits_measure(w);
    return true;
}

/// How strongly a held sample is pulled to the limit instead of pushed.
static double pull_of(const limits_work *w, int sample)
{
    return limits_hold(w, sample) ? fmax(0, -w->solver->limits.held[sample] * w->solver->limits.pull[sample]) : 0;
}

/// Frees samples that are pulled, and holds the farthest sample of each stretch beyond a limit.
static void exchange(limits_work *w, double slack)
{
    const limits_part *parts[] = {&w->body, &w->tail};
    signed char *held = w->solver->limits.held;
    double hardest = 0;
    for (int i = 0; i < w->p->desc->samples; i++) hardest = fmax(hardest, pull_of(w, i));
    for (int n = 0; n < 2; n++) {
        for (int i = parts[n]->from; i <= parts[n]->to; i++) {
            const double by = held[i] == LIMITS_FREE ? limits_excess(w, i, slack) : 0, sign = by > 0 ? 1 : -1;
            if (pull_of(w, i) > faint * hardest) {
                held[i] = LIMITS_FREE;
                limits_part_of(w, i)->held--;
            }
            if (by == 0 || (i > parts[n]->from && sign * limits_excess(w, i - 1, 0) > fabs(by)) ||
                (i < parts[n]->to && sign * limits_excess(w, i + 1, 0) >= fabs(by)))
                continue;
            limits_take(w, i, by > 0);
        }
    }
}

/// In a loop held by nothing else, one sample, the farthest, may be enough.
static bool rests_on_one(limits_work *w)
{
    double slack = find_slack(w), most = slack;
    int at = -1;
    for (int i = w->body.from; i <= w->body.to; i++) {
        const double by = fabs(limits_excess(w, i, 0));
        if (by > most) most = by, at = i;
    }
    if (at < 0 || problem_is_asked(w->p)) return false;
    limits_take(w, at, limits_excess(w, at, 0) > 0);
    w->attempts++; // held samples have to be freed
    return limits_solve(w) && find_excess(w) <= slack && limits_release(w) <= slack;
}

/// Solves with the samples that the search holds. This is right if no sample exceeds a limit and no limit pulls. If it is nearly right, a few
/// exchanges correct it.
static bool finish(void *user)
{
    limits_work *w = user;
    for (int i = 0; i < w->search.count; i++) {
        const double sign = one_sided_holds(&w->search, i);
        if (sign != 0) limits_take(w, w->from + i, sign < 0);
    }
    for (int n = 0;; n++) {
        w->has_room = limits_solve(w);
        if (!w->has_room) return true;
        const double slack = find_slack(w);
        w->missed = fmax(find_excess(w), limits_release(w));
        const bool is_right = w->missed <= slack;
        if (is_right && (n == EXCHANGES || limits_catch(w, rounded * slack) <= slack)) return true;
        if (n == EXCHANGES) return false;
        exchange(w, is_right ? rounded * slack : slack);
    }
}

wiggly_status limits_find(wiggly_solver *solver, problem *p, wiggly_curve *curve, minimum *result)
{
    limits_work w = {.solver = solver, .p = p, .curve = curve, .result = result, .has_room = true};
    solver->limits.solves = 0;
    w.status = problem_find(solver, p, curve, result);
    if (w.status == WIGGLY_SINGULAR) return w.status;
    w.body = body_of(p);
    w.tail = tail_of(p);
    limits_set_search(&w);
    w.search.begin = begin, w.search.finish = finish;
    hold_nothing(&w);
    const bool found = rests_on_one(&w) || one_sided_solve(&w.search, find_slack(&w));
    if (!w.has_room) return WIGGLY_ERROR_CAPACITY;
    if (found) result->error += 2 * limits_catch(&w, rounded * find_slack(&w));
    if (!found) result->error += reach * fmax(w.missed, find_excess(&w));
    return w.status;
}

static void clamp(const limits_part *part, const wiggly_desc *desc, const signed char *held, double *total)
{
    for (int i = part->from; i <= part->to; i++) {
        if (held[i] == LIMITS_LOW || total[i] < desc->low) total[i] = desc->low;
        if (held[i] == LIMITS_HIGH || total[i] > desc->high) total[i] = desc->high;
    }
}

void limits_clamp(const wiggly_solver *solver, const problem *p, wiggly_curve *curve)
{
    const limits_part body = body_of(p), tail = tail_of(p);
    clamp(&body, p->desc, solver->limits.held, curve->total);
    clamp(&tail, p->desc, solver->limits.held, curve->total);
    if (p->start == WIGGLY_LOOP) curve->total[p->count] = curve->total[0];
}

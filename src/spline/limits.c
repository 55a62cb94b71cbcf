/// Which samples of a limited spline are held at a limit: an active set.
//
// The dual method of Goldfarb and Idnani: hold the sample that is farthest beyond a limit, and on the way there let go whatever its limit
// would have to pull and not push, the first one first. Between two sets of held samples everything is linear, so that a solve of
// each is all that it takes. E grows with every sample that is taken in, so no set comes twice and the method ends.
//
// It takes as many solves as samples are held, and a few; so a guess comes first (limits_guess.c), which is nearly always right. What
// of it would have to be pulled is let go, and the dual method goes on from there.
//
// Every solve starts from nothing but the description: the same samples are held, and the curve has the same bits, however one came
// to it.
#include "spline/limits.h"
#include <math.h>
#include <string.h>

enum { MOST = 1000 }; ///< solves

static const double beyond = 1e-10;   ///< of the size of the total: what a sample may miss a limit by
static const double faintest = 1e-12; ///< of the size of w: a pull that may be rounding

void limits_begin(wiggly_solver *solver, problem *p, wiggly_desc *ordered, const wiggly_curve *curve,
                  wiggly_curve *all)
{
    limit_memory *m = &solver->limits;
    for (int k = 0; k < p->desc->knot_count; k++) m->own[k] = p->desc->knots[solver->order[k]];
    for (int k = 0; k < p->desc->knot_count; k++) solver->order[k] = k;
    *ordered = *p->desc;
    ordered->knots = m->own;
    p->desc = ordered;
    if (!curve->re) all->re = m->re;
    if (!curve->im) all->im = m->im;
}

/// Up to the last knot, or to the end where nothing moves by itself behind it.
static limits_part body_of(const problem *p)
{
    const bool oscillates = problem_oscillates(p);
    limits_part body = {.to = p->settles ? p->latest : p->first + p->count - 1, .from = p->first};
    if (p->start == WIGGLY_REST) body.from += oscillates ? 1 : 2;
    bool moves = p->desc->knot_count > 0 || p->start == WIGGLY_LOOP || (p->start == WIGGLY_REST && !oscillates);
    if (p->count < 3 || !moves) body.to = -1;
    return body;
}

/// What moves by itself and swings.
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

/// Largest |w| and |total| of a part.
static void measure(const limits_work *w, const limits_part *part, double *of_w, double *of_total)
{
    for (int i = part->from; i <= part->to; i++) {
        *of_w = fmax(*of_w, fabs(w->curve->re[i]));
        *of_total = fmax(*of_total, fabs(limits_total(w, i)));
    }
}

/// How far a sample is beyond a limit, above the high one (positive) or below the low one; 0: within.
static double excess(const limits_work *w, int sample, double slack)
{
    const wiggly_desc *desc = w->p->desc;
    double total = limits_total(w, sample);
    return total > desc->high + slack ? total - desc->high : total < desc->low - slack ? total - desc->low : 0;
}

static void let_go(limits_work *w, int sample)
{
    w->solver->limits.held[sample] = LIMITS_FREE;
    limits_part_of(w, sample)->held--;
}

/// How hard a limit pushes a sample away; negative: it would have to pull.
static double push_of(const limits_work *w, int sample, double pull) { return w->solver->limits.held[sample] * pull; }

/// Lets go what limits pull. true where there was any.
static bool relax(limits_work *w, double noise)
{
    bool any = false;
    for (int i = 0; i < w->p->desc->samples; i++) {
        if (!limits_hold(w, i) || push_of(w, i, w->solver->limits.pull[i]) >= -noise) continue;
        let_go(w, i);
        any = true;
    }
    return any;
}

/// The sample that is farthest beyond a limit, -1: none.
static int find_farthest(const limits_work *w, double slack)
{
    double worst = 0;
    int at = -1;
    const limits_part *parts[] = {&w->body, &w->tail};
    for (int n = 0; n < 2; n++) {
        for (int i = parts[n]->from; i <= parts[n]->to; i++) {
            double by = limits_hold(w, i) ? 0 : fabs(excess(w, i, slack));
            if (by > worst) worst = by, at = i;
        }
    }
    return at;
}

/// The held sample that would have to be pulled first on the way from the pulls `now` to those just found, and how far that is.
static int find_blocking(const limits_work *w, const double *now, double noise, double *way)
{
    int at = -1;
    *way = 1;
    for (int i = 0; i < w->p->desc->samples; i++) {
        if (!limits_hold(w, i)) continue;
        double from = fmax(push_of(w, i, now[i]), 0), to = push_of(w, i, w->solver->limits.pull[i]);
        if (!(to < -noise) || !(from / (from - to) < *way)) continue;
        *way = from / (from - to);
        at = i;
    }
    return at;
}

/// Takes in one sample: false where there is no room.
static bool take_in(limits_work *w, int sample, double noise)
{
    const limit_memory *m = &w->solver->limits;
    double *now = m->now;
    now[sample] = 0;
    limits_take(w, sample, excess(w, sample, 0) > 0);
    for (;;) {
        if (!limits_solve(w)) return false;
        double way;
        int blocking = find_blocking(w, now, noise, &way);
        for (int i = 0; i < w->p->desc->samples; i++) {
            if (limits_hold(w, i)) now[i] += way * (m->pull[i] - now[i]);
        }
        if (blocking < 0 || blocking == sample) return true;
        let_go(w, blocking);
    }
}

static void hold_nothing(limits_work *w)
{
    const problem *p = w->p;
    limit_memory *m = &w->solver->limits;
    memset(m->held, LIMITS_FREE, (size_t)p->desc->samples);
    for (int k = 0; k < p->desc->knot_count; k++) m->held[m->own[k].sample] = LIMITS_KEYED;
    w->body.held = w->tail.held = 0;
}

static void measure_work(limits_work *w, double *slack, double *noise)
{
    double of_w = 0, of_total = 0;
    measure(w, &w->body, &of_w, &of_total);
    measure(w, &w->tail, &of_w, &of_total);
    *slack = beyond * of_total;
    *noise = faintest * of_w;
}

/// How a search for the samples to hold went.
enum outcome { FOUND, TIRED, NO_ROOM };

/// The dual method, from where no limit pulls and all is solved.
static enum outcome climb(limits_work *w)
{
    double slack, noise;
    for (;;) {
        measure_work(w, &slack, &noise);
        int sample = find_farthest(w, slack);
        if (sample < 0) return FOUND;
        if (w->solver->limits.solves >= MOST) return TIRED;
        if (!take_in(w, sample, noise)) return NO_ROOM;
    }
}

/// Lets go until nothing has to be pulled: the dual method can go on from there.
static bool settle(limits_work *w)
{
    const limit_memory *m = &w->solver->limits;
    double slack, noise;
    measure_work(w, &slack, &noise);
    while (relax(w, noise)) {
        if (!limits_solve(w)) return false;
        measure_work(w, &slack, &noise);
    }
    for (int i = 0; i < w->p->desc->samples; i++) {
        if (limits_hold(w, i)) m->now[i] = m->pull[i];
    }
    return true;
}

static enum outcome search(limits_work *w)
{
    double slack, noise;
    measure_work(w, &slack, &noise);
    limits_guess(w, slack);
    if (w->body.held + w->tail.held > 0 && !limits_solve(w)) hold_nothing(w); // there may be room for fewer
    return settle(w) ? climb(w) : NO_ROOM;
}

wiggly_status limits_find(wiggly_solver *solver, problem *p, wiggly_curve *curve, minimum *result)
{
    limits_work w = {.solver = solver, .p = p, .curve = curve, .result = result};
    solver->limits.solves = 0;
    solver->limits.tail_energy = 0;
    w.status = problem_find(solver, p, curve, result);
    if (w.status == WIGGLY_SINGULAR) return w.status;
    w.body = body_of(p);
    w.tail = tail_of(p);
    hold_nothing(&w);
    switch (search(&w)) {
    case NO_ROOM:
        return WIGGLY_ERROR_CAPACITY;
    case TIRED:
        result->error += fabs(excess(&w, find_farthest(&w, 0), 0)), result->unrefined = false;
        break;
    case FOUND:
        break;
    }
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

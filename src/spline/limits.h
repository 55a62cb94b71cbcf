/// Limits: min E subject to low ≤ total ≤ high (docs/mathematics.md, Limits). Internal to src/spline.
#ifndef SPLINE_LIMITS_H
#define SPLINE_LIMITS_H

#include "spline/one_sided.h"
#include "spline/problem.h"
#include <math.h>

static inline bool limits_are_set(const wiggly_desc *desc) { return desc->low > -INFINITY || desc->high < INFINITY; }

/// Sorts the knots of a limited spline that was just posed into the solver's memory, with room for held samples between them: its
/// description becomes `ordered`. `all` is the curve with the solver's arrays for those that `curve` lacks.
/// Returns the index of a still knot whose total is beyond a limit, else -1.
int limits_begin(wiggly_solver *solver, problem *p, wiggly_desc *ordered, const wiggly_curve *curve,
                 wiggly_curve *all);

/// problem_find() for a limited spline. WIGGLY_ERROR_CAPACITY if more samples must be held than there is room for.
wiggly_status limits_find(wiggly_solver *solver, problem *p, wiggly_curve *curve, minimum *result);

/// Rounds the completed total to the limits where it exceeds them in the last digits.
void limits_clamp(const wiggly_solver *solver, const problem *p, wiggly_curve *curve);

/// The state of a sample: free, held at a limit, or keyed.
enum { LIMITS_FREE = 0, LIMITS_LOW = -1, LIMITS_HIGH = 1, LIMITS_KEYED = 2 };

/// A part of a limited spline: up to the last knot, or the motion that limits add after it.
typedef struct limits_part {
    problem p; ///< with held samples as knots
    wiggly_desc desc;
    int begin;    ///< the spline's sample that is sample 0 here
    int from, to; ///< samples that may be held, as the spline counts them
    int held;     ///< how many are
} limits_part;

/// A limited spline being solved.
typedef struct limits_work {
    wiggly_solver *solver;
    problem *p; ///< with its knots alone
    wiggly_curve *curve;
    minimum *result;
    double tail_error; ///< estimated error of the motion that limits add after the last knot
    one_sided search;  ///< of the samples from `from` on
    int from;
    int attempts; ///< of the search
    double missed;
    bool fresh;             ///< the rows must be set
    bool is_lossy;          ///< solutions of the factor are corrected
    bool has_room;          ///< for all samples that are to be held
    limits_part body, tail; ///< one of them may be empty: to < from
    int first;              ///< sample of the first block of the matrix
    wiggly_status status;
} limits_work;

/// Solves with the held samples; their `pull` becomes −½ of the energy's gradient. false if there is no room for so many.
bool limits_solve(limits_work *work);

/// Rows of the tail with nothing held, and `free` of the solver's memory.
void limits_set_tail_rows(limits_work *w);

/// The search's input, and its arrays in the solver's memory.
void limits_set_search(limits_work *w);

/// The search's present values, and its limits.
void limits_measure(limits_work *w);

/// How far x would move if samples pulled by limits were freed; 0 if none is.
double limits_release(limits_work *w);

/// How far x would move if free samples beyond a limit by more than `slack` were held there; 0 if none is.
double limits_catch(limits_work *w, double slack);

static inline bool limits_has_body(const limits_work *w) { return w->body.to >= w->body.from; }
static inline bool limits_has_tail(const limits_work *w) { return w->tail.to >= w->tail.from; }

/// The part that contains a sample.
static inline limits_part *limits_part_of(limits_work *w, int sample)
{
    return limits_has_tail(w) && sample >= w->tail.from ? &w->tail : &w->body;
}

static inline void limits_take(limits_work *w, int sample, bool high)
{
    w->solver->limits.held[sample] = high ? LIMITS_HIGH : LIMITS_LOW;
    limits_part_of(w, sample)->held++;
}

static inline double limits_total(const limits_work *w, int sample)
{
    return problem_about(w->p, sample) + w->curve->re[sample];
}

/// How far a sample is above the high limit (positive) or below the low one (negative); 0: within, or no farther beyond than `slack`.
static inline double limits_excess(const limits_work *w, int sample, double slack)
{
    const wiggly_desc *desc = w->p->desc;
    double total = limits_total(w, sample);
    return total > desc->high + slack ? total - desc->high : total < desc->low - slack ? total - desc->low : 0;
}

static inline bool limits_hold(const limits_work *w, int sample) { return w->solver->limits.held[sample] & 1; }

/// The limit that holds a sample.
static inline double limits_bound(const limits_work *w, int sample)
{
    return w->solver->limits.held[sample] > 0 ? w->p->desc->high : w->p->desc->low;
}

#endif

/// Splines that are meant to be hard on the solver, made from a seed and judged by the textbook: no OK above the tolerance, no estimate
/// below the error, no complaint about what is easy. tests/test_adversary.c tries a few, tools/adversary.c as many as you like.
#ifndef TESTS_ADVERSARY_H
#define TESTS_ADVERSARY_H

#include "textbook.h"
#include <stdint.h>
#include <stdio.h>

enum { ADVERSARY_TRACKS = 6 };

/// What a problem is made to be hard by.
typedef enum adversary_kind {
    ADVERSARY_FILTER,     ///< a short filter, everything at random
    ADVERSARY_OSCILLATOR, ///< a short oscillator, the same
    ADVERSARY_ADJACENT,   ///< three knots side by side and no calm: nothing else holds Im x
    ADVERSARY_NODAL,      ///< knots where an undamped swing passes through 0
    ADVERSARY_NYQUIST,    ///< as fast as samples can show, and faster
    ADVERSARY_FROM_ZERO,  ///< tracks that are 0 at times, damped up to 25 times too much
    ADVERSARY_SLOW,       ///< a fraction of a period over a loop, or a few
    ADVERSARY_CHAIN,      ///< hundreds of samples, undamped, next to no calm
    ADVERSARY_LONG,       ///< up to thousands of samples, everything at random
    ADVERSARY_KINDS
} adversary_kind;

/// A description with its storage.
struct adversary_problem {
    wiggly_desc desc;
    double fps; ///< 1 / desc.step
    wiggly_knot knots[TEXTBOOK_MAX];
    double tracks[ADVERSARY_TRACKS][TEXTBOOK_MAX];
    int tracks_used;
};

/// The problem of a kind and seed: the same on every machine.
void adversary_make(struct adversary_problem *problem, adversary_kind kind, uint64_t seed);

/// Makes poses of some of its knots, and lets some be still.
void adversary_hold(struct adversary_problem *problem, uint64_t seed);

/// The nth problem of a search: the kinds take turns, and every other time some knots hold more.
static inline adversary_kind adversary_make_nth(struct adversary_problem *problem, uint64_t seed, uint64_t n)
{
    const adversary_kind kind = (adversary_kind)(n % ADVERSARY_KINDS);
    const uint64_t own = seed * 0x9E3779B97F4A7C15u + n;
    adversary_make(problem, kind, own);
    if (n / ADVERSARY_KINDS % 2 == 1) adversary_hold(problem, own);
    return kind;
}

/// Writes the problem as a scene in one line, for `wiggly solve`; its last spline is the problem's, the others its tracks.
void adversary_print(FILE *out, const struct adversary_problem *problem);

/// What the solver and the textbook say of a problem.
struct adversary_verdict {
    const char *fault; ///< what is wrong with the solver's answer, or NULL
    wiggly_status said, status;
    bool exists;     ///< there is an answer for the status that the solver gave
    bool undecided;  ///< quadruple precision is not enough for the textbook either
    bool needless;   ///< the fault is no more than a complaint about what is easy
    bool borderline; ///< whether it is singular depends on the last digits
    double error, estimate, pivot, growth, condition;
};

/// Solves with the solver, which has room for it, and judges the answer. Not for two threads at once.
void adversary_judge(wiggly_solver *solver, const struct adversary_problem *problem,
                     struct adversary_verdict *verdict);

/// The verdict in one line.
void adversary_explain(FILE *out, const char *name, const struct adversary_verdict *verdict);

#endif

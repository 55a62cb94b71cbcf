/// Splines made from a seed to be hard for the solver, checked against the textbook: no OK above the tolerance, no estimate below the
/// error, no complaint about easy problems. tests/spline/test_adversary.c tries a few, tools/adversary.c as many as you like.
#ifndef TESTS_ADVERSARY_H
#define TESTS_ADVERSARY_H

#include "textbook.h"
#include <stdint.h>
#include <stdio.h>

enum { ADVERSARY_TRACKS = 6, ADVERSARY_MAX = 4096 }; ///< of a problem; its samples

/// What makes a problem hard.
typedef enum adversary_kind {
    ADVERSARY_FILTER,     ///< a short filter with random parameters
    ADVERSARY_OSCILLATOR, ///< the same for a short oscillator
    ADVERSARY_ADJACENT,   ///< three adjacent knots and no calm: nothing else determines Im x
    ADVERSARY_NODAL,      ///< knots where an undamped swing passes through 0
    ADVERSARY_NYQUIST,    ///< at the Nyquist frequency and above
    ADVERSARY_FROM_ZERO,  ///< tracks that touch 0, damped up to 25 times too much
    ADVERSARY_SLOW,       ///< a loop of a few periods or less
    ADVERSARY_CHAIN,      ///< hundreds of samples, undamped, almost no calm
    ADVERSARY_LONG,       ///< up to thousands of samples, random parameters
    ADVERSARY_GAPS,       ///< hundreds to thousands of samples between poses, still knots or knots
    ADVERSARY_CALM,       ///< a start held by 1e-20 to 1e-3
    ADVERSARY_CRITICAL,   ///< damping within 1e-9 of 1
    ADVERSARY_ALIAS,      ///< frequencies near multiples of the sample rate, bandwidth 1
    ADVERSARY_JUMPS,      ///< real tracks from 0 with jumps
    ADVERSARY_LAST,       ///< the filter with a slope on its last sample
    ADVERSARY_STIFF,      ///< stiffness from 1e-12 to 1e15
    ADVERSARY_RESONANT,   ///< loops with knots on the seam and equilibria in resonance
    ADVERSARY_KINDS
} adversary_kind;

/// A description with its storage.
struct adversary_problem {
    wiggly_desc desc;
    double fps; ///< 1 / desc.step
    wiggly_knot knots[ADVERSARY_MAX];
    double tracks[ADVERSARY_TRACKS][ADVERSARY_MAX];
    int tracks_used;
};

/// The problem of a kind and seed: the same on every machine.
void adversary_make(struct adversary_problem *problem, adversary_kind kind, uint64_t seed);

/// Turns some knots into poses and some into still knots.
void adversary_hold(struct adversary_problem *problem, uint64_t seed);

/// Lets the motion wind up and some knots settle.
void adversary_direct(struct adversary_problem *problem, uint64_t seed);

/// The nth problem of a search: kinds alternate; every other round some knots are poses or still, and every other two the motion has a
/// direction.
static inline adversary_kind adversary_make_nth(struct adversary_problem *problem, uint64_t seed, uint64_t n)
{
    const adversary_kind kind = (adversary_kind)(n % ADVERSARY_KINDS);
    const uint64_t own = seed * 0x9E3779B97F4A7C15u + n;
    adversary_make(problem, kind, own);
    if (n / ADVERSARY_KINDS % 2 == 1) adversary_hold(problem, own);
    if (n / ADVERSARY_KINDS % 4 >= 2) adversary_direct(problem, own);
    return kind;
}

/// Prints the problem as a scene in one line, for `wiggly solve`. The last spline is the problem's, the others are its tracks.
void adversary_print(FILE *out, const struct adversary_problem *problem);

/// The solver's answer compared with the textbook's.
struct adversary_verdict {
    const char *fault; ///< what is wrong with the solver's answer, or NULL
    wiggly_status said, status;
    bool exists;     ///< an answer exists for the solver's status
    bool undecided;  ///< quadruple precision does not suffice for the textbook either
    bool needless;   ///< the fault is only a complaint about an easy problem
    bool borderline; ///< the last digits decide whether it is singular
    double error, estimate, pivot, growth, condition;
};

/// Solves with the solver, which must have room, and checks the answer. Not thread-safe.
void adversary_judge(wiggly_solver *solver, const struct adversary_problem *problem,
                     struct adversary_verdict *verdict);

/// Prints the verdict in one line.
void adversary_explain(FILE *out, const char *name, const struct adversary_verdict *verdict);

#endif

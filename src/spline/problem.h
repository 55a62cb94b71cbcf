/// A description with the rules of the start applied. Internal to src/spline.
#ifndef SPLINE_PROBLEM_H
#define SPLINE_PROBLEM_H

#include "spline/solver.h"

/// Values and equilibria beyond this are refused: sums of them must not overflow.
#define LARGEST_VALUE 1e300

/// A slope row heavier than this is met to the last digit anyway, and could overflow.
#define STIFFEST 1e20

/// One solve in progress: the description with the rules of the start applied.
typedef struct problem {
    const wiggly_desc *desc;
    const double *y; ///< equilibrium of the whole domain, where it moves; a loop's last is its first
    wiggly_start start;
    double calm;
    int first;     ///< sample of the system's row 0
    int count;     ///< rows of the system
    int earliest;  ///< sample of the earliest knot, or -1
    bool level;    ///< a level slope is implied at the earliest knot
    bool free_end; ///< c·H = 0
} problem;

static inline double problem_y(const problem *p, int sample)
{
    return p->y ? p->y[sample] : p->desc->equilibrium.value;
}

/// Whether the document is one for the chain: constant parameters, a constant equilibrium, no seam.
bool problem_fits_chain(wiggly_solver *solver, const problem *p);

/// Checks a description and applies the rules of the start; y receives the equilibrium where it moves, N numbers. What is wrong,
/// or WIGGLY_OK.
wiggly_status problem_pose(wiggly_solver *solver, const wiggly_desc *desc, double *y, problem *p);

/// Puts filter, start and nodes into the solver's chain; true where the nodes differ from those before only in values.
bool problem_make_chain(wiggly_solver *solver, const problem *p);

/// Solves by the chain: x of the system, M numbers each (x_im in complex mode). false where it declines: one knot without any
/// hold, digits lost, or numbers so large that something might overflow.
bool problem_solve_chain(wiggly_solver *solver, const problem *p, double *x_re, double *x_im);

/// Poses a spline that might be solved in a group. false where it is one for wiggly_solve().
bool problem_pose_for_group(wiggly_solver *solver, const wiggly_desc *desc, problem *p);

/// Whether the problem that was posed last has the filter and the start of the chain as it is.
bool problem_shares_chain(wiggly_solver *solver, const problem *p);

/// Puts it into the chain, with its stretches and everything unknown 0. false where nothing holds it.
bool problem_join(wiggly_solver *solver, const problem *p);

/// Samples of a spline whose nodes are solved, and all else of the curve, as wiggly_solve() would leave it. false where something
/// is wrong with them, and wiggly_solve() is to find a way.
bool problem_finish(wiggly_solver *solver, const problem *p, wiggly_curve *curve);

/// Whether max |x| is beyond what the knots can mean. `solved` is the chain where that found x, else NULL.
bool problem_blew_up(const problem *p, const chain *solved, const wiggly_curve *curve);

/// What follows from x: samples outside the system, the total, the equilibrium, the band's centre.
void problem_complete(wiggly_solver *solver, const problem *p, wiggly_curve *curve);

#endif

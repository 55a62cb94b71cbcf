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
    const double *y; ///< of the whole domain; a loop's last is its first
    wiggly_start start;
    double calm;
    int first;     ///< sample of the system's row 0
    int earliest;  ///< sample of the earliest knot, or -1
    bool level;    ///< a level slope is implied at the earliest knot
    bool free_end; ///< c·H = 0
} problem;

/// Whether the document is one for the chain: constant parameters, a constant equilibrium, no seam.
bool problem_fits_chain(wiggly_solver *solver, const problem *p);

/// Checks a description and applies the rules of the start; y receives the equilibrium, N numbers. What is wrong, or WIGGLY_OK.
wiggly_status problem_pose(wiggly_solver *solver, const wiggly_desc *desc, double *y, problem *p);

/// Puts filter, start and nodes into the solver's chain; true where the nodes differ from those before only in values.
bool problem_make_chain(wiggly_solver *solver, const problem *p);

/// Solves by the chain: x of the system, M numbers each (x_im in complex mode). false where it declines: one knot without any
/// hold, digits lost, or numbers so large that something might overflow.
bool problem_solve_chain(wiggly_solver *solver, const problem *p, double *x_re, double *x_im);

#endif

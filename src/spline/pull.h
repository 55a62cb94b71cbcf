/// A spline that is pulled at some of its samples: what each pull makes of x there (docs/mathematics.md, Pins).
#ifndef SPLINE_PULL_H
#define SPLINE_PULL_H

#include "spline/bound_tail.h"

/// One spline of a group.
typedef struct pulled {
    wiggly_solver *solver;
    problem problem;
    system_pulls pulls;
    double scale;    ///< of the system's compliance, to that of its weighted energy
    bound_tail tail; ///< what bounds press behind the last knot
    double *e;       ///< that, one number a sample
} pulled;

/// x at pulled samples under single pulls, 2P × 2P for P pulls: row 2i is Re x at sample i, 2i + 1 Im x, likewise the columns' pulls; the
/// lower triangle. And x without pulls, 2P. false where the system is singular.
bool pull_respond(pulled *of, double *compliance, double *alone);

#endif

/// A spline that is pulled at some of its samples: what each pull makes of x there, and the motion under all of them
/// (docs/mathematics.md, Pins). Two ways, as for a spline by itself: the chain's nodes, or the band.
#ifndef SPLINE_PULL_H
#define SPLINE_PULL_H

#include "spline/bound_tail.h"

/// A node of the chain whose Re x need not be known: the state (Re x, Im x, Re d, Im d) is to · unknowns + known.
typedef struct pull_node {
    double to[4][4], known[4];
    double pivot[4][4]; ///< the block, then its pivot's inverse
    double below[4][4]; ///< coupling to the next node, then of the factor
    double right[4];    ///< what is known pulls
    double solved[4];
    double border[4][4]; ///< of a loop's: what 1 of each of the first node's unknowns takes off this one's
} pull_node;

/// Where a pulled sample is: a node's own, or the one after it.
typedef struct pull_place {
    int node;
    bool second;
} pull_place;

/// One spline of a group.
typedef struct pulled {
    wiggly_solver *solver;
    problem problem;
    system_pulls pulls;
    pull_place *place; ///< of each pull, where the chain serves
    pull_node *nodes;
    int first_knot, first_pull; ///< with which a loop's nodes begin
    double scale;               ///< of the system's compliance, to that of its weighted energy
    bool by_chain;
    bound_tail tail; ///< what bounds press behind the last knot
    double *e;       ///< that, one number a sample
} pulled;

/// x at pulled samples under single pulls, 2P × 2P for P pulls: row 2i is Re x at sample i, 2i + 1 Im x, likewise the columns' pulls; the
/// lower triangle. And x without pulls, 2P. `columns` is room for 8P numbers. false where the nodes have lost digits.
bool pull_chain_respond(pulled *of, double *compliance, double *alone, double *columns);

/// The same by the band, whatever the spline; `columns` is not used. false where the system is singular.
bool pull_band_respond(pulled *of, double *compliance, double *alone);

/// The curve under `pulls`, by the nodes that pull_chain_respond() has factored. false where something is wrong with it: then
/// wiggly_solve() is to find a way.
bool pull_chain_solve(pulled *of, wiggly_curve *curve);

#endif

/// Fewer knots for nearly the same motion.
#ifndef SCENE_SIMPLIFY_H
#define SCENE_SIMPLIFY_H

#include "base/need.h"
#include <wiggly/more.h>

/// The knots of a description, and those that do. Private from `pool` on.
struct simplify {
    int count, left;         ///< knots, and how many of them stay
    wiggly_desc given, desc; ///< the description, and with which frequency and damping they do
    bool *stays;             ///< of each
    wiggly_knot *knots;      ///< in order of time, with new values
    double range;            ///< of the values
    bool searched;           ///< other frequencies, too

    struct pool pool;
    wiggly_knot *solved; ///< those of `knots` that stay
    wiggly_solver *solver;
    wiggly_curve curve;
    bool *held, *kept;    ///< knots whose values stay, and all that do
    bool may_turn, turns; ///< the first knot is a pose with a fitted phase
    double *error;        ///< of the curve at each knot, with the given values
    double *column; ///< a row a fitted number: how it moves the curve there; then the errors with the new values
    double tolerance;
    double tries[15][2]; ///< frequencies and dampings
    int try_count;
};

/// Opens a description with one knot or more; its tracks must live on. The ends, the highest and the lowest knot will stay, and with their values those
/// that are `fixed`, poses or still. `searches`: if fewer knots then do, it takes another frequency and damping, and makes the first knot a pose.
/// Allocates; the caller frees it by simplify_close().
struct simplify *simplify_open(const wiggly_desc *desc, const bool *fixed, bool searches);

/// Leaves out as many knots as it can while the curve stays within `tolerance` of all given values. The values of others change if fewer then do.
void simplify_within(struct simplify *s, double tolerance);

/// The curve's value at a knot if that is left out.
double simplify_without(struct simplify *s, int knot);

/// NULL is fine.
void simplify_close(struct simplify *s);

#endif

/// Retiming: the later knots move along.
#ifndef EDITOR_CURVES_RIPPLE_H
#define EDITOR_CURVES_RIPPLE_H

#include "editor/curves/state.h"

/// Whether a knot moves along, as it was before the drag.
bool ripple_moves(const struct knot_drag *drag, const struct knot *knot);
/// Retiming (R while knots are dragged): the later knots of the spline keep their distances to the dragged ones.
void ripple_toggle(struct curves *curves, struct core *core, const struct editor_world *world);
/// The furthest shift to the left, in frames: to the first frame, or with ripple to behind the knot that stays.
double ripple_least(const struct curves *curves, const struct core *core, const struct document *document,
                    const struct spline *spline);
/// Says why the knots go no further to the right.
void ripple_stopped(struct core *core);

#endif

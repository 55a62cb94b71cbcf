/// Drags of knots and of their slopes.
#ifndef EDITOR_CURVES_KNOT_DRAG_H
#define EDITOR_CURVES_KNOT_DRAG_H

#include "editor/curves/state.h"

/// The copies of all knots that move, which the edits of the drag start from.
void drag_collect(struct curves *curves, struct core *core, const struct spline *spline);
/// Starts to move the selected knots of the active spline; `knot` is the one under the pointer.
void drag_begin_knots(struct curves *curves, struct core *core, const struct editor_world *world, unsigned knot,
                      const struct event *event);
/// Starts to turn the slope of a knot by an end of its handle.
void drag_begin_slope(struct curves *curves, struct core *core, const struct editor_world *world, unsigned knot,
                      int handle, const struct event *event);

#endif

/// What the mouse does in the curves panel: drags of knots and slopes, scaling, boxes, the range that is played.
#ifndef EDITOR_CURVES_GESTURES_H
#define EDITOR_CURVES_GESTURES_H

#include "editor/core/drag.h"
#include "editor/curves/state.h"

/// The copies of all knots that move, which the edits of the drag start from.
void drag_collect(struct curves *curves, struct core *core, const struct spline *spline);
/// Starts to move the selected knots of the active spline; `knot` is the one under the pointer.
void drag_begin_knots(struct curves *curves, struct core *core, const struct editor_world *world, unsigned knot,
                      const struct event *event);
/// Starts to turn the slope of a knot by an end of its handle.
void drag_begin_slope(struct curves *curves, struct core *core, const struct editor_world *world, unsigned knot,
                      int handle, const struct event *event);

/// Whether a knot moves along, as it was before the drag.
bool ripple_moves(const struct knot_drag *drag, const struct knot *knot);
/// Retiming (R while knots are dragged): the later knots of the spline keep their distances to the dragged ones.
void ripple_toggle(struct curves *curves, struct core *core, const struct editor_world *world);
/// The furthest shift to the left, in frames: to the first frame, or with ripple to behind the knot that stays.
double ripple_least(const struct curves *curves, const struct core *core, const struct document *document,
                    const struct spline *spline);
/// Says why the knots go no further to the right.
void ripple_stopped(struct core *core);

/// Makes the edits for where the pointer is now.
void scale_apply(struct curves *curves, struct core *core, const struct editor_world *world);
/// The pivot, and the line from it to the pointer.
void scale_show(const struct curves *curves, struct core *core);
/// Events while it runs, but the pointer's: axes, pivot, a typed factor, the end; true where the event is used up.
enum drag_answer scale_event(struct curves *curves, struct core *core, const struct editor_world *world,
                             const struct event *event);

/// Starts to select knots of the active spline by a box; Shift adds them, Ctrl or Alt removes them.
void box_begin(struct curves *curves, struct core *core, const struct event *event);
/// Selects what is in the box as it is now.
void box_update(const struct curves *curves, struct core *core, const struct editor_world *world);
/// Ends it: a press that did not move was a click on empty; `keep` false brings the former selection back.
void box_end(struct curves *curves, struct core *core, bool keep);
/// The box while it grows.
void box_show(const struct curves *curves, struct core *core);

/// Starts to choose the part that is played.
void range_begin(struct core *core, const struct event *event);
/// The part goes from where the drag began to the pointer.
void range_drag(const struct curves *curves, struct core *core, const struct document *document, float x);
/// A press that did not move plays all again; `keep` false brings the former part back.
void range_end(struct core *core, bool keep);
/// Marks the part on the ruler; nothing where all is played.
void range_show_ruler(const struct curves *curves, struct core *core, const struct document *document);
/// Tints the part in the plot.
void range_show_plot(const struct curves *curves, struct core *core, const struct document *document);

#endif

/// What the mouse does in the curves panel: drags of knots and slopes, scaling, boxes, the range that is played.
#ifndef EDITOR_CURVES_GESTURES_H
#define EDITOR_CURVES_GESTURES_H

#include "editor/core/drag.h"
#include "editor/curves/state.h"

/// Starts to move the selected knots; `knot` is the one under the pointer.
void drag_begin_knots(struct curves *curves, struct core *core, const struct editor_world *world, unsigned knot,
                      const struct event *event);
/// Starts to turn the slope of a knot by an end of its handle.
void drag_begin_slope(struct curves *curves, struct core *core, const struct editor_world *world, unsigned knot,
                      int handle, const struct event *event);

/// A line of a limit of the spline near that height.
void limits_hover(const struct curves *curves, const struct core *core, const struct spline *spline, float y,
                  struct hover *hover);
/// Starts to drag the low limit (0) or the high one (1).
void limits_begin_drag(struct curves *curves, struct core *core, const struct editor_world *world, int handle,
                       const struct event *event);
/// The active spline's limits, dashed.
void limits_show(const struct curves *curves, struct core *core, const struct editor_world *world);

/// The pin whose mark on the ruler is there, or HOVER_NONE.
struct hover ruler_pins_hover(const struct curves *curves, const struct core *core, const struct document *document,
                              float x, float y);
/// Selects it, goes to its frame and starts to drag it.
void ruler_pins_begin(struct curves *curves, struct core *core, const struct editor_world *world,
                      const struct hover *hover, const struct event *event);
/// The marks of all pins.
void ruler_pins_show(const struct curves *curves, struct core *core, const struct document *document);

/// Its rows with their names, and what opens it.
struct rect sheet_area(const struct core *core);
struct rect sheet_switch(const struct core *core);
/// The mark or the row at a point of its area.
struct hover sheet_hover(const struct curves *curves, const struct core *core, const struct document *document,
                         float x, float y);
/// A press beside the marks: the spline becomes the active one; a double click inserts a knot on its curve, a drag begins a box.
void sheet_press_row(struct curves *curves, struct core *core, const struct editor_world *world, int spline,
                     const struct event *event);
/// Selects or deselects, as the running drag says, the marks in a box.
void sheet_take_inside(const struct curves *curves, struct core *core, const struct document *document,
                       struct rect box);
/// Scrolls it; false where the wheel means something else.
bool sheet_wheel(struct curves *curves, struct core *core, const struct event *event);
/// Rows, marks, names, and its switch in the ruler's corner.
void sheet_show(const struct curves *curves, struct core *core, const struct document *document);

/// The pivot, the line from it to the pointer, and beside that both factors and what stopped them.
void scale_show(void *room, struct core *core, const struct editor_world *world);
/// Starts to scale by a handle of the box round the selected knots: about its other side or, with Alt, the equilibrium.
void scale_begin_handle(struct curves *curves, struct core *core, const struct editor_world *world, int handle,
                        const struct event *event);
/// The handle at a point.
void scale_box_hover(const struct curves *curves, const struct core *core, const struct document *document, float x,
                     float y, struct hover *hover);
/// The box round the selected knots, where there are several, and its handles.
void scale_box_show(const struct curves *curves, struct core *core, const struct document *document, bool handles);
/// Starts to select knots of the drawn curves by a box; Shift adds them, Ctrl or Alt removes them.
void box_begin(struct curves *curves, struct core *core, const struct event *event);
/// Starts to choose the part that is played.
void range_begin(struct curves *curves, struct core *core, const struct event *event);
/// Marks the part on the ruler; nothing where all is played.
void range_show_ruler(const struct curves *curves, struct core *core, const struct document *document);
/// Tints the part in the plot.
void range_show_plot(const struct curves *curves, struct core *core, const struct document *document);

#endif

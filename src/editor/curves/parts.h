/// What the files of the curves panel give each other. Private to the room, and to tests.
#ifndef EDITOR_CURVES_PARTS_H
#define EDITOR_CURVES_PARTS_H

#include "editor/core/drag.h"
#include "editor/curves/state.h"

/// Logical pixels a frame.
double curves_pixels_per_frame(const struct curves *curves, const struct core *core);
/// Logical pixels a unit of value.
double curves_pixels_per_value(const struct curves *curves, const struct core *core);
/// Logical pixels to frame.
double curves_frame(const struct curves *curves, const struct core *core, double x);
/// Logical pixels to value.
double curves_value(const struct curves *curves, const struct core *core, double y);
/// Whether the view is on its way.
bool follow_moves(const struct curves *curves);

/// Where a spline's values are drawn.
struct value_map normal_map(const struct curves *curves, const struct core *core, int spline);
/// Height of a value of any spline in logical pixels; normalised curves are scaled.
float curves_y_of(const struct curves *curves, const struct core *core, int spline, double value);
/// Measures the curves to normalise, but not during a drag, so that other curves keep still.
void normal_update(struct curves *curves, const struct core *core);

/// Rebuilds the polylines where document, view or layout changed since; allocates nothing.
void curves_update(struct curves *curves, struct core *core);
/// The spline whose polyline is one of the others, or -1 where an edit has given it another place since it was drawn.
int curves_other(const struct curves *curves, const struct document *document, int other);
/// Before a drag makes its first edits: keeps a copy of the active curve to show behind it.
void keep_ghost(struct curves *curves, const struct core *core);
/// Where a knot is across the panel, logical pixels: on its sample.
float curves_knot_x(const struct curves *curves, const struct core *core, const struct knot *knot);

/// Index of the first knot at a place across the panel or to the right of it, or the knot before that one; or how many there are.
int curves_knot_from(const struct curves *curves, const struct core *core, const struct spline *spline, double x);

/// Starts to move the selected knots; `knot` is the one under the pointer.
void drag_begin_knots(struct curves *curves, struct core *core, unsigned knot, const struct event *event);
/// Starts to turn the slope of a knot by an end of its handle.
void drag_begin_slope(struct curves *curves, struct core *core, unsigned knot, int handle, const struct event *event);

/// The active spline's limits, dashed.
void limits_show(const struct curves *curves, struct core *core);

/// The pin whose mark on the ruler is there, or HOVER_NONE.
struct hover ruler_pins_hover(const struct curves *curves, const struct core *core, float x, float y);
/// Selects it, goes to its frame and starts to drag it.
void ruler_pins_begin(struct curves *curves, struct core *core, const struct hover *hover, const struct event *event);
/// The marks of all pins.
void ruler_pins_show(const struct curves *curves, struct core *core);

/// Its rows with their names, and what opens it.
struct rect sheet_area(const struct core *core);
struct rect sheet_switch(const struct core *core);
/// The mark or the row at a point of its area.
struct hover sheet_hover(const struct curves *curves, const struct core *core, float x, float y);
/// A press beside the marks: the spline becomes the active one; a double click inserts a knot on its curve, a drag begins a box.
void sheet_press_row(struct curves *curves, struct core *core, int spline, const struct event *event);
/// Selects or deselects, as the running drag says, the marks in a box.
void sheet_take_inside(const struct curves *curves, struct core *core, struct rect box);
/// Scrolls it; false where the wheel means something else.
bool sheet_wheel(struct curves *curves, struct core *core, const struct event *event);
/// Rows, marks, names, and its switch in the ruler's corner.
void sheet_show(const struct curves *curves, struct core *core);

/// Starts to scale by a handle of the box round the selected knots: about its other side or, with Alt, the equilibrium.
void scale_begin_handle(struct curves *curves, struct core *core, int handle, const struct event *event);
/// The handle at a point.
void scale_box_hover(const struct curves *curves, const struct core *core, float x, float y, struct hover *hover);
/// The box round the selected knots, where there are several, and its handles.
void scale_box_show(const struct curves *curves, struct core *core, bool handles);
/// Starts to select knots of the drawn curves by a box; Shift adds them, Ctrl or Alt removes them.
void box_begin(struct curves *curves, struct core *core, const struct event *event);
/// Starts to choose the part that is played.
void range_begin(struct curves *curves, struct core *core, const struct event *event);

/// The handle's length in pixels says how firmly the slope is held, 12 for each power of ten.
double handle_length(double stiffness);
/// The stiffness that a length of the handle stands for.
double handle_stiffness(double length);
/// A knot: a diamond, filled with its colour; with an outline where it is selected.
void knot_mark(struct drawlist *list, float x, float y, float radius, uint32_t color, bool selected);
/// The ring around the knot under the pointer.
void knot_ring(struct drawlist *list, float x, float y);
/// Where the playhead's frame number is, on the ruler; empty where the playhead is out of sight.
struct rect playhead_tag(const struct curves *curves, const struct core *core);

/// The corner left of the ruler, which says what it counts.
struct rect ruler_corner(const struct core *core);
/// Grids, numbers and ruler; part of curves_show().
void grid_show(const struct curves *curves, struct core *core);

/// The knot to draw after one, where knots are crowded: the next that is selected or under the pointer, or at least `gap` pixels on.
int crowd_next(const struct curves *curves, const struct core *core, int spline, int knot, float gap);

/// Finds what is wrong with a solved spline. At most WARNINGS_MAX, spans in the order of time.
void warnings_find(const struct document *document, const struct evaluation *evaluation, int of,
                   struct warnings *found);
/// The same for the active spline where document or look have changed since; allocates nothing.
void warnings_update(struct curves *curves, const struct core *core);

/// Where a warning's marker is, in logical pixels; false where it is out of sight.
bool warning_place(const struct curves *curves, const struct core *core, const struct warning *warning, float xy[2]);
/// The markers.
void warnings_show(const struct curves *curves, struct core *core);
/// Words under the pointer; after everything else, so that nothing lies over them.
void warnings_show_words(const struct curves *curves, struct core *core);

/// Fixes a warning, as one undo step: tries the remedies in turn and keeps the first that helps.
void warning_remedy(const struct curves *curves, struct core *core, const struct warning *warning);

#endif

/// What of the curves is in sight, and where it is on the screen.
#ifndef EDITOR_CURVES_VIEW_H
#define EDITOR_CURVES_VIEW_H

#include "editor/curves/state.h"

/// Logical pixels a frame.
double curves_pixels_per_frame(const struct curves *curves, const struct core *core);
/// Logical pixels a unit of value.
double curves_pixels_per_value(const struct curves *curves, const struct core *core);
/// Logical pixels to frame.
double curves_frame(const struct curves *curves, const struct core *core, double x);
/// Logical pixels to value.
double curves_value(const struct curves *curves, const struct core *core, double y);
/// Shows a part, within reason.
void view_set(struct curves *curves, struct core *core, struct view view);
/// The view stays where it is, whatever was edited.
void follow_stop(struct curves *curves, struct core *core);
/// Whether the view is on its way.
bool follow_moves(const struct curves *curves);
/// Shows the values v that were shown as scale·v + offset.
void view_rescale(struct curves *curves, struct core *core, double scale, double offset);

/// Where a spline's values are drawn.
struct value_map normal_map(const struct curves *curves, const struct core *core, int spline);
/// Height of a value of any spline in logical pixels; normalised curves are scaled.
float curves_y_of(const struct curves *curves, const struct core *core, int spline, double value);
/// Measures the curves to normalise, but not during a drag, so that other curves keep still.
void normal_update(struct curves *curves, const struct core *core, const struct editor_world *world);

/// Rebuilds the polylines where document, view or layout changed since; allocates nothing.
void curves_update(struct curves *curves, struct core *core, const struct editor_world *world);
/// The spline whose polyline is one of the others, or -1 where an edit has given it another place since it was drawn.
int curves_other(const struct curves *curves, const struct document *document, int other);
/// Before a drag makes its first edits: keeps a copy of the active curve to show behind it.
void keep_ghost(struct curves *curves, const struct core *core, const struct editor_world *world);
/// Where a knot is across the panel, logical pixels: on its sample.
float curves_knot_x(const struct curves *curves, const struct core *core, const struct document *document,
                    const struct knot *knot);

/// Index of the first knot at a place across the panel or to the right of it, or the knot before that one; or how many there are.
int curves_knot_from(const struct curves *curves, const struct core *core, const struct document *document,
                     const struct spline *spline, double x);

#endif

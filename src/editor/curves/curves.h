/// The curves panel: where frames and values are on the screen, what is drawn there and what the mouse does.
#ifndef EDITOR_CURVES_CURVES_H
#define EDITOR_CURVES_CURVES_H

#include "editor/core/state.h"

enum { CURVES_HIT_RADIUS = 10 };

/// Frame and value to logical pixels and back. Pixels stay within a few thousand of the plot, whatever the value.
float curves_x(const struct editor *editor, double frame);
float curves_y(const struct editor *editor, double value);
double curves_frame(const struct editor *editor, double x);
double curves_value(const struct editor *editor, double y);

/// Logical pixels a frame, and a unit of value.
double curves_pixels_per_frame(const struct editor *editor);
double curves_pixels_per_value(const struct editor *editor);

/// Height of a value of any spline that is drawn: the others are scaled where curves are normalised.
float curves_y_of(const struct editor *editor, int spline, double value);
struct value_map normal_map(const struct editor *editor, int spline);
/// Measures the curves that are to be normalised; while a drag runs nothing is, so that what is not touched stays.
void normal_update(struct editor *editor, const struct editor_world *world);
/// Switches normalisation; another spline becomes the active one without a change of the picture.
void normal_toggle(struct editor *editor, const struct editor_world *world);
void normal_activate(struct editor *editor, int spline);

/// A value with no more decimals than somebody who moves a mouse can mean: a multiple of the power of ten at or below
/// `resolution` (> 0), so that files keep short numbers.
double round_value(double value, double resolution);

/// Shows everything, or the selected knots with room around them (everything where none is selected).
void view_frame_all(struct editor *editor, const struct editor_world *world);
void view_frame_selection(struct editor *editor, const struct editor_world *world);
/// Pans so that a frame and value can be seen, and no further.
void view_reveal(struct editor *editor, double frame, double value);
/// Shows the values v that were shown as scale·v + offset.
void view_rescale(struct editor *editor, double scale, double offset);
/// Moves the view with the pointer, by logical pixels.
void view_pan(struct editor *editor, double dx, double dy);
/// Zooms about a point of the panel; factors below 1 come closer.
void view_zoom(struct editor *editor, float x, float y, double time_factor, double value_factor);

/// Rebuilds the polylines where document, view or layout changed since; allocates nothing.
void curves_update(struct editor *editor, const struct editor_world *world);
/// Remembers the active curve as it is now, to be shown behind a drag.
void ghost_capture(struct editor *editor, const struct editor_world *world);

/// Where the playhead's frame number is, on the ruler; empty where the playhead is out of sight.
struct rect playhead_tag(const struct editor *editor, const struct document *document);
/// Grids, numbers and ruler; part of curves_show().
void grid_show(struct editor *editor, const struct editor_world *world);
/// The whole panel into the draw list. The playhead comes last: nothing before it depends on the time shown.
void curves_show(struct editor *editor, const struct editor_world *world);

/// The corner left of the ruler, which says what the ruler counts and changes it.
struct rect ruler_corner(const struct editor *editor);
void ruler_toggle(struct editor *editor);

/// What is under a point of the panel.
struct hover curves_hover(const struct editor *editor, const struct editor_world *world, float x, float y);
/// Ends of a knot's slope handle: before (0) or after (1) the knot.
void curves_handle(const struct editor *editor, const struct document *document, const struct knot *knot, int end,
                   float xy[2]);

/// The handle's length in pixels says how firmly the slope is held, 12 for each power of ten; and back.
double handle_length(double stiffness);
double handle_stiffness(double length);

/// A press or wheel in the panel.
void curves_press(struct editor *editor, const struct editor_world *world, const struct event *event);
void curves_wheel(struct editor *editor, const struct event *event);

/// Position in samples (fractional) of a frame, and the spline's solved parts there.
double curves_position(const struct document *document, double frame);
wiggly_value curves_solved(const struct editor_world *world, int spline, double position);

#endif

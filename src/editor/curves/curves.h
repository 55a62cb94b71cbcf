/// Interface of the curves panel.
#ifndef EDITOR_CURVES_CURVES_H
#define EDITOR_CURVES_CURVES_H

#include "editor/core/drag.h"

struct curves;

struct curves *curves_create(void);
void curves_destroy(struct curves *curves);
/// Lays the dope sheet out, which takes its room from the plot.
void sheet_update(struct curves *curves, struct core *core);
/// Where a knot's mark is on the dope sheet; false where it is out of sight.
bool curves_mark_point(const struct curves *curves, const struct core *core, int spline, int knot, float xy[2]);
/// Finds the item under a point of the panel.
struct hover curves_hover(const struct curves *curves, const struct core *core, float x, float y);
/// A press in the panel.
void curves_press(struct curves *curves, struct core *core, const struct event *event);
/// The wheel over the panel.
void curves_wheel(struct curves *curves, struct core *core, const struct event *event);
/// A new document is on the table.
void curves_open(struct curves *curves);
/// Whether the view moves.
bool curves_wants_frames(const struct curves *curves);
/// Ends of a knot's slope handle: before (0) or after (1) the knot.
void curves_handle(const struct curves *curves, const struct core *core, const struct knot *knot, int end,
                   float xy[2]);
/// The whole panel into the draw list. The playhead comes last: nothing before it depends on the time shown.
void curves_show(struct curves *curves, struct core *core);
/// Another spline has become active than `before`: keeps the picture as it is.
void curves_activate(struct curves *curves, struct core *core, int before);
/// Fixes the first warning.
void curves_remedy_first(struct curves *curves, struct core *core, int unused);
/// Starts to scale the selected knots with the pointer: about the middle of the selection, or their values about the
/// equilibrium. P goes on to the next pivot.
void curves_scale(struct curves *curves, struct core *core, int about_equilibrium);
/// Where a handle of the box round the selected knots is: column and row −1 … 1, 0 0 is none. false where it is not shown.
bool curves_box_point(const struct curves *curves, const struct core *core, int column, int row, float xy[2]);
/// Moves the selected knots by frames, and by hundredths of the values in sight; repeated nudges are one undo step.
void curves_nudge(const struct curves *curves, struct core *core, double frames, double hundredths);
/// Frame to logical pixels, within a few thousand of the plot.
float curves_x(const struct curves *curves, const struct core *core, double frame);
/// Value to logical pixels, within a few thousand of the plot.
float curves_y(const struct curves *curves, const struct core *core, double value);
/// Shows everything.
void curves_frame_all(struct curves *curves, struct core *core);
/// Shows the selected knots with room around them (everything where none is selected).
void curves_frame_selection(struct curves *curves, struct core *core);
/// Pans just far enough to show a frame and value.
void curves_reveal(struct curves *curves, struct core *core, double frame, double value);
/// After the solve: widens the view to edits that left the panel.
void follow_edits(struct curves *curves, struct core *core);
/// Time passes: the view goes on to where it is to be.
void curves_advance(struct curves *curves, struct core *core, double dt);
/// Moves the view with the pointer, by logical pixels.
void curves_pan(struct curves *curves, struct core *core, double dx, double dy);
/// Zooms about a point of the panel; factors below 1 come closer.
void curves_zoom(struct curves *curves, struct core *core, float x, float y, double time_factor, double value_factor);
/// Where the mark of a pin is on the ruler; false where it is out of sight.
bool curves_pin_point(const struct curves *curves, const struct core *core, const struct pin *pin, float xy[2]);
/// Where a warning's marker is on the screen; false where there is none.
bool curves_warning(const struct curves *curves, const struct core *core, double number, float xy[2]);

#endif

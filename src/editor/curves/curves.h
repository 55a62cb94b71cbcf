/// Interface of the curves panel.
#ifndef EDITOR_CURVES_CURVES_H
#define EDITOR_CURVES_CURVES_H

#include "editor/core/core.h"

struct curves;

/// The things that replays name; ends with NULL.
extern const struct thing *const curves_things[];

struct curves *curves_create(void);
void curves_destroy(struct curves *curves);
/// Lays out the dope sheet; the plot shrinks by its height.
void sheet_update(struct curves *curves, struct core *core);
struct hover curves_hover(const struct curves *curves, const struct core *core, float x, float y);
void curves_press(struct curves *curves, struct core *core, const struct event *event);
void curves_wheel(struct curves *curves, struct core *core, const struct event *event);
/// Resets the panel for a new document.
void curves_open(struct curves *curves);
/// Whether the view is still moving.
bool curves_wants_frames(const struct curves *curves);
/// Draws the panel. The playhead comes last, so that nothing before it depends on the time.
void curves_show(struct curves *curves, struct core *core);
/// Keeps the picture in place when another spline than `before` becomes active.
void curves_activate(struct curves *curves, struct core *core, int before);
void curves_remedy_first(struct curves *curves, struct core *core, int unused);
/// Starts scaling the selected knots with the pointer, about the selection's middle or about the equilibrium; P changes the pivot.
void curves_scale(struct curves *curves, struct core *core, int about_equilibrium);
/// Moves the selected knots by frames and by hundredths of the visible values. Repeated nudges are one undo step.
void curves_nudge(const struct curves *curves, struct core *core, double frames, double hundredths);
void curves_frame_all(struct curves *curves, struct core *core);
/// Shows the selected knots with a margin, or everything if none is selected.
void curves_frame_selection(struct curves *curves, struct core *core);
void curves_reveal(struct curves *curves, struct core *core, double frame, double value);
/// Call after the solve: widens the view to edits that left the panel.
void follow_edits(struct curves *curves, struct core *core);
/// Moves the view towards its target.
void curves_advance(struct curves *curves, struct core *core, double dt);
/// By logical pixels.
void curves_pan(struct curves *curves, struct core *core, double dx, double dy);
/// Zooms about a point of the panel; factors below 1 zoom in.
void curves_zoom(struct curves *curves, struct core *core, float x, float y, double time_factor, double value_factor);

#endif

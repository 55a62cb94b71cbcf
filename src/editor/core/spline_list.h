/// What happens to the list of splines and to the scene's timing.
///
/// Whatever loses or moves something that nobody asked to be moved is asked about first.
#ifndef EDITOR_CORE_SPLINE_LIST_H
#define EDITOR_CORE_SPLINE_LIST_H

#include "editor/core/state.h"

/// The colour of a spline on the screen, 0xRRGGBBAA: its own, or the theme's in turn.
uint32_t spline_list_color(const struct document *document, int spline);
/// Whether the curves show a spline: those that are solo where any is, else those that are not hidden.
bool spline_list_shows(const struct core *core, int spline);
/// The active spline where the curves show it, else NULL.
const struct spline *spline_list_seen(const struct core *core);
/// After an edit, undo or redo: the active spline keeps being the same one, and the playhead stays on its frame.
void spline_list_refresh(struct core *core);
/// A new spline at the end of the list with its first knot at the playhead; it is active then.
void spline_list_add(struct core *core);
/// A copy of the active spline behind it; it is active then.
void spline_list_copy(struct core *core);
/// Moves a spline to another place in the list.
void spline_list_move(struct core *core, int spline, int to);
/// The number that a track gives at the playhead, inside of what the parameter takes.
double spline_list_present(const struct core *core, int spline, enum parameter parameter);
/// Deletes the active spline; asks where something follows it.
void spline_list_remove(struct core *core);
/// Sets frames per second; asks whether knots keep their frames or their seconds, where there are any.
void spline_list_fps(struct core *core, double fps);
/// Sets the range; asks what becomes of knots that would lie outside.
void spline_list_range(struct core *core, int first, int last);

#endif

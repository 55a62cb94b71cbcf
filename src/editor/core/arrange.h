/// What the editor does to the list of splines and to the scene's timing. Private to src/editor.
///
/// Whatever loses or moves something that nobody asked to be moved asks first, by dialog_ask().
#ifndef EDITOR_CORE_ARRANGE_H
#define EDITOR_CORE_ARRANGE_H

#include "editor/core/state.h"

/// The colour of a spline on the screen, 0xRRGGBBAA: its own, or the theme's in turn.
uint32_t arrange_color(const struct document *document, int spline);

/// Whether the curves show a spline: those that are solo where any is, else those that are not hidden.
bool arrange_shows(const struct editor *editor, const struct document *document, int spline);

/// The active spline where the curves show it, else NULL.
const struct spline *arrange_seen(const struct editor *editor, const struct editor_world *world);

/// After an edit, undo or redo: the active spline keeps being the same one, and the playhead stays on its frame.
void arrange_follow(struct editor *editor, const struct editor_world *world);

/// A new spline at the end of the list with its first knot at the playhead; it is active then.
void arrange_add(struct editor *editor, const struct editor_world *world);
/// A copy of the active spline behind it; it is active then.
void arrange_copy(struct editor *editor, const struct editor_world *world);
/// Deletes the active spline; asks where something follows it.
void arrange_remove(struct editor *editor, const struct editor_world *world);
/// The same without asking: tracks keep the value that they have at the playhead, channels and drives go with it.
void arrange_remove_now(struct editor *editor, const struct editor_world *world);
/// Moves a spline to another place in the list.
void arrange_move(struct editor *editor, const struct editor_world *world, int spline, int to);

/// The number that a track gives at the playhead, inside of what the parameter takes.
double arrange_present(const struct editor *editor, const struct editor_world *world, int spline,
                       enum parameter parameter);

/// Sets frames per second; asks whether knots keep their frames or their seconds, where there are any.
void arrange_fps(struct editor *editor, const struct editor_world *world, double fps);
/// How many knots a range would leave outside.
int arrange_outside(const struct document *document, int first, int last);
/// Sets the range; asks what becomes of knots that would lie outside.
void arrange_range(struct editor *editor, const struct editor_world *world, int first, int last);

#endif

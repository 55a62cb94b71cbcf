/// The body of the animal, taken hold of and moved over the ground. Private to src/editor.
#ifndef EDITOR_STAGE_BODY_H
#define EDITOR_STAGE_BODY_H

#include "editor/core/state.h"

/// The body under a point of the stage (HOVER_BODY), the nearest to the eye, or HOVER_NONE.
struct hover body_hover(const struct editor *editor, float x, float y);
/// A point of the screen where body_hover() finds that tail's body; false where it is hidden.
bool body_point(const struct editor *editor, int tail, float xy[2]);
/// Takes hold of a body: the drag is to begin.
void body_begin(struct editor *editor, int tail);
/// How far the running drag has moved a tail's base from where the document has it, metres; 0 for all others.
void body_offset(const struct editor *editor, int tail, double offset[3]);
/// The end of a drag, inside its step of the history: where `keep`, the document gets the new place (a number, or a knot at
/// the playhead where a spline is followed).
void body_release(struct editor *editor, const struct editor_world *world, bool keep);
/// A ring on the ground round the body that is held or can be.
void body_show(struct editor *editor);

#endif

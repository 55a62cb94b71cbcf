/// Follow-through of tails whose body is moved by hand: live, beside the solve. Private to src/editor.
#ifndef EDITOR_STAGE_FOLLOW_H
#define EDITOR_STAGE_FOLLOW_H

#include "editor/core/state.h"

/// `dt` seconds pass: the bases go where body_offset() says, and what hangs on them swings.
void follow_advance(struct editor *editor, const struct editor_world *world, double dt);
/// The document has taken the offset over: the base stands where it stood, which is no movement.
void follow_land(struct editor *editor, int tail);
/// Ends a tail's swing at once.
void follow_stop(struct editor *editor, int tail);
/// Whether anything still swings.
bool follow_is_moving(const struct editor *editor);
/// What is to be added to a channel's value now, y being 0.
wiggly_value follow_value(const struct editor *editor, int tail, int channel);

#endif

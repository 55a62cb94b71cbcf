/// Follow-through of tails whose body is moved by hand: live, beside the solve.
#ifndef EDITOR_STAGE_FOLLOW_H
#define EDITOR_STAGE_FOLLOW_H

#include "editor/stage/state.h"

/// `dt` seconds pass: the bases go where body_offset() says, and what hangs on them swings.
void follow_advance(struct stage *stage, const struct core *core, const struct editor_world *world, double dt);
/// The document has taken the offset over: the base stands where it stood, which is no movement.
void follow_land(struct stage *stage, int tail);
/// Ends a tail's swing at once.
void follow_stop(struct stage *stage, int tail);
/// What is to be added to a channel's value now, y being 0.
wiggly_value follow_value(const struct stage *stage, int tail, int channel);

#endif

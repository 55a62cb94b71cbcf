/// The tail, taken hold of and pulled.
#ifndef EDITOR_STAGE_GRAB_H
#define EDITOR_STAGE_GRAB_H

#include "editor/stage/state.h"

/// Takes hold of a tail; edits nothing until the pointer moves.
void grab_begin(struct stage *stage, struct core *core, const struct editor_world *world, const struct hover *hover);
/// One step towards the pointer; needs the pose of the last solved frame.
void grab_apply(struct stage *stage, struct core *core, const struct editor_world *world);

#endif

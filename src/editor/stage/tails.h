/// Tails on the stage, with what moves them by hand.
#ifndef EDITOR_STAGE_TAILS_H
#define EDITOR_STAGE_TAILS_H

#include "editor/stage/state.h"
#include "rig/posing.h"

/// Poses one tail with what is moved by hand; `change` may be NULL.
void stage_pose_tail(const struct stage *stage, const struct core *core, const struct editor_world *world, int tail,
                     double position, const struct what_if *change, struct rig_pose *pose);

#endif

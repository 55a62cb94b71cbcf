/// Posing tails, and where their points are on the screen.
#ifndef EDITOR_STAGE_STAGE_POSE_H
#define EDITOR_STAGE_STAGE_POSE_H

#include "editor/stage/state.h"
#include "rig/posing.h"

/// What rigs are posed from: the world, in the editor's look.
struct posing stage_posing(const struct core *core, const struct editor_world *world);
/// Poses one tail with what is moved by hand; `change` may be NULL.
void stage_pose_tail(const struct stage *stage, const struct core *core, const struct editor_world *world, int tail,
                     double position, const struct what_if *change, struct pose *pose);
/// The same as stage_project() of any pose.
bool stage_project_pose(const struct stage *stage, const struct core *core, const struct pose *pose, int joint,
                        double fraction, float xy[2]);

#endif

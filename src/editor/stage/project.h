/// What rigs are posed from, and where points of posed tails are on the screen.
#ifndef EDITOR_STAGE_PROJECT_H
#define EDITOR_STAGE_PROJECT_H

#include "editor/stage/state.h"
#include "rig/posing.h"

/// What rigs are posed from: the world, in the editor's look.
struct posing stage_posing(const struct core *core, const struct editor_world *world);
/// The same as stage_project() of any pose.
bool stage_project_pose(const struct stage *stage, const struct core *core, const struct pose *pose, int joint,
                        double fraction, float xy[2]);

#endif

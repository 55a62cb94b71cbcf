/// Soft characters on the stage.
#ifndef EDITOR_STAGE_CHARACTERS_H
#define EDITOR_STAGE_CHARACTERS_H

#include "editor/stage/state.h"

/// Poses them into the editor's stage view, with their shadows.
void characters_pose(struct stage *stage, const struct core *core, const struct editor_world *world);
/// Adds their motion over the whole scene to the box lo … hi; true where there is any.
bool characters_bounds(const struct core *core, const struct editor_world *world, float lo[3], float hi[3]);

#endif

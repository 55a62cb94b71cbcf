/// A rig as it is at another time, as lightly as can be: the outline of a tail or character, the line of a chain's bones.
#ifndef EDITOR_STAGE_PROXY_H
#define EDITOR_STAGE_PROXY_H

#include "editor/stage/state.h"
#include "rig/posing.h"

/// Draws the rig as it is on a sample; `tip` is where words about it may stand. false where it cannot be seen.
bool proxy_show(struct stage *stage, struct core *core, const struct posing *posing, int rig, int sample, float width,
                uint32_t color, float tip[2]);

#endif

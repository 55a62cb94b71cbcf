/// What a recorded motion becomes in the document.
#ifndef EDITOR_STAGE_RECORD_KEEP_H
#define EDITOR_STAGE_RECORD_KEEP_H

#include "editor/stage/state.h"

/// Makes the edits, in the open step: base splines for the coordinates that moved, and channels that follow them. Then forgets
/// the motion.
void record_keep(struct stage *stage, struct core *core, const struct editor_world *world);

#endif

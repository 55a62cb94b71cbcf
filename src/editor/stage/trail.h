/// The motion arc: where the tip of the tail goes.
#ifndef EDITOR_STAGE_TRAIL_H
#define EDITOR_STAGE_TRAIL_H

#include "editor/stage/state.h"

/// Motion arc (P): where the tip of the tail goes within two seconds of the playhead, with a mark at each frame.
void trail_show(struct stage *stage, struct core *core, const struct editor_world *world);

#endif

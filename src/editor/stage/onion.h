/// Onion skin: the tail at the knots around the playhead.
#ifndef EDITOR_STAGE_ONION_H
#define EDITOR_STAGE_ONION_H

#include "editor/stage/state.h"

/// The tail that the active spline moves, else the first; -1 where there is none to be seen.
int overlay_tail(const struct stage *stage, const struct core *core, const struct document *document);
/// Onion skin (O): the outline of the tail at the active spline's knots, those nearest to the playhead.
void onion_show(const struct stage *stage, struct core *core, const struct editor_world *world);

#endif

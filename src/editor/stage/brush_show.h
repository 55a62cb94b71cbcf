/// The ring of the brush, and its state.
#ifndef EDITOR_STAGE_BRUSH_SHOW_H
#define EDITOR_STAGE_BRUSH_SHOW_H

#include "editor/stage/state.h"

/// The ring on the surface, and above the legend what the brush does and what is painted at the pointer.
void brush_show(struct stage *stage, struct core *core, const struct editor_world *world);

#endif

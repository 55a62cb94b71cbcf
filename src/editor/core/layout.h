/// Where the panels are.
#ifndef EDITOR_CORE_LAYOUT_H
#define EDITOR_CORE_LAYOUT_H

#include "editor/core/state.h"

/// Rectangles of all panels for the window's size.
void core_layout(struct core *core);
/// Which divider is under a point, or DRAG_NONE.
enum drag_kind core_divider_at(const struct core *core, float x, float y);
/// Moves a divider to a point.
void core_divider_move(struct core *core, enum drag_kind kind, float x, float y);

#endif

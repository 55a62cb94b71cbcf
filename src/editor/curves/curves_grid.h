/// Grids, numbers and ruler.
#ifndef EDITOR_CURVES_CURVES_GRID_H
#define EDITOR_CURVES_CURVES_GRID_H

#include "editor/curves/state.h"

/// The corner left of the ruler, which says what it counts.
struct rect ruler_corner(const struct core *core);
/// Grids, numbers and ruler; part of curves_show().
void grid_show(const struct curves *curves, struct core *core, const struct editor_world *world);

#endif

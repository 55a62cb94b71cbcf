/// The slopes of the selected knots.
#ifndef EDITOR_CORE_SLOPES_H
#define EDITOR_CORE_SLOPES_H

#include "editor/core/state.h"

/// Adds `share` of the visible values a second to the slopes of the selected knots.
void nudge_slope(struct core *core, const struct editor_world *world, double share);
/// Makes the slopes of the selected knots firmer.
void nudge_stiffness(struct core *core, const struct editor_world *world, double factor);
/// Switches slopes on (as the curve runs there) or off.
void toggle_slope(struct core *core, const struct editor_world *world);
/// Level slopes for the selected knots.
void flatten_slopes(struct core *core, const struct editor_world *world);
/// Slopes towards the neighbours' as Catmull and Rom have it.
void smooth_slopes(struct core *core, const struct editor_world *world);

#endif

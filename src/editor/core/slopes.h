/// The slopes of the selected knots.
#ifndef EDITOR_CORE_SLOPES_H
#define EDITOR_CORE_SLOPES_H

#include "editor/core/state.h"

/// Adds `share` of the visible values a second to the slopes of the selected knots.
void slopes_turn(struct core *core, const struct editor_world *world, double share);
/// Makes the slopes of the selected knots firmer.
void slopes_stiffen(struct core *core, const struct editor_world *world, double factor);
/// Switches slopes on (as the curve runs there) or off.
void slopes_toggle(struct core *core, const struct editor_world *world);
/// Level slopes for the selected knots.
void slopes_flatten(struct core *core, const struct editor_world *world);
/// Slopes towards the neighbours' as Catmull and Rom have it.
void slopes_smooth(struct core *core, const struct editor_world *world);

#endif

/// Presenting: large type, and a stage that fills the window. Panels slide in over it when the pointer comes near, or on Tab.
#ifndef EDITOR_CORE_PRESENTER_H
#define EDITOR_CORE_PRESENTER_H

#include "editor/core/state.h"

/// Begins or ends it (F5).
void presenter_toggle(struct core *core, const struct editor_world *world, int argument);
/// Tab shows all panels or lets them go; true where the event is used up.
bool presenter_event(struct core *core, const struct event *event);
/// Time passes: panels slide; `busy`: those in sight stay.
void presenter_advance(struct core *core, double dt, bool busy);
/// Whether a panel is on its way.
bool presenter_is_sliding(const struct core *core);
/// Moves the panels of a layout to where they have slid to, and gives the stage the window.
void presenter_arrange(const struct presenter *presenter, struct layout *layout);

#endif

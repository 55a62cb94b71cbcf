/// Interface of the status line.
#ifndef EDITOR_TRANSPORT_TRANSPORT_H
#define EDITOR_TRANSPORT_TRANSPORT_H

#include "editor/core/state.h"

/// Where a control is: HOVER_PLAY … HOVER_PRESENT.
struct rect controls_rect(const struct core *core, enum hover_kind control);
/// Finds the item under a point of the status line.
struct hover transport_hover(const struct core *core, float x, float y);
/// A press or the wheel on a control; true where there is one.
bool transport_event(struct core *core, const struct event *event);
/// Time passes (editor_advance): the figures change at most twice a second, so that they cost no redraws.
void transport_advance(struct core *core, double dt);
/// A sentence on the control that the pointer is on: of playback, of the ruler's units. NULL: none.
const char *transport_hint(const struct core *core);
/// Draws the status line; `hint` stands where there is no message, NULL: one on the item under the pointer.
void transport_show(struct core *core, const char *hint);

#endif

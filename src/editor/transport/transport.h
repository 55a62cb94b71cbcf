/// Interface of the status line.
#ifndef EDITOR_TRANSPORT_TRANSPORT_H
#define EDITOR_TRANSPORT_TRANSPORT_H

#include "editor/core/state.h"

/// The rectangle of a control: HOVER_PLAY … HOVER_PRESENT.
struct rect controls_rect(const struct core *core, enum hover_kind control);
struct hover transport_hover(const struct core *core, float x, float y);
/// A press or the wheel on a control; true if used.
bool transport_event(struct core *core, const struct event *event);
/// The figures change at most twice a second, to save redraws.
void transport_advance(struct core *core, double dt);
/// A sentence on the control under the pointer; NULL: none.
const char *transport_hint(const struct core *core);
/// Draws the status line. Without a message it shows `hint`, or if that is NULL a hint on the item under the pointer.
void transport_show(struct core *core, const char *hint);

#endif

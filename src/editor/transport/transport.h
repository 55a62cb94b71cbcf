/// Interface of the status line.
#ifndef EDITOR_TRANSPORT_TRANSPORT_H
#define EDITOR_TRANSPORT_TRANSPORT_H

#include "editor/core/state.h"
#include "ui/widgets.h"

/// A press or the wheel on a control.
void transport_event(struct ui *ui, struct core *core, const struct event *event);
/// Finds a control by name: "play", "loop", "speed", "auto-key", "keep", "size", "present". false if it is not visible.
bool transport_target(struct ui *ui, struct core *core, const char *name, float *x, float *y);
/// The figures change at most twice a second, to save redraws.
void transport_advance(struct core *core, double dt);
/// Draws the status line. Without a message it shows `hint`, or if that is NULL one on the control under the pointer or on the scene.
void transport_show(struct ui *ui, struct core *core, const char *hint);

#endif

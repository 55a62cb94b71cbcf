/// Scaling the selected knots.
#ifndef EDITOR_CURVES_SCALE_H
#define EDITOR_CURVES_SCALE_H

#include "editor/core/drag.h"
#include "editor/curves/state.h"

/// Makes the edits for where the pointer is now.
void scale_apply(struct curves *curves, struct core *core, const struct editor_world *world);
/// The pivot, and the line from it to the pointer.
void scale_show(const struct curves *curves, struct core *core);
/// Events while it runs, but the pointer's: axes, pivot, a typed factor, the end; true where the event is used up.
enum drag_answer scale_event(struct curves *curves, struct core *core, const struct editor_world *world,
                             const struct event *event);

#endif

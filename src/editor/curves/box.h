/// Selecting knots by a box.
#ifndef EDITOR_CURVES_BOX_H
#define EDITOR_CURVES_BOX_H

#include "editor/curves/state.h"

/// Starts to select knots of the active spline by a box; Shift adds them, Ctrl or Alt removes them.
void box_begin(struct curves *curves, struct core *core, const struct event *event);
/// Selects what is in the box as it is now.
void box_update(const struct curves *curves, struct core *core, const struct editor_world *world);
/// Ends it: a press that did not move was a click on empty; `keep` false brings the former selection back.
void box_end(struct curves *curves, struct core *core, bool keep);
/// The box while it grows.
void box_show(const struct curves *curves, struct core *core);

#endif

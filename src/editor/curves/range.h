/// The part that is played, on the ruler and in the plot.
#ifndef EDITOR_CURVES_RANGE_H
#define EDITOR_CURVES_RANGE_H

#include "editor/curves/state.h"

/// Starts to choose the part that is played.
void range_begin(struct core *core, const struct event *event);
/// The part goes from where the drag began to the pointer.
void range_drag(const struct curves *curves, struct core *core, const struct document *document, float x);
/// A press that did not move plays all again; `keep` false brings the former part back.
void range_end(struct core *core, bool keep);
/// Marks the part on the ruler; nothing where all is played.
void range_show_ruler(const struct curves *curves, struct core *core, const struct document *document);
/// Tints the part in the plot.
void range_show_plot(const struct curves *curves, struct core *core, const struct document *document);

#endif

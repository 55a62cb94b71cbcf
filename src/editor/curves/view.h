/// What part of time and value is shown.
#ifndef EDITOR_CURVES_VIEW_H
#define EDITOR_CURVES_VIEW_H

#include "editor/curves/state.h"

/// Logical pixels a frame.
double curves_pixels_per_frame(const struct curves *curves, const struct core *core);
/// Logical pixels a unit of value.
double curves_pixels_per_value(const struct curves *curves, const struct core *core);
/// Logical pixels to frame.
double curves_frame(const struct curves *curves, const struct core *core, double x);
/// Logical pixels to value.
double curves_value(const struct curves *curves, const struct core *core, double y);
/// Shows the values v that were shown as scale·v + offset.
void view_rescale(struct curves *curves, struct core *core, double scale, double offset);

#endif

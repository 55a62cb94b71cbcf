/// Curves of unlike sizes in one panel.
#ifndef EDITOR_CURVES_NORMAL_H
#define EDITOR_CURVES_NORMAL_H

#include "editor/curves/state.h"

/// Where a spline's values are drawn.
struct value_map normal_map(const struct curves *curves, const struct core *core, int spline);
/// Height of a value of any spline that is drawn: the others are scaled where curves are normalised.
float curves_y_of(const struct curves *curves, const struct core *core, int spline, double value);
/// Measures the curves that are to be normalised; while a drag runs nothing is, so that what is not touched stays.
void normal_update(struct curves *curves, const struct core *core, const struct editor_world *world);

#endif

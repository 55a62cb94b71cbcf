/// The polylines of the solved splines.
#ifndef EDITOR_CURVES_CURVES_CACHE_H
#define EDITOR_CURVES_CURVES_CACHE_H

#include "editor/curves/state.h"

/// Rebuilds the polylines where document, view or layout changed since; allocates nothing.
void curves_update(struct curves *curves, struct core *core, const struct editor_world *world);

#endif

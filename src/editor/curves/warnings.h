/// What the active spline does that nobody wants, and where.
#ifndef EDITOR_CURVES_WARNINGS_H
#define EDITOR_CURVES_WARNINGS_H

#include "editor/curves/state.h"

/// Finds what is wrong with a solved spline. At most WARNINGS_MAX, spans in the order of time.
void warnings_find(const struct document *document, const struct evaluation *evaluation, int of,
                   struct warnings *found);
/// The same for the active spline where document or look have changed since; allocates nothing.
void warnings_update(struct curves *curves, const struct core *core, const struct editor_world *world);

#endif

/// Sets of ids: selected knots, hidden splines.
#ifndef EDITOR_CORE_SELECTION_H
#define EDITOR_CORE_SELECTION_H

#include "editor/core/state.h"

/// Whether an id is selected.
bool selection_has(const struct selection *selection, unsigned id);
/// Selects or deselects an id.
void selection_set(struct selection *selection, unsigned id, bool selected);
/// Deselects everything.
void selection_clear(struct selection *selection);
/// Forgets the ids from `id` on, which will be given again.
void selection_drop_from(struct selection *selection, unsigned id);
/// How many of a spline's knots are selected.
int selection_count(const struct selection *selection, const struct spline *spline);
/// Index of the only selected knot of the spline, or -1.
int selection_single(const struct selection *selection, const struct spline *spline);
/// Selects the same ids.
void selection_copy(struct selection *to, const struct selection *from);

#endif

/// Inserting, deleting and choosing knots.
#ifndef EDITOR_CORE_KNOTS_H
#define EDITOR_CORE_KNOTS_H

#include "editor/core/state.h"

/// A number for history_begin(): the same for the same kind of nudge of the same knots.
uint64_t core_merge_key(const struct core *core, const struct editor_world *world, uint64_t kind);
/// A knot on a frame (whole frames when `snap`), selected; where there is one already, that one is selected.
void core_insert_knot(struct core *core, const struct editor_world *world, double frame, double value, bool snap);
/// A knot that leaves the curve where it is, with its slope there too (eq. 9) where `slope` is set.
void core_insert_on_curve(struct core *core, const struct editor_world *world, double frame, bool snap, bool slope);
/// Removes the selected knots as a step of that name.
void core_remove_knots(struct core *core, const struct editor_world *world, const char *label);
/// Removes the selected knots.
void core_delete_knots(struct core *core, const struct editor_world *world);
/// Selects all knots of the active spline.
void core_select_all(struct core *core, const struct editor_world *world);
/// Selects the selected knot's neighbour (from the playhead where not just one is selected); NULL where there is none.
const struct knot *core_select_neighbour(struct core *core, const struct editor_world *world, int direction);
/// The knot after the last selected one (1), or before the first one (-1), is selected besides; NULL where there is none.
const struct knot *core_extend_selection(struct core *core, const struct editor_world *world, int direction);
/// The next spline in the list (1) or the one before (-1) becomes active, round the end.
void core_activate_neighbour(struct core *core, const struct editor_world *world, int direction);

#endif

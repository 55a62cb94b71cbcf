/// Edits of the selected knots of all splines.
#ifndef EDITOR_CORE_KNOTS_H
#define EDITOR_CORE_KNOTS_H

#include "editor/core/core.h"

/// Inserts and selects a value or a pose at a frame (whole if `snap`), or selects the knot there. Value NAN: where the curve is; without wind-up,
/// between knots, the curve stays as it is.
void core_insert_knot(struct core *core, double frame, double value, bool snap, enum holds holds);
/// Deletes the selected pin, else the selected knots.
void core_delete(struct core *core);
/// Selects a knot and nothing else, not even a pin.
void core_select_only(struct core *core, unsigned id);
/// Selects the active spline's knots, or those of all shown splines.
void core_select_all(struct core *core, int all_splines);
/// Selects the neighbour of the selected knot, or of the playhead if not exactly one is selected; NULL if none.
const struct knot *core_select_neighbour(struct core *core, int direction);
/// Selects the next knot after the playhead (1) or before it (-1) and goes there; NULL if none.
const struct knot *core_visit_neighbour(struct core *core, int direction);
/// Adds the knot after the last selected one (1) or before the first (-1) to the selection; NULL if none.
const struct knot *core_extend_selection(struct core *core, int direction);
/// Lets the motion settle at the selected knots, or if it does at all of them, at none. Still knots have no value to settle at.
void core_toggle_settles(struct core *core);
/// Makes the selected knots hold that where the curves are now. If all do already, they hold a value only.
void core_set_hold(struct core *core, int holds);

/// Changes of the selected knots' slopes: on as the curve runs, or off; level; aimed at the neighbours (Catmull-Rom); turned in proportion to
/// the visible values; stiffer or less.
enum slopes { SLOPES_TOGGLE, SLOPES_FLAT, SLOPES_SMOOTH, SLOPES_UP, SLOPES_DOWN, SLOPES_FIRMER, SLOPES_SOFTER };
void slopes_set(struct core *core, int how);

/// Copies the selected knots as text; `cut` also deletes them. false if none is selected.
bool core_copy_knots(struct core *core, bool cut);
/// Turns the selected knots upside down about zero.
void core_mirror_knots(struct core *core);
/// Begins to simplify the active spline, or of its knots the selected ones if these are several; or ends it (0). Until then,
/// core_simplify_advance() applies the chosen tolerance once a frame.
void core_simplify(struct core *core, int on);
void core_simplify_advance(struct core *core);
/// Moves the selected knots half way to a cubic through the others; those at the ends of a row stay.
void core_smooth_knots(struct core *core);

/// Pastes knots, the first at the playhead with the others at their distances, and selects them; at their own frames or upside down if
/// input.paste says so, once. If one does not fit, none is pasted.
void core_paste_knots(struct core *core, const char *text);
/// Inserts copies of the selected knots after them and selects the copies.
void core_duplicate_knots(struct core *core);

#endif

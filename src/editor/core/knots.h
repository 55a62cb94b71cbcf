/// Edits of the selected knots of all splines, their slopes, and the parameters of the active spline.
#ifndef EDITOR_CORE_KNOTS_H
#define EDITOR_CORE_KNOTS_H

#include "editor/core/state.h"

/// The merge key for history_begin(): equal for equal kinds of nudges of the same knots, so that these are one undo step.
uint64_t core_merge_key(const struct core *core, uint64_t kind);
/// A knot on a frame (whole frames when `snap`), selected; where there is one already, that one is selected.
void core_insert_knot(struct core *core, double frame, double value, bool snap);
/// A pose that leaves the curve where it is, with its slope there too (eq. 9) where `slope` is set.
void core_insert_on_curve(struct core *core, double frame, bool snap, bool slope);
/// Removes the selected knots as a step of that name.
void core_remove_knots(struct core *core, const char *label);
/// Removes the selected pin, else the selected knots.
void core_delete(struct core *core, int unused);
/// Selects all knots of the active spline, or of all that are shown.
void core_select_all(struct core *core, int all_splines);
/// Selects the selected knot's neighbour (from the playhead where not just one is selected); NULL where there is none.
const struct knot *core_select_neighbour(struct core *core, int direction);
/// Selects the first knot after the playhead (1), or the last one before it (-1), and goes there; NULL where there is none.
const struct knot *core_visit_neighbour(struct core *core, int direction);
/// Also selects the knot after the last selected one (1) or before the first one (-1); NULL if there is none.
const struct knot *core_extend_selection(struct core *core, int direction);
/// Activates the next spline in the list (1) or the previous one (-1), wrapping round.
void core_activate_neighbour(struct core *core, int direction);

/// What a knot holds: its value, a pose (value and phase), or that the motion is still.
enum holds { HOLDS_VALUE, HOLDS_POSE, HOLDS_STILL };
static inline enum holds knot_holds(const struct knot *knot)
{
    return knot->still ? HOLDS_STILL : knot->has_phase ? HOLDS_POSE : HOLDS_VALUE;
}
/// Lets the selected knots hold that, as the curves run there now; where all of them hold it, their value alone.
void core_set_hold(struct core *core, int holds);

/// Turns the slopes of the selected knots up (1) or down (-1), in proportion to the values in sight.
void slopes_turn(struct core *core, int direction);
/// Makes them firmer (1) or softer (-1).
void slopes_stiffen(struct core *core, int direction);

enum slopes { SLOPES_TOGGLE, SLOPES_FLAT, SLOPES_SMOOTH };

/// Switches them on, as the curve runs there, or off; makes them level; or aims them at the neighbours (Catmull-Rom).
void slopes_set(struct core *core, int how);

/// Gives the active spline the frequency and damping that explain its knots best; if it has these already, the runner-up's.
void core_find_frequency(struct core *core, int unused);

/// The channel of a tail or chain that the active spline moves, the first of all where it moves none; NULL where there is none at all.
const struct channel *core_active_channel(const struct core *core, int *rig, int *channel);
/// Where a parameter's slider ends; 0: it has none.
double core_slider_end(const struct document *document, const struct spline *spline, enum parameter parameter);
/// Where a limit begins that is switched on: a little beyond the knots.
double core_fresh_limit(const struct spline *spline, enum parameter parameter);
/// Changes the parameter whose letter is held, or with L the lag, by its step.
void core_nudge_parameter(struct core *core, int direction);
/// The next word of a parameter that is a choice, after the last the first again.
void core_cycle_choice(struct core *core, int parameter);

/// The selected knots as text for the clipboard; `cut` also deletes them. false where there is nothing to copy.
bool core_copy_knots(struct core *core, bool cut);
/// Knots from text: the first one at the playhead, the others as far behind it as they are in the text; selected. All or, where
/// one would not fit, none.
void core_paste_knots(struct core *core, const char *text);
/// Inserts copies of the selected knots after them, and selects the copies.
void core_duplicate_knots(struct core *core);

#endif

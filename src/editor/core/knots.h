/// Edits of the selected knots of all splines, their slopes, and the active spline's parameters.
#ifndef EDITOR_CORE_KNOTS_H
#define EDITOR_CORE_KNOTS_H

#include "editor/core/state.h"

/// A merge key for history_begin() that makes equal nudges of the same knots one undo step.
uint64_t core_merge_key(const struct core *core, uint64_t kind);
/// Inserts and selects a knot at a frame (whole if `snap`), or selects the one there.
void core_insert_knot(struct core *core, double frame, double value, bool snap);
/// Inserts a knot where the curve is, or a pose. Without wind-up, between knots, the curve stays as it is.
void core_insert_on_curve(struct core *core, double frame, bool snap, bool pose);
/// Deletes the selected knots in a step `label`.
void core_remove_knots(struct core *core, const char *label);
/// Deletes the selected pin, else the selected knots.
void core_delete(struct core *core, int unused);
/// Selects the active spline's knots, or those of all shown splines.
void core_select_all(struct core *core, int all_splines);
/// Selects the neighbour of the selected knot, or of the playhead if not exactly one is selected; NULL if none.
const struct knot *core_select_neighbour(struct core *core, int direction);
/// Selects the next knot after the playhead (1) or before it (-1) and goes there; NULL if none.
const struct knot *core_visit_neighbour(struct core *core, int direction);
/// Adds the knot after the last selected one (1) or before the first (-1) to the selection; NULL if none.
const struct knot *core_extend_selection(struct core *core, int direction);
/// Activates the next (1) or previous (-1) spline, cyclically.
void core_activate_neighbour(struct core *core, int direction);

/// What a knot holds: a value, a pose (value and phase), or stillness.
enum holds { HOLDS_VALUE, HOLDS_POSE, HOLDS_STILL };
static inline enum holds knot_holds(const struct knot *knot)
{
    return knot->still ? HOLDS_STILL : knot->has_phase ? HOLDS_POSE : HOLDS_VALUE;
}
/// Lets the motion settle at the selected knots, or if it does at all of them, at none. Still knots have no value to settle at.
void core_toggle_settles(struct core *core, int unused);
/// Makes the selected knots hold that where the curves are now. If all do already, they hold a value only.
void core_set_hold(struct core *core, int holds);

/// Increases (1) or decreases (-1) the selected knots' slopes, in proportion to the visible values.
void slopes_turn(struct core *core, int direction);
/// Increases (1) or decreases (-1) their stiffness.
void slopes_stiffen(struct core *core, int direction);

enum slopes { SLOPES_TOGGLE, SLOPES_FLAT, SLOPES_SMOOTH };

/// Turns slopes on as the curve runs, or off; makes them level; or aims them at the neighbours (Catmull-Rom).
void slopes_set(struct core *core, int how);

/// Sets the frequency and damping that explain the knots best, or second best if those are set already.
void core_find_frequency(struct core *core, int unused);

/// The rig that Feel acts on as a whole: the one chosen last, while the active spline bends or drives it; -1: the active spline alone.
int core_limb(const struct core *core);
/// Sets a parameter of the active spline. Frequency, damping and wind-up also change for the limb's (-1: none) other splines that use
/// them: to the same value if `alike`, else by core_in_step(). What follows a spline still does. Edits.
bool core_set_felt(struct core *core, int limb, enum parameter parameter, double value, bool alike,
                   struct error *error);
/// Sets a channel's lag, and scales those of the limb's other channels that bend. Edits.
bool core_set_lag(struct core *core, int limb, struct channel_place at, const struct angles *lag,
                  struct error *error);
/// A number changed by the factor that took another from `before` to `now`. From 0 there is none: a 0 becomes `now`, others stay.
double core_in_step(double other, double before, double now);

/// The channel the active spline moves, of the limb if possible, else the first channel of all; NULL if there are none.
const struct channel *core_active_channel(const struct core *core, int *rig, int *channel);
/// End of a parameter's slider; 0: none.
double core_slider_end(const struct document *document, const struct spline *spline, enum parameter parameter);
/// Initial value of a limit: a little beyond the knots.
double core_fresh_limit(const struct spline *spline, enum parameter parameter);
/// Steps the parameter whose letter is held, or with L the lag.
void core_nudge_parameter(struct core *core, int direction);
/// Goes to the next choice of a parameter, cyclically.
void core_cycle_choice(struct core *core, int parameter);

/// Lets the active spline's motion settle at all of its knots, or if it does, at none.
void core_toggle_pose_to_pose(struct core *core, int unused);

/// Copies the selected knots as text; `cut` also deletes them. false if none is selected.
bool core_copy_knots(struct core *core, bool cut);
/// Pastes knots, the first at the playhead with the others at their distances, and selects them. If one does not fit, none is pasted.
void core_paste_knots(struct core *core, const char *text);
/// Inserts copies of the selected knots after them and selects the copies.
void core_duplicate_knots(struct core *core);

#endif

/// Edits of splines: their list, timing and parameters.
#ifndef EDITOR_CORE_SPLINES_H
#define EDITOR_CORE_SPLINES_H

#include "editor/core/state.h"

/// Activates the next (1) or previous (-1) spline, cyclically.
void core_activate_neighbour(struct core *core, int direction);

/// Appends a spline with a knot at the playhead and activates it. The others act on the chosen splines: copies them, removes them (and asks if
/// something follows them), moves them in the list, flips what shows and locks them, puts them into a folder or takes them out.
enum list_change {
    LIST_ADD,
    LIST_COPY,
    LIST_REMOVE,
    LIST_UP,
    LIST_DOWN,
    LIST_FOLDER,
    LIST_SOLO,
    LIST_HIDE,
    LIST_LOCK
};
void spline_list_change(struct core *core, int change);
/// Moves the chosen splines before the one at an index, into a folder (NULL: none).
void spline_list_place(struct core *core, int to, const char *folder);
/// The row of splines first … end − 1, a folder's or one. Whether it acts on a spline, too: that is among them, or selected as the one is.
bool spline_list_acts(const struct core *core, int first, int end, int spline);
/// Shows that row's splines alone, hides or locks them; or no longer.
void spline_list_flip(struct core *core, enum list_change change, int first, int end);
/// Whether two splines, which may lie outside the list, are in one folder.
bool spline_list_together(const struct document *document, int a, int b);
/// Value of a track at the playhead, within the parameter's limits.
double spline_list_present(const struct core *core, int spline, enum parameter parameter);
/// Sets the frame rate; asks whether knots keep their frames or seconds.
void spline_list_fps(struct core *core, double fps);
/// Sets the range; asks whether to move or delete knots outside.
void spline_list_range(struct core *core, int first, int last);

/// How many curves do not end as they start, so that looping playback jumps.
int core_open_curves(const struct core *core);
/// Closes all curves: each ends as it starts. A knot on the last frame goes, because that frame then repeats the first.
void core_close_curves(struct core *core);

/// Sets the frequency and damping that explain the knots best, or second best if those are set already.
void core_find_frequency(struct core *core);

enum { LIMB_NONE = -1, LIMB_ROWS = -2 };
/// What Feel acts on, whichever was chosen last: LIMB_ROWS, several rows of the list; a rig, while the active spline bends or drives it; or LIMB_NONE,
/// the active spline alone.
int core_limb(const struct core *core);
/// Whether a spline is one of a limb's.
bool core_is_felt(const struct core *core, int limb, int spline);
/// Sets a parameter of the active spline. Frequency, damping and wind-up also change for the limb's other splines that use
/// them: to the same value if `alike`, else by core_in_step(). What follows a spline still does. Edits.
bool core_set_felt(struct core *core, int limb, enum parameter parameter, double value, bool alike,
                   struct error *error);
/// Sets a channel's lag, and scales those of the limb's other channels that bend, of rows those that they drive. Edits.
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
/// Steps the frequency while F is held, with Z the damping, with L the lag.
void core_nudge_parameter(struct core *core, int direction);
/// Goes to the next kind of spline, cyclically.
void core_cycle_mode(struct core *core);

/// Lets the motion of a limb settle at all of its knots, which then hold values alone; or if the active spline does, at none. The second: of the
/// limb that Feel acts on.
void core_pose_to_pose(struct core *core, int limb);
void core_toggle_pose_to_pose(struct core *core);

#endif

/// The core of the editor: edits, messages, requests to the app, the active spline and the list of all, where the panels are, playing.
///
/// Asks before an edit loses or moves something else.
#ifndef EDITOR_CORE_CORE_H
#define EDITOR_CORE_CORE_H

#include "editor/core/state.h"

/// A new document: resets selection, playhead and views.
void core_open(struct core *core);
/// The path of the document's own file, "" for none.
void core_set_path(struct core *core, const char *path);
/// A spline was edited, or where it is -1, its selected knots were.
void core_edited(struct core *core, int spline);
/// Opens a step, whose edits say why they fail in core->error, and clears the last message; `merge` as in history_begin(). false while another step is open: that of a
/// drag is not to be mixed with others.
bool core_begin(struct core *core, const char *label, uint64_t merge);
/// Closes the step, taken back where it is not `done`, which is returned.
bool core_end(struct core *core, bool done);
/// After edits: the editor follows the document, and core->error goes to the status line.
void core_settle(struct core *core);
/// An edit: gives a parameter of a spline a value, which stops it from following another.
bool core_set_parameter(struct core *core, int spline, enum parameter parameter, double value);
/// A parameter of a spline at a sample, in its range, also where it follows another spline.
double core_parameter_at(const struct core *core, const struct spline *spline, enum parameter parameter, int sample);
/// An edit: sets a knot, or inserts it where its id is 0.
bool core_put_knot(struct core *core, int spline, const struct knot *knot);
/// The knot on a sample, or a new one with id 0 for it, to be given a value: not still.
struct knot core_knot_at(const struct document *document, int spline, int sample);
/// After undo, redo and another document: see editor_refresh().
void core_refresh(struct core *core);
/// Undoes the last step (direction -1), or does the next one again (1).
void core_undo(struct core *core, int direction);
/// Undoes or redoes until `done` of the history's steps are done.
void core_jump(struct core *core, size_t done);
/// Asks the app for something; `path` may be NULL.
void core_request(struct core *core, enum request_kind kind, const char *path);
/// A question of core's own, to be given its words: asked after the event.
struct question *core_ask(struct core *core, const struct answer *answers, int count,
                          void (*answered)(void *dialogs, struct core *core, int answer));
/// Shows a sentence in the status line (an error until the next key or click, else for some seconds of `dt`).
void core_message(struct core *core, bool is_error, const char *text);
/// Puts a knot within the limits of its spline. Where one holds it, says so: "held by the limit 1.2 of sway at frame 14".
void core_hold(const struct spline *spline, struct knot *knot, char why[STOPPED_SIZE]);
/// Where a knot is shown: at its value; a still one on its curve.
double core_knot_value(const struct core *core, int spline, const struct knot *knot);
/// Appends the reason why an edit stopped to a sentence; nothing for "".
void core_add_stopped(const char *why, char *text, size_t size);
/// Shows in the status line why an edit stopped.
void core_stopped(struct core *core, const char *why);
/// The active spline, or NULL.
struct spline *core_active_spline(const struct core *core);
/// Makes a spline the active one, which drops the selection.
void core_activate(struct core *core, int spline);
/// The same, but keeps the selection.
void core_turn_to(struct core *core, int spline);
/// Switches, by keys and on the screen.
enum core_switch {
    SWITCH_SNAP,
    SWITCH_AUTO_KEY,
    SWITCH_LOOP,
    SWITCH_ONION,
    SWITCH_TRAIL,
    SWITCH_GHOST,
    SWITCH_SHEET,
    SWITCH_PHASE,
    SWITCH_MORE,
    SWITCH_SECONDS,
    SWITCH_NORMALISE,
    SWITCH_RECORD,
    SWITCH_PHASE_MAP,
    SWITCH_TWIN
};
/// Flips one of them, and says so.
void core_flip(struct core *core, int which);
/// Chooses how the knots are shown, and says so.
void core_set_look(struct core *core, enum look look);
void core_turn_look(struct core *core, int unused);
/// Frame (fractional) that is shown.
double core_frame(const struct core *core);
/// Position in samples (fractional) of a frame.
double core_position(const struct document *document, double frame);
/// Rounds to a multiple of the power of ten at or below `resolution` (> 0): no more decimals than a mouse can mean, so that
/// files keep short numbers.
double core_round(double value, double resolution);
/// The panel that is uppermost at a point.
enum panel core_panel_at(const struct core *core, float x, float y);
/// Sets the panels' sizes: the stage's share of the height, the inspector's width.
void core_set_panels(struct core *core, double stage_share, double inspector_width);
/// Rectangles of all panels for the window's size.
void core_layout(struct core *core);
/// Which divider is under a point, or DIVIDER_NONE.
enum divider core_divider_at(const struct core *core, float x, float y);
/// Moves a divider to a point.
void core_divider_move(struct core *core, enum divider divider, float x, float y);

/// Begins or ends it (F5).
void presenter_toggle(struct core *core, int argument);
/// Tab shows all panels or lets them go; true where the event is used up.
bool presenter_event(struct core *core, const struct event *event);
/// Time passes: panels slide; `busy`: those in sight stay.
void presenter_advance(struct core *core, double dt, bool busy);
/// Whether a panel is on its way.
bool presenter_is_sliding(const struct core *core);

/// Plays or pauses.
void playback_toggle(struct core *core);
/// Advances by `dt` seconds of the real clock. Counts the scene frames that a late picture skipped.
void playback_advance(struct core *core, double dt);
/// Stops at a frame.
void playback_seek(struct core *core, double frame);
/// Stops and goes to the next whole frame in a direction.
void playback_step(struct core *core, int direction);
/// Stops and goes to an end of the range.
void playback_end(struct core *core, int direction);
/// The next faster (direction 1) or slower speed, 0.1 … 4 times real time; 0: real time.
void playback_change_speed(struct core *core, int direction);

/// First and last frame that are played: the part that was chosen, as far as the scene has it, else all.
void playback_range(const struct core *core, double range[2]);
/// Whether less than the whole scene is played.
bool playback_is_part(const struct core *core);
/// Sets the part; an empty one, or one that holds everything, is none.
void playback_choose(struct core *core, double first, double last);
/// Says which part is played.
void playback_say_range(struct core *core);
/// Sets the part's beginning (0) or end (1) to the playhead's frame.
void playback_mark(struct core *core, int end);

/// The colour of a spline on the screen, 0xRRGGBBAA: its own, or the theme's in turn.
uint32_t spline_list_color(const struct document *document, int spline);
/// Whether the curves show a spline: those that are solo where any is, else those that are not hidden.
bool spline_list_shows(const struct core *core, int spline);
/// Turns a spline solo or hidden, or back: `set` is the core's `solo` or `hidden`.
void spline_list_flip(struct core *core, struct selection *set, int spline);
/// The active spline where the curves show it, else NULL.
const struct spline *spline_list_seen(const struct core *core);
/// After an edit, undo or redo: the active spline keeps being the same one, and the playhead stays on its frame.
void spline_list_refresh(struct core *core);
/// A new spline at the end of the list with its first knot at the playhead; it is active then.
void spline_list_add(struct core *core);
/// A copy of the active spline behind it; it is active then.
void spline_list_copy(struct core *core);
/// Moves a spline to another place in the list.
void spline_list_move(struct core *core, int spline, int to);
/// Value of a track at the playhead, within the parameter's limits.
double spline_list_present(const struct core *core, int spline, enum parameter parameter);
/// Deletes the active spline; asks where something follows it.
void spline_list_remove(struct core *core);
/// Sets frames per second; asks whether knots keep their frames or their seconds, where there are any.
void spline_list_fps(struct core *core, double fps);
/// Sets the range; asks whether to move or delete knots that would lie outside.
void spline_list_range(struct core *core, int first, int last);

#endif

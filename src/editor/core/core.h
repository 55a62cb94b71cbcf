/// The core of the editor: edits, messages, requests to the app, splines, layout, playback. It asks before an edit loses or moves something
/// else.
#ifndef EDITOR_CORE_CORE_H
#define EDITOR_CORE_CORE_H

#include "editor/core/state.h"

/// Resets selection, playhead and views for a new document.
void core_open(struct core *core);
/// Sets the path of the document's file, or "".
void core_set_path(struct core *core, const char *path);
/// Notes an edit of a spline, or of its selected knots if it is -1.
void core_edited(struct core *core, int spline);
/// Opens the undo step for the edits that follow, and clears the last message; `merge` as in history_begin(). The end of the event closes it.
/// An edit that fails writes core->error, and all of the step is reverted. false while a drag's step is open, because others must not mix with it.
bool core_step(struct core *core, const char *label, uint64_t merge);
/// Closes the step of this event, if any. editor_settle() calls it; a drag's step stays open.
void core_close(struct core *core);
/// Call after edits in a drag: the editor follows the document, and core->error goes to the status line.
void core_settle(struct core *core);
/// Notes the phases that an open step keeps; call it when the step opens.
void core_keep_phases(struct core *core);
/// Call after edits in an open step: of each spline that winds up and whose knots have changed, the next free knot becomes a pose with the phase
/// it had when the step began. So nothing changes beyond it. Not in a drag with Alt held, or if that is switched off.
void core_keep_following(struct core *core);
/// Sets a spline's parameter, which then no longer follows another spline. Edits.
bool core_set_parameter(struct core *core, int spline, enum parameter parameter, double value);
/// A parameter's value at a sample, clamped to its range, even if it follows another spline.
double core_parameter_at(const struct core *core, const struct spline *spline, enum parameter parameter, int sample);
/// Sets a knot, or inserts it if its id is 0. Edits.
bool core_put_knot(struct core *core, int spline, const struct knot *knot);
/// The knot at a sample, or a new one with id 0.
struct knot core_knot_at(const struct document *document, int spline, int sample);
/// Call after undo, redo and a new document: see editor_refresh().
void core_refresh(struct core *core);
/// Undoes (-1) or redoes (1) a step.
void core_undo(struct core *core, int direction);
/// Undoes or redoes until `done` steps are done.
void core_jump(struct core *core, size_t done);
/// `path` may be NULL.
void core_request(struct core *core, enum request_kind kind, const char *path);
/// A question to ask after the event; the caller fills in its text.
struct question *core_ask(struct core *core, const struct answer *answers, int count,
                          void (*answered)(void *dialogs, struct core *core, int answer));
/// Shows a message in the status line: an error until the next key or click, others for some seconds.
void core_message(struct core *core, bool is_error, const char *format, ...) __attribute__((format(printf, 3, 4)));
/// Moves a knot within its spline's limits. `why` says what held it: "held by the limit 1.2 of sway at frame 14".
void core_hold(const struct spline *spline, struct knot *knot, char why[STOPPED_SIZE]);
/// The knot's drawn value; for a still one, its curve's.
double core_knot_value(const struct core *core, int spline, const struct knot *knot);
/// Appends the reason an edit stopped to a sentence, unless it is "".
void core_add_stopped(const char *why, char *text, size_t size);
/// Shows the reason an edit stopped in the status line.
void core_stopped(struct core *core, const char *why);
struct spline *core_active_spline(const struct core *core);
/// Activates a spline and clears the selection.
void core_activate(struct core *core, int spline);
/// The same for a spline chosen by itself: Feel then acts on no other.
void core_choose(struct core *core, int spline);
/// Activates a spline and keeps the selection.
void core_turn_to(struct core *core, int spline);
/// Keeps the scene as "before", solved once; or forgets it (0).
void take_keep(struct core *core, int keep);
/// Whether it is shown: K is held, and no edit is open. And whether on the stage, too: its rigs and samples are those of now.
bool take_is_shown(const struct core *core);
bool take_is_posed(const struct core *core);
/// What a spline or rig was before: the spline's index there, or -1; the rig, or NULL.
int take_spline(const struct core *core, int spline);
const struct rig *take_rig(const struct core *core, int rig);
/// Says why K does not show it.
void take_explain(struct core *core);
/// The switches of core_flip().
enum core_switch {
    SWITCH_SNAP,
    SWITCH_AUTO_KEY,
    SWITCH_KEEP,
    SWITCH_LOOP,
    SWITCH_ONION,
    SWITCH_TRAIL,
    SWITCH_GHOST,
    SWITCH_ORIGINAL,
    SWITCH_SHEET,
    SWITCH_PHASE,
    SWITCH_MORE,
    SWITCH_SECONDS,
    SWITCH_NORMALISE,
    SWITCH_RECORD,
    SWITCH_PHASE_MAP,
    SWITCH_TWIN
};
/// Flips a switch and shows a message.
void core_flip(struct core *core, int which);
/// Chooses the look and shows a message.
void core_set_look(struct core *core, enum look look);
void core_turn_look(struct core *core, int unused);
/// The frame at the playhead, fractional.
double core_frame(const struct core *core);
/// A frame as a fractional sample.
double core_position(const struct document *document, double frame);
/// Rounds to the power of ten at or below `resolution` (> 0), so that dragged values have no meaningless decimals in files.
double core_round(double value, double resolution);
/// The topmost panel at a point.
enum panel core_panel_at(const struct core *core, float x, float y);
/// Sets the stage's share of the height and the inspector's width.
void core_set_panels(struct core *core, double stage_share, double inspector_width);
/// Lays out all panels in the window.
void core_layout(struct core *core);
/// How near the pointer must be to something that a mouse hits within `pixels`.
float core_reach(const struct core *core, float pixels);
/// The divider at a point, or DIVIDER_NONE.
enum divider core_divider_at(const struct core *core, float x, float y);
void core_divider_move(struct core *core, enum divider divider, float x, float y);

/// Starts or stops presenting (F5).
void presenter_toggle(struct core *core, int argument);
/// Tab shows or hides all panels; true if used.
bool presenter_event(struct core *core, const struct event *event);
/// Slides panels; `busy`: visible ones stay.
void presenter_advance(struct core *core, double dt, bool busy);
bool presenter_is_sliding(const struct core *core);

void playback_toggle(struct core *core);
/// Advances by `dt` seconds of real time. Counts scene frames that were skipped.
void playback_advance(struct core *core, double dt);
/// Stops at a frame.
void playback_seek(struct core *core, double frame);
/// Stops at the next whole frame in a direction.
void playback_step(struct core *core, int direction);
/// Stops at an end of the range.
void playback_end(struct core *core, int direction);
/// Goes to the next faster (1) or slower (-1) speed between 0.1 and 4; 0: real time.
void playback_change_speed(struct core *core, int direction);

/// First and last played frame: the chosen range within the scene, or the whole scene.
void playback_range(const struct core *core, double range[2]);
/// Whether less than the whole scene is played.
bool playback_is_part(const struct core *core);
/// Sets the played range; an empty or complete one means the whole scene.
void playback_choose(struct core *core, double first, double last);
/// Shows the played range in a message.
void playback_say_range(struct core *core);
/// Sets the range's start (0) or end (1) to the playhead.
void playback_mark(struct core *core, int end);

/// A spline's colour 0xRRGGBBAA: its own or the theme's.
uint32_t spline_list_color(const struct document *document, int spline);
/// Whether the curves show a spline: a solo one if any is, else one that is not hidden.
bool spline_list_shows(const struct core *core, int spline);
/// Flips a spline in core's `solo` or `hidden`.
void spline_list_flip(struct core *core, struct selection *set, int spline);
/// The active spline if the curves show it, else NULL.
const struct spline *spline_list_seen(const struct core *core);
/// Call after an edit, undo or redo: keeps the active spline and the playhead's frame.
void spline_list_refresh(struct core *core);
/// Appends a spline with a knot at the playhead and activates it.
void spline_list_add(struct core *core);
/// Inserts a copy after the active spline and activates it.
void spline_list_copy(struct core *core);
void spline_list_move(struct core *core, int spline, int to);
/// Value of a track at the playhead, within the parameter's limits.
double spline_list_present(const struct core *core, int spline, enum parameter parameter);
/// Deletes the active spline; asks if something follows it.
void spline_list_remove(struct core *core);
/// Sets the frame rate; asks whether knots keep their frames or seconds.
void spline_list_fps(struct core *core, double fps);
/// Sets the range; asks whether to move or delete knots outside.
void spline_list_range(struct core *core, int first, int last);

#endif

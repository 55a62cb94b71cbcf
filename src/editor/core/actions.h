/// What keys and mouse do to the document and the view: drags, nudges, playback. Private to src/editor.
#ifndef EDITOR_CORE_ACTIONS_H
#define EDITOR_CORE_ACTIONS_H

#include "editor/core/playback.h"
#include "editor/core/state.h"
#include "rig/posing.h"

/// Whether knots go to whole frames: Ctrl turns around what the panel is set to.
bool drag_snaps(const struct editor *editor, unsigned mods);
/// Starts a drag at a press; a history step is opened only once the pointer has moved.
void drag_begin(struct editor *editor, enum drag_kind kind, const struct event *event);
/// Starts to move the selected knots of the active spline; `knot` is the one under the pointer.
void drag_begin_knots(struct editor *editor, const struct editor_world *world, unsigned knot,
                      const struct event *event);
/// X and Y while knots are dragged: only the frame, only the value may change. false for other keys.
bool drag_lock(struct drag *drag, int key);
/// The copies of all selected knots that the edits of a drag start from.
void drag_collect(struct editor *editor, const struct spline *spline);
void drag_begin_slope(struct editor *editor, const struct editor_world *world, unsigned knot, int handle,
                      const struct event *event);
/// The pointer left the place of the press: this is a drag, not a click. Opens its history step.
void drag_start_moving(struct editor *editor, const struct editor_world *world);
/// Events of a running drag; true where the event is used up.
bool drag_event(struct editor *editor, const struct editor_world *world, const struct event *event);
/// Makes the drag's edits for where the pointer is now.
void drag_apply(struct editor *editor, const struct editor_world *world);
/// Ends a drag; `keep` false takes everything back.
void drag_end(struct editor *editor, const struct editor_world *world, bool keep);

/// Starts to select knots of the active spline by a box; Shift adds them, Ctrl or Alt removes them.
void box_begin(struct editor *editor, const struct event *event);
/// Selects what is in the box as it is now.
void box_update(struct editor *editor, const struct editor_world *world);
/// Ends it: a press that did not move was a click on empty; `keep` false brings the former selection back.
void box_end(struct editor *editor, bool keep);
void box_show(struct editor *editor);

/// Retiming (R while knots are dragged): the later knots of the spline keep their distances to the dragged ones.
void ripple_toggle(struct editor *editor, const struct editor_world *world);
bool ripple_moves(const struct drag *drag, const struct knot *knot);
/// The furthest shift to the left, in frames: to the first frame, or with ripple to behind the knot that stays.
double ripple_least(const struct editor *editor, const struct document *document, const struct spline *spline);
/// Says why the knots go no further to the right.
void ripple_stopped(struct editor *editor);

/// Starts to scale the selected knots with the pointer, about the middle of the selection (P: about the
/// equilibrium at the playhead).
void scale_begin(struct editor *editor, const struct editor_world *world);
/// Events while it runs, but the pointer's: axes, pivot, a typed factor, the end; true where the event is used up.
bool scale_event(struct editor *editor, const struct editor_world *world, const struct event *event);
/// Makes the edits for where the pointer is now.
void scale_apply(struct editor *editor, const struct editor_world *world);
/// The pivot, and the line from it to the pointer.
void scale_show(struct editor *editor);

/// Keys and characters; true where the event is used up.
bool keys_event(struct editor *editor, const struct editor_world *world, const struct event *event);

/// Moves the selected knots by frames and values, as one step with equal nudges before.
void nudge_knots(struct editor *editor, const struct editor_world *world, double frames, double value);
/// Adds `share` of the visible values a second to the slopes of the selected knots.
void nudge_slope(struct editor *editor, const struct editor_world *world, double share);
void nudge_stiffness(struct editor *editor, const struct editor_world *world, double factor);
/// Switches slopes on (as the curve runs there) or off.
void toggle_slope(struct editor *editor, const struct editor_world *world);
/// Slopes of the selected knots: level, or towards the neighbours' as Catmull and Rom have it.
void flatten_slopes(struct editor *editor, const struct editor_world *world);
void smooth_slopes(struct editor *editor, const struct editor_world *world);
/// Where a parameter's slider ends; 0: it has none.
double slider_end(const struct document *document, const struct spline *spline, enum parameter parameter);
/// Changes the parameter that a held letter stands for, or with L the lag, by its step.
void nudge_parameter(struct editor *editor, const struct editor_world *world, int letter, int direction);
/// The channel that the active spline moves, the first of all where it moves none; NULL where there is none at all.
const struct channel *active_channel(const struct editor *editor, const struct document *document, int *tail,
                                     int *channel);
void cycle_mode(struct editor *editor, const struct editor_world *world);

/// A knot on a frame (whole frames when `snap`), selected; where there is one already, that one is selected.
void insert_knot(struct editor *editor, const struct editor_world *world, double frame, double value, bool snap);
/// A knot that leaves the curve where it is, with its slope there too (eq. 9) where `slope` is set.
void insert_on_curve(struct editor *editor, const struct editor_world *world, double frame, bool snap, bool slope);
/// Removes the selected knots as a step of that name.
void remove_knots(struct editor *editor, const struct editor_world *world, const char *label);
void delete_knots(struct editor *editor, const struct editor_world *world);
/// The selected knots as text for the clipboard; `cut` also deletes them. false where there is nothing to copy.
bool copy_knots(struct editor *editor, const struct editor_world *world, bool cut);
/// Knots from text: the first one at the playhead, the others as far behind it as they are in the text; selected. All or, where
/// one would not fit, none.
void paste_knots(struct editor *editor, const struct editor_world *world, const char *text);
/// Copies of the selected knots behind them, selected.
void duplicate_knots(struct editor *editor, const struct editor_world *world);
void select_all(struct editor *editor, const struct editor_world *world);
/// The selected knot's neighbour (from the playhead where not just one is selected).
void select_neighbour(struct editor *editor, const struct editor_world *world, int direction);
void activate_neighbour(struct editor *editor, const struct editor_world *world, int direction);
/// A number for history_begin(): the same for the same kind of nudge of the same knots.
uint64_t merge_key(const struct editor *editor, const struct editor_world *world, uint64_t kind);

/// A press or wheel on the stage.
void stage_press(struct editor *editor, const struct editor_world *world, const struct event *event);
void stage_wheel(struct editor *editor, const struct event *event);
/// The nearest point of a tail, where it is near enough to be held.
struct hover stage_hover(const struct editor *editor, float x, float y);
void stage_fit(struct editor *editor, const struct editor_world *world);
void stage_pose(struct editor *editor, const struct editor_world *world);
void stage_show(struct editor *editor, const struct editor_world *world);
/// Where a point of the last pose is on the screen: `fraction` 0 … 1 of the way from joint to joint + 1.
bool stage_project(const struct editor *editor, int tail, int joint, double fraction, float xy[2]);
/// A change of one spline's x, to see what would happen.
struct what_if {
    int spline;
    double re, im;
};
/// What rigs are posed from: the world, in the editor's look.
struct posing stage_posing(const struct editor *editor, const struct editor_world *world);
/// Poses one tail with what is moved by hand; `change` may be NULL.
void stage_pose_tail(const struct editor *editor, const struct editor_world *world, int tail, double position,
                     const struct what_if *change, struct rig_pose *pose);
/// The same as stage_project() of any pose.
bool stage_project_pose(const struct editor *editor, const struct pose *pose, int joint, double fraction,
                        float xy[2]);

/// Takes hold of a tail; edits nothing until the pointer moves.
void grab_begin(struct editor *editor, const struct editor_world *world, const struct hover *hover);
/// One step towards the pointer; needs the pose of the last solved frame.
void grab_apply(struct editor *editor, const struct editor_world *world);

/// Which divider is under a point, or DRAG_NONE; and moves it.
enum drag_kind divider_at(const struct editor *editor, float x, float y);
void divider_move(struct editor *editor, enum drag_kind kind, float x, float y);

#endif

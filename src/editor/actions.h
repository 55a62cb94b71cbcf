/// What keys and mouse do to the document and the view: drags, nudges, playback. Private to src/editor.
#ifndef EDITOR_ACTIONS_H
#define EDITOR_ACTIONS_H

#include "editor/state.h"

/// Starts a drag at a press; a history step is opened only once the pointer has moved.
void drag_begin(struct editor *editor, enum drag_kind kind, const struct event *event);
/// Starts to move the selected knots of the active spline; `knot` is the one under the pointer.
void drag_begin_knots(struct editor *editor, const struct editor_world *world, unsigned knot,
                      const struct event *event);
void drag_begin_slope(struct editor *editor, const struct editor_world *world, unsigned knot, int handle,
                      const struct event *event);
/// Events of a running drag; true where the event is used up.
bool drag_event(struct editor *editor, const struct editor_world *world, const struct event *event);
/// Makes the drag's edits for where the pointer is now.
void drag_apply(struct editor *editor, const struct editor_world *world);
/// Ends a drag; `keep` false takes everything back.
void drag_end(struct editor *editor, const struct editor_world *world, bool keep);

/// Keys; true where the event is used up.
bool keys_event(struct editor *editor, const struct editor_world *world, const struct event *event);

/// Moves the selected knots by frames and values, as one step with equal nudges before.
void nudge_knots(struct editor *editor, const struct editor_world *world, double frames, double value);
/// Adds `share` of the visible values a second to the slopes of the selected knots.
void nudge_slope(struct editor *editor, const struct editor_world *world, double share);
void nudge_stiffness(struct editor *editor, const struct editor_world *world, double factor);
/// Switches slopes on (as the curve runs there) or off.
void toggle_slope(struct editor *editor, const struct editor_world *world);
/// Changes the parameter that a held letter stands for (F Z B C L), in steps of design.
void nudge_parameter(struct editor *editor, const struct editor_world *world, int letter, int direction);
/// The channel that the active spline moves, the first of all where it moves none; NULL where there is none at all.
const struct channel *active_channel(const struct editor *editor, const struct document *document, int *tail,
                                     int *channel);
void cycle_mode(struct editor *editor, const struct editor_world *world);

/// A knot on a frame (whole frames when `snap`), selected; where there is one already, that one is selected.
void insert_knot(struct editor *editor, const struct editor_world *world, double frame, double value, bool snap);
/// A knot at the playhead that leaves the curve where it is.
void insert_knot_at_playhead(struct editor *editor, const struct editor_world *world);
void delete_knots(struct editor *editor, const struct editor_world *world);
void select_all(struct editor *editor, const struct editor_world *world);
/// The selected knot's neighbour (from the playhead where not just one is selected).
void select_neighbour(struct editor *editor, const struct editor_world *world, int direction);
void activate_neighbour(struct editor *editor, const struct editor_world *world, int direction);
/// A number for history_begin(): the same for the same kind of nudge of the same knots.
uint64_t merge_key(const struct editor *editor, const struct editor_world *world, uint64_t kind);

void playback_toggle(struct editor *editor, const struct editor_world *world);
void playback_advance(struct editor *editor, const struct editor_world *world, double dt);
/// Stops and goes to the next whole frame in a direction, or to an end of the range.
void playback_step(struct editor *editor, const struct editor_world *world, int direction);
void playback_end(struct editor *editor, const struct editor_world *world, int direction);
/// Stops and shows a frame.
void playback_seek(struct editor *editor, const struct document *document, double frame);

/// A press or wheel on the stage.
void stage_press(struct editor *editor, const struct editor_world *world, const struct event *event);
void stage_wheel(struct editor *editor, const struct event *event);
/// The nearest point of a tail, where it is near enough to be held.
struct hover stage_hover(const struct editor *editor, float x, float y);
void stage_fit(struct editor *editor, const struct editor_world *world);
void stage_pose(struct editor *editor, const struct editor_world *world);
void stage_show(struct editor *editor);
/// Where a point of the last pose is on the screen: `fraction` 0 … 1 of the way from joint to joint + 1.
bool stage_project(const struct editor *editor, int tail, int joint, double fraction, float xy[2]);
/// A change of one spline's x at the time shown, to see what would happen.
struct what_if {
    int spline;
    double re, im;
};
/// Poses one tail at the time shown; `change` may be NULL.
void stage_pose_tail(const struct editor *editor, const struct editor_world *world, int tail,
                     const struct what_if *change, struct pose *pose);
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

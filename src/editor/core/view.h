/// What is shown: where the panels are, what time it is, and the switches of how the scene looks.
#ifndef EDITOR_CORE_VIEW_H
#define EDITOR_CORE_VIEW_H

#include "editor/core/state.h"

/// The values in sight of the curves.
static inline double plot_height(const struct core *core) { return core->view.plot.value1 - core->view.plot.value0; }

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

/// Plays, or stops at the nearest frame.
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
/// Sets the played range and shows it in a message; an empty or complete one means the whole scene.
void playback_choose(struct core *core, double first, double last);
/// Sets the range's start (0) or end (1) to the playhead.
void playback_mark(struct core *core, int end);

/// Flips a switch and shows a message.
void core_flip(struct core *core, int which);
/// Chooses the look and shows a message.
void core_set_look(struct core *core, enum look look);
void core_turn_look(struct core *core);
/// The frame at the playhead, fractional.
double core_frame(const struct core *core);
/// A frame as a fractional sample.
double core_position(const struct document *document, double frame);

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

#endif

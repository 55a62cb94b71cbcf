/// Interface of the stage.
#ifndef EDITOR_STAGE_STAGE_H
#define EDITOR_STAGE_STAGE_H

#include "editor/core/core.h"

struct stage;

/// The things that replays name; ends with NULL.
extern const struct thing *const stage_things[];

struct stage *stage_create(const struct core *core);
void stage_destroy(struct stage *stage);
/// Shows the scene's description in the top left corner: the title is the text up to the first full stop.
void stage_show_caption(struct core *core, float bottom);
/// Whether anything still swings.
bool stage_is_moving(const struct stage *stage);
/// Continues recordings and follow-through.
void stage_advance(struct stage *stage, struct core *core, double dt);
/// Call after a new document is opened.
void stage_open(struct stage *stage);
/// The rigs of the stage, as last posed.
const struct stage_view *stage_seen(const struct stage *stage);
/// Resets the camera to show everything.
void stage_fit(struct stage *stage, struct core *core);
/// Shows the selected bone and those to its tip, else the tail or chain of the active spline, else everything.
void stage_frame(struct stage *stage, struct core *core);
/// Where the scene moves on the screen, as first seen; empty without rigs.
struct rect stage_figure(const struct stage *stage, const struct core *core);
/// Poses everything after the solve. `covered`: something lies over the panels.
void stage_pose(struct stage *stage, struct core *core, bool covered);
/// Draws the overlays.
void stage_show(struct stage *stage, struct core *core);
/// The item to hold or click at a point: a pin, else the nearest tail or bone, else a floor's edge, else a body, else a surface.
struct hover stage_hover(struct stage *stage, const struct core *core, float x, float y);
/// A press on the stage.
void stage_press(struct stage *stage, struct core *core, const struct event *event);
/// The wheel over the stage.
void stage_wheel(struct core *core, const struct event *event);
/// Moves the selected pin parallel to the screen by steps of 1 % of the view.
void stage_nudge_pin(struct stage *stage, struct core *core, double right, double up);
/// Pins the point under the pointer; else the selected pin's point at the playhead; else a tip, or the vertex that moves most.
void stage_hold_point(struct stage *stage, struct core *core);

#endif

/// Interface of the stage.
#ifndef EDITOR_STAGE_STAGE_H
#define EDITOR_STAGE_STAGE_H

#include "editor/core/drag.h"

struct stage;

struct stage *stage_create(const struct core *core);
void stage_destroy(struct stage *stage);
/// A screen point where body_hover() finds a tail's body; false if it is hidden.
bool stage_body_point(struct stage *stage, const struct core *core, int tail, float xy[2]);
/// Shows the scene's description in the top left corner: the title is the text up to the first full stop.
void stage_show_caption(struct core *core, float bottom);
/// Projects a point of a character's surface: `uv` across and up its box at rest, seen from the front. False if not shown.
bool stage_character_point(const struct stage *stage, int character, const double uv[2], float xy[2]);
/// The middle of a bone on the screen; false if not shown.
bool stage_bone_point(const struct stage *stage, const struct core *core, int model, int node, float xy[2]);
/// Whether anything still swings.
bool stage_is_moving(const struct stage *stage);
/// Continues recordings and follow-through.
void stage_advance(struct stage *stage, struct core *core, double dt);
/// Call after a new document is opened.
void stage_open(struct stage *stage);
/// The rigs of the stage, as last posed.
const struct stage_view *stage_seen(const struct stage *stage);
/// Resets the camera to show everything.
void stage_fit(struct stage *stage, const struct core *core);
/// Shows the selected bone and those to its tip, else the tail or chain of the active spline, else everything.
void stage_frame(struct stage *stage, const struct core *core);
/// Where the scene moves on the screen, as first seen; empty without rigs.
struct rect stage_figure(const struct stage *stage, const struct core *core);
/// Turns the camera about its target, radians.
void stage_orbit(struct stage *stage, float across, float up);
/// Moves closer (factors below 1) or away.
void stage_approach(struct stage *stage, float factor);
/// Poses everything after the solve. `covered`: something lies over the panels.
void stage_pose(struct stage *stage, struct core *core, bool covered);
/// Draws the overlays.
void stage_show(struct stage *stage, struct core *core);
/// Projects a point of a tail or chain, as last posed: `fraction` 0 … 1 of the way from joint to joint + 1.
bool stage_project(const struct stage *stage, const struct core *core, int rig, int joint, double fraction,
                   float xy[2]);
/// The item to hold or click at a point: a pin, else the nearest tail or bone, else a floor's edge, else a body, else a surface.
struct hover stage_hover(struct stage *stage, const struct core *core, float x, float y);
/// A press on the stage.
void stage_press(struct stage *stage, struct core *core, const struct event *event);
/// The wheel over the stage.
void stage_wheel(struct stage *stage, struct core *core, const struct event *event);
/// Moves the selected pin parallel to the screen by steps of 1 % of the view.
void stage_nudge_pin(struct stage *stage, struct core *core, double right, double up);
/// Pins the point under the pointer; else the selected pin's point at the playhead; else a tip, or the vertex that moves most.
void stage_hold_point(struct stage *stage, struct core *core);
/// A pin's marker on the screen; false if not visible.
bool stage_pin_point(const struct stage *stage, const struct core *core, const struct pin *pin, float xy[2]);
/// The middle of a near edge of a character's floor (by its number among characters); false if not visible.
bool stage_floor_point(const struct stage *stage, const struct core *core, int character, float xy[2]);

#endif

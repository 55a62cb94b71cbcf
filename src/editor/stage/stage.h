/// Interface of the stage.
#ifndef EDITOR_STAGE_STAGE_H
#define EDITOR_STAGE_STAGE_H

#include "editor/core/drag.h"

struct stage;

struct stage *stage_create(const struct core *core);
void stage_destroy(struct stage *stage);
/// A point of the screen where body_hover() finds that tail's body; false where it is hidden.
bool stage_body_point(struct stage *stage, const struct core *core, int tail, float xy[2]);
/// The scene's description, in the upper left corner of the stage: up to the first full stop as a title.
void stage_show_caption(struct core *core, float bottom);
/// Where a point of its surface is on the screen: `uv` across and up its box at rest, seen from the front. false where it is not
/// shown.
bool stage_character_point(const struct stage *stage, int character, const double uv[2], float xy[2]);
/// The middle of a bone of a model rig on the screen; false where it is not shown.
bool stage_bone_point(const struct stage *stage, const struct core *core, int model, int node, float xy[2]);
/// Whether anything still swings.
bool stage_is_moving(const struct stage *stage);
/// Time passes: recordings and follow-through go on.
void stage_advance(struct stage *stage, struct core *core, double dt);
/// A new document is on the table.
void stage_open(struct stage *stage);
/// The rigs of the stage, as last posed.
const struct stage_view *stage_seen(const struct stage *stage);
/// All of the stage in sight, from where the camera was at first.
void stage_fit(struct stage *stage, const struct core *core);
/// About where on the screen the scene moves, as the stage was first seen; empty where nothing is on it.
struct rect stage_figure(const struct stage *stage, const struct core *core);
/// Turns the camera about its target, radians.
void stage_orbit(struct stage *stage, float across, float up);
/// Comes nearer (factors below 1) or goes away.
void stage_approach(struct stage *stage, float factor);
/// After the solve: poses everything; `covered`: something lies over the panels.
void stage_pose(struct stage *stage, struct core *core, bool covered);
/// Draws over the picture.
void stage_show(struct stage *stage, struct core *core);
/// Where a point of a tail or chain is on the screen, as of the last pose: `fraction` 0 … 1 of the way from joint to joint + 1.
bool stage_project(const struct stage *stage, const struct core *core, int rig, int joint, double fraction,
                   float xy[2]);
/// The item to hold or click at a point: the nearest of tails and bones, else a floor's edge, else a body; pins before these, surfaces
/// behind.
struct hover stage_hover(struct stage *stage, const struct core *core, float x, float y);
/// A press on the stage.
void stage_press(struct stage *stage, struct core *core, const struct event *event);
/// The wheel over the stage.
void stage_wheel(struct stage *stage, struct core *core, const struct event *event);
/// Moves the selected pin in the plane that faces the eye, by steps of 1 % of the view.
void stage_nudge_pin(struct stage *stage, struct core *core, double right, double up);
/// Pins the point under the pointer where it is; else the selected pin's point at the playhead; else a tip, or the liveliest point.
void stage_hold_point(struct stage *stage, struct core *core);
/// Where a pin's marker is on the screen; false where it is not in sight.
bool stage_pin_point(const struct stage *stage, const struct core *core, const struct pin *pin, float xy[2]);
/// The middle of a near edge of a character's floor on the screen (its number among characters); false where it is not in sight.
bool stage_floor_point(const struct stage *stage, const struct core *core, int character, float xy[2]);

#endif

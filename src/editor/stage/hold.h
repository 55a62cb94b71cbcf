/// What can be dragged on the stage: a tail, and a body, whose tail follows through and whose motion can be recorded.
#ifndef EDITOR_STAGE_HOLD_H
#define EDITOR_STAGE_HOLD_H

#include "editor/stage/state.h"

/// The body under a point of the stage (HOVER_BODY), the nearest to the eye, or HOVER_NONE.
struct hover hold_hover(const struct stage *stage, float x, float y);
/// How far from the eye a point of the stage meets the body of a posed tail, metres, or a negative number.
float hold_distance(const struct stage *stage, const struct pose *pose, float x, float y);
/// What was under a point within the last third of a second of a scene that plays: who presses there aimed at that.
struct hover hold_moment_ago(const struct stage *stage, const struct core *core, const struct editor_world *world,
                             float x, float y);
/// Points of a body that are likely to be in sight, the likeliest first, on the screen; false where one is behind the eye.
enum { HOLD_HEAD = 1, HOLD_POINTS = 4 };
bool hold_point(const struct stage *stage, const struct core *core, int tail, int point, float xy[2]);
/// Starts to drag a body, over the ground or, with Ctrl, up and across. X, Y and Z lock an axis, R records.
void hold_begin(struct stage *stage, struct core *core, int tail, const struct event *event);
/// Whether a body is dragged.
bool body_is_held(const struct core *core);
/// Keeps the way of the held body, metres, where the limits of the splines that it follows will keep what place_body() or a recording
/// makes of it.
void place_within(const struct stage *stage, const struct core *core, const struct editor_world *world,
                  double offset[3]);
/// The new place, metres from the old one: knots at the playhead with auto-key, else all of the shot moves. Says which.
void place_body(struct stage *stage, struct core *core, const struct editor_world *world, const double offset[3]);
/// A ring on the ground round the body that is held or can be.
void hold_show(struct stage *stage, struct core *core);

/// How far the pointer has taken the held body, metres, whatever holds it; 0 where none is held.
void hold_way(const struct stage *stage, const struct core *core, double offset[3]);
/// The held body goes as far as the pointer and limits have it: before what else advances.
void hold_advance(struct stage *stage, const struct core *core, const struct editor_world *world);
/// How far the running drag has moved a tail's base from where the document has it, metres; 0 for all others.
void hold_offset(const struct stage *stage, const struct core *core, int tail, double offset[3]);

/// Advances by `dt` seconds: the bases go where hold_offset() says, and what hangs on them swings.
void sway_advance(struct stage *stage, const struct core *core, const struct editor_world *world, double dt);
/// The document now holds the offset: the base has not moved by that.
void sway_land(struct stage *stage, int tail);
/// Stops a tail's swing at once.
void sway_stop(struct stage *stage, int tail);
/// What follow-through adds to a channel's value now (y is 0).
wiggly_value sway_value(const struct stage *stage, int tail, int channel);

/// Starts to record at the playhead, and plays; the body must be held.
void record_begin(struct stage *stage, struct core *core);
/// Records where the body is, up to the playhead; stops at the end of what is played.
void record_advance(struct stage *stage, const struct core *core, const struct editor_world *world);
/// The path of the body that is pointed at or held, and the way that is being recorded.
void record_show(struct stage *stage, struct core *core, const struct editor_world *world);
/// Whether a motion was recorded.
bool record_has_motion(const struct stage *stage);
/// Forgets the motion.
void record_forget(struct stage *stage);
/// Indices (from 0) of knots that a cubic through them, level at both ends, needs to stay within `tolerance` of `count` values a
/// sample; at most `capacity` (at least 2). Returns how many, 0 where memory is short. Allocates.
int record_simplify(const double *values, int count, double tolerance, wiggly_method method, int *knots,
                    int capacity);

/// Makes the edits, in the open step: base splines for the coordinates that moved, and channels that follow them. Says how many
/// knots that took, then forgets the motion.
void record_keep(struct stage *stage, struct core *core, const struct editor_world *world);

/// Whether a tail or chain is in the document and has the joint.
bool grab_holds(const struct document *document, int rig, int joint);
/// Starts to pull a tail or chain; edits nothing until the pointer moves.
void grab_begin(struct stage *stage, struct core *core, const struct editor_world *world, const struct hover *hover,
                const struct event *event);

#endif

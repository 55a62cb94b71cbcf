/// Samples → pose: a tail's joint matrices from its channels' spline values (spec: "Scene file", paper section 7.1).
#ifndef RIG_POSE_H
#define RIG_POSE_H

#include "scene/document.h"

/// How the same knots are shown: the paper's method, without lag, or as classical cubics (the splines are then solved
/// so).
enum look { LOOK_WIGGLY, LOOK_STIFF, LOOK_CUBIC };

/// A pose: frames of joints+1 points along the tail, in metres; entry n is where joint n sits, the last one is the
/// tip. Column-major 4×4, +z along the tail, y up. Entry n carries the bend of joint n.
struct pose {
    int count;    ///< joints + 1
    float ground; ///< height of what the body stands on, metres
    float matrix[TAIL_MAX_JOINTS + 1][16];
};

/// Poses a tail at its position, coordinates that follow a spline being 0 (see pose_move()). `values[c]` is the spline value of
/// channel c at the time shown. Joint n bends by gain·(y + Re(e^{−j·n·lag} x)) about each channel's axis, without y for
/// PART_DISPLACEMENT, over rest (which bends up about the `up` axis, positive lifts). LOOK_STIFF takes every lag as 0.
/// The ground is right below the body; one whose height follows a spline has it at 0.
/// `side` turns before `up`. Allocates nothing.
void pose_tail(const struct tail *tail, const wiggly_value *values, enum look look, struct pose *pose);

/// Moves a posed tail, metres: where its position follows splines, and while it is dragged.
void pose_move(struct pose *pose, const double by[3]);

/// Length of the tail that was posed, in metres.
float pose_length(const struct pose *pose);

/// The box around the skin of tail and body (whose size follows the tail's length), metres.
void pose_bounds(const struct pose *pose, float lo[3], float hi[3]);

#endif

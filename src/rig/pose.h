/// Samples → pose: a tail's joint matrices from its channels' spline values (docs/mathematics.md, Poses; section 7.1 of the paper).
#ifndef RIG_POSE_H
#define RIG_POSE_H

#include "model/pose.h"
#include "rig/look.h"
#include "scene/document.h"

/// Poses a tail at its position, coordinates that follow a spline being 0 (see pose_move()). `values[c]` is the spline value of
/// channel c at the time shown. Joint n bends by gain·(y + Re(e^{−j·n·lag} x)) about each channel's axis, without y for
/// PART_DISPLACEMENT, over rest (which bends up about the `up` axis, positive lifts). LOOK_STIFF takes every lag as 0.
/// The ground is right below the body; one whose height follows a spline has it at 0.
/// `side` turns before `up`. Allocates nothing.
void pose_tail(const struct tail *tail, const wiggly_value *values, enum look look, struct pose *pose);

#endif

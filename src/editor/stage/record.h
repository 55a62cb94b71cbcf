/// Recording how the body is moved by hand.
#ifndef EDITOR_STAGE_RECORD_H
#define EDITOR_STAGE_RECORD_H

#include "editor/stage/state.h"

/// Starts from the playhead, which plays from here on; the body must be held.
void record_begin(struct stage *stage, struct core *core);
/// Notes where the body is, up to the playhead; ends at the end of what is played.
void record_advance(struct stage *stage, const struct core *core, const struct editor_world *world);
/// Whether there is a motion to be kept.
bool record_has_motion(const struct stage *stage);
/// Forgets the motion.
void record_forget(struct stage *stage);
/// Indices (from 0) of knots that a cubic through them, level at both ends, needs to stay within `tolerance` of `count` values a
/// sample; at most `capacity` (at least 2). Returns how many, 0 where memory is short. Allocates.
int record_simplify(const double *values, int count, double tolerance, int *knots, int capacity);

#endif

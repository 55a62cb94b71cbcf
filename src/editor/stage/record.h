/// Recording how the body is moved by hand, as knots of splines that its position follows. Private to src/editor.
#ifndef EDITOR_STAGE_RECORD_H
#define EDITOR_STAGE_RECORD_H

#include "editor/core/state.h"

/// Starts from the playhead, which plays from here on; the body must be held.
void record_begin(struct editor *editor);
/// Notes where the body is, up to the playhead; ends at the end of what is played.
void record_advance(struct editor *editor, const struct editor_world *world);
/// Whether there is a motion to be kept.
bool record_has_motion(const struct editor *editor);
/// Makes the edits, in the open step: base splines for the coordinates that moved, and channels that follow them. Then forgets
/// the motion.
void record_keep(struct editor *editor, const struct editor_world *world);
void record_forget(struct editor *editor);

/// Indices (from 0) of knots that a cubic through them, level at both ends, needs to stay within `tolerance` of `count` values a
/// sample; at most `capacity` (at least 2). Returns how many, 0 where memory is short. Allocates.
int record_simplify(const double *values, int count, double tolerance, int *knots, int capacity);

#endif

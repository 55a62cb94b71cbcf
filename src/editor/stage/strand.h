/// Tails and chains on the stage, as rows of points.
#ifndef EDITOR_STAGE_STRAND_H
#define EDITOR_STAGE_STRAND_H

#include "editor/stage/state.h"
#include "rig/posing.h"

/// Adds one that is shown.
void strand_add(struct stage *stage, int rig, const struct rig_pose *pose);
/// The one of a rig as it was last shown, or NULL.
const struct strand *strand_of(const struct stage *stage, int rig);
/// Poses one with what is moved by hand; `change` may be NULL. false if its model is missing.
bool strand_pose(const struct stage *stage, const struct core *core, const struct editor_world *world, int rig,
                 double position, const struct what_if *change, struct strand *strand);
/// Where a point of it is on the screen: `fraction` 0 … 1 of the way from joint to joint + 1. false where it is behind the eye.
bool strand_project(const struct stage *stage, const struct core *core, const struct strand *strand, int joint,
                    double fraction, float xy[2]);
/// Pixels from its centre line within which a tail is taken.
#define STRAND_REACH 16.0f
/// Sets `hover` (HOVER_JOINT) and `nearest` (pixels) if a point of it is nearer to p than that.
void strand_nearer(const struct stage *stage, const struct core *core, const struct strand *strand, const float p[2],
                   float *nearest, struct hover *hover);
/// The nearest point of a tail (HOVER_JOINT), or HOVER_NONE. Chains are pointed at by their bones (bone_hover()).
struct hover strand_hover(const struct stage *stage, const struct core *core, float x, float y);
/// The end of the joint of a tail or chain that is nearest to a point between two (HOVER_POINT); HOVER_NONE where it is behind the eye.
struct hover strand_end(const struct stage *stage, const struct core *core, const struct hover *between);

#endif

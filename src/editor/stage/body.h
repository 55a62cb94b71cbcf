/// The body of the animal, taken hold of and moved over the ground.
#ifndef EDITOR_STAGE_BODY_H
#define EDITOR_STAGE_BODY_H

#include "editor/stage/state.h"

/// The body under a point of the stage (HOVER_BODY), the nearest to the eye, or HOVER_NONE.
struct hover body_hover(const struct stage *stage, float x, float y);
/// Takes hold of a body: the drag is to begin.
void body_begin(struct stage *stage, const struct core *core, int tail);
/// The end of a drag, inside its step of the history: where `keep`, the document gets the new place (a number, or a knot at
/// the playhead where a spline is followed).
void body_release(struct stage *stage, struct core *core, const struct editor_world *world, bool keep);
/// A ring on the ground round the body that is held or can be.
void body_show(struct stage *stage, struct core *core);

#endif

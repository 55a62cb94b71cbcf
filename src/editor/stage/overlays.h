/// What lies over the stage to show more of the motion than its present: the poses at knots and the way of the tip. Both are
/// view state, and both follow an edit in its own frame. Private to src/editor.
#ifndef EDITOR_STAGE_OVERLAYS_H
#define EDITOR_STAGE_OVERLAYS_H

#include "editor/core/state.h"

/// Onion skin (O): the outline of the tail at the active spline's knots, those nearest to the playhead.
void onion_show(struct editor *editor, const struct editor_world *world);
void onion_toggle(struct editor *editor);

/// Motion arc (P): where the tip of the tail goes within two seconds of the playhead, with a mark at each frame.
void trail_show(struct editor *editor, const struct editor_world *world);
void trail_toggle(struct editor *editor);

/// The tail that the active spline moves, else the first; -1 where there is none to be seen.
int overlay_tail(const struct editor *editor, const struct document *document);

#endif

/// Floors of characters on the stage: the edge of the plane round each, which is dragged up and down.
#ifndef EDITOR_STAGE_FLOORS_H
#define EDITOR_STAGE_FLOORS_H

#include "editor/stage/state.h"

/// A floor as it is seen: corners in turn, on the screen.
struct shown_floor {
    float xy[4][2];
    int first; ///< the corner that is nearest to the eye
};

/// The floor of a character that is shown, and where it is on the screen; NULL where it has none, or it is not in sight.
const struct character_rig *floors_find(const struct stage *stage, const struct core *core,
                                        const struct document *document, const struct stage_character *shown,
                                        struct shown_floor *floor);

/// The edge of a floor under a point of the stage (HOVER_FLOOR), or HOVER_NONE.
struct hover floors_hover(const struct stage *stage, const struct core *core, const struct document *document,
                          float x, float y);
/// Whether a rig of the document has a floor.
bool floors_exist(const struct document *document, int rig);

/// Starts to drag a floor; edits nothing until the pointer moves.
void floors_begin(struct stage *stage, struct core *core, const struct editor_world *world, const struct hover *hover,
                  const struct event *event);
/// Draws all floors: brighter where a character stands on one, in the colour of warnings where it is below.
void floors_show(const struct stage *stage, struct core *core, const struct editor_world *world);

#endif

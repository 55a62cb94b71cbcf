/// Pins on the stage: points are lit up and dragged, markers show where they are to be.
#ifndef EDITOR_STAGE_PINS_H
#define EDITOR_STAGE_PINS_H

#include "editor/stage/state.h"

/// What of pins is under a point of the stage: a marker (HOVER_PIN), else, where nothing else was `found` there, a point of a surface
/// that can be pinned (HOVER_POINT). HOVER_NONE: nothing.
struct hover pins_hover(struct stage *stage, const struct core *core, const struct document *document,
                        const struct hover *found, float x, float y);
/// The picture's directions in the world, and its scale at a place.
void pins_take_plane(const struct stage *stage, const struct core *core, const double place[3],
                     struct pin_drag *drag);
/// Whether what was found is still in the document.
bool pins_hover_exists(const struct editor_world *world, const struct hover *hover);

/// Starts to drag what is under the pointer, a point or a marker; edits nothing until it moves.
void pins_begin(struct stage *stage, struct core *core, const struct editor_world *world, const struct hover *hover,
                const struct event *event);
/// Draws the line along which a locked drag goes.
void pins_show_axis(void *room, struct core *core, const struct editor_world *world);

/// Draws all markers, what is lit up, and the path of the point that is held or selected.
void pins_show(struct stage *stage, struct core *core, const struct editor_world *world);

#endif

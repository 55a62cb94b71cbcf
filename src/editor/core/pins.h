/// The selected pin and its edits. Pins of all rigs share one selection of at most one.
#ifndef EDITOR_CORE_PINS_H
#define EDITOR_CORE_PINS_H

#include "editor/core/state.h"

/// A pin by its indices; PINS_START: before the first one.
struct pin_place {
    int rig, at;
};
#define PINS_START                                                                                                   \
    (struct pin_place) { 0, -1 }
/// Goes on to the next pin, rig by rig; NULL behind the last one.
const struct pin *pins_next(const struct document *document, struct pin_place *place);
/// The selected pin and its rig, or NULL.
const struct pin *pins_selected(const struct core *core, int *rig);
/// The colour of a rig's pins: that of its first spline.
uint32_t pins_color(const struct document *document, int rig);
/// Selects a pin and goes to its frame.
void pins_visit(struct core *core, const struct pin *pin);
/// Lets go of the selected pin.
void pins_clear(struct core *core);
/// The frame for a pin at the playhead: a whole one, inside the scene.
double pins_frame_here(const struct core *core, int rig);
/// Pins a point inside the open step, or moves its pin on that frame; selects it.
bool pins_put(struct core *core, int rig, int point, double frame, const double to[3]);
/// The same at the playhead, as a step of its own.
void pins_put_here(struct core *core, int rig, int point, const double to[3]);
/// The splines that a pin of the rig moves have been edited.
void pins_tell(struct core *core, int rig);
/// An edit: gives the pin of that id, or where it is 0 a new one, these numbers.
bool pins_set(struct document *document, int rig, const struct pin *pin, struct error *error);
/// Moves the selected pin by metres; repeated nudges are one undo step.
void pins_nudge(struct core *core, const double by[3]);
/// Moves it by so many frames, skipping those where its point has a pin; repeated moves are one undo step.
void pins_retime(struct core *core, int frames);
/// Removes the selected pin.
void pins_delete(struct core *core);
/// Selects the pin after the selected one (1) or before it (-1), in the order of frames.
void pins_select_neighbour(struct core *core, int direction);

#endif

/// The selected pin (at most one among all rigs) and its edits.
#ifndef EDITOR_CORE_PINS_H
#define EDITOR_CORE_PINS_H

#include "editor/core/state.h"

/// A pin's indices; start from PINS_START.
struct pin_place {
    int rig, at;
};
#define PINS_START                                                                                                   \
    (struct pin_place) { 0, -1 }
/// Goes to the next pin, rig by rig; NULL after the last.
const struct pin *pins_next(const struct document *document, struct pin_place *place);
/// The selected pin and its rig, or NULL; and whether there is one.
const struct pin *pins_selected(const struct core *core, int *rig);
bool pins_any_selected(const struct core *core);
/// The colour of a rig's pins: its first spline's.
uint32_t pins_color(const struct document *document, int rig);
void pins_visit(struct core *core, const struct pin *pin);
void pins_clear(struct core *core);
/// A whole frame at the playhead, within the scene.
double pins_frame_here(const struct core *core, int rig);
/// In the open step, pins a point or moves its pin at that frame; selects the pin.
bool pins_put(struct core *core, int rig, int point, double frame, const double to[3]);
/// The same at the playhead, in its own step.
void pins_put_here(struct core *core, int rig, int point, const double to[3]);
/// Reports that the splines under a rig's pins were edited.
void pins_tell(struct core *core, int rig);
/// Replaces the pin with that id, or adds one if it is 0. Edits.
bool pins_set(struct document *document, int rig, const struct pin *pin, struct error *error);
/// Moves the selected pin by metres. Repeated nudges are one undo step.
void pins_nudge(struct core *core, const double by[3]);
/// Moves the selected pin by frames, past other pins of its point. Repeated moves are one undo step.
void pins_retime(struct core *core, int frames);
void pins_delete(struct core *core);
/// Selects the pin after (1) or before (-1) the selected one, by frame.
void pins_select_neighbour(struct core *core, int direction);

#endif

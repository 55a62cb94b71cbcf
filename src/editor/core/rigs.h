/// Edits of rigs: tails, characters with their bones, chains and paint, pins. Each is one undo step.
#ifndef EDITOR_CORE_RIGS_H
#define EDITOR_CORE_RIGS_H

#include "editor/core/state.h"

/// What new users should drag: the first of these kinds the scene has.
enum lead { LEAD_TAIL, LEAD_CHARACTER, LEAD_CHAIN, LEAD_MODEL, LEAD_MESH, LEAD_NOTHING, LEADS };
enum lead rigs_lead(const struct core *core);
/// Whether a character has bones to click. One that could not be read counts.
bool rigs_have_bones(const struct core *core);
bool rigs_have_knots(const struct document *document);

/// Adds a tail beside the other rigs, bent by the active spline or a new one.
void rigs_add_tail(struct core *core);
/// Adds a copy moved by the same splines. A character's chains are copied too.
void rigs_copy(struct core *core, int rig);
/// Removes a rig and its chains. Asks whether to delete splines that move nothing else. Splines that follow one of its joints keep their
/// value at the playhead.
void rigs_ask_remove(struct core *core, int rig);

// --- bones of characters

/// The character of a model rig, or NULL if its file could not be read.
const struct imported *bones_character(const struct core *core, int model);
/// The selected bone's node, and its character's rig; −1 if none is selected or the character is gone.
int bones_selected(const struct core *core, int *model);
enum { BONES_TITLE = 512 };
/// A bone's name, with its rig's before it if there are several characters: "dog 2/tail_1".
const char *bones_title(const struct document *document, int model, const char *name, char title[BONES_TITLE]);
/// A click on a bone answers a pick, else selects the bone.
void bones_clicked(struct core *core, int model, int node);
void bones_clear(struct core *core);

/// Number of joints of a tail or chain; 1 for a chain whose bones are missing.
int bones_joints(const struct core *core, int rig);

/// Sets a model rig's clip (NULL: none) and whether it repeats, in one step. import_choose_clip() sets the scene's length.
void bones_choose_clip(struct core *core, int model, const char *clip, enum clip_repeat repeat);

/// Lists a character's bones below `top` (−1: all) in file order, at most `most`. Returns how many.
int bones_below(const struct imported *character, int top, int *nodes, int most);

/// Makes a spline's equilibrium follow a joint of a model rig (−1: the best one), in one step. Keeps the kind of motion, the gain and the
/// reference chain; the first time, they suit a chain the spline bends.
void bones_follow(struct core *core, int spline, int model, int node);
/// Moves a chain's first or last bone, in one step. A first bone beside the old end makes the chain go on to its own tip. Splines that
/// follow the last bone follow the new one.
void bones_set_end(struct core *core, int chain, bool first, int node);

/// Makes the selected bone and those down to the tip a chain. With `follow` the chain swings after its motion in the clip. Its first spline
/// becomes active.
void bones_make_chain(struct core *core, int follow);

/// Has flesh made of the selected bone and those below it; else of what paint chooses of the selected character, or all of it. The second time it ends that.
void rigs_make_flesh(struct core *core, int unused);

/// A chain whose bones have twins on the other side (ear_L and ear_R, LeftEar and RightEar) that no chain begins at: `chain` if it
/// has, else the last; -1: none.
int bones_mirrorable(const struct core *core, int chain);
/// Makes the chain of the twins, mirrored, by the same splines.
void bones_make_twin(struct core *core, int chain);

// --- the selected soft character and its brush

/// Whether a rig is a character with coordinates, in the scene or in its file.
bool rigs_is_soft(const struct core *core, int rig);
/// The rig that is selected, else the first that is soft; −1: there is none. And it.
int characters_rig(const struct core *core);
const struct model_rig *characters_selected(const struct core *core);
const struct coordinate *characters_coordinate(const struct core *core);
/// The selected character's figure, or NULL, and its coordinate.
const struct figure *characters_figure(const struct core *core, int *coordinate);
/// Turns the brush on or off. It stays off unless a character with a coordinate is selected.
void characters_set_brush(struct core *core, bool on);
/// Gives the selected character blank paint of the figure's size. Edits.
bool characters_blank_paint(struct core *core, const struct figure *figure);
/// Removes the selected character's paint in one undo step.
void characters_clean_paint(struct core *core);

// --- pins: at most one is selected, among all rigs

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
/// Selects the pin after (1) or before (-1) the selected one, by frame.
void pins_select_neighbour(struct core *core, int direction);

#endif

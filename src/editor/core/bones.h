/// The bones of imported characters: selection, and chains made of them.
#ifndef EDITOR_CORE_BONES_H
#define EDITOR_CORE_BONES_H

#include "editor/core/state.h"

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
/// Uses the next click on a bone for `use`.
void bones_pick(struct core *core, enum bone_use use, int which);

/// Makes the selected bone and those down to the tip a chain. With `follow` the chain swings after its motion in the clip. Its first spline
/// becomes active.
void bones_make_chain(struct core *core, int follow);

/// A chain whose bones have twins on the other side (ear_L and ear_R, LeftEar and RightEar) that no chain begins at: `chain` if it
/// has, else the last; -1: none.
int bones_mirrorable(const struct core *core, int chain);
/// Makes the chain of the twins, mirrored, by the same splines.
void bones_make_twin(struct core *core, int chain);

#endif

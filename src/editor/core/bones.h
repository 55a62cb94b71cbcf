/// The bones of imported characters: which is selected, and the chains that are made of them.
#ifndef EDITOR_CORE_BONES_H
#define EDITOR_CORE_BONES_H

#include "editor/core/state.h"

/// The imported character of a model rig, NULL where it could not be read.
const struct imported *bones_character(const struct core *core, int model);
/// The selected bone's node, and the rig of its character; −1 where none is selected or its character is gone.
int bones_selected(const struct core *core, int *model);
enum { BONES_TITLE = 512 };
/// Title of a bone: its name; with several characters the rig's before it, as in "dog 2/tail_1".
const char *bones_title(const struct document *document, int model, const char *name, char title[BONES_TITLE]);
/// A click on a bone: answers a pick, else selects it.
void bones_clicked(struct core *core, int model, int node);
/// Selects none.
void bones_clear(struct core *core);

/// The joints of a tail or chain; 1 for a chain whose bones are not there.
int bones_joints(const struct core *core, int rig);

/// Sets the clip of a model rig (by its index; NULL: none) in one step; import_choose_clip() sets the scene's length.
void bones_choose_clip(struct core *core, int model, const char *clip);

/// The bones of a character to choose from, in the order of its file, those below `top` (−1: all); at most `most`. Returns how many.
int bones_below(const struct imported *character, int top, int *nodes, int most);

/// Has a spline's equilibrium follow a joint of a model rig (−1: the best one), as one step. Keeps the kind of motion, its gain and
/// the chain whose axes count; the first time they suit a chain that the spline bends.
void bones_follow(struct core *core, int spline, int model, int node);
/// Has a chain begin (or end) at another bone, as one step. One that begins beside its old end goes on to its own tip. Its splines that
/// follow its last bone go on to do so.
void bones_set_end(struct core *core, int chain, bool first, int node);
/// The next click on a bone is for `use`.
void bones_pick(struct core *core, enum bone_use use, int which);

/// Makes the selected bone, and those behind it to the tip, a chain; where `follow` is set one that swings after its motion in the clip.
/// Its first spline becomes the active one.
void bones_make_chain(struct core *core, int follow);

/// A chain whose bones have twins on the other side (ear_L and ear_R, LeftEar and RightEar) that no chain begins at: `chain` if it
/// has, else the last; -1: none.
int bones_mirrorable(const struct core *core, int chain);
/// Makes the chain of the twins, mirrored, by the same splines.
void bones_make_twin(struct core *core, int chain);

#endif

/// The bones of imported characters: which is selected, and the chains that are made of them.
#ifndef EDITOR_CORE_BONES_H
#define EDITOR_CORE_BONES_H

#include "editor/core/state.h"

/// What a model rig shows, NULL where it could not be read.
const struct imported *bones_character(const struct editor_world *world, int model);
/// The selected bone's node, and the rig of its character; −1 where none is selected or its character is gone.
int bones_selected(const struct core *core, const struct editor_world *world, int *model);
/// Selects a bone of a model rig.
void bones_select(struct core *core, const struct editor_world *world, int model, int node);
/// Selects none.
void bones_clear(struct core *core);

/// The joints of a tail or chain; 1 for a chain whose bones are not there.
int bones_joints(const struct editor_world *world, int rig);

/// Has a model rig (by its index) play a clip, NULL: none, as one step; import_choose_clip() says what it does to the scene's length.
void bones_choose_clip(struct core *core, const struct editor_world *world, int model, const char *clip);

/// Makes the selected bone, and those behind it to the tip, a chain; where `follow` is set one that swings after its motion in the clip.
/// Its first spline becomes the active one.
void bones_make_chain(struct core *core, const struct editor_world *world, int follow);

/// Whether a chain's bones have twins on the other side (ear_L and ear_R, LeftEar and RightEar) that no chain begins at.
bool bones_has_twin(const struct editor_world *world, int chain);
/// Makes the chain of the twins, mirrored, by the same splines.
void bones_make_twin(struct core *core, const struct editor_world *world, int chain);

#endif

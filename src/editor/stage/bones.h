/// The bones of imported characters, drawn over them and pointed at.
#ifndef EDITOR_STAGE_BONES_H
#define EDITOR_STAGE_BONES_H

#include "editor/stage/state.h"
#include "rig/chain_bones.h"

/// Adds the bones of a character that is shown.
void bones_add(struct stage *stage, int model, const struct rig_pose *pose);
/// Marks those of a chain of a model rig.
void bones_mark(struct stage *stage, const struct core *core, const struct document *document, int rig, int model,
                const struct chain_bones *bones);

/// The bone that is meant by a point of the stage: HOVER_JOINT of its chain, else HOVER_BONE, or HOVER_NONE.
struct hover bone_hover(const struct stage *stage, const struct core *core, float x, float y);
/// Whether a rig is still an imported character.
bool bone_exists(const struct document *document, int model);
/// A click where the pointer went down: selects the bone there, or none.
void bone_click(const struct stage *stage, struct core *core, const struct editor_world *world);

/// Draws them: all of the character under the pointer, those behind the selected bone.
void bones_show(const struct stage *stage, struct core *core, const struct editor_world *world);

#endif

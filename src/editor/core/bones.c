/// The selected bone of an imported character, and what can be made of it.
#include "editor/core/bones.h"
#include "editor/core/core.h"
#include "rig/chain_bones.h"
#include <stdio.h>

const struct imported *bones_character(const struct editor_world *world, int model)
{
    return models_imported(world->models, posing_number(world->document, model));
}

int bones_selected(const struct core *core, const struct editor_world *world, int *model)
{
    const struct bone_selection *bone = &core->bone;
    *model = bone->any ? document_find_rig(world->document, RIG_MODEL, bone->model) : -1;
    const struct imported *shown = *model >= 0 ? bones_character(world, *model) : NULL;
    return shown && shown->gltf.id == bone->file ? bone->node : -1;
}

void bones_select(struct core *core, const struct editor_world *world, int model, int node)
{
    const struct imported *shown = bones_character(world, model);
    if (!shown) return;
    core->bone = (struct bone_selection){
        .any = true, .model = posing_number(world->document, model), .file = shown->gltf.id, .node = node};
}

void bones_clear(struct core *core) { core->bone.any = false; }

int bones_joints(const struct editor_world *world, int rig)
{
    const struct rig *bent = &world->document->rigs[rig];
    if (bent->kind == RIG_TAIL) return bent->tail.joints;
    const int model = document_find_model(world->document, bent->chain.model, bent->chain.by_file);
    const struct imported *shown = model >= 0 ? bones_character(world, model) : NULL;
    struct chain_bones bones;
    return shown && chain_find(&shown->gltf, bent->chain.from, bent->chain.to, &bones, NULL) ? bones.count : 1;
}

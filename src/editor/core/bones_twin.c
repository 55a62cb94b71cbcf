/// The other side of a chain: left for right, right for left.
#include "editor/core/bones.h"
#include "editor/core/core.h"
#include "rig/chain_make.h"
#include <stdio.h>
#include <string.h>

/// Whether a chain of the model begins at a bone.
static bool begins_at(const struct document *document, int model, const char *from)
{
    for (int r = document_next_rig(document, RIG_CHAIN, 0); r >= 0;
         r = document_next_rig(document, RIG_CHAIN, r + 1)) {
        const struct chain *chain = &document->rigs[r].chain;
        if (document_find_model(document, chain->model, chain->by_file) == model && strcmp(chain->from, from) == 0)
            return true;
    }
    return false;
}

/// The names of both ends of the twin; false where it has none, or is there already.
static bool find_twin(const struct editor_world *world, int rig, char from[BONE_NAME_SIZE], char to[BONE_NAME_SIZE])
{
    const struct chain *chain = &world->document->rigs[rig].chain;
    const int model = document_find_model(world->document, chain->model, chain->by_file);
    const struct imported *shown = model >= 0 ? bones_character(world, model) : NULL;
    if (!shown || !chain_other_side(chain->from, from) || !chain_other_side(chain->to, to)) return false;
    return gltf_find_node(&shown->gltf, from) >= 0 && gltf_find_node(&shown->gltf, to) >= 0 &&
           !begins_at(world->document, model, from);
}

bool bones_has_twin(const struct editor_world *world, int chain)
{
    char from[BONE_NAME_SIZE], to[BONE_NAME_SIZE];
    return find_twin(world, chain, from, to);
}

void bones_make_twin(struct core *core, const struct editor_world *world, int chain)
{
    char from[BONE_NAME_SIZE], to[BONE_NAME_SIZE], name[BONE_NAME_SIZE], text[2 * BONE_NAME_SIZE];
    if (!find_twin(world, chain, from, to)) return;
    struct rig twin = world->document->rigs[chain];
    struct edit edit = core_edit_of(EDIT_CHAIN_ADD, core->active);
    twin.name = twin.name && chain_other_side(twin.name, name) ? name : NULL;
    twin.chain.from = from;
    twin.chain.to = to;
    twin.chain.mirror = !twin.chain.mirror;
    edit.contents = &twin;
    if (!core_step(core, world, "Mirror chain", 0, &edit)) return;
    snprintf(text, sizeof text, "Made the chain %s, mirrored, by the same splines.",
             rig_title(&world->document->rigs[world->document->rig_count - 1]));
    core_message(core, false, text);
}

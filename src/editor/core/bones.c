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

/// A spline for a chain: called after the bone where that is no other's name.
static bool add_spline(struct core *core, const struct editor_world *world, const char *bone)
{
    struct edit edit = core_edit_of(EDIT_SPLINE_ADD, world->document->spline_count);
    edit.text = document_find_spline(world->document, bone) < 0 ? bone : NULL;
    return core_edit(core, world, &edit);
}

/// The edits of a chain without a knot yet, in the open step.
static bool add_chain(struct core *core, const struct editor_world *world, int model, const char *from,
                      const char *to)
{
    const struct document *document = world->document;
    const struct rig *shown = &document->rigs[model];
    struct edit edit = core_edit_of(EDIT_CHAIN_ADD, core->active);
    struct channel channel = {.lag.value = {CHANNEL_DEFAULT_LAG}, .gain.value = {CHANNEL_DEFAULT_GAIN}};
    if (!add_spline(core, world, from)) return false;
    channel.spline = document->spline_count - 1;
    const struct rig contents = {.kind = RIG_CHAIN,
                                 .chain = {.model = shown->name ? shown->name : shown->model.model,
                                           .by_file = !shown->name,
                                           .from = (char *)from,
                                           .to = (char *)to,
                                           .channels = &channel,
                                           .channel_count = 1}};
    edit.contents = &contents;
    return core_edit(core, world, &edit);
}

void bones_make_chain(struct core *core, const struct editor_world *world, int follow)
{
    int model;
    const int node = bones_selected(core, world, &model);
    struct error error = {0};
    char text[256];
    (void)follow;
    if (history_is_open(world->history)) return;
    if (node < 0) {
        core_message(core, false, "Click a bone of an imported character first.");
        return;
    }
    const struct gltf *gltf = &bones_character(world, model)->gltf;
    const int last = chain_end(gltf, node, &error);
    if (last < 0) {
        core_message(core, true, error.text);
        return;
    }
    history_begin(world->history, "Make chain", 0);
    const bool made = add_chain(core, world, model, gltf->nodes[node].name, gltf->nodes[last].name);
    if (!made) history_restart(world->history, world->document);
    history_end(world->history);
    if (!made) return;
    core_activate(core, world, world->document->spline_count - 1);
    snprintf(text, sizeof text, "Made a chain from %.80s to %.80s. Drag it on the stage to set knots.",
             gltf->nodes[node].name, gltf->nodes[last].name);
    core_message(core, false, text);
}

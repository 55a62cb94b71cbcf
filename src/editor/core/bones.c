/// The selected bone of an imported character, and what can be made of it.
#include "editor/core/bones.h"
#include "editor/core/core.h"
#include "rig/bones.h"
#include "rig/chain_make.h"
#include "rig/import.h"
#include <stdio.h>

const struct imported *bones_character(const struct editor_world *world, int model)
{
    return models_imported(world->models, document_rig_number(world->document, model));
}

int bones_selected(const struct core *core, const struct editor_world *world, int *model)
{
    const struct bone_selection *bone = &core->bone;
    *model = bone->any ? document_find_rig(world->document, RIG_MODEL, bone->model) : -1;
    const struct imported *shown = *model >= 0 ? bones_character(world, *model) : NULL;
    return shown && shown->gltf.id == bone->file ? bone->node : -1;
}

const char *bones_title(const struct document *document, int model, const char *name, char title[BONES_TITLE])
{
    if (document_count_rigs(document, RIG_MODEL) < 2) return name;
    snprintf(title, BONES_TITLE, "%.200s/%.300s", rig_title(&document->rigs[model]), name);
    return title;
}

void bones_select(struct core *core, const struct editor_world *world, int model, int node)
{
    const struct imported *shown = bones_character(world, model);
    if (!shown) return;
    core->bone = (struct bone_selection){
        .any = true, .model = document_rig_number(world->document, model), .file = shown->gltf.id, .node = node};
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

/// Says what was made.
static void tell(struct core *core, const struct document *document, const struct rig *made, int model, bool follows)
{
    const char *clip = document->rigs[model].model.clip;
    char text[512], title[BONES_TITLE];
    const int length = snprintf(text, sizeof text, "Made the chain %.80s, from %.160s to %.80s.", rig_title(made),
                                bones_title(document, model, made->chain.from, title), made->chain.to);
    if (!follows) {
        snprintf(text + length, sizeof text - (size_t)length, " Drag it on the stage to set knots.");
    } else if (clip) {
        snprintf(text + length, sizeof text - (size_t)length, " It swings after the clip %.80s.", clip);
    } else {
        snprintf(text + length, sizeof text - (size_t)length, " It swings once the character plays a clip.");
    }
    core_message(core, false, text);
}

void bones_choose_clip(struct core *core, const struct editor_world *world, int model, const char *clip)
{
    const struct imported *character = bones_character(world, model);
    struct error error = {0};
    if (history_is_open(world->history) || !character) return;
    history_begin(world->history, "Choose clip", 0);
    const bool chosen = import_choose_clip(world->history, world->document, model, &character->gltf, clip, &error);
    if (!chosen) history_restart(world->history, world->document);
    history_end(world->history);
    core_refresh(core, world);
    core->refit_curves = world->document->spline_count == 0;
    if (!chosen) core_message(core, true, error.text);
}

void bones_make_chain(struct core *core, const struct editor_world *world, int follow)
{
    int model, rig;
    const int node = bones_selected(core, world, &model);
    struct error error = {0};
    const bool has_splines = world->document->spline_count > 0;
    if (history_is_open(world->history)) return;
    if (node < 0) {
        core_message(core, false, "Click a bone of an imported character first.");
        return;
    }
    const struct chain_wish wish = {
        .model = model, .from = bones_character(world, model)->gltf.nodes[node].name, .follows = follow};
    history_begin(world->history, follow ? "Make chain that follows" : "Make chain", 0);
    const bool made = chain_make(world->history, world->document, world->models, &wish, &rig, &error);
    if (!made) history_restart(world->history, world->document);
    history_end(world->history);
    core_refresh(core, world);
    if (!made) {
        core_message(core, true, error.text);
        return;
    }
    core_activate(core, world, rig_input(&world->document->rigs[rig], 0));
    core->refit_curves = !has_splines;
    tell(core, world->document, &world->document->rigs[rig], model, follow);
}

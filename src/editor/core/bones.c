/// The selected bone of an imported character, chains of its bones, and splines that follow it.
#include "editor/core/bones.h"
#include "base/names.h"
#include "base/need.h"
#include "editor/core/core.h"
#include "rig/import.h"
#include "rig/models.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const struct imported *bones_character(const struct core *core, int model)
{
    return models_imported(core->models, core->document, model);
}

int bones_selected(const struct core *core, int *model)
{
    const struct bone_selection *bone = &core->bone;
    *model = bone->any ? document_find_rig(core->document, RIG_MODEL, bone->model) : -1;
    const struct imported *shown = *model >= 0 ? bones_character(core, *model) : NULL;
    return shown && shown->gltf.id == bone->file ? bone->node : -1;
}

const char *bones_title(const struct document *document, int model, const char *name, char title[BONES_TITLE])
{
    if (document_count_rigs(document, RIG_MODEL) < 2) return name;
    snprintf(title, BONES_TITLE, "%.*s/%.*s", name_fit(rig_title(document->rigs[model]), 200),
             rig_title(document->rigs[model]), name_fit(name, 300), name);
    return title;
}

static void bones_select(struct core *core, int model, int node)
{
    const struct imported *shown = bones_character(core, model);
    if (!shown) return;
    core->bone = (struct bone_selection){
        .any = true, .model = document_rig_number(core->document, model), .file = shown->gltf.id, .node = node};
}

void bones_clear(struct core *core) { core->bone.any = false; }

int bones_joints(const struct core *core, int rig)
{
    const struct rig *bent = core->document->rigs[rig];
    if (bent->kind == RIG_TAIL) return bent->tail.joints;
    const int model = rig_body(core->document, rig);
    const struct imported *shown = model >= 0 ? bones_character(core, model) : NULL;
    struct chain_bones bones;
    return shown && chain_find(&shown->gltf, bent->chain.from, bent->chain.to, &bones, NULL) ? bones.count : 1;
}

static void tell(struct core *core, const struct rig *made, int model, bool follows)
{
    const char *playing = core->document->rigs[model]->model.clip, *clip = follows && playing ? playing : "";
    char title[BONES_TITLE];
    const char *next = !follows ? "Drag it on the stage to set knots."
                       : *clip  ? "It follows through on the clip "
                                : "It swings once the character plays a clip.";
    core_message(core, false, "Made the chain %.*s, from %s to %.*s. %s%.*s%s", name_fit(rig_title(made), 80),
                 rig_title(made), bones_title(core->document, model, made->chain.from, title),
                 name_fit(made->chain.to, 80), made->chain.to, next, name_fit(clip, 80), clip, *clip ? "." : "");
}

void bones_choose_clip(struct core *core, int model, const char *clip, enum clip_repeat repeat)
{
    const struct imported *character = bones_character(core, model);
    const int first = core->document->first_frame, last = core->document->last_frame;
    if (!character || !core_step(core, repeat == REPEAT_BY_CLIP ? "Choose clip" : "Loop clip", 0)) return;
    if (!import_choose_clip(core->document, model, &character->gltf, clip, repeat, &core->error)) return;
    core->refit_curves = core->document->first_frame != first || core->document->last_frame != last;
}

void bones_make_chain(struct core *core, int follow)
{
    int model, rig;
    const int node = bones_selected(core, &model);
    const bool has_splines = core->document->spline_count > 0;
    if (node < 0) {
        core_message(core, false, "Click a bone of an imported character first.");
        return;
    }
    const struct chain_wish wish = {
        .model = model, .from = bones_character(core, model)->gltf.nodes[node].name, .follows = follow};
    if (!core_step(core, follow ? "Make chain that follows" : "Make chain", 0)) return;
    if (!chain_make(core->document, core->models, &wish, &rig, &core->error)) return;
    core_activate(core, rig_input(core->document->rigs[rig], 0));
    core->limb = core->document->rigs[rig]->id;
    core->refit_curves = !has_splines;
    tell(core, core->document->rigs[rig], model, follow);
}

static bool is_below(const struct gltf *gltf, int node, int top)
{
    while (node >= 0 && node != top) node = gltf->nodes[node].parent;
    return node == top;
}

int bones_below(const struct imported *character, int top, int *nodes, int most)
{
    int count = 0;
    for (int b = 0; b < character->skeleton.own && count < most; b++) {
        const int node = character->skeleton.bones[b].node;
        if (is_below(&character->gltf, node, top)) nodes[count++] = node;
    }
    return count;
}

void bones_pick(struct core *core, enum bone_use use, int which) { core->pick = (struct bone_pick){use, which}; }

void bones_clicked(struct core *core, int model, int node)
{
    const struct bone_pick pick = core->pick;
    const struct document *document = core->document;
    core->pick = (struct bone_pick){0};
    if (pick.use == BONE_SELECTED) {
        bones_select(core, model, node);
    } else if (pick.use == BONE_FOLLOWED) {
        bones_follow(core, pick.which, model, node);
    } else if (rig_body(document, pick.which) == model) {
        bones_set_end(core, pick.which, pick.use == BONE_FIRST, node);
    } else {
        core_message(core, true, "This bone belongs to another character. A chain stays on its own character.");
    }
}

/// A chain of a model that a spline bends, and the first such channel; NULL if there is none.
static const struct rig *bent_by(const struct document *document, int spline, int model,
                                 const struct channel **channel)
{
    for (int r = -1; (r = document_next_chain(document, model, r)) >= 0;) {
        const struct chain *chain = &document->rigs[r]->chain;
        for (int c = 0; c < chain->channel_count; c++) {
            *channel = &chain->channels[c];
            if (chain->channels[c].spline == spline) return document->rigs[r];
        }
    }
    return NULL;
}

/// The gain with which a channel bends its chain as far as its joint has moved.
static double gain_for(const struct core *core, int model, const struct chain *chain, const struct channel *channel)
{
    const struct imported *character = bones_character(core, model);
    struct chain_bones bones;
    if (!chain_find(&character->gltf, chain->from, chain->to, &bones, NULL)) return 1;
    const double wanted = chain_bend_a_metre(character, &bones, core->document->rigs[model]->model.scale);
    const double bend = angles_at(&channel->gain, 0, bones.count);
    const double gain = wanted / bend;
    return isfinite(gain) && gain > 0 ? core_round(gain, 0.01 * gain) : 1;
}

/// The motion along a channel's axis.
static enum motion_of motion_along(enum axis axis)
{
    return axis == AXIS_SIDE ? MOTION_ACROSS : axis == AXIS_UP ? MOTION_UP : MOTION_TURN;
}

/// Makes the chains' channels bend by the displacement alone, because the followed joint already carries them.
static void bend_by_the_rest(struct core *core, int spline, int model)
{
    const struct document *document = core->document;
    for (int r = -1; (r = document_next_chain(document, model, r)) >= 0;) {
        for (int c = 0; c < document->rigs[r]->chain.channel_count; c++) {
            struct channel changed = document->rigs[r]->chain.channels[c];
            if (changed.spline != spline) continue;
            changed.of = PART_DISPLACEMENT;
            edit_channel(core->document, (struct channel_place){r, c}, &changed, &core->error);
        }
    }
}

void bones_follow(struct core *core, int spline, int model, int node)
{
    const struct document *document = core->document;
    const struct param *old = &document->splines[spline]->parameter[PARAMETER_EQUILIBRIUM];
    const struct imported *character = bones_character(core, model);
    if (!character) return;
    const struct channel *channel = NULL;
    const struct rig *bent = bent_by(document, spline, model, &channel), *rig = document->rigs[model];
    struct joint_motion motion = {.model = rig->name ? rig->name : rig->model.model, .of = MOTION_TURN, .gain = 1};
    const struct param param = {.track = -1, .motion = &motion};
    if (bent) {
        motion.chain = bent->name;
        motion.joint = bent->chain.to;
        motion.of = motion_along(channel->axis);
        if (motion.of != MOTION_TURN) motion.gain = gain_for(core, model, &bent->chain, channel);
    }
    const bool goes_on =
        old->motion && document_find_model(document, old->motion->model, old->motion->by_file) == model;
    if (goes_on) motion = *old->motion;
    int chosen_on;
    const int chosen = bones_selected(core, &chosen_on);
    if (node < 0 && !bent && chosen_on == model) node = chosen;
    if (node < 0 && !bent && bones_below(character, -1, &node, 1) == 0) return;
    if (node >= 0) motion.joint = character->gltf.nodes[node].name;
    const bool is_new = !old->motion;
    if (!core_step(core, "Follow joint", 0)) return;
    const bool done = edit_parameter(core->document, spline, PARAMETER_EQUILIBRIUM, &param, &core->error);
    if (done && is_new) bend_by_the_rest(core, spline, model);
}

/// The names of a chain's ends after one of them moves to `node`; false with an error.
static bool find_ends(const struct imported *character, const struct chain *chain, bool first, int node,
                      char *ends[2], struct error *error)
{
    const struct gltf *gltf = &character->gltf;
    struct chain_bones bones;
    ends[0] = first ? gltf->nodes[node].name : chain->from;
    ends[1] = first ? chain->to : gltf->nodes[node].name;
    if (chain_find(gltf, ends[0], ends[1], &bones, error)) return true;
    const int last = first ? chain_end(character, node, error) : -1;
    if (last < 0) return false;
    ends[1] = gltf->nodes[last].name;
    return chain_find(gltf, ends[0], ends[1], &bones, error);
}

/// Splines that followed a chain's old last bone follow its new one.
static bool follow_end(struct core *core, const char *chain, const char *old, char *new)
{
    const struct document *document = core->document;
    bool done = true;
    for (int s = 0; s < document->spline_count; s++) {
        struct param param = document->splines[s]->parameter[PARAMETER_EQUILIBRIUM];
        if (!param.motion || !param.motion->chain || !chain) continue;
        struct joint_motion motion = *param.motion;
        if (strcmp(motion.chain, chain) != 0 || strcmp(motion.joint, old) != 0) continue;
        motion.joint = new;
        param.motion = &motion;
        done &= edit_parameter(core->document, s, PARAMETER_EQUILIBRIUM, &param, &core->error);
    }
    return done;
}

void bones_set_end(struct core *core, int chain, bool first, int node)
{
    struct rig contents = *core->document->rigs[chain];
    const int model = rig_body(core->document, chain);
    const struct imported *character = model >= 0 ? bones_character(core, model) : NULL;
    struct error error = {0};
    char *ends[2];
    if (!character) return;
    if (!find_ends(character, &contents.chain, first, node, ends, &error)) {
        core_message(core, true, "%s", error.text);
        return;
    }
    char *old = need_text(contents.chain.to);
    contents.chain.from = ends[0];
    contents.chain.to = ends[1];
    const bool done = core_step(core, "Set chain's bones", 0) &&
                      edit_rig_set(core->document, chain, &contents, &core->error) &&
                      follow_end(core, contents.name, old, ends[1]);
    free(old);
    if (!done) return;
    const struct rig *rig = core->document->rigs[chain];
    core_message(core, false, "%.*s goes from %.*s to %.*s.", name_fit(rig_title(rig), 80), rig_title(rig),
                 name_fit(rig->chain.from, 100), rig->chain.from, name_fit(rig->chain.to, 100), rig->chain.to);
}

static bool begins_at(const struct document *document, int model, const char *from)
{
    for (int r = -1; (r = document_next_chain(document, model, r)) >= 0;) {
        if (strcmp(document->rigs[r]->chain.from, from) == 0) return true;
    }
    return false;
}

/// The names of the twin chain's ends; false if there is no twin or it already has a chain.
static bool find_twin(const struct core *core, int rig, char from[BONE_NAME_SIZE], char to[BONE_NAME_SIZE])
{
    if (core->document->rigs[rig]->kind != RIG_CHAIN) return false;
    const struct chain *chain = &core->document->rigs[rig]->chain;
    const int model = rig_body(core->document, rig);
    const struct imported *shown = model >= 0 ? bones_character(core, model) : NULL;
    if (!shown || !bone_other_side(chain->from, from) || !bone_other_side(chain->to, to)) return false;
    return gltf_find_node(&shown->gltf, from) >= 0 && gltf_find_node(&shown->gltf, to) >= 0 &&
           !begins_at(core->document, model, from);
}

int bones_mirrorable(const struct core *core, int chain)
{
    char from[BONE_NAME_SIZE], to[BONE_NAME_SIZE];
    if (chain < core->document->rig_count && find_twin(core, chain, from, to)) return chain;
    int rig = core->document->rig_count - 1;
    while (rig >= 0 && !find_twin(core, rig, from, to)) rig--;
    return rig;
}

void bones_make_twin(struct core *core, int chain)
{
    char from[BONE_NAME_SIZE], to[BONE_NAME_SIZE], name[BONE_NAME_SIZE];
    if (!find_twin(core, chain, from, to)) return;
    struct rig twin = *core->document->rigs[chain];
    twin.name = twin.name && bone_other_side(twin.name, name) ? name : NULL;
    twin.chain.from = from;
    twin.chain.to = to;
    twin.chain.mirror = !twin.chain.mirror;
    twin.chain.turn = -twin.chain.turn;
    if (!core_step(core, "Mirror chain", 0) || !edit_rig_add(core->document, &twin, &core->error)) return;
    core_message(core, false, "Made the chain %s, mirrored, by the same splines.",
                 rig_title(core->document->rigs[core->document->rig_count - 1]));
}

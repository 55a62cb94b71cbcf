/// Edits of rigs: adding and removing them, bones and chains of characters, the selected soft character, pins.
#include "base/hash.h"
#include "base/names.h"
#include "base/need.h"
#include "editor/core/core.h"
#include "rig/import.h"
#include "rig/models.h"
#include "scene/pins.h"
#include "ui/theme.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double APART = 1.25; ///< distance between rigs, in widths
static const double ROOM = 1.2;   ///< metres, if a width is unknown

bool rigs_have_bones(const struct core *core)
{
    for (int r = -1; (r = document_next_rig(core->document, RIG_MODEL, r)) >= 0;) {
        const struct imported *imported = models_imported(core->models, core->document, r);
        if (!imported || imported->skeleton.count > 0) return true;
    }
    return false;
}

enum lead rigs_lead(const struct core *core)
{
    const struct document *document = core->document;
    if (document_next_rig(document, RIG_TAIL, -1) >= 0) return LEAD_TAIL;
    if (characters_rig(core) >= 0) return LEAD_CHARACTER;
    if (document_next_rig(document, RIG_CHAIN, -1) >= 0) return LEAD_CHAIN;
    if (document_next_rig(document, RIG_MODEL, -1) < 0) return LEAD_NOTHING;
    return rigs_have_bones(core) ? LEAD_MODEL : LEAD_MESH;
}

bool rigs_have_knots(const struct document *document)
{
    int s = 0;
    while (s < document->spline_count && document->splines[s]->knot_count == 0) s++;
    return s < document->spline_count;
}

/// A rig's x and width.
static double place_of(const struct core *core, int rig, double *width)
{
    const struct rig *at = core->document->rigs[rig];
    const struct imported *imported =
        at->kind == RIG_MODEL ? models_imported(core->models, core->document, rig) : NULL;
    *width = ROOM;
    if (imported) *width = (double)(imported->gltf.hi[0] - imported->gltf.lo[0]) * at->model.scale;
    if (at->kind == RIG_MODEL) return at->model.position[0];
    return at->kind == RIG_TAIL ? at->tail.position[0].value : 0;
}

/// A free x to the right of all rigs, for a rig of that width.
static double free_place(const struct core *core, double wide)
{
    double right = -INFINITY;
    for (int r = 0; r < core->document->rig_count; r++) {
        const enum rig_kind kind = core->document->rigs[r]->kind;
        double width;
        const double at = place_of(core, r, &width);
        if (kind != RIG_CHAIN) right = fmax(right, at + APART * (width + wide) / 2);
    }
    return isfinite(right) ? core_round(right, 0.01) : 0;
}

void rigs_add_tail(struct core *core)
{
    struct document *document = core->document;
    const double place = free_place(core, ROOM);
    if (!core_step(core, "Add tail", 0)) return;
    const bool is_new = !core_active_spline(core);
    const struct knot first = {.frame = round(core_frame(core))};
    bool done = !is_new || edit_spline_add(document, -1, NULL, &first, &core->step.error);
    const int spline = is_new ? document->spline_count - 1 : core->focus.active;
    done = done && edit_tail_add(document, -1, spline, &core->step.error);
    if (done) {
        struct rig added = *document->rigs[document->rig_count - 1];
        added.tail.position[0] = param_number(place);
        done = edit_rig_set(document, document->rig_count - 1, &added, &core->step.error);
    }
    core->view.refit_stage = done;
    if (done) core_activate(core, spline);
}

void rigs_copy(struct core *core, int rig)
{
    struct document *document = core->document;
    double width;
    if (rig < 0 || rig >= document->rig_count) return;
    struct rig copy = *document->rigs[rig];
    place_of(core, rig, &width);
    const double place = free_place(core, width);
    copy.pin_count = 0; // pins would drive both
    if (copy.kind == RIG_CHAIN) {
        core_message(core, false, "A chain is copied with its character: copy that.");
        return;
    }
    if (copy.kind == RIG_MODEL) copy.model.position[0] = place;
    if (!core_step(core, "Add one more", 0)) return;
    bool done = copy.kind == RIG_TAIL ? edit_tail_add(document, rig, core->focus.active, &core->step.error)
                                      : edit_rig_add(document, &copy, &core->step.error);

    // A model's chains are copied onto its copy, the last rig.
    const int count = document->rig_count;
    for (int r = 0; r < count && done && copy.kind == RIG_MODEL; r++) {
        if (r == rig || rig_body(document, r) != rig) continue;
        struct rig chain = *document->rigs[r];
        char *name = need_text(document->rigs[count - 1]->name);
        chain.chain.model = name;
        chain.pin_count = 0;
        done = edit_rig_add(document, &chain, &core->step.error);
        free(name);
    }
    core->view.refit_stage = done;
}

/// Whether a rig goes with one that is removed: it is that one or a chain of it.
static bool goes_with(const struct document *document, int removed, int rig)
{
    return rig == removed || rig_body(document, rig) == removed;
}

/// Whether a spline moves something, and that all goes with a rig.
static bool moves_alone(const struct document *document, int spline, int rig)
{
    bool moves = false;
    for (struct reference reference = {0}; reference_next(document, &reference);) {
        if (reference.spline != spline) continue;
        if (reference.kind == REFERENCE_TRACK || !goes_with(document, rig, reference.owner)) return false;
        moves = true;
    }
    return moves;
}

static void remove_rig(void *of, int answer)
{
    struct core *core = of;
    int rig = core->subject.rig;
    const bool with_splines = answer == 0;
    struct document *document = core->document;
    struct error *error = &core->step.error;
    bool done = true;
    if (rig < 0 || rig >= document->rig_count) return;
    if (!core_step(core, with_splines ? "Remove with splines" : "Remove", 0)) return;
    bool *goes = need_zeroed((size_t)document->spline_count + 1, sizeof *goes);
    for (int s = 0; s < document->spline_count; s++) goes[s] = with_splines && moves_alone(document, s, rig);

    // Splines that follow a joint of a removed rig keep their value at the playhead.
    for (int s = 0; s < document->spline_count && done; s++) {
        bool follows = false;
        for (int r = 0; r < document->rig_count; r++)
            follows |= goes_with(document, rig, r) && document_follows(document, s, r);
        if (!follows) continue;
        const double present = spline_list_present(core, s, PARAMETER_EQUILIBRIUM);
        done = core_set_parameter(core, s, PARAMETER_EQUILIBRIUM, core_round(present, 1e-3));
    }

    // Its chains go first.
    for (int r = document->rig_count - 1; r >= 0 && done; r--) {
        if (r == rig || !goes_with(document, rig, r)) continue;
        done = edit_rig_remove(document, r, error);
        rig -= r < rig;
    }
    done = done && edit_rig_remove(document, rig, error);
    for (int s = document->spline_count - 1; s >= 0 && done; s--) {
        if (goes[s]) done = edit_spline_remove(document, s, error);
    }
    free(goes);
}

void rigs_ask_remove(struct core *core, int rig)
{
    static const struct answer answers[] = {
        {"dialog.with", "With splines", 'W'}, {"dialog.keep", "Keep splines", 'K'}, {"dialog.cancel", "Cancel", 'C'}};
    const struct document *document = core->document;
    if (rig < 0 || rig >= document->rig_count) {
        core_message(core, false, "There is nothing on the stage to remove.");
        return;
    }

    // The names of splines that move only this rig.
    char names[160] = "";
    size_t used = 0;
    int count = 0;
    for (int s = 0; s < document->spline_count; s++) {
        if (!moves_alone(document, s, rig)) continue;
        const int wrote = snprintf(names + used, sizeof names - used, "%s%.*s", count > 0 ? ", " : "",
                                   name_fit(document->splines[s]->name, 40), document->splines[s]->name);
        used = used + (size_t)wrote < sizeof names ? used + (size_t)wrote : sizeof names - 1;
        count++;
    }
    core->subject.rig = rig;
    if (count == 0) {
        remove_rig(core, 1);
        return;
    }
    struct question *question = core_ask(core, answers, 3, remove_rig);
    snprintf(question->title, sizeof question->title, "Remove %.*s, with its spline%s or without?",
             name_fit(path_name(rig_title(document->rigs[rig])), 150), path_name(rig_title(document->rigs[rig])),
             count == 1 ? "" : "s");
    snprintf(question->note, sizeof question->note, "%s move%s nothing else. Keep %s for what you add next?", names,
             count == 1 ? "s" : "", count == 1 ? "it" : "them");
}

// --- bones and chains

const struct imported *bones_character(const struct core *core, int model)
{
    return models_imported(core->models, core->document, model);
}

int bones_selected(const struct core *core, int *model)
{
    const struct bone_selection *bone = &core->focus.bone;
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

int bones_joints(const struct core *core, int rig)
{
    const struct rig *bent = core->document->rigs[rig];
    if (bent->kind == RIG_TAIL) return bent->tail.joints;
    const int model = rig_body(core->document, rig);
    const struct imported *shown = model >= 0 ? bones_character(core, model) : NULL;
    struct chain_bones bones;
    return shown && chain_find(&shown->gltf, bent->chain.from, bent->chain.to, &bones, NULL) ? bones.count : 1;
}

void bones_choose_clip(struct core *core, int model, const char *clip, enum clip_repeat repeat)
{
    const struct imported *character = bones_character(core, model);
    const int first = core->document->first_frame, last = core->document->last_frame;
    if (!character || !core_step(core, repeat == REPEAT_BY_CLIP ? "Choose clip" : "Loop clip", 0)) return;
    if (!import_choose_clip(core->document, model, &character->gltf, clip, repeat, &core->step.error)) return;
    core->view.refit_curves = core->document->first_frame != first || core->document->last_frame != last;
}

void bones_make_chain(struct core *core, int follow)
{
    int model, rig;
    const int node = bones_selected(core, &model);
    const bool has_splines = core->document->spline_count > 0;
    if (node < 0) {
        core_message(core, false, "Click a bone of a character first.");
        return;
    }
    const struct chain_wish wish = {
        .model = model, .from = bones_character(core, model)->gltf.nodes[node].name, .follows = follow};
    if (!core_step(core, follow ? "Make chain that follows" : "Make chain", 0)) return;
    if (!chain_make(core->document, core->models, &wish, &rig, &core->step.error)) return;
    const struct rig *made = core->document->rigs[rig];
    core_activate(core, rig_input(made, 0));
    core->focus.limb = made->id;
    core->view.refit_curves = !has_splines;

    const char *playing = core->document->rigs[model]->model.clip, *clip = follow && playing ? playing : "";
    char title[BONES_TITLE];
    const char *next = !follow ? "Drag it on the stage to set knots."
                       : *clip ? "It follows through on the clip "
                               : "It swings once the character plays a clip.";
    core_message(core, false, "Made the chain %.*s, from %s to %.*s. %s%.*s%s", name_fit(rig_title(made), 80),
                 rig_title(made), bones_title(core->document, model, made->chain.from, title),
                 name_fit(made->chain.to, 80), made->chain.to, next, name_fit(clip, 80), clip, *clip ? "." : "");
}

int bones_below(const struct imported *character, int top, int *nodes, int most)
{
    int count = 0;
    for (int b = 0; b < character->skeleton.own && count < most; b++) {
        const int node = character->skeleton.bones[b].node;
        int above = node;
        while (above >= 0 && above != top) above = character->gltf.nodes[above].parent;
        if (above == top) nodes[count++] = node;
    }
    return count;
}

void bones_clicked(struct core *core, int model, int node)
{
    const struct bone_pick pick = core->focus.pick;
    const struct document *document = core->document;
    core->focus.pick = (struct bone_pick){0};
    if (pick.use == BONE_SELECTED) {
        const struct imported *shown = bones_character(core, model);
        if (shown)
            core->focus.bone = (struct bone_selection){
                .any = true, .model = document_rig_number(document, model), .file = shown->gltf.id, .node = node};
    } else if (pick.use == BONE_FOLLOWED) {
        bones_follow(core, pick.which, model, node);
    } else if (rig_body(document, pick.which) == model) {
        bones_set_end(core, pick.which, pick.use == BONE_FIRST, node);
    } else {
        core_message(core, true, "This bone belongs to another character. A chain stays on its own character.");
    }
}

void bones_follow(struct core *core, int spline, int model, int node)
{
    const struct document *document = core->document;
    const struct param *old = &document->splines[spline]->parameter[PARAMETER_EQUILIBRIUM];
    const struct imported *character = bones_character(core, model);
    if (!character) return;
    const struct rig *rig = document->rigs[model], *bent = NULL; // the first chain that the spline bends
    const struct channel *channel = NULL;
    for (int r = -1; !bent && (r = document_next_chain(document, model, r)) >= 0;) {
        const struct chain *chain = &document->rigs[r]->chain;
        for (int c = 0; c < chain->channel_count && !bent; c++) {
            channel = &chain->channels[c];
            if (channel->spline == spline) bent = document->rigs[r];
        }
    }
    struct joint_motion motion = {.model = rig->name ? rig->name : rig->model.model, .of = MOTION_TURN, .gain = 1};
    const struct param param = {.track = -1, .motion = &motion};
    if (bent) {
        motion.chain = bent->name;
        motion.joint = bent->chain.to;
        motion.of = channel->axis == AXIS_SIDE ? MOTION_ACROSS : channel->axis == AXIS_UP ? MOTION_UP : MOTION_TURN;
        const struct chain *chain = &bent->chain;
        struct chain_bones bones;
        if (motion.of != MOTION_TURN && chain_find(&character->gltf, chain->from, chain->to, &bones, NULL)) {
            // The gain with which the channel bends the chain as far as its joint has moved.
            const double wanted = chain_bend_a_metre(character, &bones, rig->model.scale);
            const double gain = wanted / angles_at(&channel->gain, 0, bones.count);
            if (isfinite(gain) && gain > 0) motion.gain = core_round(gain, 0.01 * gain);
        }
    }
    const bool goes_on = old->motion && document_find_model(document, old->motion->model) == model;
    if (goes_on) motion = *old->motion;
    int chosen_on;
    const int chosen = bones_selected(core, &chosen_on);
    if (node < 0 && !bent && chosen_on == model) node = chosen;
    if (node < 0 && !bent && bones_below(character, -1, &node, 1) == 0) return;
    if (node >= 0) motion.joint = character->gltf.nodes[node].name;
    const bool is_new = !old->motion;
    if (!core_step(core, "Follow joint", 0)) return;
    if (!edit_parameter(core->document, spline, PARAMETER_EQUILIBRIUM, &param, &core->step.error) || !is_new) return;

    // The followed joint already carries the chains, so their channels bend by the displacement alone.
    for (int r = -1; (r = document_next_chain(document, model, r)) >= 0;) {
        for (int c = 0; c < document->rigs[r]->chain.channel_count; c++) {
            struct channel changed = document->rigs[r]->chain.channels[c];
            if (changed.spline != spline) continue;
            changed.of = PART_DISPLACEMENT;
            edit_channel(core->document, (struct channel_place){r, c}, &changed, &core->step.error);
        }
    }
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
    bool done =
        core_step(core, "Set chain's bones", 0) && edit_rig_set(core->document, chain, &contents, &core->step.error);
    // Splines that followed the chain's old last bone follow its new one.
    for (int s = 0; s < core->document->spline_count && done; s++) {
        struct param param = core->document->splines[s]->parameter[PARAMETER_EQUILIBRIUM];
        if (!param.motion || !param.motion->chain || !contents.name) continue;
        struct joint_motion motion = *param.motion;
        if (strcmp(motion.chain, contents.name) != 0 || strcmp(motion.joint, old) != 0) continue;
        motion.joint = ends[1];
        param.motion = &motion;
        done = edit_parameter(core->document, s, PARAMETER_EQUILIBRIUM, &param, &core->step.error);
    }
    free(old);
    if (!done) return;
    const struct rig *rig = core->document->rigs[chain];
    core_message(core, false, "%.*s goes from %.*s to %.*s.", name_fit(rig_title(rig), 80), rig_title(rig),
                 name_fit(rig->chain.from, 100), rig->chain.from, name_fit(rig->chain.to, 100), rig->chain.to);
}

/// The names of the twin chain's ends; false if there is no twin or it already has a chain.
static bool find_twin(const struct core *core, int rig, char from[BONE_NAME_SIZE], char to[BONE_NAME_SIZE])
{
    if (core->document->rigs[rig]->kind != RIG_CHAIN) return false;
    const struct chain *chain = &core->document->rigs[rig]->chain;
    const int model = rig_body(core->document, rig);
    const struct imported *shown = model >= 0 ? bones_character(core, model) : NULL;
    if (!shown || !bone_other_side(chain->from, from) || !bone_other_side(chain->to, to)) return false;
    bool has_chain = false;
    for (int r = -1; (r = document_next_chain(core->document, model, r)) >= 0;)
        has_chain |= strcmp(core->document->rigs[r]->chain.from, from) == 0;
    return gltf_find_node(&shown->gltf, from) >= 0 && gltf_find_node(&shown->gltf, to) >= 0 && !has_chain;
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
    if (!core_step(core, "Mirror chain", 0) || !edit_rig_add(core->document, &twin, &core->step.error)) return;
    core_message(core, false, "Made the chain %s, mirrored, by the same splines.",
                 rig_title(core->document->rigs[core->document->rig_count - 1]));
}

void rigs_make_flesh(struct core *core)
{
    int model;
    const int node = bones_selected(core, &model);
    if (node < 0) model = characters_rig(core);
    if (model < 0) model = document_find_rig(core->document, RIG_MODEL, 0);
    core_request(core,
                 &(struct request){.kind = REQUEST_FLESH,
                                   .number = model,
                                   .text = node < 0 ? NULL : bones_character(core, model)->gltf.nodes[node].name});
}

// --- the selected soft character

bool rigs_is_soft(const struct core *core, int rig)
{
    const struct rig *at = core->document->rigs[rig];
    return at->kind == RIG_MODEL && (at->model.drive_count > 0 || models_figure(core->models, core->document, rig));
}

int characters_rig(const struct core *core)
{
    const struct document *document = core->document;
    const int chosen = document_find_rig(document, RIG_MODEL, core->focus.characters.character);
    int rig = -1;
    if (chosen >= 0 && rigs_is_soft(core, chosen)) return chosen;
    while ((rig = document_next_rig(document, RIG_MODEL, rig)) >= 0 && !rigs_is_soft(core, rig)) continue;
    return rig;
}

const struct model_rig *characters_selected(const struct core *core)
{
    const int rig = characters_rig(core);
    return rig >= 0 ? &core->document->rigs[rig]->model : NULL;
}

const struct figure *characters_figure(const struct core *core, int *coordinate)
{
    const struct model_rig *rig = characters_selected(core);
    const struct figure *figure = models_figure(core->models, core->document, characters_rig(core));
    if (!rig || !figure || core->focus.characters.drive >= rig->drive_count) return NULL;
    *coordinate = figure_find(figure, rig->drives[core->focus.characters.drive].name);
    return *coordinate >= 0 ? figure : NULL;
}

const struct coordinate *characters_coordinate(const struct core *core)
{
    int coordinate;
    const struct figure *figure = characters_figure(core, &coordinate);
    return figure ? &figure->character.coordinates[coordinate] : NULL;
}

void characters_set_brush(struct core *core, bool on)
{
    int coordinate;
    const struct figure *figure = on ? characters_figure(core, &coordinate) : NULL;
    core->focus.brush.on = figure != NULL;
    if (!on) return;
    if (!figure) {
        core_message(core, false, "This scene has no character to paint.");
        return;
    }

    // The phases along the axis of the largest movement, unless another was chosen.
    const float *largest = figure->largest[coordinate];
    int axis = 0;
    for (int k = 1; k < 3; k++) {
        if (largest[k] > largest[axis]) axis = k;
    }
    if (!core->view.on[SWITCH_PHASE_MAP]) core->focus.characters.axis = axis;
    core_message(core, false, "Drag over the character to paint. Ctrl reverses, Shift smooths, Esc ends.");
}

bool characters_blank_paint(struct core *core, const struct figure *figure)
{
    const struct character *character = &figure->character;
    return edit_paint_new(core->document, characters_rig(core), character->coordinate_count, character->vertex_count,
                          &core->step.error);
}

void characters_clean_paint(struct core *core)
{
    int coordinate;
    const struct model_rig *rig = characters_selected(core);
    const struct figure *figure = characters_figure(core, &coordinate);
    if (!figure || !rig->painted || paint_is_plain(rig->painted)) {
        core_message(core, false, "There is no paint to remove.");
        return;
    }
    if (core_step(core, "Remove paint", 0)) characters_blank_paint(core, figure);
}

// --- pins

static const double RESOLUTION = 1e-4; ///< metres, of saved positions

const struct pin *pins_next(const struct document *document, struct pin_place *place)
{
    place->at++;
    for (; place->rig < document->rig_count && place->at >= document->rigs[place->rig]->pin_count; place->rig++)
        place->at = 0;
    return place->rig < document->rig_count ? &document->rigs[place->rig]->pins[place->at] : NULL;
}

const struct pin *pins_selected(const struct core *core, int *rig)
{
    struct pin_place place = PINS_START;
    const struct pin *pin = NULL;
    while (core->focus.pin && (pin = pins_next(core->document, &place)) && pin->id != core->focus.pin) continue;
    *rig = place.rig;
    return pin;
}

bool pins_any_selected(const struct core *core)
{
    int rig;
    return pins_selected(core, &rig) != NULL;
}

uint32_t pins_color(const struct document *document, int rig)
{
    const int spline = rig_point_spline(document->rigs[rig]);
    return spline >= 0 ? spline_list_color(document, spline) : theme()->text_dim;
}

void pins_visit(struct core *core, const struct pin *pin)
{
    playback_seek(core, pin->frame);
    selection_clear(&core->focus.selection);
    core->focus.pin = pin->id;
}

double pins_frame_here(const struct core *core, int rig)
{
    const struct document *document = core->document;
    const int sample = document_sample(document, round(core_frame(core)));
    const int last = pins_last_sample(document, document->rigs[rig]);
    return document_frame(document, sample < 0 ? 0 : sample > last ? last : sample);
}

bool pins_set(struct document *document, int rig, const struct pin *pin, struct error *error)
{
    struct pin rounded = *pin;
    for (int k = 0; k < 3; k++) rounded.to[k] = core_round(pin->to[k], RESOLUTION);
    return edit_pin_set(document, rig, &rounded, error);
}

void pins_tell(struct core *core, int rig)
{
    const struct rig *moved = core->document->rigs[rig];
    for (int i = 0; i < rig_input_count(moved); i++) {
        if (rig_point_input(moved, i) >= 0) core_edited(core, rig_point_input(moved, i));
    }
}

bool pins_put(struct core *core, int rig, int point, double frame, const double to[3])
{
    const struct document *document = core->document;
    const int sample = document_sample(document, frame);
    const int there = pins_find(document, document->rigs[rig], point, sample);
    struct pin pin = {.frame = frame, .point = point};
    if (there >= 0) pin = document->rigs[rig]->pins[there];
    for (int k = 0; k < 3; k++) pin.to[k] = to[k];
    if (!pins_set(core->document, rig, &pin, &core->step.error)) return false;
    selection_clear(&core->focus.selection);
    core->focus.pin = document->rigs[rig]->pins[pins_find(document, document->rigs[rig], point, sample)].id;
    pins_tell(core, rig);
    return true;
}

void pins_put_here(struct core *core, int rig, int point, const double to[3])
{
    const double frame = pins_frame_here(core, rig);
    if (!core_step(core, "Pin", 0) || !pins_put(core, rig, point, frame, to)) return;
    core_message(core, false, "Pinned at frame %.6g. Drag the marker, or type its place in the section Pins.", frame);
    playback_seek(core, frame);
}

/// Moves the selected pin in a step. Moves with the same label are one step. false if it fails.
static bool move_selected(struct core *core, int rig, const struct pin *moved, const char *label)
{
    const uint64_t merge = hash_word(hash_bytes(HASH_START, label, strlen(label)), moved->id);
    const bool done = core_step(core, label, merge) && pins_set(core->document, rig, moved, &core->step.error);
    if (done) pins_tell(core, rig);
    return done;
}

void pins_nudge(struct core *core, const double by[3])
{
    int rig;
    const struct pin *pin = pins_selected(core, &rig);
    if (!pin) return;
    struct pin moved = *pin;
    for (int k = 0; k < 3; k++) moved.to[k] += by[k];
    move_selected(core, rig, &moved, "Nudge pin");
}

void pins_retime(struct core *core, int frames)
{
    int rig;
    const struct document *document = core->document;
    const struct pin *pin = pins_selected(core, &rig);
    if (!pin) return;
    struct pin moved = *pin;
    int sample;
    do {
        moved.frame += frames;
        sample = document_sample(document, moved.frame);
        if (sample < 0 || sample > pins_last_sample(document, document->rigs[rig])) return;
    } while (pins_find(document, document->rigs[rig], pin->point, sample) >= 0);
    if (move_selected(core, rig, &moved, "Move pin in time")) playback_seek(core, moved.frame);
}

/// Orders by frame, then id.
static bool is_before(const struct pin *a, const struct pin *b)
{
    return a->frame != b->frame ? a->frame < b->frame : a->id < b->id;
}

void pins_select_neighbour(struct core *core, int direction)
{
    int rig;
    const struct pin *from = pins_selected(core, &rig), *best = NULL;
    struct pin_place place = PINS_START;
    for (const struct pin *pin; from && (pin = pins_next(core->document, &place));) {
        if (pin == from || is_before(pin, from) == (direction > 0)) continue;
        if (!best || is_before(pin, best) == (direction > 0)) best = pin;
    }
    if (best) pins_visit(core, best);
}

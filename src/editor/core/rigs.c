/// Adds and removes rigs.
#include "editor/core/rigs.h"
#include "base/names.h"
#include "base/need.h"
#include "editor/core/core.h"
#include "scene/order.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

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
    static const enum rig_kind kinds[] = {
        [LEAD_TAIL] = RIG_TAIL, [LEAD_CHARACTER] = RIG_CHARACTER, [LEAD_CHAIN] = RIG_CHAIN, [LEAD_MODEL] = RIG_MODEL};
    enum lead lead = LEAD_TAIL;
    while (lead < LEAD_MESH && document_next_rig(core->document, kinds[lead], -1) < 0) lead++;
    if (lead == LEAD_MESH) return LEAD_NOTHING;
    return lead == LEAD_MODEL && !rigs_have_bones(core) ? LEAD_MESH : lead;
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
    const int number = document_rig_number(core->document, rig);
    const struct figure *figure = at->kind == RIG_CHARACTER ? models_figure(core->models, number) : NULL;
    const struct imported *imported =
        at->kind == RIG_MODEL ? models_imported(core->models, core->document, rig) : NULL;
    *width = ROOM;
    if (figure) *width = (double)(figure->hi[0] - figure->lo[0]);
    if (imported) *width = (double)(imported->gltf.hi[0] - imported->gltf.lo[0]) * at->model.scale;
    if (at->kind == RIG_CHARACTER) return at->character.position[0];
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

/// The active spline, or a new one with a knot at the playhead; -1 on failure.
static int spline_to_use(struct core *core)
{
    if (core_active_spline(core)) return core->active;
    const struct knot first = {.frame = round(core_frame(core))};
    const bool done = edit_spline_add(core->document, -1, NULL, &first, &core->error);
    return done ? core->document->spline_count - 1 : -1;
}

void rigs_add_tail(struct core *core)
{
    struct document *document = core->document;
    const double place = free_place(core, ROOM);
    if (!core_step(core, "Add tail", 0)) return;
    const int spline = spline_to_use(core);
    bool done = spline >= 0 && edit_tail_add(document, -1, spline, &core->error);
    if (done) {
        struct rig added = *document->rigs[document->rig_count - 1];
        added.tail.position[0] = param_number(place);
        done = edit_rig_set(document, document->rig_count - 1, &added, &core->error);
    }
    core->refit_stage = done;
    if (done) core_activate(core, spline);
}

/// Copies a model's chains onto its copy, the last rig.
static bool copy_chains(struct core *core, int model, const char *copy)
{
    const int count = core->document->rig_count;
    bool done = true;
    for (int r = 0; r < count && done; r++) {
        if (r == model || rig_body(core->document, r) != model) continue;
        struct rig chain = *core->document->rigs[r];
        char *name = need_text(copy);
        chain.chain.model = name;
        chain.pin_count = 0;
        done = edit_rig_add(core->document, &chain, &core->error);
        free(name);
    }
    return done;
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
    switch (copy.kind) {
    case RIG_TAIL:
        break;
    case RIG_CHARACTER:
        copy.character.position[0] = place;
        break;
    case RIG_MODEL:
        copy.model.position[0] = place;
        break;
    case RIG_CHAIN:
    case RIG_KINDS:
        core_message(core, false, "A chain is copied with its character: copy that.");
        return;
    }
    if (!core_step(core, "Add one more", 0)) return;
    bool done = copy.kind == RIG_TAIL ? edit_tail_add(document, rig, core->active, &core->error)
                                      : edit_rig_add(document, &copy, &core->error);
    if (done && copy.kind == RIG_MODEL) done = copy_chains(core, rig, document->rigs[document->rig_count - 1]->name);
    core->refit_stage = done;
}

/// What goes with a rig: its chains, and splines that move nothing else.
struct removal {
    const struct document *document;
    int rig;
    bool *mine, *others; ///< by spline: used by removed rigs, by others
};

static bool goes(const struct removal *removal, int rig)
{
    return rig == removal->rig || rig_body(removal->document, rig) == removal->rig;
}

static void survey(struct removal *removal, const struct document *document, int rig)
{
    const size_t count = (size_t)document->spline_count + 1;
    *removal = (struct removal){document, rig, need_zeroed(count, sizeof(bool)), need_zeroed(count, sizeof(bool))};
    for (struct reference reference = {0}; reference_next(document, &reference);) {
        const bool stays = reference.kind == REFERENCE_TRACK || !goes(removal, reference.owner);
        (stays ? removal->others : removal->mine)[reference.spline] = true;
    }
}

static void forget(struct removal *removal)
{
    free(removal->mine);
    free(removal->others);
}

/// The names of splines that move only this rig, comma-separated; returns how many.
static int own_splines(const struct document *document, int rig, char *names, size_t size)
{
    struct removal removal;
    int count = 0;
    size_t used = 0;
    names[0] = '\0';
    survey(&removal, document, rig);
    for (int s = 0; s < document->spline_count; s++) {
        if (!removal.mine[s] || removal.others[s]) continue;
        const int wrote = snprintf(names + used, size - used, "%s%.*s", count > 0 ? ", " : "",
                                   name_fit(document->splines[s]->name, 40), document->splines[s]->name);
        used = used + (size_t)wrote < size ? used + (size_t)wrote : size - 1;
        count++;
    }
    forget(&removal);
    return count;
}

/// Splines that follow a joint of a removed rig keep their value at the playhead.
static bool let_go(struct core *core, const struct removal *removal)
{
    const struct document *document = core->document;
    bool done = true;
    for (int s = 0; s < document->spline_count && done; s++) {
        bool follows = false;
        for (int r = 0; r < document->rig_count; r++) follows |= goes(removal, r) && document_follows(document, s, r);
        if (!follows) continue;
        const double present = spline_list_present(core, s, PARAMETER_EQUILIBRIUM);
        done = core_set_parameter(core, s, PARAMETER_EQUILIBRIUM, core_round(present, 1e-3));
    }
    return done;
}

static bool remove_rigs(struct core *core, struct removal *removal)
{
    bool done = true;
    for (int r = core->document->rig_count - 1; r >= 0 && done; r--) {
        if (r == removal->rig || !goes(removal, r)) continue;
        done = edit_rig_remove(core->document, r, &core->error);
        if (r < removal->rig) removal->rig--;
    }
    return done && edit_rig_remove(core->document, removal->rig, &core->error);
}

static bool remove_splines(struct core *core, const struct removal *removal)
{
    bool done = true;
    for (int s = core->document->spline_count - 1; s >= 0 && done; s--) {
        if (removal->mine[s] && !removal->others[s]) done = edit_spline_remove(core->document, s, &core->error);
    }
    return done;
}

static void remove_rig(struct core *core, int rig, bool with_splines)
{
    struct removal removal;
    if (rig < 0 || rig >= core->document->rig_count) return;
    if (!core_step(core, with_splines ? "Remove with splines" : "Remove", 0)) return;
    survey(&removal, core->document, rig);
    if (let_go(core, &removal) && remove_rigs(core, &removal) && with_splines) remove_splines(core, &removal);
    forget(&removal);
}

static void answer_removal(void *dialogs, struct core *core, int answer)
{
    (void)dialogs;
    remove_rig(core, core->subject.rig, answer == 0);
}

void rigs_ask_remove(struct core *core, int rig)
{
    static const struct answer answers[] = {
        {"dialog.with", "With splines", 'W'}, {"dialog.keep", "Keep splines", 'K'}, {"dialog.cancel", "Cancel", 'C'}};
    if (rig < 0 || rig >= core->document->rig_count) {
        core_message(core, false, "There is nothing on the stage to remove.");
        return;
    }
    char names[160];
    const int count = own_splines(core->document, rig, names, sizeof names);
    if (count == 0) {
        remove_rig(core, rig, false);
        return;
    }
    struct question *question = core_ask(core, answers, 3, answer_removal);
    core->subject.rig = rig;
    snprintf(question->title, sizeof question->title, "Remove %.*s, with its spline%s or without?",
             name_fit(path_name(rig_title(core->document->rigs[rig])), 150),
             path_name(rig_title(core->document->rigs[rig])), count == 1 ? "" : "s");
    snprintf(question->note, sizeof question->note, "%s move%s nothing else. Keep %s for what you add next?", names,
             count == 1 ? "s" : "", count == 1 ? "it" : "them");
}

/// Edits that add rigs, and those of imported characters and of chains on them.
#include "base/path.h"
#include "scene/edit_rig.h"
#include "scene/rig_kind.h"
#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static bool check_place(const struct model_rig *model, struct error *error)
{
    bool finite = isfinite(model->turn);
    for (int k = 0; k < 3; k++) finite &= isfinite(model->position[k]) != 0;
    if (!finite) return fail(error, ERROR_INPUT, "position and turn must be finite");
    return (isfinite(model->scale) && model->scale > 0) ||
           fail(error, ERROR_INPUT, "the scale must be above 0 and finite");
}

static bool check_ends(const struct chain *chain, struct error *error)
{
    if (!chain->from || !chain->from[0] || !chain->to || !chain->to[0]) {
        return fail(error, ERROR_INPUT, "a chain needs the names of its first joint and its last");
    }
    return isfinite(chain->turn) || fail(error, ERROR_INPUT, "the turn must be finite");
}

static bool check_chain(const struct document *document, const struct rig *rig, struct error *error)
{
    const struct chain *chain = &rig->chain;
    const char *model = chain->model ? chain->model : "";
    if (!check_ends(chain, error)) return false;
    if (document_find_model(document, model, false) < 0 && document_find_model(document, model, true) < 0) {
        return fail(error, ERROR_INPUT, "there is no model \"%s\" in the scene", model);
    }
    if (chain->channel_count < 0 || chain->channel_count > SCENE_MAX_CHANNELS) {
        return fail(error, ERROR_INPUT, "a chain has at most %d channels", SCENE_MAX_CHANNELS);
    }
    for (int c = 0; c < chain->channel_count; c++) {
        const struct channel *channel = &chain->channels[c];
        if (!plan_has_spline(document, channel->spline, error) || !plan_check_axis(RIG_CHAIN, channel->axis, error) ||
            !plan_check_part(channel->of, error) || !plan_check_angles(rig, &channel->lag, error) ||
            !plan_check_angles(rig, &channel->gain, error))
            return false;
    }
    return true;
}

static bool check_character(const struct document *document, const struct character_rig *rig, struct error *error)
{
    if (!rig->model || !rig->model[0]) return fail(error, ERROR_INPUT, "a character needs a file");
    bool finite = true;
    for (int k = 0; k < 3; k++) finite &= isfinite(rig->position[k]) != 0;
    if (!finite) return fail(error, ERROR_INPUT, "the position must be finite");
    for (int i = 0; i < rig->drive_count; i++) {
        if (!plan_has_spline(document, rig->drives[i].spline, error)) return false;
    }
    return true;
}

static bool check_contents(const struct document *document, const struct rig *rig, struct error *error)
{
    if (rig->kind == RIG_CHARACTER) return check_character(document, &rig->character, error);
    if (rig->kind == RIG_MEADOW) return plan_has_spline(document, rig->meadow.spline, error);
    if (rig->kind == RIG_CHAIN) return check_chain(document, rig, error);
    if (!rig->model.model || !rig->model.model[0]) return fail(error, ERROR_INPUT, "a model needs a file");
    return check_place(&rig->model, error);
}

/// Its name, or what it goes by: a file without folders and ending, or a joint.
static char *new_name(const struct document *document, const struct rig *rig)
{
    if (rig->name && rig->name[0]) return plan_rig_free_name(document, rig->name);
    if (rig->kind == RIG_CHAIN) return plan_rig_free_name(document, rig->chain.from);
    if (rig->kind == RIG_MEADOW) return plan_rig_free_name(document, "meadow");
    const char *path = rig->kind == RIG_CHARACTER ? rig->character.model : rig->model.model;
    const char *file = path_name(path), *dot = strrchr(file, '.');
    char *stem = strndup(file, dot && dot > file ? (size_t)(dot - file) : strlen(file));
    char *name = stem ? plan_rig_free_name(document, stem[0] ? stem : "model") : NULL;
    free(stem);
    return name;
}

static bool add(struct document *document, const struct rig *contents, struct change_list *list, struct error *error)
{
    if (!plan_rig_fits(document, error) || !check_contents(document, contents, error)) return false;
    struct rig named = *contents, *rig = malloc(sizeof *rig);
    named.extra = NULL;
    for (int i = 0; named.kind == RIG_CHARACTER && i < named.character.drive_count; i++) {
        struct drive *drive = &named.character.drives[i];
        drive->name = document_keep_text(document, drive->name);
        if (!drive->name) {
            free(rig);
            return plan_no_memory(error);
        }
    }
    named.name = new_name(document, contents);
    const bool copied = rig && named.name && rig_copy(&named, rig);
    free(named.name);
    if (!copied) {
        free(rig);
        return plan_no_memory(error);
    }
    if (rig->kind == RIG_CHAIN) rig->chain.by_file = document_find_model(document, rig->chain.model, false) < 0;
    return plan_rig_append(document, rig, list, error);
}

bool plan_model_add(struct document *document, const struct edit *edit, struct change_list *list, struct error *error)
{
    assert(edit->contents->kind == RIG_MODEL);
    return add(document, edit->contents, list, error);
}

bool plan_rig_add(struct document *document, const struct edit *edit, struct change_list *list, struct error *error)
{
    assert(edit->contents->kind == RIG_CHARACTER || edit->contents->kind == RIG_MEADOW);
    return add(document, edit->contents, list, error);
}

bool plan_chain_add(struct document *document, const struct edit *edit, struct change_list *list, struct error *error)
{
    assert(edit->contents->kind == RIG_CHAIN);
    return add(document, edit->contents, list, error);
}

bool plan_clip(struct document *document, const struct edit *edit, struct change_list *list, struct error *error)
{
    const char *old = document->rigs[edit->rig].model.clip, *clip = edit->text && edit->text[0] ? edit->text : NULL;
    if (old == clip || (old && clip && strcmp(old, clip) == 0)) return true;
    struct rig *rig = plan_rig_begin(document, edit->rig, error);
    if (!rig) return false;
    free(rig->model.clip);
    rig->model.clip = clip ? strdup(clip) : NULL;
    if (clip && !rig->model.clip) return plan_rig_abandon(rig, error);
    return plan_rig_finish(edit->rig, rig, list, error);
}

bool plan_place(struct document *document, const struct edit *edit, struct change_list *list, struct error *error)
{
    const struct model_rig *old = &document->rigs[edit->rig].model, *wanted = &edit->contents->model;
    if (!check_place(wanted, error)) return false;
    bool same = old->scale == wanted->scale && old->turn == wanted->turn;
    for (int k = 0; k < 3; k++) same &= old->position[k] == wanted->position[k];
    if (same) return true;
    struct rig *rig = plan_rig_begin(document, edit->rig, error);
    if (!rig) return false;
    for (int k = 0; k < 3; k++) rig->model.position[k] = wanted->position[k] + 0.0;
    rig->model.scale = wanted->scale;
    rig->model.turn = wanted->turn + 0.0;
    return plan_rig_finish(edit->rig, rig, list, error);
}

bool plan_chain(struct document *document, const struct edit *edit, struct change_list *list, struct error *error)
{
    const struct chain *old = &document->rigs[edit->rig].chain, *wanted = &edit->contents->chain;
    if (!check_ends(wanted, error)) return false;
    if (strcmp(old->from, wanted->from) == 0 && strcmp(old->to, wanted->to) == 0 && old->turn == wanted->turn &&
        old->mirror == wanted->mirror)
        return true;
    struct rig *rig = plan_rig_begin(document, edit->rig, error);
    if (!rig) return false;
    free(rig->chain.from);
    free(rig->chain.to);
    rig->chain.from = strdup(wanted->from);
    rig->chain.to = strdup(wanted->to);
    rig->chain.turn = wanted->turn + 0.0;
    rig->chain.mirror = wanted->mirror;
    const bool copied = rig->chain.from && rig->chain.to;
    return copied ? plan_rig_finish(edit->rig, rig, list, error) : plan_rig_abandon(rig, error);
}

static bool same_meadow(const struct meadow_rig *a, const struct meadow_rig *b)
{
    return a->count == b->count && a->seed == b->seed && a->area[0] == b->area[0] && a->area[1] == b->area[1] &&
           a->height == b->height && a->variation == b->variation && a->lag == b->lag && a->gain == b->gain;
}

bool plan_meadow(struct document *document, const struct edit *edit, struct change_list *list, struct error *error)
{
    const struct meadow_rig *old = &document->rigs[edit->rig].meadow, *wanted = &edit->contents->meadow;
    const bool fits = wanted->count >= 1 && wanted->count <= MEADOW_MAX_REEDS && wanted->seed >= 0 &&
                      wanted->height > 0 && wanted->area[0] > 0 && wanted->area[1] > 0 && wanted->variation >= 0;
    if (!fits) return fail(error, ERROR_INPUT, "a meadow has 1 to %d reeds, an area and a height", MEADOW_MAX_REEDS);
    if (same_meadow(old, wanted)) return true;
    struct rig *rig = plan_rig_begin(document, edit->rig, error);
    if (!rig) return false;
    const int spline = rig->meadow.spline;
    rig->meadow = *wanted;
    rig->meadow.spline = spline;
    rig->meadow.lag += 0.0, rig->meadow.gain += 0.0;
    return plan_rig_finish(edit->rig, rig, list, error);
}

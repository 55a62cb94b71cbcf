/// Edits that rename and remove rigs, and what edits of rigs share.
#include "scene/edit_rig.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { NAME_SIZE = 512 };

struct rig *plan_rig_begin(const struct document *document, int index, struct error *error)
{
    struct rig *rig = malloc(sizeof *rig);
    if (rig && rig_copy(&document->rigs[index], rig)) return rig;
    free(rig);
    plan_no_memory(error);
    return NULL;
}

bool plan_rig_finish(int index, struct rig *rig, struct change_list *list, struct error *error)
{
    return plan_add(list, &(struct change){.kind = CHANGE_RIG, .spline = -1, .rig = {index, rig}}, error);
}

bool plan_rig_abandon(struct rig *rig, struct error *error)
{
    rig_release(rig);
    free(rig);
    return plan_no_memory(error);
}

bool plan_rig_append(struct document *document, struct rig *rig, struct change_list *list, struct error *error)
{
    const int count = document->rig_count;
    if (!document_reserve_rigs(document, count + 1)) return plan_rig_abandon(rig, error);
    return plan_add(list, &(struct change){.kind = CHANGE_RIG_OUT, .spline = -1, .rig = {count, rig}}, error);
}

bool plan_rig_fits(const struct document *document, struct error *error)
{
    return document->rig_count < SCENE_MAX_RIGS ||
           fail(error, ERROR_INPUT, "there are %d rigs, and no more fit", SCENE_MAX_RIGS);
}

static bool is_taken(const struct document *document, const char *name, int own)
{
    for (int r = 0; r < document->rig_count; r++) {
        const char *other = document->rigs[r].name;
        if (r != own && other && strcmp(other, name) == 0) return true;
    }
    return false;
}

/// Whether a chain of the document is on the model rig at `model`.
static bool is_on(const struct document *document, int chain, int model)
{
    const struct rig *rig = &document->rigs[chain];
    return rig->kind == RIG_CHAIN && document_find_model(document, rig->chain.model, rig->chain.by_file) == model;
}

static const struct joint_motion *motion_of_spline(const struct document *document, int spline)
{
    return document->splines[spline].parameter[PARAMETER_EQUILIBRIUM].motion;
}

static void append_name(char list[NAME_SIZE], const char *name)
{
    const size_t used = strlen(list);
    snprintf(list + used, NAME_SIZE - used, "%s%s", used > 0 ? ", " : "", name);
}

bool plan_rig_remove(struct document *document, const struct edit *edit, struct change_list *list,
                     struct error *error)
{
    const struct rig *rig = &document->rigs[edit->rig];
    char users[NAME_SIZE] = "";
    for (int r = 0; r < document->rig_count; r++) {
        if (is_on(document, r, edit->rig)) append_name(users, rig_title(&document->rigs[r]));
    }
    for (int s = 0; s < document->spline_count; s++) {
        if (document_follows(document, s, edit->rig)) append_name(users, document->splines[s].name);
    }
    if (users[0]) {
        return fail(error, ERROR_INPUT, "%s: still needed by %s; remove those first", rig_title(rig), users);
    }
    struct rig *room = malloc(sizeof *room);
    if (!room) return plan_no_memory(error);
    return plan_add(list, &(struct change){.kind = CHANGE_RIG_IN, .spline = -1, .rig = {edit->rig, room}}, error);
}

/// Whether a chain or a spline goes by that file: a model of that name would take it over.
static bool is_file_of_any(const struct document *document, const char *name)
{
    bool any = false;
    for (int r = 0; r < document->rig_count; r++) {
        const struct rig *rig = &document->rigs[r];
        any |= rig->kind == RIG_CHAIN && rig->chain.by_file && strcmp(rig->chain.model, name) == 0;
    }
    for (int s = 0; s < document->spline_count; s++) {
        const struct joint_motion *motion = motion_of_spline(document, s);
        any |= motion && motion->by_file && strcmp(motion->model, name) == 0;
    }
    return any;
}

char *plan_rig_free_name(const struct document *document, const char *wanted)
{
    char name[NAME_SIZE];
    snprintf(name, sizeof name, "%s", wanted);
    for (int n = 2; is_taken(document, name, -1) || is_file_of_any(document, name); n++)
        snprintf(name, sizeof name, "%.*s %d", NAME_SIZE - 16, wanted, n);
    return strdup(name);
}

static bool check_name(const struct document *document, const struct edit *edit, const char *name,
                       struct error *error)
{
    const enum rig_kind kind = document->rigs[edit->rig].kind;
    if (!name[0]) return fail(error, ERROR_INPUT, "a %s needs a name", rig_word(kind));
    if (is_taken(document, name, edit->rig)) {
        return fail(error, ERROR_INPUT, "there is a rig called %s already", name);
    }
    if (kind == RIG_MODEL && is_file_of_any(document, name)) {
        return fail(error, ERROR_INPUT, "%s is the file by which a model is found", name);
    }
    return true;
}

/// Adds the change of one text of a rig.
static bool set_text(struct document *document, int index, char **(*text)(struct rig *rig), const char *value,
                     struct change_list *list, struct error *error)
{
    struct rig *rig = plan_rig_begin(document, index, error);
    if (!rig) return false;
    free(*text(rig));
    *text(rig) = strdup(value);
    return *text(rig) ? plan_rig_finish(index, rig, list, error) : plan_rig_abandon(rig, error);
}

static char **name_of(struct rig *rig) { return &rig->name; }
static char **model_of(struct rig *rig) { return &rig->chain.model; }

/// Lets a spline follow the same joint under the rig's new name.
static bool rename_followed(struct document *document, int spline, const char *old, const char *name,
                            struct change_list *list, struct error *error)
{
    struct change change = {
        .kind = CHANGE_SETTINGS, .spline = spline, .settings = settings_of(&document->splines[spline])};
    struct param *param = &change.settings.parameter[PARAMETER_EQUILIBRIUM];
    struct joint_motion motion = *param->motion;
    char *const copy = strdup(name);
    if (!motion.by_file && strcmp(motion.model, old) == 0) motion.model = copy;
    if (motion.chain && strcmp(motion.chain, old) == 0) motion.chain = copy;
    param->motion = copy ? motion_list_keep(&document->motions, &motion) : NULL;
    free(copy);
    return param->motion ? plan_add(list, &change, error) : plan_no_memory(error);
}

/// All that goes by the rig's name goes by the new one.
static bool rename_users(struct document *document, int rig, const char *name, struct change_list *list,
                         struct error *error)
{
    const char *old = document->rigs[rig].name;
    for (int r = 0; r < document->rig_count; r++) {
        const bool goes_by_name = is_on(document, r, rig) && !document->rigs[r].chain.by_file;
        if (goes_by_name && !set_text(document, r, model_of, name, list, error)) return false;
    }
    for (int s = 0; old && s < document->spline_count; s++) {
        if (document_follows(document, s, rig) && !rename_followed(document, s, old, name, list, error)) return false;
    }
    return true;
}

bool plan_rig_name(struct document *document, const struct edit *edit, struct change_list *list, struct error *error)
{
    const char *name = edit->text ? edit->text : "", *old = document->rigs[edit->rig].name;
    if (!check_name(document, edit, name, error)) return false;
    if (old && strcmp(old, name) == 0) return true;
    return rename_users(document, edit->rig, name, list, error) &&
           set_text(document, edit->rig, name_of, name, list, error);
}

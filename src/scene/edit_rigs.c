/// Edits that add, rename and remove rigs, those of imported characters, chains on them, and of pins.
#include "base/file.h"
#include "base/names.h"
#include "base/need.h"
#include "scene/editing.h"
#include "scene/pins.h"
#include "scene/rig_kind.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { NAME_SIZE = 512 };

static bool rig_fits(const struct document *document, struct error *error)
{
    return document->rig_count < SCENE_MAX_RIGS ||
           fail(error, ERROR_INPUT, "there are %d rigs, and no more fit", SCENE_MAX_RIGS);
}

static bool is_taken(const struct document *document, const char *name, int own)
{
    for (int r = 0; r < document->rig_count; r++) {
        const char *other = document->rigs[r]->name;
        if (r != own && other && strcmp(other, name) == 0) return true;
    }
    return false;
}

static const struct joint_motion *motion_of_spline(const struct document *document, int spline)
{
    return document->splines[spline]->parameter[PARAMETER_EQUILIBRIUM].motion;
}

static void append_name(char list[NAME_SIZE], const char *name)
{
    const size_t used = strlen(list);
    if (used + 2 < NAME_SIZE)
        snprintf(list + used, NAME_SIZE - used, "%s%.*s", used > 0 ? ", " : "", name_fit(name, NAME_SIZE - used - 3),
                 name);
}

bool edit_rig_remove(struct document *document, int rig, struct error *error)
{
    char users[NAME_SIZE] = "";
    if (!edit_find_rig(document, rig, EDIT_ANY_KIND, error)) return false;
    for (int r = -1; (r = document_next_chain(document, rig, r)) >= 0;)
        append_name(users, rig_title(document->rigs[r]));
    for (int s = 0; s < document->spline_count; s++) {
        if (document_follows(document, s, rig)) append_name(users, document->splines[s]->name);
    }
    if (users[0]) {
        return fail(error, ERROR_INPUT, "%s: still needed by %s; remove those first", rig_title(document->rigs[rig]),
                    users);
    }
    document_remove_rig(document, rig);
    return true;
}

/// Whether a chain or a spline refers to a model by that file. A rig with that name would take its place.
static bool is_file_of_any(const struct document *document, const char *name)
{
    bool any = false;
    for (int r = 0; r < document->rig_count; r++) {
        const struct rig *rig = document->rigs[r];
        any |= rig->kind == RIG_CHAIN && rig->chain.by_file && strcmp(rig->chain.model, name) == 0;
    }
    for (int s = 0; s < document->spline_count; s++) {
        const struct joint_motion *motion = motion_of_spline(document, s);
        any |= motion && motion->by_file && strcmp(motion->model, name) == 0;
    }
    return any;
}

static void take(struct names *names, const char *name)
{
    if (name && !names_has(names, name)) names_add(names, name);
}

char *edit_rig_free_name(const struct document *document, const char *wanted)
{
    struct names names = {0};
    for (int r = 0; r < document->rig_count; r++) {
        const struct rig *rig = document->rigs[r];
        take(&names, rig->name);
        if (rig->kind == RIG_CHAIN && rig->chain.by_file) take(&names, rig->chain.model);
    }
    for (int s = 0; s < document->spline_count; s++) {
        const struct joint_motion *motion = motion_of_spline(document, s);
        if (motion && motion->by_file) take(&names, motion->model);
    }
    char *name = need_text(names_add(&names, wanted));
    names_free(&names);
    return name;
}

static bool check_name(const struct document *document, int rig, const char *name, struct error *error)
{
    const enum rig_kind kind = document->rigs[rig]->kind;
    if (!name[0]) return fail(error, ERROR_INPUT, "a %s needs a name", rig_word(kind));
    if (is_taken(document, name, rig)) {
        return fail(error, ERROR_INPUT, "there is a rig called %s already", name);
    }
    if (kind == RIG_MODEL && is_file_of_any(document, name)) {
        return fail(error, ERROR_INPUT, "expected a name that is no model's file, got %s", name);
    }
    return true;
}

static void set_text(char **text, const char *value)
{
    char *copy = value ? need_text(value) : NULL; // first: need_text() may save the document when memory runs out
    free(*text);
    *text = copy;
}

/// Makes a spline follow the same joint under the rig's new name.
static void rename_followed(struct document *document, int spline, const char *old, const char *name)
{
    struct param *param = &document_own_spline(document, spline)->parameter[PARAMETER_EQUILIBRIUM];
    struct joint_motion *motion = motion_create(param->motion);
    if (!motion->by_file && strcmp(motion->model, old) == 0) set_text(&motion->model, name);
    if (motion->chain && strcmp(motion->chain, old) == 0) set_text(&motion->chain, name);
    motion_drop(param->motion);
    param->motion = motion;
}

/// Changes all references to the rig's name.
static void rename_users(struct document *document, int rig, const char *old, const char *name)
{
    for (int s = 0; s < document->spline_count; s++) {
        if (document_follows(document, s, rig)) rename_followed(document, s, old, name);
    }
    for (int r = -1; (r = document_next_chain(document, rig, r)) >= 0;) {
        if (!document->rigs[r]->chain.by_file) set_text(&document_own_rig(document, r)->chain.model, name);
    }
}

bool edit_rig_name(struct document *document, int rig, const char *name, struct error *error)
{
    if (!edit_find_rig(document, rig, EDIT_ANY_KIND, error)) return false;
    if (!check_name(document, rig, name ? name : "", error)) return false;
    char *const old = document->rigs[rig]->name ? need_text(document->rigs[rig]->name) : NULL;
    if (!old || strcmp(old, name) != 0) {
        if (old) rename_users(document, rig, old, name);
        set_text(&document_own_rig(document, rig)->name, name);
    }
    free(old);
    return true;
}

/// The rig's name or, without one, a name from its file, joint or kind.
static char *new_name(const struct document *document, const struct rig *rig)
{
    const bool is_file = !(rig->name && rig->name[0]) && (rig->kind == RIG_CHARACTER || rig->kind == RIG_MODEL);
    const char *title = is_file ? path_name(rig_title(rig)) : rig_title(rig);
    const char *dot = is_file ? strrchr(title, '.') : NULL;
    char *stem = name_from(title, dot && dot > title ? (size_t)(dot - title) : strlen(title));
    char *name = edit_rig_free_name(document, stem[0] ? stem : "model");
    free(stem);
    return name;
}

bool edit_rig_add(struct document *document, const struct rig *contents, struct error *error)
{
    if (!rig_fits(document, error)) return false;
    struct rig *rig = rig_clone(contents);
    if (!rig_check(document, rig, error)) {
        rig_drop(rig);
        return false;
    }
    struct document *before = document_copy(document);
    free(rig->name);
    rig->name = new_name(document, contents);
    rig->extra = NULL;
    rig->id = document->next_id++;
    document_add_rig(document, rig);
    return edit_end(document, before, true, error);
}

bool edit_rig_set(struct document *document, int rig, const struct rig *wanted, struct error *error)
{
    return edit_find_rig(document, rig, EDIT_KIND(wanted->kind), error) &&
           edit_replace_rig(document, rig, rig_clone(wanted), error);
}

/// Whether a rig may have a pin. Turns −0 into 0.
static bool check_pin(const struct document *document, const struct rig *rig, struct pin *pin, struct error *error)
{
    struct error why;
    return fields_check(document, JOINTS_UNKNOWN, rig_pin_fields(rig), pin, &why) ||
           fail(error, ERROR_INPUT, "%s: a pin: %s", rig_title(rig), why.text);
}

/// The rig that has the pin; NULL and an error if there is none.
static const struct rig *find(const struct document *document, int rig, unsigned id, struct error *error)
{
    const struct rig *found = edit_find_rig(document, rig, EDIT_PINNED, error);
    if (!found || pins_find_id(found, id) >= 0) return found;
    fail(error, ERROR_INPUT, "%s: this pin no longer exists", rig_title(found));
    return NULL;
}

bool edit_pin_add(struct document *document, int rig, const struct pin *pin, struct error *error)
{
    const struct rig *old = edit_find_rig(document, rig, EDIT_PINNED, error);
    struct pin added = *pin;
    if (!old || !check_pin(document, old, &added, error)) return false;
    if (pins_count(document) >= SCENE_MAX_PINS)
        return fail(error, ERROR_INPUT, "the limit of %d pins is reached", SCENE_MAX_PINS);
    struct document *before = document_copy(document);
    added.id = document->next_id++;
    pins_insert(document_own_rig(document, rig), &added);
    return edit_end(document, before, true, error);
}

bool edit_pin_remove(struct document *document, int rig, unsigned id, struct error *error)
{
    if (!find(document, rig, id, error)) return false;
    struct document *before = document_copy(document);
    pins_remove(document_own_rig(document, rig), id);
    return edit_end(document, before, true, error);
}

bool edit_pin_set(struct document *document, int rig, const struct pin *pin, struct error *error)
{
    const struct rig *old = find(document, rig, pin->id, error);
    struct pin changed = *pin;
    if (!old || !check_pin(document, old, &changed, error)) return false;
    const struct pin *was = &old->pins[pins_find_id(old, pin->id)];
    if (fields_equal(rig_pin_fields(old), was, &changed)) return true;
    changed.extra = was->extra;
    struct document *before = document_copy(document);
    struct rig *own = document_own_rig(document, rig);
    pins_remove(own, changed.id);
    pins_insert(own, &changed);
    return edit_end(document, before, true, error);
}

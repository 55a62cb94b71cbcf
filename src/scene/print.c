/// Writes a document as the text of a scene file.
#include "base/file.h"
#include "scene/fields.h"
#include "scene/load.h"
#include "scene/order.h"
#include "scene/text.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static bool is_parameter(const char *key) { return parameter_find(key) != PARAMETER_COUNT; }

static bool is_variation(enum parameter p) { return p == PARAMETER_VARIATION || p == PARAMETER_SEED; }

/// Values that differ from the default are printed even if the mode does not use them, because another mode may.
static bool is_printed(const struct spline *spline, enum parameter parameter)
{
    const struct param *param = &spline->parameter[parameter];
    const struct parameter_row *row = &parameter_rows[parameter];
    if (row->kind == PARAMETER_LIMIT || is_variation(parameter)) return false;
    if (param_follows(param) || param->value != row->standard) return true;
    return row->print == PRINT_ALWAYS || (row->print == PRINT_USED && spline_uses(spline, parameter, false));
}

/// "limits": [low, high], if there are any; null: none.
static void print_limits(struct members *members, const struct spline *spline)
{
    const double limits[] = {spline->parameter[PARAMETER_LOW].value, spline->parameter[PARAMETER_HIGH].value};
    if (!isfinite(limits[0]) && !isfinite(limits[1])) return;
    member(members, parameter_key(PARAMETER_LOW));
    for (int i = 0; i < 2; i++) {
        text_string(members->text, i == 0 ? "[" : ", ");
        if (isfinite(limits[i]))
            text_number(members->text, limits[i]);
        else
            text_string(members->text, "null");
    }
    text_string(members->text, "]");
}

/// "variation": { "seed", "amount" }, if there is one.
static void print_variation(struct members *members, const struct spline *spline)
{
    const double amount = spline->parameter[PARAMETER_VARIATION].value,
                 seed = spline->parameter[PARAMETER_SEED].value;
    json_t *extra = json_object_get(spline->extra, parameter_key(PARAMETER_VARIATION));
    if (amount == 0 && seed == 0 && !extra) return;
    member(members, parameter_key(PARAMETER_VARIATION));
    struct members pair = {members->text, "{ ", ", ", false};
    member_number(&pair, "seed", seed);
    member_number(&pair, "amount", amount);
    members_extra(&pair, extra, NULL);
    text_string(members->text, " }");
}

static void print_spline(struct text *text, const struct document *document, const struct spline *spline,
                         const char *folder)
{
    struct members members = {text, "    {\n      ", ",\n      ", false};
    member_string(&members, "name", spline->name);
    if (spline->color >= 0) {
        char color[COLOR_TEXT_SIZE];
        color_print(spline->color, color);
        member_string(&members, "color", color);
    }
    for (enum parameter p = 0; p < PARAMETER_COUNT; p++) {
        const char *name = parameter_key(p);
        if (p == PARAMETER_LOW) print_limits(&members, spline);
        if (p == PARAMETER_VARIATION) print_variation(&members, spline);
        if (!is_printed(spline, p)) continue;
        if (parameter_rows[p].kind == PARAMETER_CHOICE) {
            member_string(&members, name, parameter_rows[p].words[(int)spline->parameter[p].value]);
            continue;
        }
        member(&members, name);
        print_param(text, document, &spline->parameter[p], spline->extra, name, folder);
    }
    list_print(&members, document, &knot_list_field, spline, folder);
    members_extra(&members, spline->extra, is_parameter);
    text_string(text, "\n    }");
}

/// The format's version that the document needs: 2 only for paint.
static int version_for(const struct document *document)
{
    for (int i = 0; i < document->rig_count; i++) {
        const struct rig *rig = document->rigs[i];
        if (rig->kind == RIG_CHARACTER && rig->character.painted && !paint_is_plain(rig->character.painted)) return 2;
    }
    return 1;
}

static void print_origin(struct members *members, const struct scene_origin *origin)
{
    char absolute[PATH_LIMIT], content[32]; // absolute, because the working folder may differ next time
    if (!origin->path[0] || !path_resolve(NULL, origin->path, absolute)) return;
    struct members pair = {members->text, "{ ", ", ", false};
    snprintf(content, sizeof content, "%016llx", (unsigned long long)origin->content);
    member(members, "recovers");
    member_path(&pair, "file", NULL, absolute, NULL);
    member_string(&pair, "content", content);
    text_string(members->text, " }");
}

static bool is_rigs(const char *key) { return strcmp(key, "rigs") == 0; }

static void print_document(struct text *text, const struct document *document, const char *folder,
                           const struct scene_origin *origin)
{
    struct members members = {text, "{\n  ", ",\n  ", false};
    double frames[] = {document->first_frame, document->last_frame};
    member_number(&members, "wiggly", version_for(document));
    if (document->about) member_string(&members, "about", document->about);
    member_number(&members, "fps", document->fps);
    member_number(&members, "substeps", document->substeps);
    member(&members, "frames");
    text_numbers(text, frames, 2);
    member(&members, "splines");
    for (int i = 0; i < document->spline_count; i++) {
        text_string(text, i > 0 ? ",\n" : "[\n");
        print_spline(text, document, document->splines[i], folder);
    }
    text_string(text, document->spline_count > 0 ? "\n  ]" : "[]");
    member(&members, "rigs");
    print_rigs(text, document, folder);
    members_extra(&members, document->extra, is_rigs);
    if (origin) print_origin(&members, origin);
    text_string(text, "\n}\n");
}

char *scene_print_for(const struct document *document, const char *folder, const struct scene_origin *origin,
                      size_t *size)
{
    struct text text = {0};
    print_document(&text, document, folder, origin);
    *size = text.size;
    text_bytes(&text, "", 1);
    return text.data;
}

char *scene_print(const struct document *document, size_t *size)
{
    return scene_print_for(document, document->folder, NULL, size);
}

bool scene_save_for(const struct document *document, const char *path, const struct scene_origin *origin,
                    struct error *error)
{
    struct file_output output;
    char folder[PATH_LIMIT];
    size_t size;
    if (!path_folder(path, folder)) return fail(error, ERROR_ENVIRONMENT, "%s: the path is too long", path);
    char *text = scene_print_for(document, folder, origin, &size);
    const bool opened = file_output_open(&output, path, error);
    if (opened && origin) fchmod(fileno(output.stream), 0600); // readable by this user alone
    if (opened) fwrite(text, 1, size, output.stream);
    free(text);
    return opened && file_output_commit(&output, error);
}

bool scene_save(const struct document *document, const char *path, struct error *error)
{
    return scene_save_for(document, path, NULL, error);
}

uint64_t scene_hash(const struct document *document)
{
    uint64_t hash = 0xcbf29ce484222325u; // FNV-1a's offset basis
    size_t size;
    char *text = scene_print(document, &size);
    for (size_t i = 0; i < size; i++) hash = (hash ^ (unsigned char)text[i]) * 0x100000001b3u;
    free(text);
    return hash;
}

void member(struct members *members, const char *key)
{
    text_string(members->text, members->any ? members->separator : members->open);
    text_quoted(members->text, key);
    text_string(members->text, ": ");
    members->any = true;
}

void member_number(struct members *members, const char *key, double value)
{
    member(members, key);
    text_number(members->text, value);
}

void member_string(struct members *members, const char *key, const char *string)
{
    member(members, key);
    text_quoted(members->text, string);
}

void member_path(struct members *members, const char *key, const struct document *document, const char *path,
                 const char *folder)
{
    char moved[PATH_LIMIT];
    member(members, key);
    text_path(members->text, document && path_rebase(path, document->folder, folder, moved) ? moved : path);
}

void members_extra(struct members *members, json_t *extra, bool (*skips)(const char *key))
{
    const char *key;
    json_t *value;
    json_object_foreach(extra, key, value)
    {
        if (skips && skips(key)) continue;
        member(members, key);
        text_json(members->text, value);
    }
}

void text_numbers(struct text *text, const double *values, int count)
{
    text_string(text, "[");
    for (int i = 0; i < count; i++) {
        if (i > 0) text_string(text, ", ");
        text_number(text, values[i]);
    }
    text_string(text, "]");
}

void print_param(struct text *text, const struct document *document, const struct param *param, json_t *extras,
                 const char *key, const char *folder)
{
    if (!param_follows(param)) {
        text_number(text, param->value);
        return;
    }
    struct members track = {text, "{ ", ", ", false};
    if (param->motion) {
        fields_print(&track, document, motion_fields, param->motion, folder);
    } else {
        member_string(&track, "spline", document->splines[param->track]->name);
        members_extra(&track, json_object_get(extras, key), NULL);
    }
    text_string(text, " }");
}

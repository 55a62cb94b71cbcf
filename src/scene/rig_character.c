/// Characters in the file, in memory and among the references to splines.
#include "base/path.h"
#include "scene/rig_kind.h"
#include <stdlib.h>
#include <string.h>

_Static_assert((int)CHARACTER_MAX_DRIVES <= (int)RIG_MAX_INPUTS, "a drive is an input");

static const char *const character_keys[] = {"type",        "name",   "model", "position",
                                             "coordinates", "phases", "paint", NULL};
static const char *const axes[] = {"x", "y", "z", NULL};
static const char *const drive_keys[] = {"name", "spline", "amplitude", "lag", NULL};

static void load_position(struct reader *reader, const struct where *at, const json_t *value, double position[3])
{
    if (!value || !reader_array(reader, at, value, 3, "[x, y, z]")) return;
    for (size_t i = 0; i < 3; i++) {
        struct where element_at = {.parent = at, .index = i};
        reader_number(reader, &element_at, json_array_get(value, i), true, range_any, &position[i]);
    }
}

static void load_drive(struct reader *reader, const struct where *at, json_t *object, struct drive *drive)
{
    struct where name_at, spline_at, amplitude_at, lag_at;
    const json_t *name = reader_member(at, object, "name", &name_at);
    const json_t *spline = reader_member(at, object, "spline", &spline_at);
    const json_t *amplitude = reader_member(at, object, "amplitude", &amplitude_at);
    const json_t *lag = reader_member(at, object, "lag", &lag_at);
    drive->amplitude = DRIVE_DEFAULT_AMPLITUDE;
    char *text = reader_name(reader, &name_at, name);
    if (text) drive->name = document_keep_text(reader->document, text);
    if (text && !drive->name) reader_no_memory(reader);
    free(text);
    drive->spline = reader_spline_name(reader, &spline_at, spline);
    reader_number(reader, &amplitude_at, amplitude, false, range_any, &drive->amplitude);
    reader_number(reader, &lag_at, lag, false, range_any, &drive->lag);
    drive->extra = reader_keep(reader, reader_extra(reader, at, object, drive_keys));
}

static void load(struct reader *reader, const struct where *at, json_t *object, struct rig *rig)
{
    struct character_rig *character = &rig->character;
    struct where name_at, model_at, position_at, coordinates_at, phases_at, paint_at;
    const json_t *name = reader_member(at, object, "name", &name_at);
    const json_t *model = reader_member(at, object, "model", &model_at);
    const json_t *position = reader_member(at, object, "position", &position_at);
    const json_t *coordinates = reader_member(at, object, "coordinates", &coordinates_at);
    const json_t *phases = reader_member(at, object, "phases", &phases_at);
    const json_t *paint = reader_member(at, object, "paint", &paint_at);
    if (name) rig->name = reader_name(reader, &name_at, name);
    character->model = reader_name(reader, &model_at, model);
    if (paint) character->paint = reader_name(reader, &paint_at, paint);
    load_position(reader, &position_at, position, character->position);
    character->phases = phases ? reader_word(reader, &phases_at, phases, axes, -1) : -1;
    int count = reader_objects(reader, &coordinates_at, coordinates, CHARACTER_MAX_DRIVES);
    for (int i = 0; i < count; i++) {
        struct where drive_at = {.parent = &coordinates_at, .index = (size_t)i};
        load_drive(reader, &drive_at, json_array_get(coordinates, (size_t)i), &character->drives[i]);
    }
    character->drive_count = count > 0 ? count : 0;
    rig->extra = reader_keep(reader, reader_extra(reader, at, object, character_keys));
}

static void member_path(struct members *members, const char *key, const struct document *document, const char *path,
                        const char *folder)
{
    char moved[PATH_LIMIT];
    member_string(members, key, path_rebase(path, document->folder, folder, moved) ? moved : path);
}

static void print_drive(struct text *text, const struct document *document, const struct drive *drive)
{
    struct members members = {text, "{ ", ", ", false};
    member_string(&members, "name", drive->name);
    member_string(&members, "spline", document->splines[drive->spline].name);
    member_number(&members, "amplitude", drive->amplitude);
    member_number(&members, "lag", drive->lag);
    members_extra(&members, drive->extra, NULL);
    text_string(text, " }");
}

/// Paint that was taken away again, or that does nothing, needs no file; one that could not be read stays named.
static bool is_painted(const struct character_rig *character)
{
    if (!character->paint) return false;
    return character->painted ? !paint_is_plain(character->painted) : character->filed == 0;
}

static void print(struct members *members, const struct document *document, const struct rig *rig, const char *folder)
{
    const struct character_rig *character = &rig->character;
    struct text *text = members->text;
    member_path(members, "model", document, character->model, folder);
    member(members, "position");
    text_numbers(text, character->position, 3);
    member(members, "coordinates");
    for (int i = 0; i < character->drive_count; i++) {
        text_string(text, i > 0 ? ",\n        " : "[\n        ");
        print_drive(text, document, &character->drives[i]);
    }
    text_string(text, character->drive_count > 0 ? "\n      ]" : "[]");
    if (character->phases >= 0) member_string(members, "phases", axes[character->phases]);
    if (is_painted(character)) member_path(members, "paint", document, character->paint, folder);
}

static int input_count(const struct rig *rig) { return rig->character.drive_count; }

static int input(const struct rig *rig, int input) { return rig->character.drives[input].spline; }

static void references(const struct rig *rig, int index, reference_visitor *visit, void *context)
{
    for (int i = 0; i < rig->character.drive_count; i++) {
        visit(&(struct reference){REFERENCE_DRIVE, index, i, rig->character.drives[i].spline}, context);
    }
}

static void set_reference(struct rig *rig, const struct reference *reference, int spline)
{
    rig->character.drives[reference->which].spline = spline;
}

static void release(struct rig *rig)
{
    free(rig->character.model);
    free(rig->character.paint);
    paint_destroy(rig->character.painted);
}

static size_t bytes(const struct rig *rig)
{
    return strlen(rig->character.model) + 1 + paint_bytes(rig->character.painted);
}

/// Replaces a path by the one from the new folder.
static bool rebase_path(char **path, const char *from, const char *to)
{
    char moved[PATH_LIMIT];
    if (!*path || !path_rebase(*path, from, to, moved)) return true;
    char *copy = strdup(moved);
    if (!copy) return false;
    free(*path);
    *path = copy;
    return true;
}

static bool rebase(struct rig *rig, const char *from, const char *to)
{
    bool model = rebase_path(&rig->character.model, from, to);
    return rebase_path(&rig->character.paint, from, to) && model;
}

const struct rig_functions character_functions = {.word = "character",
                                                  .load = load,
                                                  .print = print,
                                                  .input_count = input_count,
                                                  .input = input,
                                                  .references = references,
                                                  .set_reference = set_reference,
                                                  .release = release,
                                                  .bytes = bytes,
                                                  .rebase = rebase};

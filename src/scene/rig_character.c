/// Characters as a kind of rig: loading, printing, references and memory.
#include "scene/rig_kind.h"
#include <stdlib.h>
#include <string.h>

_Static_assert((int)CHARACTER_MAX_DRIVES <= (int)RIG_MAX_INPUTS, "a drive is an input");

static const char *const character_keys[] = {"type",   "name",  "model", "position", "coordinates",
                                             "phases", "paint", "floor", "pins",     NULL};
static const char *const axes[] = {"x", "y", "z", NULL};
static const char *const drive_keys[] = {"name", "spline", "amplitude", "lag", NULL};

static void load_drive(struct reader *reader, struct value object, struct drive *drive)
{
    drive->amplitude = DRIVE_DEFAULT_AMPLITUDE;
    drive->name = reader_name(reader, reader_member(&object, "name"));
    drive->spline = reader_spline_name(reader, reader_member(&object, "spline"));
    reader_number(reader, reader_member(&object, "amplitude"), false, range_any, &drive->amplitude);
    reader_number(reader, reader_member(&object, "lag"), false, range_any, &drive->lag);
    drive->extra = reader_keep(reader, reader_extra(reader, &object, drive_keys));
}

static void load(struct reader *reader, const struct value *object, struct rig *rig)
{
    struct character_rig *character = &rig->character;
    const struct value name = reader_member(object, "name"), coordinates = reader_member(object, "coordinates");
    const struct value phases = reader_member(object, "phases"), paint = reader_member(object, "paint");
    const struct value floor = reader_member(object, "floor");
    if (name.json) rig->name = reader_name(reader, name);
    character->model = reader_name(reader, reader_member(object, "model"));
    character->has_floor = floor.json && reader_number(reader, floor, false, range_any, &character->floor);
    if (paint.json) character->file->path = reader_name(reader, paint);
    reader_point(reader, reader_member(object, "position"), character->position);
    character->phases = phases.json ? reader_word(reader, phases, axes, -1) : -1;
    int count = reader_objects(reader, coordinates, CHARACTER_MAX_DRIVES);
    for (int i = 0; i < count; i++) load_drive(reader, reader_element(&coordinates, i), &character->drives[i]);
    character->drive_count = count > 0 ? count : 0;
    rig->extra = reader_keep(reader, reader_extra(reader, object, character_keys));
}

static void print_drive(struct text *text, const struct document *document, const struct drive *drive)
{
    struct members members = {text, "{ ", ", ", false};
    member_string(&members, "name", drive->name);
    member_string(&members, "spline", document->splines[drive->spline]->name);
    member_number(&members, "amplitude", drive->amplitude);
    member_number(&members, "lag", drive->lag);
    members_extra(&members, drive->extra, NULL);
    text_string(text, " }");
}

/// Whether the scene names a paint file: not for paint that changes nothing, but still for a file that could not be read.
static bool is_painted(const struct character_rig *character)
{
    if (!character->file->path) return false;
    return character->painted ? !paint_is_plain(character->painted) : character->file->version == 0;
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
    if (character->has_floor) member_number(members, "floor", character->floor);
    if (is_painted(character)) member_path(members, "paint", document, character->file->path, folder);
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

static void copy(struct rig *copy)
{
    struct character_rig *character = &copy->character;
    rig_own_texts((char **const[]){&character->model}, 1);
    for (int i = 0; i < character->drive_count; i++) rig_own_texts((char **const[]){&character->drives[i].name}, 1);
    paint_hold(character->painted);
    paint_file_hold(character->file);
}

static void release(struct rig *rig)
{
    struct character_rig *character = &rig->character;
    for (int i = 0; i < character->drive_count; i++) free(character->drives[i].name);
    free(character->model);
    paint_drop(character->painted);
    paint_file_drop(character->file);
}

static size_t bytes(const struct rig *rig, const struct rig *other)
{
    const struct character_rig *character = &rig->character;
    const bool is_shared = other && other->character.painted == character->painted;
    return text_size(character->model) + (is_shared ? 0 : paint_bytes(character->painted));
}

static const char *title(const struct rig *rig) { return rig->character.model; }

const struct rig_functions character_functions = {.word = "character",
                                                  .load = load,
                                                  .print = print,
                                                  .pin_key = "vertex",
                                                  .input_count = input_count,
                                                  .input = input,
                                                  .references = references,
                                                  .set_reference = set_reference,
                                                  .copy = copy,
                                                  .release = release,
                                                  .bytes = bytes,
                                                  .title = title};

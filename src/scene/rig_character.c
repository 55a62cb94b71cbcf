/// Characters as a kind of rig.
#include "base/need.h"
#include "scene/rig_kind.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

_Static_assert((int)CHARACTER_MAX_DRIVES <= (int)RIG_MAX_INPUTS, "a drive is an input");

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

static void load_drives(struct reader *reader, const struct value *object, struct rig *rig)
{
    struct character_rig *character = &rig->character;
    const struct value coordinates = reader_member(object, "coordinates");
    int count = reader_objects(reader, coordinates, CHARACTER_MAX_DRIVES);
    for (int i = 0; i < count; i++) load_drive(reader, reader_element(&coordinates, i), &character->drives[i]);
    character->drive_count = count > 0 ? count : 0;
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

static void print_drives(struct members *members, const struct document *document, const struct rig *rig,
                         const char *folder)
{
    const struct character_rig *character = &rig->character;
    struct text *text = members->text;
    (void)folder;
    member(members, "coordinates");
    for (int i = 0; i < character->drive_count; i++) {
        text_string(text, i > 0 ? ",\n        " : "[\n        ");
        print_drive(text, document, &character->drives[i]);
    }
    text_string(text, character->drive_count > 0 ? "\n      ]" : "[]");
}

static void load_phases(struct reader *reader, const struct value *object, struct rig *rig)
{
    const struct value phases = reader_member(object, "phases");
    if (phases.json) rig->character.phases = reader_word(reader, phases, axes, -1);
}

static void print_phases(struct members *members, const struct document *document, const struct rig *rig,
                         const char *folder)
{
    (void)document, (void)folder;
    if (rig->character.phases >= 0) member_string(members, "phases", axes[rig->character.phases]);
}

static void load_floor(struct reader *reader, const struct value *object, struct rig *rig)
{
    const struct value floor = reader_member(object, "floor");
    rig->character.has_floor = floor.json && reader_number(reader, floor, false, range_any, &rig->character.floor);
}

static void print_floor(struct members *members, const struct document *document, const struct rig *rig,
                        const char *folder)
{
    (void)document, (void)folder;
    if (rig->character.has_floor) member_number(members, "floor", rig->character.floor);
}

static const struct field fields[] = {
    {FIELD("model", FIELD_PATH, character.model)},
    {FIELD("position", FIELD_NUMBERS, character.position), .range = FIELD_ANY},
    {"coordinates", .load = load_drives, .print = print_drives},
    {"phases", .load = load_phases, .print = print_phases},
    {FIELD("floor", FIELD_OWN, character.floor), .load = load_floor, .print = print_floor},
    {"paint", .load = paint_load, .print = paint_print},
    {.key = "vertices"}, // the paint's
    {.key = NULL},
};

static void reset(struct rig *rig) { rig->character.phases = -1; }

static void copy(struct rig *copy)
{
    struct character_rig *character = &copy->character;
    for (int i = 0; i < character->drive_count; i++) {
        struct drive *drive = &character->drives[i];
        if (drive->name) drive->name = need_text(drive->name);
    }
    if (character->paint_file) character->paint_file = need_text(character->paint_file);
    paint_hold(character->painted);
}

static void release(struct rig *rig)
{
    struct character_rig *character = &rig->character;
    for (int i = 0; i < character->drive_count; i++) free(character->drives[i].name);
    paint_drop(character->painted);
    free(character->paint_file);
}

/// What its drives and paint say.
static bool equals(const struct rig *a, const struct rig *b)
{
    const struct character_rig *left = &a->character, *right = &b->character;
    bool same = left->painted == right->painted && left->has_floor == right->has_floor &&
                left->drive_count == right->drive_count;
    for (int i = 0; same && i < left->drive_count; i++) {
        const struct drive *l = &left->drives[i], *r = &right->drives[i];
        same = strcmp(l->name, r->name) == 0 && l->spline == r->spline && l->amplitude == r->amplitude &&
               l->lag == r->lag;
    }
    return same;
}

static size_t bytes(const struct rig *rig, const struct rig *other)
{
    const struct character_rig *character = &rig->character;
    const bool is_shared = other && other->character.painted == character->painted;
    return is_shared ? 0 : paint_bytes(character->painted);
}

const struct rig_functions character_functions = {.word = "character",
                                                  .fields = fields,
                                                  .title = offsetof(struct rig, character.model),
                                                  .pin_key = "vertex",
                                                  .reset = reset,
                                                  .copy = copy,
                                                  .release = release,
                                                  .bytes = bytes,
                                                  .equals = equals};

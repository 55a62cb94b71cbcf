/// The table of rig kinds; makes, copies, frees, reads and prints rigs.
#include "scene/rig_kind.h"
#include "base/need.h"
#include "scene/pins.h"
#include <stdlib.h>
#include <string.h>

#define RIG_ROW(constant, name) [constant] = &name##_functions,
static const struct rig_functions *const kinds[RIG_KINDS] = {RIG_KIND_LIST(RIG_ROW)};
#undef RIG_ROW

_Static_assert(offsetof(struct tail, channels) == 0 && offsetof(struct chain, channels) == 0,
               "rig.bent is their beginning");

const char *rig_word(enum rig_kind kind) { return kinds[kind]->word; }

const char *rig_title(const struct rig *rig)
{
    const struct rig_functions *kind = kinds[rig->kind];
    const char *title = *(char *const *)((const char *)rig + kind->title);
    if (rig->name && rig->name[0]) return rig->name;
    return title && title[0] ? title : kind->word;
}

int rig_input_count(const struct rig *rig)
{
    if (rig->kind == RIG_CHARACTER) return rig->character.drive_count;
    return kinds[rig->kind]->is_bent ? rig->bent.channel_count : 0;
}

int rig_input(const struct rig *rig, int input)
{
    if (rig->kind == RIG_CHARACTER) return rig->character.drives[input].spline;
    return rig->bent.channels[input].spline;
}

int rig_point_input(const struct rig *rig, int input)
{
    const bool is_point = !kinds[rig->kind]->is_bent || axis_bends(rig->bent.channels[input].axis);
    return is_point ? rig_input(rig, input) : -1;
}

int rig_point_spline(const struct rig *rig)
{
    const int count = rig_input_count(rig);
    for (int i = 0; i < count; i++) {
        if (rig_point_input(rig, i) >= 0) return rig_point_input(rig, i);
    }
    return -1;
}

bool rig_is_moved(const struct rig *rig, int spline)
{
    const int count = rig_input_count(rig);
    int i = 0;
    while (i < count && rig_point_input(rig, i) != spline) i++;
    return i < count;
}

struct channel *rig_channels(const struct rig *rig, int *count)
{
    const bool is_bent = kinds[rig->kind]->is_bent;
    *count = is_bent ? rig->bent.channel_count : 0;
    return is_bent ? rig->bent.channels : NULL;
}

const struct field *rig_pin_fields(const struct rig *rig) { return kinds[rig->kind]->pins; }

const char *rig_pin_key(const struct rig *rig)
{
    const struct field *pins = rig_pin_fields(rig);
    return pins ? pins[1].key : NULL;
}

struct rig *rig_create(enum rig_kind kind)
{
    struct rig *rig = need_zeroed(1, sizeof *rig);
    atomic_init(&rig->holders, 1);
    rig->kind = kind;
    fields_reset(kinds[kind]->fields, rig);
    return rig;
}

struct rig *rig_clone(const struct rig *rig)
{
    struct rig *copy = need(1, sizeof *copy);
    *copy = *rig;
    atomic_init(&copy->holders, 1);
    fields_copy(kinds[rig->kind]->fields, copy);
    return copy;
}

struct rig *rig_hold(struct rig *rig)
{
    atomic_fetch_add(&rig->holders, 1);
    return rig;
}

void rig_drop(struct rig *rig)
{
    if (!rig || atomic_fetch_sub(&rig->holders, 1) > 1) return;
    fields_free(kinds[rig->kind]->fields, rig);
    free(rig);
}

bool rig_check(const struct document *document, struct rig *rig, struct error *error)
{
    const int joints = rig->kind == RIG_TAIL ? rig->tail.joints : JOINTS_UNKNOWN;
    struct error why;
    return fields_check(document, joints, kinds[rig->kind]->fields, rig, &why) ||
           fail(error, ERROR_INPUT, "%s: %s", rig_title(rig), why.text);
}

bool rig_equals(const struct rig *a, const struct rig *b)
{
    return a == b || (a->kind == b->kind && fields_equal(kinds[a->kind]->fields, a, b));
}

size_t rig_bytes(const struct rig *rig, const struct rig *other)
{
    return sizeof *rig + fields_bytes(kinds[rig->kind]->fields, rig, other);
}

void load_pins(struct reader *reader, const struct value *object, void *at)
{
    struct rig *rig = at;
    const struct where pins_at = {.parent = &object->at, .key = "pins"};
    list_load(reader, object, fields_find(kinds[rig->kind]->fields, "pins"), rig);
    struct pin *loaded = rig->pins;
    const int count = rig->pin_count;
    if (pins_count(reader->document) > SCENE_MAX_PINS)
        reader_fail(reader, &pins_at, "expected at most %d pins over all rigs, got more", SCENE_MAX_PINS);
    rig->pins = NULL;
    rig->pin_count = 0;
    for (int i = 0; i < count; i++) {
        loaded[i].id = reader->document->next_id++;
        pins_insert(rig, &loaded[i]);
    }
    free(loaded);
}

/// Reports an earlier rig with the same name as the last one.
static void check_name(struct reader *reader, const struct where *rig_at)
{
    struct rig *const *rigs = reader->document->rigs;
    const int index = reader->document->rig_count - 1;
    struct where at = {.parent = rig_at, .key = "name"};
    for (int i = 0; i < index && rigs[index]->name; i++) {
        if (!rigs[i]->name || strcmp(rigs[i]->name, rigs[index]->name) != 0) continue;
        reader_fail(reader, &at, "expected a unique name, got \"%s\", the name of rigs[%d]", rigs[i]->name,
                    reader->places[i]);
        return;
    }
}

/// Keeps a meadow of an old file as unknown keys are kept, and warns once; false: it is another rig.
static bool keep_meadow(struct reader *reader, const struct value *object)
{
    const char *type = json_string_value(json_object_get(object->json, "type"));
    if (!type || strcmp(type, "meadow") != 0) return false;
    if (!reader->meadows) {
        reader_warn(reader, &object->at, "meadows are no longer shown; the file keeps them");
        reader->meadows = reader_keep(reader, json_array());
    }
    if (json_array_append(reader->meadows, object->json) != 0) need_failed();
    return true;
}

/// The kind of a rig, -1 after an error.
static int load_kind(struct reader *reader, struct value type)
{
    const char *words[RIG_KINDS + 1] = {NULL};
    for (int k = 0; k < RIG_KINDS; k++) words[k] = kinds[k]->word;
    return reader_word(reader, type, words);
}

void load_rigs(struct reader *reader, const struct value *scene)
{
    const struct value rigs = reader_member(scene, "rigs");
    int count = reader_objects(reader, rigs, SCENE_MAX_RIGS);
    struct document *document = reader->document;
    if (count <= 0) return;
    for (int i = 0; i < count; i++) {
        const struct value object = reader_element(&rigs, i);
        if (keep_meadow(reader, &object)) continue;
        int kind = load_kind(reader, reader_member(&object, "type"));
        // an unknown kind is an error already, so any kind will do
        struct rig *rig = rig_create(kind < 0 ? RIG_TAIL : (enum rig_kind)kind);
        rig->id = document->next_id++;
        reader->places[document->rig_count] = i;
        document_add_rig(document, rig);
        reader->rig = rig;
        if (kind >= 0) object_load(reader, &object, kinds[kind]->fields, rig);
        check_name(reader, &object.at);
    }
    for (int i = 0; i < document->rig_count; i++) {
        const struct value object = reader_element(&rigs, reader->places[i]);
        const struct where at = {.parent = &object.at, .key = "model"};
        struct rig *rig = document->rigs[i];
        struct error error;
        if (rig->kind == RIG_CHAIN && rig->chain.model &&
            !model_find(document, rig->chain.model, &rig->chain.by_file, &error))
            reader_fail(reader, &at, "%s", error.text);
    }
}

bool scene_has_meadow(const struct document *document) { return json_object_get(document->extra, "rigs") != NULL; }

void print_type(struct members *members, const struct document *document, const void *at, const char *folder)
{
    (void)document, (void)folder;
    member_string(members, "type", rig_word(((const struct rig *)at)->kind));
}

void print_rigs(struct text *text, const struct document *document, const char *folder)
{
    const char *before = "[\n";
    for (int r = 0; r < document->rig_count; r++, before = ",\n") {
        const struct rig *rig = document->rigs[r];
        struct members members = {text, "    {\n      ", ",\n      ", false};
        text_string(text, before);
        fields_print(&members, document, kinds[rig->kind]->fields, rig, folder);
        text_string(text, "\n    }");
    }
    const json_t *meadows = json_object_get(document->extra, "rigs");
    for (size_t m = 0; m < json_array_size(meadows); m++, before = ",\n") {
        text_string(text, before);
        text_string(text, "    ");
        text_json(text, json_array_get(meadows, m));
    }
    text_string(text, before[0] == ',' ? "\n  ]" : "[]");
}

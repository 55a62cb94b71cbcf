/// Kinds of rig: the table of them, and their members in the file as rows: read, printed, copied, counted and freed.
#include "scene/rig_kind.h"
#include "base/need.h"
#include "scene/pins.h"
#include <assert.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static int count_of(const struct field *field) { return (int)(field->size / sizeof(double)); }

static void load_numbers(struct reader *reader, struct value value, const struct field *field, double *numbers)
{
    const int count = count_of(field);
    if (!value.json || !reader_array(reader, value, (size_t)count, count == 3 ? "[x, y, z]" : "[x, z]")) return;
    for (int i = 0; i < count; i++) reader_number(reader, reader_element(&value, i), true, field->range, &numbers[i]);
}

static void load_field(struct reader *reader, struct value value, const struct field *field, void *at)
{
    switch (field->kind) {
    case FIELD_NUMBER:
        reader_number(reader, value, false, field->range, at);
        break;
    case FIELD_WHOLE:
        reader_integer(reader, value, (int)field->range.minimum, (int)field->range.maximum, at);
        break;
    case FIELD_FLAG:
        reader_flag(reader, value, at);
        break;
    case FIELD_NUMBERS:
        load_numbers(reader, value, field, at);
        break;
    case FIELD_TEXT:
    case FIELD_PATH:
        if (value.json || !field->is_optional) *(char **)at = reader_name(reader, value);
        break;
    case FIELD_SPLINE:
        *(int *)at = reader_spline_name(reader, value);
        break;
    case FIELD_OWN:
        break;
    }
}

static void load_fields(struct reader *reader, const struct value *object, const struct field *fields,
                        struct rig *rig)
{
    for (const struct field *field = fields; field->key; field++) {
        load_field(reader, reader_member(object, field->key), field, (char *)rig + field->place);
        if (field->load) field->load(reader, object, rig);
    }
}

static void print_row(struct members *members, const struct document *document, const struct field *field,
                      const void *at, const char *folder)
{
    switch (field->kind) {
    case FIELD_NUMBER:
        member_number(members, field->key, *(const double *)at);
        break;
    case FIELD_WHOLE:
        member_number(members, field->key, *(const int *)at);
        break;
    case FIELD_FLAG:
        member_flag(members, field->key, *(const bool *)at);
        break;
    case FIELD_NUMBERS:
        member(members, field->key);
        text_numbers(members->text, at, count_of(field));
        break;
    case FIELD_TEXT:
        if (*(char *const *)at) member_string(members, field->key, *(char *const *)at);
        break;
    case FIELD_PATH:
        member_path(members, field->key, document, *(char *const *)at, folder);
        break;
    case FIELD_SPLINE:
        member_string(members, field->key, document->splines[*(const int *)at]->name);
        break;
    case FIELD_OWN:
        break;
    }
}

static void print_fields(struct members *members, const struct document *document, const struct rig *rig,
                         const struct field *fields, const char *folder)
{
    for (const struct field *field = fields; field->key; field++) {
        if (field->print)
            field->print(members, document, rig, folder);
        else
            print_row(members, document, field, (const char *)rig + field->place, folder);
    }
}

static bool is_text(const struct field *field) { return field->kind == FIELD_TEXT || field->kind == FIELD_PATH; }

static void copy_fields(const struct field *fields, struct rig *copy)
{
    for (const struct field *field = fields; field->key; field++) {
        char **text = (char **)((char *)copy + field->place);
        if (is_text(field) && *text) *text = need_text(*text);
    }
}

static void free_fields(const struct field *fields, struct rig *rig)
{
    for (const struct field *field = fields; field->key; field++) {
        if (is_text(field)) free(*(char **)((char *)rig + field->place));
    }
}

static size_t fields_bytes(const struct field *fields, const struct rig *rig)
{
    size_t bytes = 0;
    for (const struct field *field = fields; field->key; field++) {
        if (is_text(field)) bytes += text_size(*(char *const *)((const char *)rig + field->place));
    }
    return bytes;
}

static bool fail_range(const struct field *field, struct error *error)
{
    const struct range range = field->range;
    if (isfinite(range.maximum))
        return fail(error, ERROR_INPUT, "the %s must be from %g to %g", field->key, range.minimum, range.maximum);
    if (range.above) return fail(error, ERROR_INPUT, "the %s must be above %g and finite", field->key, range.minimum);
    return fail(error, ERROR_INPUT, "the %s must be finite", field->key);
}

static bool check_numbers(const struct field *field, double *numbers, struct error *error)
{
    for (int i = 0; i < count_of(field); i++) {
        if (!isfinite(numbers[i]) || !range_has(field->range, numbers[i])) return fail_range(field, error);
        numbers[i] += 0.0;
    }
    return true;
}

static bool fields_check(const struct field *fields, struct rig *rig, struct error *error)
{
    bool good = true;
    for (const struct field *field = fields; good && field->key; field++) {
        void *at = (char *)rig + field->place;
        if (field->kind == FIELD_NUMBER || field->kind == FIELD_NUMBERS) good = check_numbers(field, at, error);
        if (field->kind == FIELD_WHOLE && !range_has(field->range, *(int *)at)) good = fail_range(field, error);
    }
    return good;
}

static bool same_text(const char *a, const char *b) { return a == b || (a && b && strcmp(a, b) == 0); }

static bool fields_equal(const struct field *fields, const struct rig *a, const struct rig *b)
{
    for (const struct field *field = fields; field->key; field++) {
        const char *left = (const char *)a + field->place, *right = (const char *)b + field->place;
        if (is_text(field)) {
            if (!same_text(*(char *const *)left, *(char *const *)right)) return false;
        } else if (memcmp(left, right, field->size) != 0) {
            return false;
        }
    }
    return true;
}

enum { KEYS = 16 }; ///< of a kind, and one more

#define RIG_ROW(constant, name) [constant] = &name##_functions,
static const struct rig_functions *const kinds[RIG_KINDS] = {RIG_KIND_LIST(RIG_ROW)};
#undef RIG_ROW

_Static_assert(offsetof(struct tail, channels) == 0 && offsetof(struct chain, channels) == 0,
               "rig.bent is their beginning");

const char *rig_word(enum rig_kind kind) { return kinds[kind]->word; }

const char *rig_title(const struct rig *rig)
{
    return rig->name ? rig->name : *(char *const *)((const char *)rig + kinds[rig->kind]->title);
}

int rig_input_count(const struct rig *rig)
{
    if (rig->kind == RIG_CHARACTER) return rig->character.drive_count;
    if (rig->kind == RIG_MEADOW) return 1;
    return kinds[rig->kind]->is_bent ? rig->bent.channel_count : 0;
}

int rig_input(const struct rig *rig, int input)
{
    if (rig->kind == RIG_CHARACTER) return rig->character.drives[input].spline;
    return rig->kind == RIG_MEADOW ? rig->meadow.spline : rig->bent.channels[input].spline;
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

struct channel *rig_channels(const struct rig *rig, int *count)
{
    const bool is_bent = kinds[rig->kind]->is_bent;
    *count = is_bent ? rig->bent.channel_count : 0;
    return is_bent ? rig->bent.channels : NULL;
}

const char *rig_pin_key(const struct rig *rig) { return kinds[rig->kind]->pin_key; }

/// A copy of an array, for one more.
static void *copy_array(const void *array, int count, size_t each)
{
    void *copy = need((size_t)count + 1, each);
    if (count > 0) memcpy(copy, array, (size_t)count * each);
    return copy;
}

struct rig *rig_create(enum rig_kind kind)
{
    struct rig *rig = need_zeroed(1, sizeof *rig);
    atomic_init(&rig->holders, 1);
    rig->kind = kind;
    if (kinds[kind]->reset) kinds[kind]->reset(rig);
    return rig;
}

struct rig *rig_clone(const struct rig *rig)
{
    const struct rig_functions *kind = kinds[rig->kind];
    struct rig *copy = need(1, sizeof *copy);
    *copy = *rig;
    atomic_init(&copy->holders, 1);
    copy->pins = copy_array(rig->pins, rig->pin_count, sizeof *rig->pins);
    copy->name = rig->name ? need_text(rig->name) : NULL;
    copy_fields(kind->fields, copy);
    if (kind->copy) kind->copy(copy);
    if (kind->is_bent)
        copy->bent.channels = copy_array(rig->bent.channels, rig->bent.channel_count, sizeof *rig->bent.channels);
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
    const struct rig_functions *kind = kinds[rig->kind];
    free_fields(kind->fields, rig);
    if (kind->release) kind->release(rig);
    if (kind->is_bent) free(rig->bent.channels);
    free(rig->pins);
    free(rig->name);
    free(rig);
}

static bool same_channels(const struct rig *a, const struct rig *b)
{
    const int count = a->bent.channel_count;
    return count == b->bent.channel_count &&
           (count == 0 || memcmp(a->bent.channels, b->bent.channels, (size_t)count * sizeof *a->bent.channels) == 0);
}

bool rig_check(struct rig *rig, struct error *error) { return fields_check(kinds[rig->kind]->fields, rig, error); }

bool rig_equals(const struct rig *a, const struct rig *b)
{
    const struct rig_functions *kind = kinds[a->kind];
    if (a == b || a->kind != b->kind) return a == b;
    return fields_equal(kind->fields, a, b) && (!kind->is_bent || same_channels(a, b)) &&
           (!kind->equals || kind->equals(a, b));
}

size_t rig_bytes(const struct rig *rig, const struct rig *other)
{
    const struct rig_functions *kind = kinds[rig->kind];
    size_t size = sizeof *rig + text_size(rig->name) + (size_t)rig->pin_count * sizeof *rig->pins;
    size += fields_bytes(kind->fields, rig);
    if (kind->bytes) size += kind->bytes(rig, other);
    if (kind->is_bent) size += (size_t)rig->bent.channel_count * sizeof *rig->bent.channels;
    return size;
}

static bool load_pin(struct reader *reader, struct value object, const char *key, int points, struct pin *pin)
{
    const char *const keys[] = {"frame", key, "to", NULL};
    const struct value point = reader_member(&object, key), to = reader_member(&object, "to");
    *pin = (struct pin){.id = reader->document->next_id++};
    bool good = reader_number(reader, reader_member(&object, "frame"), true, range_any, &pin->frame);
    if (!point.json) good = reader_unexpected(reader, point, "a whole number");
    good &= reader_integer(reader, point, 0, points - 1, &pin->point);
    good &= reader_array(reader, to, 3, "[x, y, z]");
    if (good) reader_point(reader, to, pin->to);
    pin->extra = reader_keep(reader, reader_extra(reader, &object, keys));
    return good;
}

static void load_pins(struct reader *reader, const struct value *object, const char *key, struct rig *rig)
{
    const struct value pins = reader_member(object, "pins");
    const int count = reader_objects(reader, pins, SCENE_MAX_PINS);
    if (count <= 0) return;
    if (pins_count(reader->document) + count > SCENE_MAX_PINS) {
        reader_fail(reader, &pins.at, "expected at most %d pins over all rigs, got more", SCENE_MAX_PINS);
    } else {
        const int points = rig->kind == RIG_TAIL ? rig->tail.joints : INT_MAX;
        struct pin pin;
        for (int i = 0; i < count; i++) {
            if (load_pin(reader, reader_element(&pins, i), key, points, &pin)) pins_insert(rig, &pin);
        }
    }
}

static void print_pins(struct members *members, const struct rig *rig, const char *key)
{
    struct text *text = members->text;
    if (rig->pin_count == 0) return;
    member(members, "pins");
    for (int i = 0; i < rig->pin_count; i++) {
        const struct pin *pin = &rig->pins[i];
        struct members own = {text, "{ ", ", ", false};
        text_string(text, i > 0 ? ",\n        " : "[\n        ");
        member_number(&own, "frame", pin->frame);
        member_number(&own, key, pin->point);
        member(&own, "to");
        text_numbers(text, pin->to, 3);
        members_extra(&own, pin->extra, NULL);
        text_string(text, " }");
    }
    text_string(text, "\n      ]");
}

/// Reports an earlier rig with the same name.
static void check_name(struct reader *reader, const struct where *rig_at, int index)
{
    struct rig *const *rigs = reader->document->rigs;
    struct where at = {.parent = rig_at, .key = "name"};
    for (int i = 0; i < index && rigs[index]->name; i++) {
        if (!rigs[i]->name || strcmp(rigs[i]->name, rigs[index]->name) != 0) continue;
        reader_fail(reader, &at, "expected a name of its own, got \"%s\" as rigs[%d] has", rigs[i]->name, i);
        return;
    }
}

/// Which kind a rig is, -1 after an error.
static int load_kind(struct reader *reader, struct value type)
{
    const char *words[RIG_KINDS + 1] = {NULL};
    for (int k = 0; k < RIG_KINDS; k++) words[k] = kinds[k]->word;
    return reader_word(reader, type, words, -1);
}

static void load_rig(struct reader *reader, const struct value *object, struct rig *rig)
{
    const struct rig_functions *kind = kinds[rig->kind];
    const struct value name = reader_member(object, "name");
    const char *known[KEYS] = {"type", "name", "pins"};
    int count = kind->pin_key ? 3 : 2;
    for (const struct field *field = kind->fields; field->key; field++) known[count++] = field->key;
    assert(count < KEYS);
    rig->extra = reader_extra(reader, object, known);
    if (kind->is_named || name.json) rig->name = reader_name(reader, name);
    load_fields(reader, object, kind->fields, rig);
    rig->extra = reader_keep(reader, rig->extra);
    if (kind->pin_key) load_pins(reader, object, kind->pin_key, rig);
}

void load_rigs(struct reader *reader, const struct value *scene)
{
    const struct value rigs = reader_member(scene, "rigs");
    int count = reader_objects(reader, rigs, SCENE_MAX_RIGS);
    struct document *document = reader->document;
    if (count <= 0) return;
    for (int i = 0; i < count; i++) {
        const struct value object = reader_element(&rigs, i);
        int kind = load_kind(reader, reader_member(&object, "type"));
        // any kind will do where it is unknown: the scene is refused
        struct rig *rig = rig_create(kind < 0 ? RIG_TAIL : (enum rig_kind)kind);
        rig->id = ++document->next_rig_id;
        document_add_rig(document, rig);
        if (kind >= 0) load_rig(reader, &object, rig);
        check_name(reader, &object.at, i);
    }
    for (int i = 0; i < count; i++) {
        const struct value object = reader_element(&rigs, i);
        struct rig *rig = document->rigs[i];
        if (kinds[rig->kind]->resolve) kinds[rig->kind]->resolve(reader, &object, rig);
    }
}

static void print_rig(struct text *text, const struct document *document, const struct rig *rig, const char *folder)
{
    const struct rig_functions *kind = kinds[rig->kind];
    struct members members = {text, "    {\n      ", ",\n      ", false};
    member_string(&members, "type", kind->word);
    if (rig->name) member_string(&members, "name", rig->name);
    print_fields(&members, document, rig, kind->fields, folder);
    if (kind->pin_key) print_pins(&members, rig, kind->pin_key);
    members_extra(&members, rig->extra, kind->has_tracks);
    text_string(text, "\n    }");
}

void print_rigs(struct text *text, const struct document *document, const char *folder)
{
    for (int r = 0; r < document->rig_count; r++) {
        text_string(text, r > 0 ? ",\n" : "[\n");
        print_rig(text, document, document->rigs[r], folder);
    }
    text_string(text, document->rig_count > 0 ? "\n  ]" : "[]");
}

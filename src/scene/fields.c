/// Objects of a scene file, described by rows: read, printed, checked, compared, copied and freed.
#include "scene/fields.h"
#include "base/need.h"
#include "scene/document.h"
#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/// A member of an object, by its place.
static void *inside(void *object, size_t at) { return (char *)object + at; }
static const void *look(const void *object, size_t at) { return (const char *)object + at; }

static int number_count(const struct field *field) { return (int)(field->size / sizeof(double)); }

static bool is_text(const struct field *field)
{
    return field->kind == FIELD_TEXT || field->kind == FIELD_PATH || field->kind == FIELD_MODEL;
}

static const char *text_of(const struct field *field, const void *object)
{
    return *(char *const *)look(object, field->place);
}

static int count_of(const struct field *list, const void *object) { return *(const int *)look(object, list->count); }

static void *element_of(const struct field *list, const void *object, int index)
{
    return *(char *const *)look(object, list->place) + (size_t)index * list->size;
}

static struct paint *paint_of(const struct field *field, const void *object)
{
    return *(struct paint *const *)look(object, field->place);
}

const struct field *fields_find(const struct field *fields, const char *key)
{
    while (fields->key && strcmp(fields->key, key) != 0) fields++;
    return fields->key ? fields : NULL;
}

/// The offset of an object's unknown keys.
static size_t extra_place(const struct field *fields)
{
    while (fields->key) fields++;
    return fields->place;
}

void fields_reset(const struct field *fields, void *object)
{
    for (const struct field *field = fields; field->key; field++) {
        void *at = inside(object, field->place);
        switch (field->kind) {
        case FIELD_NUMBER:
        case FIELD_NUMBERS:
            memcpy(at, field->usual, field->size);
            break;
        case FIELD_WHOLE:
        case FIELD_WORD:
            *(int *)at = (int)field->usual[0];
            break;
        case FIELD_PLACE:
            for (int k = 0; k < 3; k++) ((struct param *)at)[k] = param_number(0);
            break;
        case FIELD_ANGLES:
            ((struct angles *)at)->value[0] = field->usual[0];
            break;
        default:
            break;
        }
    }
}

static void load_numbers(struct reader *reader, struct value value, const struct field *field, double *numbers)
{
    const int count = number_count(field);
    if (!value.json && !field->is_required) return;
    if (!reader_array(reader, value, (size_t)count, count == 3 ? "[x, y, z]" : "[x, z]")) return;
    for (int i = 0; i < count; i++) reader_number(reader, reader_element(&value, i), true, field->range, &numbers[i]);
}

static void load_whole(struct reader *reader, struct value value, const struct field *field, int *number)
{
    if (!value.json && field->is_required) reader_unexpected(reader, value, "a whole number");
    reader_integer(reader, value, (int)field->range.minimum, (int)field->range.maximum, number);
}

static void load_word(struct reader *reader, struct value value, const struct field *field, int *word)
{
    const int found = value.json || field->is_required ? reader_word(reader, value, field->words) : -1;
    if (found >= 0) *word = found;
}

/// Each coordinate is a number in metres or follows a spline. Unknown keys of tracks are kept under the coordinate's name.
static void load_place(struct reader *reader, struct value value, struct param *params, json_t **extra)
{
    json_t *tracks = NULL;
    if (!value.json || !reader_array(reader, value, 3, "[x, y, z]")) return;
    for (int k = 0; k < 3; k++) {
        reader_param(reader, reader_element(&value, k), range_any, coordinate_name(k), false, &params[k], &tracks);
    }
    reader_put(extra, value.at.key, tracks);
}

void list_load(struct reader *reader, const struct value *object, const struct field *field, void *at)
{
    const struct value value = reader_member(object, field->key);
    const int count = reader_objects(reader, value, (int)field->range.maximum);
    if (count <= 0) return;
    *(void **)inside(at, field->place) = need_zeroed((size_t)count, field->size);
    *(int *)inside(at, field->count) = count;
    for (int i = 0; i < count; i++) {
        const struct value element = reader_element(&value, i);
        object_load(reader, &element, field->rows, element_of(field, at, i));
    }
}

static void load_field(struct reader *reader, const struct value *object, const struct field *field, void *into,
                       json_t **extra)
{
    const struct value value = reader_member(object, field->key);
    void *at = inside(into, field->place);
    switch (field->kind) {
    case FIELD_NUMBER:
        if (field->flag != 0) *(bool *)inside(into, field->flag) = value.json != NULL;
        reader_number(reader, value, field->is_required, field->range, at);
        break;
    case FIELD_WHOLE:
        load_whole(reader, value, field, at);
        break;
    case FIELD_FLAG:
        reader_flag(reader, value, at);
        break;
    case FIELD_NUMBERS:
        load_numbers(reader, value, field, at);
        break;
    case FIELD_WORD:
        load_word(reader, value, field, at);
        break;
    case FIELD_TEXT:
        if (value.json || field->is_required) *(char **)at = reader_name(reader, value);
        break;
    case FIELD_PATH:
    case FIELD_MODEL:
        if (value.json || field->is_required) *(char **)at = reader_path(reader, value);
        break;
    case FIELD_SPLINE:
        *(int *)at = reader_spline_name(reader, value);
        break;
    case FIELD_PLACE:
        load_place(reader, value, at, extra);
        break;
    case FIELD_ANGLES:
        load_angles(reader, value, at, extra);
        break;
    case FIELD_LIST:
        list_load(reader, object, field, into);
        break;
    default:
        break;
    }
}

void fields_load(struct reader *reader, const struct value *object, const struct field *fields, void *at,
                 json_t **extra)
{
    for (const struct field *field = fields; field->key; field++) {
        if (field->load)
            field->load(reader, object, at);
        else
            load_field(reader, object, field, at, extra);
    }
}

void object_load(struct reader *reader, const struct value *object, const struct field *fields, void *at)
{
    const char *known[FIELDS_MOST + 1] = {NULL};
    int count = 0;
    for (; fields[count].key; count++) known[count] = fields[count].key;
    assert(count <= FIELDS_MOST);
    json_t *extra = reader_extra(reader, object, known);
    fields_reset(fields, at);
    fields_load(reader, object, fields, at, &extra);
    *(json_t **)inside(at, extra_place(fields)) = reader_keep(reader, extra);
}

void list_print(struct members *members, const struct document *document, const struct field *field,
                const void *object, const char *folder)
{
    struct text *text = members->text;
    const int count = count_of(field, object);
    if (count == 0 && field->is_quiet) return;
    member(members, field->key);
    for (int i = 0; i < count; i++) {
        struct members own = {text, "{ ", ", ", false};
        text_string(text, i > 0 ? ",\n        " : "[\n        ");
        fields_print(&own, document, field->rows, element_of(field, object, i), folder);
        text_string(text, " }");
    }
    text_string(text, count > 0 ? "\n      ]" : "[]");
}

static void print_place(struct members *members, const struct document *document, const struct field *field,
                        const struct param *params, json_t *extra, const char *folder)
{
    json_t *tracks = json_object_get(extra, field->key);
    member(members, field->key);
    for (int k = 0; k < 3; k++) {
        text_string(members->text, k > 0 ? ", " : "[");
        print_param(members->text, document, &params[k], tracks, coordinate_name(k), folder);
    }
    text_string(members->text, "]");
}

static void print_row(struct members *members, const struct document *document, const struct field *field,
                      const void *object, json_t *extra, const char *folder)
{
    const void *at = look(object, field->place);
    switch (field->kind) {
    case FIELD_NUMBER:
        member_number(members, field->key, *(const double *)at);
        break;
    case FIELD_WHOLE:
        member_number(members, field->key, *(const int *)at);
        break;
    case FIELD_FLAG:
        member(members, field->key);
        text_string(members->text, *(const bool *)at ? "true" : "false");
        break;
    case FIELD_NUMBERS:
        member(members, field->key);
        text_numbers(members->text, at, number_count(field));
        break;
    case FIELD_WORD:
        member_string(members, field->key, field->words[*(const int *)at]);
        break;
    case FIELD_TEXT:
        if (*(char *const *)at) member_string(members, field->key, *(char *const *)at);
        break;
    case FIELD_PATH:
        member_path(members, field->key, document, *(char *const *)at, folder);
        break;
    case FIELD_MODEL:
        member_path(members, field->key, *(const bool *)look(object, field->flag) ? document : NULL,
                    *(char *const *)at, folder);
        break;
    case FIELD_SPLINE:
        member_string(members, field->key, document->splines[*(const int *)at]->name);
        break;
    case FIELD_PLACE:
        print_place(members, document, field, at, extra, folder);
        break;
    case FIELD_ANGLES:
        print_angles(members, field->key, at, extra);
        break;
    case FIELD_LIST:
        list_print(members, document, field, object, folder);
        break;
    default:
        break;
    }
}

/// Whether a field is not printed, because it has its default or is missing.
static bool is_left_out(const struct field *field, const void *object)
{
    const void *at = look(object, field->place);
    if (field->kind == FIELD_NUMBER && field->flag != 0) return !*(const bool *)look(object, field->flag);
    if (!field->is_quiet || field->kind == FIELD_LIST) return false;
    if (field->kind == FIELD_FLAG) return !*(const bool *)at;
    return (field->kind == FIELD_NUMBER ? *(const double *)at : *(const int *)at) == field->usual[0];
}

void fields_print(struct members *members, const struct document *document, const struct field *fields,
                  const void *object, const char *folder)
{
    json_t *extra = *(json_t *const *)look(object, extra_place(fields)), *value;
    const char *key;
    for (const struct field *field = fields; field->key; field++) {
        if (field->print)
            field->print(members, document, object, folder);
        else if (!is_left_out(field, object))
            print_row(members, document, field, object, extra, folder);
    }
    json_object_foreach(extra, key, value)
    {
        if (fields_find(fields, key)) continue; // unknown keys of a track or ramp
        member(members, key);
        text_json(members->text, value);
    }
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
    for (int i = 0; i < number_count(field); i++) {
        if (!isfinite(numbers[i]) || !range_has(field->range, numbers[i])) return fail_range(field, error);
        numbers[i] += 0.0;
    }
    return true;
}

bool model_find(const struct document *document, const char *text, bool *by_file, struct error *error)
{
    if (!text) text = "";
    *by_file = document_find_model(document, text, false) < 0;
    return !*by_file || document_find_model(document, text, true) >= 0 ||
           fail(error, ERROR_INPUT, "expected the name or file of a model rig, got \"%s\"", text);
}

static bool check_word(const struct field *field, int word, struct error *error)
{
    char words[WORDS_TEXT];
    for (int i = 0; field->words[i]; i++) {
        if (i == word && field->words[i][0]) return true;
    }
    return fail(error, ERROR_INPUT, "the %s must be %s", field->key, list_words(field->words, words));
}

static bool check_place(const struct document *document, const struct field *field, struct param *params,
                        struct error *error)
{
    for (int k = 0; k < 3; k++) {
        if (params[k].motion) return fail(error, ERROR_INPUT, "only an equilibrium follows a joint");
        if (params[k].track >= document->spline_count)
            return fail(error, ERROR_INPUT, "there is no spline to follow");
        if (!isfinite(params[k].value)) return fail(error, ERROR_INPUT, "the %s must be finite", field->key);
        params[k].value += 0.0;
    }
    return true;
}

static bool check_list(const struct document *document, int joints, const struct field *field, const void *object,
                       struct error *error)
{
    const int count = count_of(field, object), most = (int)field->range.maximum;
    if (count > most) return fail(error, ERROR_INPUT, "at most %d %s fit", most, field->key);
    for (int i = 0; i < count; i++) {
        if (!fields_check(document, joints, field->rows, element_of(field, object, i), error)) return false;
    }
    return true;
}

static bool check_field(const struct document *document, int joints, const struct field *field, void *object,
                        struct error *error)
{
    void *at = inside(object, field->place);
    const char *text = is_text(field) ? text_of(field, object) : NULL;
    switch (field->kind) {
    case FIELD_NUMBER:
    case FIELD_NUMBERS:
        return check_numbers(field, at, error);
    case FIELD_WHOLE:
        return range_has(field->range, *(int *)at) || fail_range(field, error);
    case FIELD_WORD:
        return (field->is_quiet && *(int *)at == (int)field->usual[0]) || check_word(field, *(int *)at, error);
    case FIELD_TEXT:
    case FIELD_PATH:
        return field->is_apart || (text ? text[0] != '\0' : !field->is_required) ||
               fail(error, ERROR_INPUT, "\"%s\" must not be empty", field->key);
    case FIELD_MODEL:
        return model_find(document, text_of(field, object), inside(object, field->flag), error);
    case FIELD_SPLINE:
        return document_has_spline(document, *(int *)at, error);
    case FIELD_PLACE:
        return check_place(document, field, at, error);
    case FIELD_ANGLES:
        return check_angles(joints, at, error);
    case FIELD_LIST:
        return check_list(document, joints, field, object, error);
    default:
        return true;
    }
}

bool fields_check(const struct document *document, int joints, const struct field *fields, void *object,
                  struct error *error)
{
    for (const struct field *field = fields; field->key; field++) {
        if (!check_field(document, joints, field, object, error)) return false;
    }
    return true;
}

static bool same_lists(const struct field *field, const void *a, const void *b)
{
    bool same = count_of(field, a) == count_of(field, b);
    for (int i = 0; same && i < count_of(field, a); i++)
        same = fields_equal(field->rows, element_of(field, a, i), element_of(field, b, i));
    return same;
}

static bool same_places(const struct param *a, const struct param *b)
{
    bool same = true;
    for (int k = 0; k < 3; k++) same &= a[k].track == b[k].track && a[k].value == b[k].value;
    return same;
}

/// NULL is only itself.
static bool same_text(const char *a, const char *b) { return a == b || (a && b && strcmp(a, b) == 0); }

static bool same_field(const struct field *field, const void *a, const void *b)
{
    const void *left = look(a, field->place), *right = look(b, field->place);
    if (field->flag != 0 && *(const bool *)look(a, field->flag) != *(const bool *)look(b, field->flag)) return false;
    if (is_text(field)) return same_text(text_of(field, a), text_of(field, b));
    if (field->kind == FIELD_LIST) return same_lists(field, a, b);
    if (field->kind == FIELD_PLACE) return same_places(left, right);
    if (field->kind == FIELD_ANGLES) return angles_equal(left, right);
    return memcmp(left, right, field->size) == 0;
}

bool fields_equal(const struct field *fields, const void *a, const void *b)
{
    for (const struct field *field = fields; field->key; field++) {
        if (!field->is_apart && !same_field(field, a, b)) return false;
    }
    return true;
}

static void copy_list(const struct field *field, void *object)
{
    const int count = count_of(field, object);
    void **list = inside(object, field->place), *shared = *list;
    *list = need((size_t)count + 1, field->size);
    if (count > 0) memcpy(*list, shared, (size_t)count * field->size);
    for (int i = 0; i < count; i++) fields_copy(field->rows, element_of(field, object, i));
}

void fields_copy(const struct field *fields, void *copy)
{
    for (const struct field *field = fields; field->key; field++) {
        const char *text = is_text(field) ? text_of(field, copy) : NULL;
        if (text) *(char **)inside(copy, field->place) = need_text(text);
        if (field->kind == FIELD_PAINT) paint_hold(paint_of(field, copy));
        if (field->kind == FIELD_LIST) copy_list(field, copy);
    }
}

void fields_free(const struct field *fields, void *object)
{
    for (const struct field *field = fields; field->key; field++) {
        const bool is_list = field->kind == FIELD_LIST;
        for (int i = 0; is_list && i < count_of(field, object); i++)
            fields_free(field->rows, element_of(field, object, i));
        if (field->kind == FIELD_PAINT) paint_drop(paint_of(field, object));
        if (is_text(field) || is_list) free(*(void **)inside(object, field->place));
    }
}

size_t fields_bytes(const struct field *fields, const void *object, const void *other)
{
    size_t bytes = 0;
    for (const struct field *field = fields; field->key; field++) {
        if (is_text(field)) bytes += text_size(text_of(field, object));
        if (field->kind == FIELD_LIST) bytes += (size_t)count_of(field, object) * field->size;
        if (field->kind != FIELD_PAINT || (other && paint_of(field, other) == paint_of(field, object))) continue;
        bytes += paint_bytes(paint_of(field, object));
    }
    return bytes;
}

/// Members of rigs that are rows of a table: read, printed, copied, counted and freed.
#include "base/need.h"
#include "scene/rig_kind.h"
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

void load_fields(struct reader *reader, const struct value *object, const struct field *fields, struct rig *rig)
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

void print_fields(struct members *members, const struct document *document, const struct rig *rig,
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

void copy_fields(const struct field *fields, struct rig *copy)
{
    for (const struct field *field = fields; field->key; field++) {
        char **text = (char **)((char *)copy + field->place);
        if (is_text(field) && *text) *text = need_text(*text);
    }
}

void free_fields(const struct field *fields, struct rig *rig)
{
    for (const struct field *field = fields; field->key; field++) {
        if (is_text(field)) free(*(char **)((char *)rig + field->place));
    }
}

size_t fields_bytes(const struct field *fields, const struct rig *rig)
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

bool fields_check(const struct field *fields, struct rig *rig, struct error *error)
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

bool fields_equal(const struct field *fields, const struct rig *a, const struct rig *b)
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

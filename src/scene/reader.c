/// Reads single values and reports errors in them.
#include "scene/reader.h"
#include "base/need.h"
#include "scene/text.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const struct range range_any = {-INFINITY, INFINITY, false};

static void compose(struct reader *reader, const struct where *where, struct error *error, const char *format,
                    va_list arguments)
{
    char path[PATH_TEXT_SIZE], sentence[sizeof error->text];
    where_path(where, path);
    vsnprintf(sentence, sizeof sentence, format, arguments);
    fail(error, ERROR_INPUT, "%s:%d: %s: %s", reader->source.name, source_line(&reader->source, where), path,
         sentence);
}

static void report(struct reader *reader, bool is_error, const char *sentence)
{
    struct problems *problems = reader->problems;
    if (!problems) return;
    if (is_error) {
        problems->errors++;
    } else {
        problems->warnings++;
    }
    problems->report(problems->user, is_error, sentence);
}

bool reader_report(struct reader *reader, const struct error *error)
{
    if (reader->errors++ == 0 && reader->error) *reader->error = *error;
    report(reader, true, error->text);
    return false;
}

bool reader_fail(struct reader *reader, const struct where *where, const char *format, ...)
{
    if (reader->errors > 0 && !reader->problems) return reader->errors++, false;
    struct error error;
    va_list arguments;
    va_start(arguments, format);
    compose(reader, where, &error, format, arguments);
    va_end(arguments);
    return reader_report(reader, &error);
}

void reader_warn(struct reader *reader, const struct where *where, const char *format, ...)
{
    if (!reader->problems) return;
    struct error warning;
    va_list arguments;
    va_start(arguments, format);
    compose(reader, where, &warning, format, arguments);
    va_end(arguments);
    report(reader, false, warning.text);
}

static const char *kind_of(const json_t *value)
{
    if (!value) return "nothing";
    switch (json_typeof(value)) {
    case JSON_OBJECT:
        return "an object";
    case JSON_ARRAY:
        return "an array";
    case JSON_STRING:
        return "a string";
    case JSON_INTEGER:
    case JSON_REAL:
        return "a number";
    case JSON_TRUE:
        return "true";
    case JSON_FALSE:
        return "false";
    default:
        return "null";
    }
}

bool reader_unexpected(struct reader *reader, struct value value, const char *expected)
{
    return reader_fail(reader, &value.at, "expected %s, got %s", expected, kind_of(value.json));
}

struct value reader_member(const struct value *object, const char *key)
{
    return (struct value){{.parent = &object->at, .key = key}, json_object_get(object->json, key)};
}

struct value reader_element(const struct value *array, int index)
{
    const size_t at = (size_t)index;
    return (struct value){{.parent = &array->at, .index = at}, json_array_get(array->json, at)};
}

static bool fail_range(struct reader *reader, const struct where *at, struct range range, double number)
{
    char low[NUMBER_TEXT_SIZE], high[NUMBER_TEXT_SIZE] = "", got[NUMBER_TEXT_SIZE];
    number_print(range.minimum, low);
    number_print(number, got);
    if (isfinite(range.maximum)) number_print(range.maximum, high);
    const char *from = range.above ? "above " : *high ? "from " : "of at least ";
    const char *to = !*high ? "" : range.above ? " and at most " : " to ";
    return reader_fail(reader, at, "expected a number %s%s%s%s, got %s", from, low, to, high, got);
}

bool reader_number(struct reader *reader, struct value value, bool required, struct range range, double *target)
{
    if (!value.json && !required) return true;
    if (!json_is_number(value.json)) return reader_unexpected(reader, value, "a number");
    double number = json_number_value(value.json);
    if (!range_has(range, number)) return fail_range(reader, &value.at, range, number);
    *target = number + 0.0; // −0 becomes 0, as when saving
    return true;
}

bool reader_integer(struct reader *reader, struct value value, int minimum, int maximum, int *target)
{
    if (!value.json) return true;
    if (!json_is_number(value.json)) return reader_unexpected(reader, value, "a whole number");
    double number = json_number_value(value.json);
    if (number == floor(number) && number >= minimum && number <= maximum) {
        *target = (int)number;
        return true;
    }
    char got[NUMBER_TEXT_SIZE];
    number_print(number, got);
    return reader_fail(reader, &value.at, "expected a whole number from %d to %d, got %s", minimum, maximum, got);
}

void reader_flag(struct reader *reader, struct value value, bool *target)
{
    if (value.json && !json_is_boolean(value.json)) {
        reader_unexpected(reader, value, "true or false");
    } else if (value.json) {
        *target = json_is_true(value.json);
    }
}

const char *list_words(const char *const *words, char text[WORDS_TEXT])
{
    size_t length = 0;
    for (int i = 0; words[i] && length < WORDS_TEXT; i++) {
        const char *before = i == 0 ? "" : words[i + 1] ? ", " : " or ";
        if (!words[i][0]) continue;
        length += (size_t)snprintf(text + length, WORDS_TEXT - length, "%s\"%s\"", before, words[i]);
    }
    return text;
}

int reader_word(struct reader *reader, struct value value, const char *const *words)
{
    char expected[WORDS_TEXT];
    const char *word = json_string_value(value.json);
    for (int i = 0; word && words[i]; i++) {
        if (words[i][0] && strcmp(words[i], word) == 0) return i;
    }
    list_words(words, expected);
    if (!word) {
        reader_unexpected(reader, value, expected);
    } else {
        reader_fail(reader, &value.at, "expected %s, got \"%s\"", expected, word);
    }
    return -1;
}

char *reader_name(struct reader *reader, struct value value)
{
    if (!json_is_string(value.json)) {
        reader_unexpected(reader, value, "a string");
        return NULL;
    }
    if (json_string_length(value.json) == 0) {
        reader_fail(reader, &value.at, "expected a name, got an empty string");
        return NULL;
    }
    return need_text(json_string_value(value.json));
}

char *reader_path(struct reader *reader, struct value value)
{
    char *path = reader_name(reader, value);
    if (path) text_read_path(path);
    return path;
}

bool reader_array(struct reader *reader, struct value value, size_t count, const char *expected)
{
    if (!json_is_array(value.json)) return reader_unexpected(reader, value, expected);
    if (json_array_size(value.json) == count) return true;
    return reader_fail(reader, &value.at, "expected %s, got %zu elements", expected, json_array_size(value.json));
}

int reader_objects(struct reader *reader, struct value value, int limit)
{
    if (!value.json) return 0;
    if (!json_is_array(value.json)) {
        reader_unexpected(reader, value, "an array");
        return -1;
    }
    size_t count = json_array_size(value.json);
    if (count > (size_t)limit) {
        reader_fail(reader, &value.at, "expected at most %d elements, got %zu", limit, count);
        return -1;
    }
    bool good = true;
    for (int i = 0; i < (int)count; i++) {
        struct value element = reader_element(&value, i);
        if (!json_is_object(element.json)) good = reader_unexpected(reader, element, "an object");
    }
    return good ? (int)count : -1;
}

static int compare_name(const void *key, const void *element)
{
    return strcmp(key, ((const struct name_index *)element)->name);
}

int reader_spline_name(struct reader *reader, struct value value)
{
    if (!json_is_string(value.json)) {
        reader_unexpected(reader, value, "the name of a spline");
        return -1;
    }
    const char *name = json_string_value(value.json);
    const struct name_index *found = NULL;
    if (reader->name_count > 0) {
        found = bsearch(name, reader->names, (size_t)reader->name_count, sizeof *found, compare_name);
    }
    if (found) return found->spline;
    reader_fail(reader, &value.at, "expected the name of a spline, got \"%s\"", name);
    return -1;
}

static bool is_among(const char *key, const char *const *words)
{
    for (; *words; words++) {
        if (strcmp(*words, key) == 0) return true;
    }
    return false;
}

static void warn_unknown(struct reader *reader, const struct where *object_at, const char *key)
{
    for (int i = 0; i < reader->warned_count; i++) {
        if (strcmp(reader->warned[i], key) == 0) return;
    }
    if (reader->warned_count == READER_MAX_WARNED) return;
    struct where at = {.parent = object_at, .key = key};
    reader->warned[reader->warned_count++] = key;
    const char *last = reader->warned_count == READER_MAX_WARNED ? "; further unknown keys are kept silently" : "";
    reader_warn(reader, &at, "unknown key: kept, but it has no effect%s", last);
}

json_t *reader_extra(struct reader *reader, const struct value *object, const char *const *known)
{
    json_t *extra = NULL;
    const char *key;
    json_t *value;
    json_object_foreach(object->json, key, value)
    {
        if (is_among(key, known)) continue;
        warn_unknown(reader, &object->at, key);
        if (!extra) extra = json_object();
        if (!extra || json_object_set(extra, key, value) != 0) need_failed();
    }
    return extra;
}

void reader_put(json_t **extra, const char *key, json_t *unknown)
{
    if (!unknown) return;
    if (!*extra) *extra = json_object();
    if (!*extra || json_object_set_new(*extra, key, unknown) != 0) need_failed();
}

/// `{"spline": "other"}`; returns its unknown keys, or NULL.
static json_t *read_track(struct reader *reader, const struct value *object, struct param *param)
{
    static const char *const known[] = {"spline", NULL};
    int track = reader_spline_name(reader, reader_member(object, "spline"));
    if (track >= 0) *param = param_track(track);
    return reader_extra(reader, object, known);
}

static void read_followed(struct reader *reader, const struct value *object, const char *key, bool may_be_motion,
                          struct param *param, json_t **extra)
{
    const bool is_motion = json_object_get(object->json, "model") != NULL;
    if (is_motion && json_object_get(object->json, "spline")) {
        reader_fail(reader, &object->at, "expected either a spline or a model, got both");
    } else if (is_motion && !may_be_motion) {
        reader_fail(reader, &object->at,
                    "expected a number or {\"spline\": name}: only an equilibrium follows a model");
    } else if (is_motion) {
        motion_load(reader, object, param);
    } else {
        reader_put(extra, key, read_track(reader, object, param));
    }
}

void reader_param(struct reader *reader, struct value value, struct range range, const char *key, bool may_be_motion,
                  struct param *param, json_t **extra)
{
    if (json_is_object(value.json)) {
        read_followed(reader, &value, key, may_be_motion, param, extra);
    } else if (!json_is_number(value.json)) {
        reader_unexpected(reader, value, "a number or {\"spline\": name}");
    } else {
        reader_number(reader, value, true, range, &param->value);
    }
}

json_t *reader_keep(struct reader *reader, json_t *extra)
{
    struct document *document = reader->document;
    if (!extra) return NULL;
    if (!document->owned) document->owned = json_array();
    if (json_array_append_new(document->owned, extra) != 0) need_failed();
    return extra;
}

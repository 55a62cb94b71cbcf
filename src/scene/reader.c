/// Readers of single values, and their complaints.
#include "scene/reader.h"
#include "scene/number.h"
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
    if (!reader->failed && reader->error) *reader->error = *error;
    reader->failed = true;
    report(reader, true, error->text);
    return false;
}

bool reader_fail(struct reader *reader, const struct where *where, const char *format, ...)
{
    if (reader->failed && !reader->problems) return false;
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

bool reader_no_memory(struct reader *reader)
{
    struct error error;
    fail_no_memory(&error, reader->source.name);
    return reader_report(reader, &error);
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

bool reader_unexpected(struct reader *reader, const struct where *where, const char *expected, const json_t *value)
{
    return reader_fail(reader, where, "expected %s, got %s", expected, kind_of(value));
}

json_t *reader_member(const struct where *object_at, const json_t *object, const char *key, struct where *at)
{
    *at = (struct where){.parent = object_at, .key = key};
    return json_object_get(object, key);
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

bool reader_number(struct reader *reader, const struct where *at, const json_t *value, bool required,
                   struct range range, double *target)
{
    if (!value && !required) return true;
    if (!json_is_number(value)) return reader_unexpected(reader, at, "a number", value);
    double number = json_number_value(value);
    bool low = range.above ? number <= range.minimum : number < range.minimum;
    if (low || number > range.maximum) return fail_range(reader, at, range, number);
    *target = number + 0.0; // −0 becomes 0, as it is saved
    return true;
}

bool reader_integer(struct reader *reader, const struct where *at, const json_t *value, int minimum, int maximum,
                    int *target)
{
    if (!value) return true;
    if (!json_is_number(value)) return reader_unexpected(reader, at, "a whole number", value);
    double number = json_number_value(value);
    if (number == floor(number) && number >= minimum && number <= maximum) {
        *target = (int)number;
        return true;
    }
    char got[NUMBER_TEXT_SIZE];
    number_print(number, got);
    return reader_fail(reader, at, "expected a whole number from %d to %d, got %s", minimum, maximum, got);
}

/// "a", "b" or "c"
static const char *list_words(const char *const *words, char *text, size_t size)
{
    size_t length = 0;
    for (int i = 0; words[i] && length < size; i++) {
        const char *before = i == 0 ? "" : words[i + 1] ? ", " : " or ";
        length += (size_t)snprintf(text + length, size - length, "%s\"%s\"", before, words[i]);
    }
    return text;
}

int reader_word(struct reader *reader, const struct where *at, const json_t *value, const char *const *words,
                int missing)
{
    char expected[128];
    const char *word = json_string_value(value);
    if (!value && missing >= 0) return missing;
    for (int i = 0; word && words[i]; i++) {
        if (strcmp(words[i], word) == 0) return i;
    }
    list_words(words, expected, sizeof expected);
    if (!word) {
        reader_unexpected(reader, at, expected, value);
    } else {
        reader_fail(reader, at, "expected %s, got \"%s\"", expected, word);
    }
    return -1;
}

char *reader_name(struct reader *reader, const struct where *at, const json_t *value)
{
    if (!json_is_string(value)) {
        reader_unexpected(reader, at, "a string", value);
        return NULL;
    }
    if (json_string_length(value) == 0) {
        reader_fail(reader, at, "expected a name, got an empty string");
        return NULL;
    }
    char *name = strdup(json_string_value(value));
    if (!name) reader_no_memory(reader);
    return name;
}

bool reader_array(struct reader *reader, const struct where *at, const json_t *value, size_t count,
                  const char *expected)
{
    if (!json_is_array(value)) return reader_unexpected(reader, at, expected, value);
    if (json_array_size(value) == count) return true;
    return reader_fail(reader, at, "expected %s, got %zu elements", expected, json_array_size(value));
}

int reader_objects(struct reader *reader, const struct where *at, const json_t *value, int limit)
{
    if (!value) return 0;
    if (!json_is_array(value)) {
        reader_unexpected(reader, at, "an array", value);
        return -1;
    }
    size_t count = json_array_size(value);
    if (count > (size_t)limit) {
        reader_fail(reader, at, "expected at most %d elements, got %zu", limit, count);
        return -1;
    }
    bool good = true;
    for (size_t i = 0; i < count; i++) {
        const json_t *element = json_array_get(value, i);
        struct where element_at = {.parent = at, .index = i};
        if (!json_is_object(element)) good = reader_unexpected(reader, &element_at, "an object", element);
    }
    return good ? (int)count : -1;
}

static int compare_name(const void *key, const void *element)
{
    return strcmp(key, ((const struct name_index *)element)->name);
}

int reader_spline_name(struct reader *reader, const struct where *at, const json_t *value)
{
    if (!json_is_string(value)) {
        reader_unexpected(reader, at, "the name of a spline", value);
        return -1;
    }
    const char *name = json_string_value(value);
    const struct name_index *found = NULL;
    if (reader->name_count > 0) {
        found = bsearch(name, reader->names, (size_t)reader->name_count, sizeof *found, compare_name);
    }
    if (found) return found->spline;
    reader_fail(reader, at, "expected the name of a spline, got \"%s\"", name);
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

json_t *reader_extra(struct reader *reader, const struct where *object_at, json_t *object, const char *const *known)
{
    json_t *extra = NULL;
    const char *key;
    json_t *value;
    json_object_foreach(object, key, value)
    {
        if (is_among(key, known)) continue;
        warn_unknown(reader, object_at, key);
        if (!extra) extra = json_object();
        if (!extra || json_object_set(extra, key, value) != 0) reader_no_memory(reader);
    }
    return extra;
}

/// `{"spline": "other"}`
static void read_track(struct reader *reader, const struct where *at, json_t *object, const char *key,
                       struct param *param, json_t **extra)
{
    static const char *const known[] = {"spline", NULL};
    struct where name_at;
    const json_t *name = reader_member(at, object, "spline", &name_at);
    int track = reader_spline_name(reader, &name_at, name);
    if (track >= 0) *param = (struct param){0, track};
    json_t *unknown = reader_extra(reader, at, object, known);
    if (!unknown) return;
    if (!*extra) *extra = json_object();
    if (!*extra || json_object_set_new(*extra, key, unknown) != 0) reader_no_memory(reader);
}

void reader_param(struct reader *reader, const struct where *at, json_t *value, struct range range, const char *key,
                  struct param *param, json_t **extra)
{
    if (json_is_object(value)) {
        read_track(reader, at, value, key, param, extra);
    } else if (!json_is_number(value)) {
        reader_unexpected(reader, at, "a number or {\"spline\": name}", value);
    } else {
        reader_number(reader, at, value, true, range, &param->value);
    }
}

json_t *reader_keep(struct reader *reader, json_t *extra)
{
    struct document *document = reader->document;
    if (!extra) return NULL;
    if (!document->owned) document->owned = json_array();
    if (json_array_append_new(document->owned, extra) == 0) return extra;
    reader_no_memory(reader);
    return NULL;
}

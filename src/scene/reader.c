/// Reads single values of a scene's text, and reports errors in them by file, line and path.
#include "base/json.h"
#include "base/need.h"
#include "scene/fields.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// --- the text: the line of every value, and its path

/// All functions here stop at the NUL at the text's end.
static void skip_space(struct cursor *c)
{
    while (*c->at == ' ' || *c->at == '\t' || *c->at == '\r' || *c->at == '\n') c->line += *c->at++ == '\n';
}

/// From the opening quote to after the closing one.
static void skip_string(struct cursor *c)
{
    c->at++;
    while (*c->at && *c->at != '"') {
        if (*c->at == '\\' && c->at[1]) c->at++;
        c->line += *c->at++ == '\n';
    }
    if (*c->at) c->at++;
}

/// A string, number, word or punctuation mark.
static void skip_token(struct cursor *c)
{
    if (*c->at == '"') {
        skip_string(c);
        return;
    }
    size_t length = strcspn(c->at, " \t\r\n\"[]{},:");
    c->at += length > 0 ? length : *c->at != '\0';
}

/// A whole value and the space after it.
static void skip_value(struct cursor *c)
{
    int depth = 0;
    do {
        depth += *c->at == '[' || *c->at == '{';
        depth -= *c->at == ']' || *c->at == '}';
        skip_token(c);
        skip_space(c);
    } while (depth > 0 && *c->at);
}

static struct cursor source_start(const struct source *source)
{
    struct cursor c = {source->text, 1};
    skip_space(&c);
    return c;
}

/// Refuses text that would take too much memory or stack to parse, by counting brackets and commas.
static bool source_check_limits(const struct source *source, struct error *error)
{
    struct cursor c = source_start(source);
    int depth = 0;
    long objects = 0, values = 1;
    for (; *c.at; skip_token(&c), skip_space(&c)) {
        bool opens = *c.at == '[' || *c.at == '{';
        depth += opens;
        depth -= *c.at == ']' || *c.at == '}';
        objects += *c.at == '{';
        values += opens || *c.at == ',';
        if (depth > SOURCE_MAX_DEPTH) {
            return fail(error, ERROR_INPUT, "%s:%d: scene: expected at most %d levels of brackets, got more",
                        source->name, c.line, SOURCE_MAX_DEPTH);
        }
        if (objects > SOURCE_MAX_OBJECTS || values > SOURCE_MAX_VALUES) {
            return fail(error, ERROR_INPUT, "%s:%d: scene: expected at most %d objects and %d values, got more",
                        source->name, c.line, SOURCE_MAX_OBJECTS, SOURCE_MAX_VALUES);
        }
    }
    if (c.at == source->text + source->size) return true;
    return fail(error, ERROR_INPUT, "%s:%d: scene: expected text, got a NUL byte", source->name, c.line);
}

/// Whether a string, with quotes and escapes, is that key.
static bool key_is(const char *from, const char *to, const char *key)
{
    size_t length = (size_t)(to - from);
    if (!memchr(from, '\\', length)) return length == strlen(key) + 2 && memcmp(from + 1, key, length - 2) == 0;
    json_t *string = json_read(from, length, JSON_DECODE_ANY, NULL);
    bool same = string && strcmp(json_string_value(string), key) == 0;
    json_decref(string);
    return same;
}

/// Moves from an object to a key's value; stays if there is none.
static struct cursor enter_object(struct cursor object, const char *key)
{
    struct cursor c = object;
    if (*c.at != '{') return object;
    do {
        c.at++;
        skip_space(&c);
        const char *from = c.at;
        if (*from != '"') return object;
        skip_string(&c);
        bool found = key_is(from, c.at, key);
        skip_space(&c);
        c.at += *c.at == ':';
        skip_space(&c);
        if (found) return c;
        skip_value(&c);
    } while (*c.at == ',');
    return object;
}

/// Moves from an array to an element; stays if there is none.
static struct cursor enter_array(struct finger *finger, struct cursor array, size_t index)
{
    if (*array.at != '[') return array;
    if (finger->array != array.at || finger->index > index) {
        *finger = (struct finger){.array = array.at, .cursor = {array.at + 1, array.line}};
        skip_space(&finger->cursor);
    }
    for (; finger->index < index; finger->index++) {
        struct cursor c = finger->cursor;
        skip_value(&c);
        if (*c.at != ',') return array;
        c.at++;
        skip_space(&c);
        finger->cursor = c;
    }
    return finger->cursor;
}

/// The place in a parsed text; if there is no such key, the nearest above.
static struct cursor locate(struct source *source, const struct where *where, int *depth)
{
    if (!where->parent) {
        *depth = 0;
        return source_start(source);
    }
    struct cursor parent = locate(source, where->parent, depth);
    if (*depth == SOURCE_MAX_DEPTH) return parent;
    struct finger *finger = &source->fingers[(*depth)++];
    return where->key ? enter_object(parent, where->key) : enter_array(finger, parent, where->index);
}

static void append_key(char path[PATH_TEXT_SIZE], const char *dot, const char *key, size_t length)
{
    print_more(path, PATH_TEXT_SIZE, "%s%.*s", *path ? dot : "", (int)length, key);
}

/// "splines[0].knots[2].frame"
static void append_where(const struct where *where, char path[PATH_TEXT_SIZE])
{
    if (!where->parent) return;
    append_where(where->parent, path);
    if (where->key) {
        append_key(path, ".", where->key, strlen(where->key));
    } else {
        print_more(path, PATH_TEXT_SIZE, "[%zu]", where->index);
    }
}

/// A bracket open at an offset.
struct level {
    bool is_object;
    const char *key; ///< the current member's in an object, as written; NULL between members
    size_t key_length, index;
};

/// The path of the value that is open at byte `offset`; the text need only be valid up to there.
static void source_path_at(const struct source *source, size_t offset, char path[PATH_TEXT_SIZE])
{
    struct level levels[SOURCE_MAX_DEPTH];
    struct cursor c = source_start(source);
    int depth = 0;
    while (*c.at) {
        const char *token = c.at;
        skip_token(&c);
        if ((size_t)(c.at - source->text) >= offset) break;
        struct level *level = depth > 0 ? &levels[depth - 1] : NULL;
        if (*token == '[' || *token == '{') {
            if (depth == SOURCE_MAX_DEPTH) break;
            levels[depth++] = (struct level){.is_object = *token == '{'};
        } else if (*token == ']' || *token == '}') {
            depth -= depth > 0;
        } else if (*token == ',' && level) {
            level->key = NULL;
            level->index++;
        } else if (*token == '"' && level && !level->key) {
            level->key = token + 1;
            level->key_length = (size_t)(c.at - token) - 2;
        }
        skip_space(&c);
    }

    path[0] = '\0';
    for (int i = 0; i < depth; i++) {
        if (!levels[i].is_object) {
            print_more(path, PATH_TEXT_SIZE, "[%zu]", levels[i].index);
        } else if (levels[i].key) {
            append_key(path, ".", levels[i].key, levels[i].key_length);
        }
    }
    if (!path[0]) append_key(path, "", "scene", 5);
}

// --- problems and values

const struct range range_any = {-INFINITY, INFINITY, false};

/// "file:line: path: sentence". The line is that of a place or, if there is no such key, of the nearest place above.
static void compose_problem(struct reader *reader, const struct where *where, struct error *error, const char *format,
                            va_list arguments)
{
    char path[PATH_TEXT_SIZE] = "", sentence[sizeof error->text];
    int depth;
    append_where(where, path);
    if (!path[0]) append_key(path, "", "scene", 5);
    vsnprintf(sentence, sizeof sentence, format, arguments);
    fail(error, ERROR_INPUT, "%s:%d: %s: %s", reader->source.name, locate(&reader->source, where, &depth).line, path,
         sentence);
}

bool reader_report(struct reader *reader, bool is_error, const struct error *problem)
{
    struct problems *problems = reader->problems;
    if (is_error && reader->errors++ == 0 && reader->error) *reader->error = *problem;
    if (!problems) return false;
    problems->errors += is_error;
    problems->warnings += !is_error;
    problems->report(problems->user, is_error, problem->text);
    return false;
}

bool reader_fail(struct reader *reader, const struct where *where, const char *format, ...)
{
    if (reader->errors > 0 && !reader->problems) return reader->errors++, false;
    struct error error;
    va_list arguments;
    va_start(arguments, format);
    compose_problem(reader, where, &error, format, arguments);
    va_end(arguments);
    return reader_report(reader, true, &error);
}

void reader_warn(struct reader *reader, const struct where *where, const char *format, ...)
{
    if (!reader->problems) return;
    struct error warning;
    va_list arguments;
    va_start(arguments, format);
    compose_problem(reader, where, &warning, format, arguments);
    va_end(arguments);
    reader_report(reader, false, &warning);
}

bool reader_unexpected(struct reader *reader, struct value value, const char *expected)
{
    static const char *const kinds[] = {
        [JSON_OBJECT] = "an object", [JSON_ARRAY] = "an array", [JSON_STRING] = "a string",
        [JSON_INTEGER] = "a number", [JSON_REAL] = "a number",  [JSON_TRUE] = "true",
        [JSON_FALSE] = "false",      [JSON_NULL] = "null"};
    return reader_fail(reader, &value.at, "expected %s, got %s", expected,
                       value.json ? kinds[json_typeof(value.json)] : "nothing");
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

bool reader_number(struct reader *reader, struct value value, bool required, struct range range, double *target)
{
    if (!value.json && !required) return true;
    if (!json_is_number(value.json)) return reader_unexpected(reader, value, "a number");
    double number = json_number_value(value.json);
    if (range_has(range, number)) {
        *target = number + 0.0; // −0 becomes 0, as when saving
        return true;
    }
    char low[NUMBER_TEXT_SIZE], high[NUMBER_TEXT_SIZE] = "", got[NUMBER_TEXT_SIZE];
    number_print(range.minimum, low);
    number_print(number, got);
    if (isfinite(range.maximum)) number_print(range.maximum, high);
    const char *from = range.above ? "above " : *high ? "from " : "of at least ";
    const char *to = !*high ? "" : range.above ? " and at most " : " to ";
    return reader_fail(reader, &value.at, "expected a number %s%s%s%s, got %s", from, low, to, high, got);
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

json_t *reader_extra(struct reader *reader, const struct value *object, const char *const *known)
{
    json_t *extra = NULL;
    const char *key;
    json_t *value;
    json_object_foreach(object->json, key, value)
    {
        bool is_known = false, is_warned = reader->warned_count == READER_MAX_WARNED;
        for (int i = 0; known[i] && !is_known; i++) is_known = strcmp(known[i], key) == 0;
        if (is_known) continue;
        for (int i = 0; i < reader->warned_count && !is_warned; i++) is_warned = strcmp(reader->warned[i], key) == 0;
        if (!is_warned) {
            const struct where at = {.parent = &object->at, .key = key};
            reader->warned[reader->warned_count++] = key;
            const bool is_last = reader->warned_count == READER_MAX_WARNED;
            reader_warn(reader, &at, "unknown key: kept, but it has no effect%s",
                        is_last ? "; further unknown keys are kept silently" : "");
        }
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

json_t *reader_param(struct reader *reader, struct value value, struct range range, bool may_be_motion,
                     struct param *param)
{
    static const char *const known[] = {"spline", NULL};
    if (json_is_number(value.json)) {
        reader_number(reader, value, true, range, &param->value);
        return NULL;
    }
    if (!json_is_object(value.json)) {
        reader_unexpected(reader, value, "a number or {\"spline\": name}");
        return NULL;
    }
    const bool is_motion = json_object_get(value.json, "model") != NULL;
    if (is_motion && json_object_get(value.json, "spline")) {
        reader_fail(reader, &value.at, "expected either a spline or a model, got both");
    } else if (is_motion && !may_be_motion) {
        reader_fail(reader, &value.at,
                    "expected a number or {\"spline\": name}: only an equilibrium follows a model");
    } else if (is_motion) {
        motion_load(reader, &value, param);
    } else {
        const int track = reader_spline_name(reader, reader_member(&value, "spline"));
        if (track >= 0) *param = param_track(track);
        return reader_extra(reader, &value, known);
    }
    return NULL;
}

json_t *reader_keep(struct reader *reader, json_t *extra)
{
    struct document *document = reader->document;
    if (!extra) return NULL;
    if (!document->owned) document->owned = json_array();
    if (json_array_append_new(document->owned, extra) != 0) need_failed();
    return extra;
}

json_t *reader_parse(struct reader *reader)
{
    struct source *source = &reader->source;
    char path[PATH_TEXT_SIZE], sentence[JSON_ERROR_TEXT_LENGTH + 64];
    struct error error;
    json_error_t syntax;
    if (!source_check_limits(source, &error)) {
        reader_report(reader, true, &error);
        return NULL;
    }
    // Whole numbers stay integers, so that unknown keys stay exact, unless one is too large.
    json_t *json = json_read(source->text, source->size, JSON_REJECT_DUPLICATES, &syntax);
    if (!json && json_error_code(&syntax) == json_error_numeric_overflow)
        json = json_read(source->text, source->size, JSON_REJECT_DUPLICATES | JSON_DECODE_INT_AS_REAL, &syntax);
    if (json) return json;

    // jansson says "X expected near Y" or "Z near Y".
    const char *near = strstr(syntax.text, " near "), *expected = strstr(syntax.text, " expected near ");
    const char *got = near ? near + 6 : "the end of the file";
    switch (json_error_code(&syntax)) {
    case json_error_duplicate_key:
        snprintf(sentence, sizeof sentence, "expected each key once, got %s again", got);
        break;
    case json_error_null_character:
        snprintf(sentence, sizeof sentence, "expected a string without \\u0000, got %s", got);
        break;
    case json_error_numeric_overflow:
        snprintf(sentence, sizeof sentence, "expected a number that fits a double, got %s", got);
        break;
    case json_error_invalid_utf8:
        snprintf(sentence, sizeof sentence, "expected UTF-8, got something else (%s)", syntax.text);
        break;
    case json_error_out_of_memory:
        need_failed();
    default:
        if (expected) {
            snprintf(sentence, sizeof sentence, "expected %.*s, got %s", (int)(expected - syntax.text), syntax.text,
                     got);
        } else {
            const int length = near ? (int)(near - syntax.text) : (int)strlen(syntax.text);
            snprintf(sentence, sizeof sentence, "expected valid JSON, got %s (%.*s)", got, length, syntax.text);
        }
    }
    source_path_at(source, (size_t)syntax.position, path);
    fail(&error, ERROR_INPUT, "%s:%d: %s: %s", source->name, syntax.line, path, sentence);
    reader_report(reader, true, &error);
    return NULL;
}

/// Finds the line of every value in a scene's text.
#include "base/json.h"
#include "scene/reader.h"
#include <stdio.h>
#include <string.h>

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

static struct cursor start(const struct source *source)
{
    struct cursor c = {source->text, 1};
    skip_space(&c);
    return c;
}

bool source_check_limits(const struct source *source, struct error *error)
{
    struct cursor c = start(source);
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

static struct cursor locate(struct source *source, const struct where *where, int *depth)
{
    if (!where->parent) {
        *depth = 0;
        return start(source);
    }
    struct cursor parent = locate(source, where->parent, depth);
    if (*depth == SOURCE_MAX_DEPTH) return parent;
    struct finger *finger = &source->fingers[(*depth)++];
    return where->key ? enter_object(parent, where->key) : enter_array(finger, parent, where->index);
}

int source_line(struct source *source, const struct where *where)
{
    int depth;
    return locate(source, where, &depth).line;
}

static void append(char path[PATH_TEXT_SIZE], const char *dot, const char *key, size_t length)
{
    size_t used = strlen(path);
    snprintf(path + used, PATH_TEXT_SIZE - used, "%s%.*s", used ? dot : "", (int)length, key);
}

static void append_index(char path[PATH_TEXT_SIZE], size_t index)
{
    size_t used = strlen(path);
    snprintf(path + used, PATH_TEXT_SIZE - used, "[%zu]", index);
}

static void append_where(const struct where *where, char path[PATH_TEXT_SIZE])
{
    if (!where->parent) return;
    append_where(where->parent, path);
    if (where->key) {
        append(path, ".", where->key, strlen(where->key));
    } else {
        append_index(path, where->index);
    }
}

void where_path(const struct where *where, char path[PATH_TEXT_SIZE])
{
    path[0] = '\0';
    append_where(where, path);
    if (!path[0]) append(path, "", "scene", 5);
}

/// A bracket open at an offset.
struct level {
    bool is_object;
    const char *key; ///< the current member's in an object, as written; NULL between members
    size_t key_length, index;
};

static void print_levels(const struct level *levels, int depth, char path[PATH_TEXT_SIZE])
{
    path[0] = '\0';
    for (int i = 0; i < depth; i++) {
        if (!levels[i].is_object) {
            append_index(path, levels[i].index);
        } else if (levels[i].key) {
            append(path, ".", levels[i].key, levels[i].key_length);
        }
    }
    if (!path[0]) append(path, "", "scene", 5);
}

void source_path_at(const struct source *source, size_t offset, char path[PATH_TEXT_SIZE])
{
    struct level levels[SOURCE_MAX_DEPTH];
    struct cursor c = start(source);
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
    print_levels(levels, depth, path);
}

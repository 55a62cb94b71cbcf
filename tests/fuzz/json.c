/// Changes JSON as JSON, so that what a fuzz target tries is refused for what it says, not for its commas.
#include "fuzz.h"
#include <jansson.h>
#include <stdlib.h>
#include <string.h>

size_t LLVMFuzzerMutate(uint8_t *data, size_t size, size_t most);

enum { MOST_CHANGES = 4, MOST_TEXT = 64, MOST_COPIES = 40, DEPTH = 24 };

static uint32_t state;

static uint32_t any(uint32_t below)
{
    state ^= state << 13;
    state ^= state >> 17;
    state ^= state << 5;
    return state % below;
}

/// Counts down over all values, the root too, and returns that number `*n`.
static json_t *pick(json_t *json, int *n, int depth)
{
    json_t *found = NULL, *value;
    const char *key;
    size_t i;
    if ((*n)-- == 0) return json;
    if (depth == 0) return NULL;
    json_object_foreach(json, key, value)
    {
        if ((found = pick(value, n, depth - 1))) return found;
    }
    json_array_foreach(json, i, value)
    {
        if ((found = pick(value, n, depth - 1))) return found;
    }
    return NULL;
}

static json_t *pick_any(json_t *root)
{
    int all = 1 << 30;
    pick(root, &all, DEPTH);
    int n = (int)any((uint32_t)((1 << 30) - all));
    return pick(root, &n, DEPTH);
}

/// A number near `old`, or one at which something ends.
static json_t *number_near(const json_t *old)
{
    static const double ends[] = {0,
                                  -1,
                                  1,
                                  0.5,
                                  255,
                                  256,
                                  65535,
                                  65536,
                                  2147483647.0,
                                  2147483648.0,
                                  1e30,
                                  -1e30,
                                  1e-30,
                                  5e-324,
                                  4294967295.0,
                                  4294967296.0,
                                  9007199254740993.0,
                                  1e18,
                                  1.7e308,
                                  30000000,
                                  -0.0,
                                  1e9,
                                  5120,
                                  5121,
                                  5123,
                                  5125,
                                  5126,
                                  3,
                                  16,
                                  1000000};
    const double was = json_number_value(old);
    double next = ends[any(sizeof ends / sizeof *ends)];
    switch (any(10)) {
    case 0:
        next = was + 1;
        break;
    case 1:
        next = was - 1;
        break;
    case 2:
        next = was * 2;
        break;
    case 3:
        next = -was;
        break;
    case 4:
        next = any(100);
        break;
    default:
        break;
    }
    const bool whole = next >= -9e18 && next <= 9e18 && next == (double)(json_int_t)next && any(8) > 0;
    return whole ? json_integer((json_int_t)next) : json_real(next);
}

/// Other text of the same kind; libFuzzer knows the words that the reader has compared with.
static json_t *text_near(const json_t *old)
{
    uint8_t text[MOST_TEXT + 1] = {0};
    size_t size = json_string_length(old) < MOST_TEXT ? json_string_length(old) : MOST_TEXT;
    memcpy(text, json_string_value(old), size);
    size = LLVMFuzzerMutate(text, size, MOST_TEXT);
    for (size_t i = 0; i < size; i++) text[i] = text[i] & 0x7F;
    return json_stringn((const char *)text, size);
}

/// A value to put in the place of `old`; NULL leaves that.
static json_t *instead_of(json_t *old, json_t *root)
{
    if (any(4) == 0) return json_deep_copy(pick_any(root));
    if (json_is_number(old)) return number_near(old);
    if (json_is_string(old)) return text_near(old);
    switch (any(8)) {
    case 0:
        return json_null();
    case 1:
        return json_boolean(any(2));
    case 2:
        return json_object();
    case 3:
        return json_array();
    case 4:
        return json_integer(any(100));
    case 5:
        return json_string("");
    default:
        return NULL;
    }
}

static void change_object(json_t *object, json_t *root)
{
    const size_t size = json_object_size(object);
    void *at = json_object_iter(object);
    for (uint32_t skip = size ? any((uint32_t)size) : 0; at && skip > 0; skip--)
        at = json_object_iter_next(object, at);
    if (!at) return;
    const char *key = json_object_iter_key(at);
    json_t *other, *value = json_object_iter_value(at);
    switch (any(4)) {
    case 0:
        json_object_del(object, key);
        break;
    case 1: // members of another
        other = json_deep_copy(pick_any(root));
        if (json_is_object(other)) json_object_update_missing(object, other);
        json_decref(other);
        break;
    default:
        other = instead_of(value, root);
        if (other) json_object_set_new(object, key, other);
    }
}

static void change_array(json_t *array, json_t *root)
{
    const size_t size = json_array_size(array), i = size ? any((uint32_t)size) : 0;
    if (size == 0) {
        json_array_append_new(array, json_deep_copy(pick_any(root)));
        return;
    }
    json_t *other;
    switch (any(5)) {
    case 0:
        json_array_remove(array, i);
        break;
    case 1:
        json_array_insert_new(array, any((uint32_t)size + 1), json_deep_copy(json_array_get(array, i)));
        break;
    case 2:
        for (uint32_t copies = any(MOST_COPIES); copies > 0; copies--)
            json_array_append_new(array, json_deep_copy(json_array_get(array, i)));
        break;
    default:
        other = instead_of(json_array_get(array, i), root);
        if (other) json_array_set_new(array, i, other);
    }
}

static char *changed(const char *text, size_t size)
{
    json_t *root = json_loadb(text, size, 0, NULL);
    if (!root) return NULL;
    for (uint32_t i = 1 + any(MOST_CHANGES); i > 0; i--) {
        json_t *at = pick_any(root);
        for (int tries = 0; at && tries < 8 && !json_is_object(at) && !json_is_array(at); tries++)
            at = pick_any(root);
        if (json_is_object(at)) change_object(at, root);
        if (json_is_array(at)) change_array(at, root);
    }
    char *out = json_dumps(root, JSON_COMPACT);
    json_decref(root);
    return out;
}

size_t fuzz_mutate_json(uint8_t *data, size_t size, size_t most, size_t start, size_t end, unsigned seed)
{
    state = seed * 2654435761u + 1;
    if (state == 0) state = 1;
    char *text = any(10) > 0 ? changed((const char *)data + start, end - start) : NULL;
    size_t length = text ? strlen(text) : 0;
    if (!text || size - (end - start) + length > most) {
        free(text);
        return LLVMFuzzerMutate(data, size, most);
    }
    memmove(data + start + length, data + end, size - end);
    memcpy(data + start, text, length);
    free(text);
    return start + length + size - end;
}

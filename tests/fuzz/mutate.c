/// Changes JSON as JSON and glTF as glTF, so that what a fuzz target tries is refused for what it says, not for its commas.
#include "fuzz.h"
#include <jansson.h>
#include <stdlib.h>
#include <string.h>

size_t LLVMFuzzerMutate(uint8_t *data, size_t size, size_t most);

enum { MOST_CHANGES = 4, MOST_TEXT = 64, MOST_COPIES = 40, DEPTH = 24, HEADER = 12, CHUNK = 8 };

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
    json_object_foreach(json, key, value) if ((found = pick(value, n, depth - 1))) return found;
    json_array_foreach(json, i, value) if ((found = pick(value, n, depth - 1))) return found;
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
    static const double ends[] = {0,          -1,     1,      0.5,  3,     16,    255,        256,
                                  65535,      65536,  1e6,    3e7,  1e9,   1e18,  0x1p31 - 1, 0x1p31,
                                  0x1p32 - 1, 0x1p32, 0x1p53, 1e30, -1e30, 1e-30, 5e-324,     1.7e308,
                                  -0.0,       5120,   5121,   5123, 5125,  5126};
    const double was = json_number_value(old), near[] = {was + 1, was - 1, was * 2, -was, any(100)};
    const uint32_t which = any(10);
    const double next = which < 5 ? near[which] : ends[any(sizeof ends / sizeof *ends)];
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
    const uint32_t which = any(8);
    if (which == 0) return json_null();
    if (which == 1) return json_boolean(any(2));
    if (which == 2) return json_object();
    if (which == 3) return json_array();
    if (which == 4) return json_integer(any(100));
    return which == 5 ? json_string("") : NULL;
}

static void change_object(json_t *object, json_t *root)
{
    const size_t size = json_object_size(object);
    void *at = json_object_iter(object);
    for (uint32_t skip = size ? any((uint32_t)size) : 0; at && skip > 0; skip--)
        at = json_object_iter_next(object, at);
    if (!at) return;
    const char *key = json_object_iter_key(at);
    const uint32_t which = any(4);
    json_t *other = which == 0   ? NULL
                    : which == 1 ? json_deep_copy(pick_any(root))
                                 : instead_of(json_object_iter_value(at), root);
    if (which == 0) json_object_del(object, key);
    if (which == 1 && json_is_object(other)) json_object_update_missing(object, other);
    if (which > 1 && other) json_object_set(object, key, other);
    json_decref(other);
}

static void change_array(json_t *array, json_t *root)
{
    const size_t size = json_array_size(array), i = size ? any((uint32_t)size) : 0;
    const uint32_t which = size ? any(5) : 5;
    json_t *other = which == 5  ? json_deep_copy(pick_any(root))
                    : which > 2 ? instead_of(json_array_get(array, i), root)
                                : NULL;
    if (which == 0) json_array_remove(array, i);
    if (which == 1) json_array_insert_new(array, any((uint32_t)size + 1), json_deep_copy(json_array_get(array, i)));
    for (uint32_t copies = which == 2 ? any(MOST_COPIES) : 0; copies > 0; copies--)
        json_array_append_new(array, json_deep_copy(json_array_get(array, i)));
    if (which == 5) json_array_append(array, other);
    if (which > 2 && which < 5 && other) json_array_set(array, i, other);
    json_decref(other);
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

/// Changes the JSON that lies between `start` and `end`.
static size_t mutate_part(uint8_t *data, size_t size, size_t most, size_t start, size_t end, unsigned seed)
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

size_t mutate_bytes(uint8_t *data, size_t size, size_t most, unsigned seed)
{
    (void)seed;
    return LLVMFuzzerMutate(data, size, most);
}

size_t mutate_json(uint8_t *data, size_t size, size_t most, unsigned seed)
{
    return mutate_part(data, size, most, 0, size, seed);
}

size_t mutate_before_nul(uint8_t *data, size_t size, size_t most, unsigned seed)
{
    return mutate_part(data, size, most, 0, strnlen((const char *)data, size), seed);
}

bool fuzz_is_glb(const uint8_t *data, size_t size) { return size >= HEADER + CHUNK && memcmp(data, "glTF", 4) == 0; }

/// The JSON of a .glb is padded, and the lengths say so.
size_t mutate_gltf(uint8_t *data, size_t size, size_t most, unsigned seed)
{
    if (!fuzz_is_glb(data, size)) return mutate_json(data, size, most, seed);
    uint32_t length;
    memcpy(&length, data + HEADER, sizeof length);
    const size_t start = HEADER + CHUNK, end = start + length, behind = size - end;
    if (length > size - start || most < size + 4) return LLVMFuzzerMutate(data, size, most);
    if (seed % 8 == 0 && behind > CHUNK) // the numbers in the other chunk
        return end + CHUNK + LLVMFuzzerMutate(data + end + CHUNK, behind - CHUNK, behind - CHUNK);
    const size_t now = mutate_part(data, size, most - 4, start, end, seed);
    if (now < start + behind || !fuzz_is_glb(data, now) || memcmp(data + HEADER, &length, sizeof length) != 0)
        return now; // changed as bytes
    const size_t json = now - start - behind, padding = (4 - json % 4) % 4;
    memmove(data + start + json + padding, data + start + json, behind);
    memset(data + start + json, ' ', padding);
    memcpy(data + HEADER, &(uint32_t){(uint32_t)(json + padding)}, sizeof length);
    memcpy(data + 8, &(uint32_t){(uint32_t)(now + padding)}, sizeof length);
    return now + padding;
}

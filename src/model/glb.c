/// Opens .glb and .gltf files with their external files and data URIs; and reads accessors.
#include "model/glb.h"
#include "base/base64.h"
#include "base/file.h"
#include "base/json.h"
#include "base/npy.h"
#include "base/progress.h"
#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { HEADER = 12, CHUNK_HEADER = 8 };

static uint32_t word_at(const char *bytes)
{
    uint32_t word;
    memcpy(&word, bytes, sizeof word);
    return word;
}

static bool expected(const struct glb *glb, const char *what, struct error *error)
{
    return fail(error, ERROR_INPUT, "%s: expected %s, got something else", glb->path, what);
}

static bool read_json(struct glb *glb, const char *text, size_t length, struct error *error)
{
    json_error_t wrong;
    while (length > 0 && text[length - 1] == '\0') length--; // padding by some writers
    // The JSON library reads past a NUL, while all other code ends the text there.
    if (memchr(text, '\0', length))
        return fail(error, ERROR_INPUT, "%s: JSON: expected text, got a NUL byte", glb->path);
    glb->json = json_read(text, length, 0, &wrong);
    if (!glb->json && json_error_code(&wrong) == json_error_out_of_memory) return fail_no_memory(error, glb->path);
    if (!glb->json) return fail(error, ERROR_INPUT, "%s: JSON, line %d: %s", glb->path, wrong.line, wrong.text);
    return true;
}

static bool read_chunks(struct glb *glb, size_t size, struct error *error)
{
    bool is_glb = size >= HEADER + CHUNK_HEADER && word_at(glb->data) == GLB_MAGIC && word_at(glb->data + 4) == 2;
    if (!is_glb) return expected(glb, "a binary glTF 2.0 file (.glb)", error);
    size_t length = word_at(glb->data + HEADER), end = HEADER + CHUNK_HEADER + length;
    if (word_at(glb->data + 8) > size || end > size)
        return fail(error, ERROR_INPUT, "%s: expected a file of %u bytes, got %zu: the file is cut off", glb->path,
                    word_at(glb->data + 8), size);
    if (word_at(glb->data + HEADER + 4) != GLB_JSON) return expected(glb, "JSON in the first chunk", error);
    if (end + CHUNK_HEADER <= size && word_at(glb->data + end + 4) == GLB_BIN) {
        struct glb_bytes *chunk = &glb->chunk;
        *chunk = (struct glb_bytes){(const unsigned char *)glb->data + end + CHUNK_HEADER, word_at(glb->data + end)};
        if (chunk->size > size - end - CHUNK_HEADER) return expected(glb, "a binary chunk as long as it says", error);
    }
    return read_json(glb, glb->data + HEADER + CHUNK_HEADER, length, error);
}

static bool refuse_fbx(const char *path, struct error *error)
{
    return fail(error, ERROR_INPUT,
                "%s: expected glTF, got FBX: export it from Blender as glTF, or run tools/from-fbx.sh on it", path);
}

bool glb_open_bytes(struct glb *glb, const char *path, char *data, size_t size, struct error *error)
{
    *glb = (struct glb){.path = path, .data = data, .room = GLB_ROOM + GLB_GROWTH * size};
    stage_tell("reading a glTF file", 0, (long)size);
    const bool binary = size >= 4 && word_at(data) == GLB_MAGIC;
    const bool parsed = path_has_end(path, ".fbx") ? refuse_fbx(path, error)
                        : binary                   ? read_chunks(glb, size, error)
                                                   : read_json(glb, data, size, error);
    if (parsed && (json_is_object(glb->json) || expected(glb, "a JSON object", error))) return true;
    glb_close(glb);
    return false;
}

bool glb_open(struct glb *glb, const char *path, struct error *error)
{
    char *data;
    size_t size;
    return file_read_text(path, GLB_FILE_LIMIT, &data, &size, error) && glb_open_bytes(glb, path, data, size, error);
}

void glb_close(struct glb *glb)
{
    for (int i = 0; i < glb->buffer_count; i++) free(glb->buffers[i].owned);
    free(glb->buffers);
    json_decref(glb->json);
    free(glb->data);
    *glb = (struct glb){0};
}

int64_t glb_integer(const json_t *object, const char *key, int64_t otherwise)
{
    const json_t *member = json_object_get(object, key);
    if (!member) return otherwise;
    json_int_t value = json_is_integer(member) ? json_integer_value(member) : -1;
    return value >= 0 && value <= INT32_MAX ? (int64_t)value : -1;
}

// --- bytes outside the chunk

static bool read_data(const char *uri, struct glb_buffer *buffer, struct error *error)
{
    const char *comma = strchr(uri, ',');
    const bool is_base64 = comma && comma - uri >= 7 && strncmp(comma - 7, ";base64", 7) == 0;
    if (!is_base64) return fail(error, ERROR_INPUT, "expected a data URI in base64, got another");
    unsigned char *bytes = malloc(base64_capacity(strlen(comma)));
    if (!bytes) return fail_no_memory(error, "a data URI");
    *buffer = (struct glb_buffer){.bytes = {.at = bytes}, .owned = bytes};
    if (base64_decode(comma + 1, bytes, &buffer->bytes.size)) return true;
    free(bytes);
    *buffer = (struct glb_buffer){0};
    return fail(error, ERROR_INPUT, "expected base64, got something else");
}

/// "a%20b" → "a b"; false for an address, an absolute path, or no file name.
static bool decode_name(const char *uri, char name[PATH_LIMIT])
{
    size_t length = 0;
    if (uri[0] == '/' || uri[0] == '\0' || uri[strcspn(uri, ":/")] == ':') return false;
    for (; *uri && length + 1 < PATH_LIMIT; uri++) {
        char hex[3] = {0};
        if (*uri == '%' && isxdigit((unsigned char)uri[1]) && isxdigit((unsigned char)uri[2])) {
            memcpy(hex, uri + 1, 2);
            uri += 2;
        }
        name[length] = hex[0] ? (char)strtol(hex, NULL, 16) : *uri;
        if (name[length++] == '\0') return false;
    }
    name[length] = '\0';
    return *uri == '\0' && name[0] != '/';
}

bool glb_read_uri(struct glb *glb, const char *uri, struct glb_buffer *buffer, struct error *error)
{
    char name[PATH_LIMIT], folder[PATH_LIMIT], path[PATH_LIMIT];
    *buffer = (struct glb_buffer){0};
    if (strncmp(uri, "data:", 5) == 0) return read_data(uri, buffer, error);
    if (!decode_name(uri, name) || !path_folder(glb->path, folder) ||
        snprintf(path, sizeof path, "%s%s%s", folder, folder[0] ? "/" : "", name) >= (int)sizeof path)
        return fail(error, ERROR_INPUT,
                    "expected a data URI or a file's name, from the folder of this one, got '%.80s'", uri);
    char *data;
    size_t size;
    if (!file_read(path, GLB_FILE_LIMIT, &data, &size, error)) return false;
    glb->room += GLB_GROWTH * size;
    stage_tell("reading a glTF file", 0, (long)size);
    *buffer = (struct glb_buffer){{(unsigned char *)data, size}, data};
    return true;
}

/// The buffer before number `index` that is the same file; NULL if there is none.
static const struct glb_buffer *same_file(const struct glb *glb, const json_t *buffers, size_t index, const char *uri)
{
    for (size_t i = 0; i < index && strncmp(uri, "data:", 5) != 0; i++) {
        const char *other = json_string_value(json_object_get(json_array_get(buffers, i), "uri"));
        if (other && strcmp(other, uri) == 0) return &glb->buffers[i];
    }
    return NULL;
}

static bool read_buffer(struct glb *glb, const json_t *buffers, size_t index, struct glb_buffer *buffer,
                        struct error *error)
{
    const json_t *described = json_array_get(buffers, index);
    if (glb_is_fallback(described)) return true;
    const char *uri = json_string_value(json_object_get(described, "uri"));
    const struct glb_buffer *same = uri ? same_file(glb, buffers, index, uri) : NULL;
    struct error why = {0};
    if (same) {
        buffer->bytes = same->bytes;
    } else if (!uri) {
        if (index == 0) buffer->bytes = glb->chunk;
    } else if (!glb_read_uri(glb, uri, buffer, &why)) {
        return fail(error, why.kind, "%s: buffers[%zu].uri: %s", glb->path, index, why.text);
    }
    int64_t length = glb_integer(described, "byteLength", 0);
    if (length >= 0 && length <= (int64_t)buffer->bytes.size) return true;
    return fail(error, ERROR_INPUT,
                "%s: buffers[%zu].byteLength: expected at most the %zu bytes that are there, got %lld", glb->path,
                index, buffer->bytes.size, (long long)length);
}

bool glb_read_buffers(struct glb *glb, struct error *error)
{
    const json_t *buffers = json_object_get(glb->json, "buffers");
    size_t total = 0;
    glb->buffers = calloc(json_array_size(buffers) + 1, sizeof *glb->buffers);
    if (!glb->buffers) return fail_no_memory(error, glb->path);
    for (size_t i = 0; i < json_array_size(buffers); i++) {
        struct glb_buffer *buffer = &glb->buffers[glb->buffer_count++];
        if (!read_buffer(glb, buffers, i, buffer, error)) return false;
        if (buffer->owned) total += buffer->bytes.size;
        if (total > GLB_FILE_LIMIT)
            return fail(error, ERROR_INPUT, "%s: buffers[%zu]: expected at most %d MiB in all, got more", glb->path,
                        i, GLB_FILE_LIMIT >> 20);
    }
    return glb_unpack(glb, error);
}

// --- accessors

/// Elements in the binary chunk: each `components` numbers of one type, `stride` bytes apart.
struct elements {
    const unsigned char *bytes;
    enum number_type type;
    int components;
    size_t stride;
    bool normalised;
};

/// 0 if glTF has no such type.
static int size_of_type(int64_t type)
{
    const bool known = type >= NUMBER_INT8 && type <= NUMBER_FLOAT32 && type != NUMBER_INT32;
    return known ? number_size((enum number_type)type) : 0;
}

static double element_at(const struct elements *e, int element, int component)
{
    static const double largest[] = {127, 255, 32767, 65535};
    const unsigned char *at = e->bytes + (size_t)element * e->stride + (size_t)(component * number_size(e->type));
    const double number = number_read(at, e->type, false);
    const bool whole = e->normalised && e->type < NUMBER_INT32;
    return whole ? fmax(number / largest[e->type - NUMBER_INT8], -1) : number;
}

static const json_t *view_of(const struct glb *glb, int64_t index)
{
    return index >= 0 ? json_array_get(json_object_get(glb->json, "bufferViews"), (size_t)index) : NULL;
}

bool glb_view(const struct glb *glb, int64_t index, struct glb_bytes *bytes)
{
    return glb_bytes(glb, view_of(glb, index), bytes);
}

bool glb_bytes(const struct glb *glb, const json_t *view, struct glb_bytes *bytes)
{
    int64_t buffer = glb_integer(view, "buffer", 0);
    int64_t start = glb_integer(view, "byteOffset", 0), length = glb_integer(view, "byteLength", -1);
    if (start < 0 || length < 0 || buffer < 0 || buffer >= glb->buffer_count) return false;
    const struct glb_bytes *whole = &glb->buffers[buffer].bytes;
    if (!whole->at || start + length > (int64_t)whole->size) return false;
    *bytes = (struct glb_bytes){whole->at + start, (size_t)length};
    return true;
}

/// Finds `count` elements in the buffer view named by `place`, and checks that they lie inside.
static bool find_elements(const struct glb *glb, const json_t *place, int64_t count, struct elements *e)
{
    struct glb_bytes view;
    int64_t index = glb_integer(place, "bufferView", -1), at = glb_integer(place, "byteOffset", 0);
    int64_t element = size_of_type(e->type) * e->components;
    if (!glb_view(glb, index, &view) || at < 0 || element == 0) return false;
    int64_t stride = glb_integer(view_of(glb, index), "byteStride", element);
    if (stride < element || (count > 0 && at + stride * (count - 1) + element > (int64_t)view.size)) return false;
    e->bytes = view.at + at;
    e->stride = (size_t)stride;
    return true;
}

/// Applies a sparse accessor's changes.
static bool apply_sparse(const struct glb *glb, const json_t *sparse, struct elements *values,
                         struct glb_numbers *numbers)
{
    const json_t *places = json_object_get(sparse, "indices");
    int64_t count = glb_integer(sparse, "count", -1);
    struct elements indices = {.type = (enum number_type)glb_integer(places, "componentType", -1), .components = 1};
    if (count < 0 || count > numbers->count || !find_elements(glb, places, count, &indices)) return false;
    if (!find_elements(glb, json_object_get(sparse, "values"), count, values)) return false;
    for (int i = 0; i < (int)count; i++) {
        double index = element_at(&indices, i, 0);
        if (!(index >= 0 && index < numbers->count)) return false;
        double *element = numbers->values + (size_t)index * (size_t)numbers->components;
        for (int k = 0; k < numbers->components; k++) element[k] = element_at(values, i, k);
    }
    return true;
}

static int components_of(const json_t *accessor)
{
    static const struct {
        const char *name;
        int components;
    } types[] = {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}};
    const char *type = json_string_value(json_object_get(accessor, "type"));
    for (size_t i = 0; type && i < sizeof types / sizeof *types; i++) {
        if (strcmp(type, types[i].name) == 0) return types[i].components;
    }
    return 0;
}

size_t glb_element(const json_t *accessor, int *type, int *components)
{
    *type = (int)glb_integer(accessor, "componentType", -1);
    *components = components_of(accessor);
    return (size_t)(size_of_type(*type) * *components);
}

/// Reads all numbers; false if some lie outside the file. Without a buffer view (and bytes) all are zero.
static bool fill(const struct glb *glb, const json_t *accessor, struct elements *e, struct glb_numbers *numbers)
{
    const json_t *sparse = json_object_get(accessor, "sparse");
    for (int i = 0; e->bytes && i < numbers->count; i++) {
        for (int k = 0; k < e->components; k++)
            numbers->values[(size_t)i * (size_t)e->components + (size_t)k] = element_at(e, i, k);
    }
    return !sparse || apply_sparse(glb, sparse, e, numbers);
}

static bool all_finite(const struct glb_numbers *numbers)
{
    size_t count = (size_t)numbers->count * (size_t)numbers->components;
    for (size_t i = 0; i < count; i++) {
        if (!isfinite(numbers->values[i])) return false;
    }
    return true;
}

static bool outside(const struct glb *glb, int64_t index, struct error *error)
{
    return fail(error, ERROR_INPUT, "%s: accessors[%lld]: expected data within the file, got a place outside of it",
                glb->path, (long long)index);
}

bool glb_is_stored(const struct glb *glb, int64_t index)
{
    const json_t *accessors = json_object_get(glb->json, "accessors");
    const json_t *accessor = index >= 0 ? json_array_get(accessors, (size_t)index) : NULL;
    return json_object_get(accessor, "bufferView") || json_object_get(accessor, "sparse");
}

bool glb_numbers(const struct glb *glb, int64_t index, struct glb_numbers *numbers, struct error *error)
{
    const json_t *accessors = json_object_get(glb->json, "accessors");
    const json_t *accessor = index >= 0 ? json_array_get(accessors, (size_t)index) : NULL;
    int64_t count = glb_integer(accessor, "count", -1), type = glb_integer(accessor, "componentType", -1);
    struct elements e = {.type = (enum number_type)type,
                         .components = components_of(accessor),
                         .normalised = json_is_true(json_object_get(accessor, "normalized"))};
    *numbers = (struct glb_numbers){.components = e.components};
    if (count < 1 || size_of_type(type) == 0 || e.components == 0)
        return fail(error, ERROR_INPUT, "%s: accessors[%lld]: expected numbers or vectors, got something else",
                    glb->path, (long long)index);
    bool within = !json_object_get(accessor, "bufferView") || find_elements(glb, accessor, count, &e);
    if (!within) return outside(glb, index, error);
    size_t most = glb->room / ((size_t)e.components * sizeof *numbers->values);
    if ((size_t)count > most)
        return fail(error, ERROR_INPUT,
                    "%s: accessors[%lld].count: expected at most %zu for a file of this size, got %lld", glb->path,
                    (long long)index, most, (long long)count);
    numbers->count = (int)count;
    numbers->values = calloc((size_t)count * (size_t)e.components, sizeof *numbers->values);
    if (!numbers->values) return fail_no_memory(error, glb->path);
    bool read = fill(glb, accessor, &e, numbers), finite = read && all_finite(numbers);
    if (finite) return true;
    free(numbers->values);
    numbers->values = NULL;
    if (!read) return outside(glb, index, error);
    return fail(error, ERROR_INPUT, "%s: accessors[%lld]: expected finite numbers, got NaN or infinity", glb->path,
                (long long)index);
}

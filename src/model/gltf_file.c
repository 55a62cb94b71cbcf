/// Assembles glTF files.
#include "model/gltf_file.h"
#include "base/base64.h"
#include "base/npy.h"
#include "model/glb.h"
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { ARRAY_BUFFER = 34962, ELEMENT_ARRAY_BUFFER = 34963 };

static const struct element {
    const char *shape;
    int components;
    enum number_type type;
    int target; ///< 0: none
} kinds[] = {
    [ELEMENTS_INDICES] = {"SCALAR", 1, NUMBER_UINT32, ELEMENT_ARRAY_BUFFER},
    [ELEMENTS_SHORT_INDICES] = {"SCALAR", 1, NUMBER_UINT16, ELEMENT_ARRAY_BUFFER},
    [ELEMENTS_VECTORS] = {"VEC3", 3, NUMBER_FLOAT32, ARRAY_BUFFER},
    [ELEMENTS_UVS] = {"VEC2", 2, NUMBER_FLOAT32, ARRAY_BUFFER},
    [ELEMENTS_JOINTS] = {"VEC4", 4, NUMBER_UINT16, ARRAY_BUFFER},
    [ELEMENTS_WEIGHTS] = {"VEC4", 4, NUMBER_FLOAT32, ARRAY_BUFFER},
    [ELEMENTS_MATRICES] = {"MAT4", 16, NUMBER_FLOAT32, 0},
    [ELEMENTS_KEYS] = {"SCALAR", 1, NUMBER_FLOAT32, 0},
    [ELEMENTS_KEY_VECTORS] = {"VEC3", 3, NUMBER_FLOAT32, 0},
    [ELEMENTS_TURNS] = {"VEC4", 4, NUMBER_FLOAT32, 0},
};

void gltf_file_continue(struct gltf_file *file, json_t *root)
{
    file->views = json_incref(json_object_get(root, "bufferViews"));
    file->accessors = json_incref(json_object_get(root, "accessors"));
}

size_t gltf_file_append(struct gltf_file *file, const void *bytes, size_t size)
{
    const size_t start = file->size, padded = (size + 3) / 4 * 4;
    if (start + padded > file->capacity) {
        const size_t capacity = 2 * (start + padded);
        char *larger = realloc(file->data, capacity);
        if (!larger) {
            file->without_memory = true;
            return start;
        }
        file->data = larger;
        file->capacity = capacity;
    }
    if (size == 0) return start;
    memcpy(file->data + start, bytes, size);
    memset(file->data + start + size, 0, padded - size);
    file->size = start + padded;
    return start;
}

json_int_t gltf_append(struct gltf_file *file, json_t *array, json_t *value)
{
    if (json_array_append_new(array, value) != 0) file->without_memory = true;
    return (json_int_t)json_array_size(array) - 1;
}

void gltf_set(struct gltf_file *file, json_t *object, const char *key, json_t *value)
{
    if (json_object_set_new(object, key, value) != 0) file->without_memory = true;
}

void gltf_append_to(struct gltf_file *file, json_t *object, const char *key, json_t *value)
{
    if (!json_object_get(object, key)) gltf_set(file, object, key, json_array());
    gltf_append(file, json_object_get(object, key), value);
}

void gltf_file_bound(struct gltf_file *file, json_t *accessor, const float *numbers, size_t count, int components)
{
    json_t *low = json_array(), *high = json_array();
    for (int k = 0; k < components; k++) {
        float least = INFINITY, most = -INFINITY;
        for (size_t i = 0; i < count; i++) {
            least = fminf(least, numbers[i * (size_t)components + (size_t)k]);
            most = fmaxf(most, numbers[i * (size_t)components + (size_t)k]);
        }
        gltf_append(file, low, json_real((double)least));
        gltf_append(file, high, json_real((double)most));
    }
    gltf_set(file, accessor, "min", low);
    gltf_set(file, accessor, "max", high);
}

/// Pads the bytes to a multiple of four.
static json_int_t add_view(struct gltf_file *file, const void *data, size_t size, int target)
{
    if (!file->views) file->views = json_array();
    json_t *view = json_pack("{s:I, s:I, s:I}", "buffer", file->buffer, "byteOffset", (json_int_t)file->size,
                             "byteLength", (json_int_t)size);
    if (target) gltf_set(file, view, "target", json_integer(target));
    gltf_file_append(file, data, size);
    return gltf_append(file, file->views, view);
}

json_int_t gltf_file_add_bytes(struct gltf_file *file, const void *data, size_t size)
{
    return add_view(file, data, size, 0);
}

json_int_t gltf_file_add(struct gltf_file *file, enum gltf_elements elements, const void *data, size_t count,
                         bool bounds)
{
    const struct element *kind = &kinds[elements];
    if (!file->accessors) file->accessors = json_array();
    const json_int_t view =
        add_view(file, data, count * (size_t)(kind->components * number_size(kind->type)), kind->target);
    json_t *accessor = json_pack("{s:I, s:i, s:I, s:s}", "bufferView", view, "componentType", kind->type, "count",
                                 (json_int_t)count, "type", kind->shape);
    if (bounds) gltf_file_bound(file, accessor, data, count, kind->components);
    return gltf_append(file, file->accessors, accessor);
}

static void write_words(FILE *out, uint32_t a, uint32_t b)
{
    const uint32_t words[2] = {a, b};
    fwrite(words, sizeof words, 1, out);
}

static void write_binary(const struct gltf_file *file, const char *text, FILE *out)
{
    const size_t length = strlen(text), padded = (length + 3) / 4 * 4, chunk = file->size > 0 ? 8 + file->size : 0;
    const uint32_t total = (uint32_t)(12 + 8 + padded + chunk);
    write_words(out, GLB_MAGIC, 2);
    fwrite(&total, sizeof total, 1, out);
    write_words(out, (uint32_t)padded, GLB_JSON);
    fprintf(out, "%s%*s", text, (int)(padded - length), "");
    if (chunk == 0) return;
    write_words(out, (uint32_t)file->size, GLB_BIN);
    fwrite(file->data, 1, file->size, out);
}

/// The bytes as a data URI; the caller frees it. NULL if memory is short.
static char *address_of(const struct gltf_file *file)
{
    static const char start[] = "data:application/octet-stream;base64,";
    char *text = malloc(sizeof start + base64_length(file->size));
    if (text) base64_encode(file->data, file->size, stpcpy(text, start));
    return text;
}

/// Describes the buffer of the bytes; it must outlive other members.
static void complete(struct gltf_file *file, json_t *root, bool binary)
{
    json_t *buffers = json_object_get(root, "buffers");
    if (file->size > 0) {
        if (json_array_size(buffers) <= (size_t)file->buffer) gltf_append_to(file, root, "buffers", json_object());
        json_t *buffer = json_array_get(json_object_get(root, "buffers"), (size_t)file->buffer);
        char *address = binary ? NULL : address_of(file);
        gltf_set(file, buffer, "byteLength", json_integer((json_int_t)file->size));
        if (!binary) gltf_set(file, buffer, "uri", address ? json_string(address) : NULL);
        free(address);
    }
    if (json_array_size(file->views) > 0) gltf_set(file, root, "bufferViews", json_incref(file->views));
    if (json_array_size(file->accessors) > 0) gltf_set(file, root, "accessors", json_incref(file->accessors));
}

bool gltf_file_write(struct gltf_file *file, json_t *root, bool binary, FILE *out, struct error *error)
{
    char *text = NULL;
    const bool fits = file->size < UINT32_MAX / 2;
    if (root && fits) complete(file, root, binary);
    if (root && fits && !file->without_memory)
        text = json_dumps(root, (binary ? JSON_COMPACT : JSON_INDENT(1)) | JSON_REAL_PRECISION(17));
    json_decref(root);
    if (!text) {
        return fail(error, ERROR_ENVIRONMENT,
                    fits ? "not enough memory, or a name is not UTF-8"
                         : "a glTF file holds at most 2 GB: choose fewer keys or frames");
    }
    if (binary) {
        write_binary(file, text, out);
    } else {
        fputs(text, out);
        fputc('\n', out);
    }
    free(text);
    return true;
}

void gltf_file_free(struct gltf_file *file)
{
    json_decref(file->views);
    json_decref(file->accessors);
    free(file->data);
    *file = (struct gltf_file){0};
}

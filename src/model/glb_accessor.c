/// Numbers from the accessors of a glTF file.
#include "model/glb.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/// Elements in the binary chunk: each `components` numbers of one type, `stride` bytes apart.
struct elements {
    const unsigned char *bytes;
    int type, components;
    size_t stride;
    bool normalised;
};

static size_t size_of_type(int64_t type)
{
    switch (type) {
    case 5120: // byte
    case 5121: // unsigned byte
        return 1;
    case 5122: // short
    case 5123: // unsigned short
        return 2;
    case GLB_UNSIGNED_INT:
    case GLB_FLOAT:
        return 4;
    default:
        return 0;
    }
}

static double number_at(const struct elements *e, int element, int component)
{
    const unsigned char *at = e->bytes + (size_t)element * e->stride + (size_t)component * size_of_type(e->type);
    float single;
    uint32_t word;
    uint16_t half = 0;
    if (e->type != 5120 && e->type != 5121) memcpy(&half, at, sizeof half);
    switch (e->type) {
    case 5120:
        return e->normalised ? fmax((int8_t)*at / 127.0, -1) : (int8_t)*at;
    case 5121:
        return e->normalised ? *at / 255.0 : *at;
    case 5122:
        return e->normalised ? fmax((int16_t)half / 32767.0, -1) : (int16_t)half;
    case 5123:
        return e->normalised ? half / 65535.0 : half;
    case GLB_UNSIGNED_INT:
        memcpy(&word, at, sizeof word);
        return word;
    default:
        memcpy(&single, at, sizeof single);
        return (double)single;
    }
}

static const json_t *view_of(const struct glb *glb, int64_t index)
{
    return index >= 0 ? json_array_get(json_object_get(glb->json, "bufferViews"), (size_t)index) : NULL;
}

bool glb_view(const struct glb *glb, int64_t index, struct glb_bytes *bytes)
{
    const json_t *view = view_of(glb, index);
    int64_t buffer = glb_integer(view, "buffer", 0);
    int64_t start = glb_integer(view, "byteOffset", 0), length = glb_integer(view, "byteLength", -1);
    if (start < 0 || length < 0 || buffer < 0 || buffer >= glb->buffer_count) return false;
    const struct glb_bytes *whole = &glb->buffers[buffer].bytes;
    if (!whole->at || start + length > (int64_t)whole->size) return false;
    *bytes = (struct glb_bytes){whole->at + start, (size_t)length};
    return true;
}

/// Finds `count` elements in the buffer view named by `place`, and checks that they lie within it.
static bool find_elements(const struct glb *glb, const json_t *place, int64_t count, struct elements *e)
{
    struct glb_bytes view;
    int64_t index = glb_integer(place, "bufferView", -1), at = glb_integer(place, "byteOffset", 0);
    int64_t element = (int64_t)size_of_type(e->type) * e->components;
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
    struct elements indices = {.type = (int)glb_integer(places, "componentType", -1), .components = 1};
    if (count < 0 || count > numbers->count || !find_elements(glb, places, count, &indices)) return false;
    if (!find_elements(glb, json_object_get(sparse, "values"), count, values)) return false;
    for (int i = 0; i < (int)count; i++) {
        double index = number_at(&indices, i, 0);
        if (!(index >= 0 && index < numbers->count)) return false;
        double *element = numbers->values + (size_t)index * (size_t)numbers->components;
        for (int k = 0; k < numbers->components; k++) element[k] = number_at(values, i, k);
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

/// Reads all numbers; false if some lie outside the file. Without a buffer view (and bytes) all are zero.
static bool fill(const struct glb *glb, const json_t *accessor, struct elements *e, struct glb_numbers *numbers)
{
    const json_t *sparse = json_object_get(accessor, "sparse");
    for (int i = 0; e->bytes && i < numbers->count; i++) {
        for (int k = 0; k < e->components; k++)
            numbers->values[(size_t)i * (size_t)e->components + (size_t)k] = number_at(e, i, k);
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
    struct elements e = {.type = (int)type,
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

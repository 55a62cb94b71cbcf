/// Numbers from the accessors of a glTF file.
#include "base/npy.h"
#include "model/glb.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/// Elements in the binary chunk: each `components` numbers of one type, `stride` bytes apart.
struct elements {
    const unsigned char *bytes;
    enum number_type type;
    int components;
    size_t stride;
    bool normalised;
};

/// 0 for what is no type of glTF's.
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

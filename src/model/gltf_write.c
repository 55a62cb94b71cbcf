/// Assembles glTF files: accessors and their bytes, meshes, materials and pictures.
#include "model/gltf_write.h"
#include "base/file.h"
#include "base/json.h"
#include "base/need.h"
#include "base/npy.h"
#include "model/adjacency.h"
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

json_int_t gltf_append_to(struct gltf_file *file, json_t *object, const char *key, json_t *value)
{
    if (!json_object_get(object, key)) gltf_set(file, object, key, json_array());
    return gltf_append(file, json_object_get(object, key), value);
}

json_t *gltf_numbers(struct gltf_file *file, const float *numbers, int count)
{
    json_t *array = json_array();
    for (int k = 0; k < count; k++) gltf_append(file, array, json_real((double)numbers[k]));
    return array;
}

void gltf_file_bound(struct gltf_file *file, json_t *accessor, const float *numbers, size_t count, int components)
{
    float least[16], most[16];
    for (int k = 0; k < components; k++) {
        least[k] = INFINITY, most[k] = -INFINITY;
        for (size_t i = 0; i < count; i++) {
            least[k] = fminf(least[k], numbers[i * (size_t)components + (size_t)k]);
            most[k] = fmaxf(most[k], numbers[i * (size_t)components + (size_t)k]);
        }
    }
    gltf_set(file, accessor, "min", gltf_numbers(file, least, components));
    gltf_set(file, accessor, "max", gltf_numbers(file, most, components));
}

/// Pads the bytes to a multiple of four.
static json_int_t add_view(struct gltf_file *file, const void *data, size_t size, int target)
{
    json_t *view = json_pack("{s:I, s:I, s:I}", "buffer", file->buffer, "byteOffset", (json_int_t)file->size,
                             "byteLength", (json_int_t)size);
    if (target) gltf_set(file, view, "target", json_integer(target));
    gltf_file_append(file, data, size);
    return gltf_append_to(file, file->root, "bufferViews", view);
}

json_int_t gltf_file_add_bytes(struct gltf_file *file, const void *data, size_t size)
{
    return add_view(file, data, size, 0);
}

json_int_t gltf_file_add(struct gltf_file *file, enum gltf_elements elements, const void *data, size_t count,
                         bool bounds)
{
    const struct element *kind = &kinds[elements];
    const json_int_t view =
        add_view(file, data, count * (size_t)(kind->components * number_size(kind->type)), kind->target);
    json_t *accessor = json_pack("{s:I, s:i, s:I, s:s}", "bufferView", view, "componentType", kind->type, "count",
                                 (json_int_t)count, "type", kind->shape);
    if (bounds) gltf_file_bound(file, accessor, data, count, kind->components);
    return gltf_append_to(file, file->root, "accessors", accessor);
}

static void write_words(FILE *out, uint32_t a, uint32_t b)
{
    const uint32_t words[2] = {a, b};
    fwrite(words, sizeof words, 1, out);
}

bool gltf_file_write(struct gltf_file *file, bool binary, FILE *out, struct error *error)
{
    if (file->size >= UINT32_MAX / 2)
        return fail(error, ERROR_ENVIRONMENT, "a glTF file holds at most 2 GB: choose fewer keys or frames");
    if (file->size > 0) { // describe the buffer of the bytes
        if (json_array_size(json_object_get(file->root, "buffers")) <= (size_t)file->buffer)
            gltf_append_to(file, file->root, "buffers", json_object());
        json_t *buffer = json_array_get(json_object_get(file->root, "buffers"), (size_t)file->buffer);
        gltf_set(file, buffer, "byteLength", json_integer((json_int_t)file->size));
        if (!binary) {
            static const char start[] = "data:application/octet-stream;base64,";
            char *address = malloc(sizeof start + base64_length(file->size));
            if (address) base64_encode(file->data, file->size, stpcpy(address, start));
            gltf_set(file, buffer, "uri", address ? json_string(address) : NULL);
            free(address);
        }
    }
    char *text = file->without_memory
                     ? NULL
                     : json_dumps(file->root, (binary ? JSON_COMPACT : JSON_INDENT(1)) | JSON_REAL_PRECISION(17));
    if (!text) return fail(error, ERROR_ENVIRONMENT, "not enough memory, or a name is not UTF-8");
    if (binary) {
        const size_t length = strlen(text), padded = (length + 3) / 4 * 4,
                     chunk = file->size > 0 ? 8 + file->size : 0;
        const uint32_t total = (uint32_t)(12 + 8 + padded + chunk);
        write_words(out, GLB_MAGIC, 2);
        fwrite(&total, sizeof total, 1, out);
        write_words(out, (uint32_t)padded, GLB_JSON);
        fprintf(out, "%s%*s", text, (int)(padded - length), "");
        if (chunk > 0) {
            write_words(out, (uint32_t)file->size, GLB_BIN);
            fwrite(file->data, 1, file->size, out);
        }
    } else {
        fputs(text, out);
        fputc('\n', out);
    }
    free(text);
    return true;
}

bool gltf_file_save(struct gltf_file *file, const char *path, struct error *error)
{
    struct file_output out;
    struct error why;
    if (!file_output_open(&out, path, error)) return false;
    if (gltf_file_write(file, true, out.stream, &why)) return file_output_commit(&out, error);
    file_output_discard(&out);
    return fail(error, why.kind, "%s: %s", path, why.text);
}

void gltf_file_free(struct gltf_file *file)
{
    json_decref(file->root);
    free(file->data);
    free(file->pictures);
    *file = (struct gltf_file){0};
}

// --- all bytes in one buffer without an address

/// Lets a view, or an extension of one, find its bytes again. False if memory is short.
static bool move_view(json_t *view, const size_t *starts, size_t count)
{
    const int64_t buffer = glb_integer(view, "buffer", -1), offset = glb_integer(view, "byteOffset", 0);
    if (buffer < 0 || (size_t)buffer >= count || offset < 0) return true;
    return json_object_set_new(view, "buffer", json_integer(0)) == 0 &&
           (starts[buffer] == 0 ||
            json_object_set_new(view, "byteOffset", json_integer(offset + (json_int_t)starts[buffer])) == 0);
}

bool gltf_file_gather(struct gltf_file *file, struct error *error)
{
    struct glb *const source = file->source;
    json_t *view, *extension, *image;
    size_t i;
    file->root = json_incref(source->json);
    const size_t count = json_array_size(json_object_get(source->json, "buffers"));
    size_t *starts = calloc(count + 1, sizeof *starts);
    bool done = starts;
    for (size_t b = 0; done && b < count; b++) { // all there is: views may reach beyond the byteLength
        const struct glb_bytes bytes = source->buffers[b].bytes;
        starts[b] = gltf_file_append(file, bytes.at, bytes.size);
    }
    json_array_foreach(json_object_get(file->root, "bufferViews"), i, view)
    {
        const char *name;
        done = done && move_view(view, starts, count);
        json_object_foreach(json_object_get(view, "extensions"), name, extension) done =
            done && move_view(extension, starts, count);
    }
    if (file->size > 0) json_object_del(source->json, "buffers");
    free(starts);

    json_array_foreach(json_object_get(source->json, "images"), i, image)
    {
        const char *uri = json_string_value(json_object_get(image, "uri"));
        struct glb_buffer picture;
        struct error why = {0};
        if (!done || !uri) continue;
        if (!glb_read_uri(source, uri, &picture, &why)) { // it keeps its address
            done = why.kind != ERROR_ENVIRONMENT;
            continue;
        }
        const struct glb_bytes bytes = picture.bytes;
        const char *kind = looks_image_kind(bytes.at, bytes.size);
        if (bytes.size >= 7 && memcmp(bytes.at, "\xABKTX 20", 7) == 0) kind = "ktx2";
        if (bytes.size >= 12 && memcmp(bytes.at, "RIFF", 4) == 0 && memcmp(bytes.at + 8, "WEBP", 4) == 0)
            kind = "webp";
        if (kind) {
            const json_int_t own = gltf_file_add_bytes(file, picture.bytes.at, picture.bytes.size);
            gltf_set(file, image, "bufferView", json_integer(own));
            gltf_set(file, image, "mimeType", json_sprintf("image/%s", kind));
            json_object_del(image, "uri");
        }
        free(picture.owned);
    }
    return done || fail_no_memory(error, source->path);
}

struct gltf_picture {
    const unsigned char *bytes;
    size_t size;
};

// --- materials

static json_int_t add_material(struct gltf_file *file, const struct looks_material *material, bool is_open)
{
    const float *c = material->color;
    const char *kind = material->image ? looks_image_kind(material->image, material->image_size) : NULL;
    json_t *base = json_pack("{s:f, s:f}", "metallicFactor", 0.0, "roughnessFactor", 0.8);
    if (c[0] != 1 || c[1] != 1 || c[2] != 1 || c[3] != 1)
        gltf_set(file, base, "baseColorFactor",
                 json_pack("[f, f, f, f]", (double)c[0], (double)c[1], (double)c[2], (double)c[3]));
    if (kind) {
        const size_t count = json_array_size(json_object_get(file->root, "textures"));
        size_t t = 0; // the texture of a picture is made if it is new
        while (t < count && (file->pictures[t].size != material->image_size ||
                             memcmp(file->pictures[t].bytes, material->image, material->image_size) != 0))
            t++;
        if (t == count) {
            file->pictures = need_more(file->pictures, count + 1, sizeof *file->pictures);
            file->pictures[count] = (struct gltf_picture){material->image, material->image_size};
            const json_int_t view = gltf_file_add_bytes(file, material->image, material->image_size);
            const json_int_t image = gltf_append_to(file, file->root, "images",
                                                    json_pack("{s:s, s:I, s:o}", "name", material->name, "bufferView",
                                                              view, "mimeType", json_sprintf("image/%s", kind)));
            t = (size_t)gltf_append_to(file, file->root, "textures", json_pack("{s:I}", "source", image));
        }
        gltf_set(file, base, "baseColorTexture", json_pack("{s:I}", "index", (json_int_t)t));
    }
    json_t *json = json_pack("{s:s, s:o}", "name", material->name, "pbrMetallicRoughness", base);
    if (c[3] < 1) gltf_set(file, json, "alphaMode", json_string("BLEND"));
    if (is_open) gltf_set(file, json, "doubleSided", json_true());
    return gltf_append_to(file, file->root, "materials", json);
}

// --- triangles

/// Whether the back of a shape can be seen, as a flag's: a triangle has none across an edge.
static bool can_see_inside(const struct gltf_shape *shape)
{
    const size_t count = (size_t)shape->index_count;
    uint32_t *corners = need(count + 1, sizeof *corners), most = 0;
    int *across = need(count + 1, sizeof *across);
    bool open = false;
    for (size_t i = 0; i < count; i++) {
        corners[i] = shape->source ? shape->source[shape->indices[i]] : shape->indices[i];
        most = corners[i] > most ? corners[i] : most;
    }
    neighbours_find(shape->position, (int)most + 1, corners, shape->index_count, across);
    for (size_t i = 0; i < count; i++) open = open || across[i] == NEIGHBOUR_NONE;
    free(corners);
    free(across);
    return open;
}

/// A primitive per material of the triangles, and one for triangles without.
static json_t *make_primitives(struct gltf_file *file, const struct gltf_shape *shape, json_t *attributes,
                               json_t *targets)
{
    const struct looks *looks = shape->looks;
    const uint32_t materials = looks ? (uint32_t)looks->material_count : 0;
    uint32_t *corners = need((size_t)shape->index_count, sizeof *corners);
    const bool is_open = can_see_inside(shape);
    json_t *primitives = json_array();
    for (uint32_t m = 0; m <= materials; m++) {
        // Its corners. Successive polygons begin at different ones, so that readers can tell them apart.
        const bool polygons = looks && looks->joined;
        const size_t triangles = (size_t)shape->index_count / 3;
        size_t count = 0, end;
        for (size_t t = 0; t < triangles; t = end) {
            const uint32_t *fan = shape->indices + 3 * t;
            const uint32_t own = looks && looks->material ? looks->material[t] : LOOKS_NONE;
            end = t + 1;
            while (polygons && end < triangles && looks->joined[end] &&
                   (!looks->material || looks->material[end] == own))
                end++;
            if ((own < materials ? own : materials) != m) continue;
            const bool same = polygons && count > 0 && corners[count - 3] == fan[0];
            for (size_t n = 0; n < end - t; n++) { // every triangle begins with the first corner, or with the second
                const size_t places[3] = {same, same + n + 1, same + n + 2};
                for (int k = 0; k < 3; k++) { // corners of the fan: the first triangle's, then the last of each other
                    const size_t place = places[k] % (end - t + 2);
                    corners[count++] = place < 3 ? fan[place] : fan[3 * (place - 2) + 2];
                }
            }
        }
        if (count == 0) continue;
        const json_int_t indices = gltf_file_add(file, ELEMENTS_INDICES, corners, count, false);
        json_int_t material;
        if (m < materials) {
            material = add_material(file, &looks->materials[m], is_open);
        } else {
            char name[] = "skin";
            const struct looks_material skin = {.name = name, .color = {1, 1, 1, 1}};
            json_int_t *plain = &file->plain[is_open];
            if (*plain == 0) *plain = add_material(file, &skin, is_open) + 1;
            material = *plain - 1;
        }
        json_t *primitive =
            json_pack("{s:O, s:I, s:I}", "attributes", attributes, "indices", indices, "material", material);
        if (json_array_size(targets) > 0) gltf_set(file, primitive, "targets", json_incref(targets));
        if (looks && looks->joined) {
            gltf_set(file, primitive, "extensions", json_pack("{s:{}}", GLTF_POLYGONS));
            gltf_set(file, file->root, "extensionsUsed", json_pack("[s]", GLTF_POLYGONS));
        }
        gltf_append(file, primitives, primitive);
    }
    free(corners);
    return primitives;
}

// --- coordinates

/// What the extras of a mesh say of a coordinate whose targets are scaled up.
static json_t *coordinate_json(struct gltf_file *file, const struct coordinate *c, double scale)
{
    json_t *known = json_pack("{s:s, s:f, s:f, s:f, s:f, s:f}", "name", c->name, "frequency", c->frequency, "damping",
                              c->damping, "explained", c->explained, "pca1", c->pca1, "pca2", c->pca2);
    if (c->bone) {
        gltf_set(file, known, "base", json_pack("[f, f, f]", c->base[0], c->base[1], c->base[2]));
        gltf_set(file, known, "at", json_pack("[f, f, f]", c->at[0], c->at[1], c->at[2]));
        gltf_set(file, known, "bone", json_string(c->bone));
    }
    if (scale != 1) gltf_set(file, known, "scale", json_real(scale));
    if (c->sq && isfinite(c->most)) gltf_set(file, known, "most", json_real(c->most));
    return known;
}

// --- the morph targets of a mesh that the file has

bool gltf_file_numbers(const struct gltf_file *file, int64_t accessor, struct pool *pool, struct glb_numbers *numbers,
                       struct error *error)
{
    const struct glb *source = file->source;
    struct glb now = *source;
    if (now.buffer_count <= file->buffer) now.buffer_count = (int)file->buffer + 1;
    now.buffers = need_zeroed((size_t)now.buffer_count, sizeof *now.buffers);
    memcpy(now.buffers, source->buffers, (size_t)source->buffer_count * sizeof *now.buffers);
    now.buffers[file->buffer].bytes = (struct glb_bytes){(unsigned char *)file->data, file->size};
    now.room += GLB_GROWTH * file->size;
    const bool done = glb_numbers(&now, accessor, pool, numbers, error);
    free(now.buffers);
    return done;
}

bool gltf_find_weights(struct gltf_retargeting *r, struct error *error)
{
    const json_t *root = r->file->root, *nodes = json_object_get(root, "nodes"), *clip, *channel;
    size_t c, i;
    json_array_foreach(json_object_get(root, "animations"), c, clip)
    {
        json_array_foreach(json_object_get(clip, "channels"), i, channel)
        {
            struct glb_numbers numbers;
            const json_t *target = json_object_get(channel, "target");
            const char *path = json_string_value(json_object_get(target, "path"));
            const json_t *node = json_array_get(nodes, (size_t)glb_integer(target, "node", -1));
            json_t *sampler =
                json_array_get(json_object_get(clip, "samplers"), (size_t)glb_integer(channel, "sampler", -1));
            bool known = !sampler || !path || strcmp(path, "weights") != 0 || r->before == 0 ||
                         glb_integer(node, "mesh", -1) != r->mesh;
            for (int n = 0; n < r->clip_count; n++) known |= r->clips[n].sampler == sampler;
            if (known) continue;
            if (!gltf_file_numbers(r->file, glb_integer(sampler, "output", -1), r->pool, &numbers, error))
                return false;
            const char *how = json_string_value(json_object_get(sampler, "interpolation"));
            r->clips = need_more(r->clips, (size_t)r->clip_count + 1, sizeof *r->clips);
            r->clips[r->clip_count++] = (struct gltf_weights){.values = numbers.values,
                                                              .rows = numbers.count * numbers.components / r->before,
                                                              .stride = r->before,
                                                              .is_cubic = how && strcmp(how, "CUBICSPLINE") == 0,
                                                              .sampler = sampler};
        }
    }
    return true;
}

float *gltf_convert_weights(const struct gltf_retargeting *r, const struct gltf_weights *weights)
{
    float *values = pool_take(r->pool, (size_t)r->count * (size_t)weights->rows, sizeof *values), *to = values;
    for (int row = 0; row < weights->rows; row++) {
        for (int t = 0; t < r->count; t++) {
            const struct gltf_retarget *target = &r->list[t];
            const float *from = weights->values + (size_t)row * (size_t)weights->stride + target->source;
            const float weight = target->source < r->before ? *from / target->scale : 0;
            *to++ = r->clamped ? fminf(fmaxf(weight, 0), 1) : weight;
        }
    }
    return values;
}

/// An attribute of a target: `scale` times vectors.
static void add_offsets(const struct gltf_retargeting *r, json_t *target, const char *name, const float *from,
                        size_t count, float scale)
{
    float *scaled = need(3 * count, sizeof *scaled);
    for (size_t n = 0; n < 3 * count; n++) scaled[n] = scale * from[n];
    const bool bounds = strcmp(name, "POSITION") == 0;
    gltf_set(r->file, target, name, json_integer(gltf_file_add(r->file, ELEMENTS_VECTORS, scaled, count, bounds)));
    free(scaled);
}

/// A target of a primitive; `part`: how that was read, or NULL; `kept`: the target that it has, or NULL.
static json_t *make_target(const struct gltf_retargeting *r, const struct gltf_retarget *wanted,
                           const struct gltf_part *part, json_t *kept, size_t vertices)
{
    const bool is_new = part && wanted->is_new;
    json_t *own = kept && !is_new ? json_copy(kept) : json_object(), *accessor;
    const char *name;
    if (is_new) {
        add_offsets(r, own, "POSITION", *part->targets[wanted->source].position, vertices, wanted->scale);
    } else if (!kept) { // an accessor without bytes is all zeros
        static const float zero[3];
        accessor = json_pack("{s:i, s:I, s:s}", "componentType", NUMBER_FLOAT32, "count", (json_int_t)vertices,
                             "type", "VEC3");
        gltf_file_bound(r->file, accessor, zero, 1, 3);
        gltf_set(r->file, own, "POSITION",
                 json_integer(gltf_append_to(r->file, r->file->root, "accessors", accessor)));
    }
    json_object_foreach(is_new || wanted->scale == 1 ? NULL : kept, name, accessor)
    {
        struct glb_numbers numbers;
        struct error error = {0};
        const bool is_read = json_is_integer(accessor) &&
                             gltf_file_numbers(r->file, json_integer_value(accessor), r->pool, &numbers, &error);
        r->file->without_memory |= error.kind == ERROR_ENVIRONMENT;
        if (is_read && numbers.components == 3)
            add_offsets(r, own, name, numbers.values, (size_t)numbers.count, wanted->scale);
    }
    return own;
}

/// Converts the weights at rest that a mesh or node has.
static void put_weights(const struct gltf_retargeting *r, json_t *object)
{
    float *values = pool_take(r->pool, (size_t)r->before + 1, sizeof *values);
    for (int t = 0; t < r->before; t++)
        values[t] = (float)json_number_value(json_array_get(json_object_get(object, "weights"), (size_t)t));
    const float *converted = gltf_convert_weights(r, &(struct gltf_weights){.values = values, .rows = 1});
    gltf_set(r->file, object, "weights", gltf_numbers(r->file, converted, r->count));
}

void gltf_retarget(const struct gltf_retargeting *r, const struct gltf_mesh *mesh)
{
    struct gltf_file *file = r->file;
    json_t *json = json_array_get(json_object_get(r->file->root, "meshes"), (size_t)r->mesh);
    json_t *primitive, *first = NULL, *node, *names = json_array();
    size_t p;
    int shown = 0;
    json_array_foreach(json_object_get(json, "primitives"), p, primitive)
    {
        const bool shows = shown < mesh->part_count && mesh->parts[shown].primitive == (int)p;
        const struct gltf_part *part = shows ? &mesh->parts[shown++] : NULL;
        const int64_t position = glb_integer(json_object_get(primitive, "attributes"), "POSITION", -1);
        const size_t vertices = (size_t)glb_integer(
            json_array_get(json_object_get(file->root, "accessors"), (size_t)position), "count", 1);
        const json_t *had = json_object_get(primitive, "targets");
        json_t *list =
            part && part->shared ? json_deep_copy(first) : json_array(); // readers see that they are the same
        for (int t = (int)json_array_size(list); t < r->count; t++) {
            json_t *kept = json_array_get(had, (size_t)r->list[t].source);
            gltf_append(file, list, make_target(r, &r->list[t], part, kept, vertices));
        }
        gltf_set(file, primitive, "targets", list);
        if (part && !first) first = list;
    }

    json_t *extras = json_object_get(json, "extras");
    if (!json_is_object(extras)) gltf_set(file, json, "extras", extras = json_object());
    for (int t = 0; t < r->count; t++) gltf_append(file, names, json_string(r->list[t].name));
    gltf_set(file, extras, "targetNames", names);
    put_weights(r, json);
    json_array_foreach(json_object_get(r->file->root, "nodes"), p, node)
    {
        if (glb_integer(node, "mesh", -1) == r->mesh && json_object_get(node, "weights")) put_weights(r, node);
    }
    for (int c = 0; c < r->clip_count; c++) {
        const struct gltf_weights *clip = &r->clips[c];
        const size_t count = (size_t)clip->rows * (size_t)r->count;
        gltf_set(file, clip->sampler, "output",
                 json_integer(gltf_file_add(file, ELEMENTS_KEYS, gltf_convert_weights(r, clip), count, false)));
    }
}

bool coordinates_write(const char *path, const struct gltf *gltf, int mesh, const struct coordinate *coordinates,
                       int count, struct error *error)
{
    struct gltf_mesh wide = gltf->meshes[mesh];
    struct pool pool = {0};
    struct glb source;
    struct gltf_file file = {.source = &source};
    struct gltf_retargeting r = {.file = &file, .pool = &pool, .mesh = mesh, .before = wide.target_count};
    if (!glb_open(&source, gltf->path, error)) return false;
    r.count = r.before + 2 * count;
    r.list = pool_take(&pool, (size_t)r.count, sizeof *r.list);
    for (int t = 0; t < r.before; t++)
        r.list[t] = (struct gltf_retarget){.source = t, .scale = 1, .name = gltf_target_label(&wide, t, r.pool)};
    for (int n = 0; n < 2 * count; n++) {
        const struct coordinate *of = &coordinates[n / 2];
        const char *name = pool_text(&pool, of->name, coordinate_endings[n % 2], "");
        r.list[r.before + n] = (struct gltf_retarget){r.before + n, (float)coordinate_sign(n % 2), name, true};
    }
    wide.parts = pool_take(&pool, (size_t)wide.part_count, sizeof *wide.parts);
    for (int p = 0, row = 0; p < wide.part_count; row += wide.parts[p++].vertex_count) {
        wide.parts[p] = gltf->meshes[mesh].parts[p];
        wide.parts[p].targets = pool_take(&pool, (size_t)r.count, sizeof *wide.parts[p].targets);
        for (int n = 0; n < 2 * count; n++)
            wide.parts[p].targets[r.before + n].position = coordinates[n / 2].parts[n % 2] + row;
    }
    bool done = glb_read_buffers(&source, error) && gltf_file_gather(&file, error) && gltf_find_weights(&r, error);
    if (done) {
        gltf_retarget(&r, &wide);
        json_t *extras =
            json_object_get(json_array_get(json_object_get(file.root, "meshes"), (size_t)mesh), "extras");
        json_t *known = json_object_get(extras, "wiggly");
        if (!json_is_object(known)) gltf_set(&file, extras, "wiggly", known = json_object());
        for (int k = 0; k < count; k++)
            gltf_append_to(&file, known, "coordinates", coordinate_json(&file, &coordinates[k], 1));
        done = gltf_file_save(&file, path, error);
    }
    free(r.clips);
    pool_free(&pool);
    gltf_file_free(&file);
    glb_close(&source);
    return done;
}

// --- vertices

/// A copy of vectors for the file's vertices, times `scale`, within [lowest, highest].
static json_int_t add_vectors(struct gltf_file *file, const struct gltf_shape *shape, const float (*vectors)[3],
                              float scale, const float range[2], bool bounds)
{
    const size_t count = (size_t)shape->vertex_count;
    float(*copy)[3] = need(count, sizeof *copy);
    for (size_t i = 0; i < count; i++) {
        const float *vector = vectors[shape->source ? shape->source[i] : i];
        for (int k = 0; k < 3; k++) copy[i][k] = fminf(fmaxf(scale * vector[k], range[0]), range[1]);
    }
    const json_int_t accessor = gltf_file_add(file, ELEMENTS_VECTORS, copy, count, bounds);
    free(copy);
    return accessor;
}

static void add_attribute(struct gltf_file *file, json_t *attributes, const char *name, enum gltf_elements elements,
                          const void *data, int count)
{
    if (!data) return;
    gltf_set(file, attributes, name, json_integer(gltf_file_add(file, elements, data, (size_t)count, false)));
}

json_t *gltf_shape_json(struct gltf_file *file, const struct gltf_shape *shape)
{
    static const float any[2] = {-INFINITY, INFINITY}, unit[2] = {-1, 1}, share[2] = {0, 1};
    const json_int_t position = add_vectors(file, shape, shape->position, 1, any, true);
    const json_int_t normal = add_vectors(file, shape, shape->normal, 1, unit, false);
    json_t *attributes = json_pack("{s:I, s:I}", "POSITION", position, "NORMAL", normal), *targets = json_array();
    bool has_colors = false;
    for (int n = 0; n < 3 * shape->vertex_count && !has_colors; n++)
        has_colors = shape->color[shape->source ? shape->source[n / 3] : (size_t)(n / 3)][n % 3] != 1;
    if (has_colors)
        gltf_set(file, attributes, "COLOR_0", json_integer(add_vectors(file, shape, shape->color, 1, share, false)));
    add_attribute(file, attributes, "TEXCOORD_0", ELEMENTS_UVS, shape->uv, shape->vertex_count);
    add_attribute(file, attributes, "JOINTS_0", ELEMENTS_JOINTS, shape->joints, shape->vertex_count);
    add_attribute(file, attributes, "WEIGHTS_0", ELEMENTS_WEIGHTS, shape->weights, shape->vertex_count);
    for (int t = 0; t < shape->target_count; t++) {
        const struct figure_target *target = &shape->targets[t];
        json_t *json =
            json_pack("{s:I}", "POSITION", add_vectors(file, shape, target->position, target->scale, any, true));
        if (target->normal)
            gltf_set(file, json, "NORMAL",
                     json_integer(add_vectors(file, shape, target->normal, target->turn, any, false)));
        gltf_append(file, targets, json);
    }
    json_t *mesh =
        json_pack("{s:s, s:o}", "name", shape->name, "primitives", make_primitives(file, shape, attributes, targets));
    for (int t = 0; t < shape->target_count; t++) gltf_append_to(file, mesh, "weights", json_integer(0));
    if (shape->target_count > 0) { // the extras that character_read() reads
        json_t *names = json_array(), *coordinates = json_array();
        for (int t = 0; t < shape->target_count; t++) gltf_append(file, names, json_string(shape->targets[t].name));
        for (int i = 0, first = 0; i < shape->coordinate_count; i++) {
            const struct coordinate *c = shape->coordinates[i];
            gltf_append(file, coordinates, coordinate_json(file, c, (double)shape->targets[first].scale));
            first += coordinate_parts(c);
        }
        gltf_set(file, mesh, "extras",
                 json_pack("{s:o, s:{s:o}}", "targetNames", names, "wiggly", "coordinates", coordinates));
    }
    json_decref(attributes);
    json_decref(targets);
    return mesh;
}

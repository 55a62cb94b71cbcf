/// Opens .glb and .gltf files with their external files and data URIs, decompresses their meshes, and reads accessors.
#include "model/glb.h"
#include "base/file.h"
#include "base/json.h"
#include "base/npy.h"
#include "base/progress.h"
#include "model/draco.h"
#include "model/gltf_write.h"
#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#ifdef WITH_MESHOPT
#include <meshoptimizer.h>
#endif

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

bool glb_open_bytes(struct glb *glb, const char *path, char *data, size_t size, struct error *error)
{
    *glb = (struct glb){.path = path, .data = data, .room = GLB_ROOM + GLB_GROWTH * size};
    progress_report("reading a glTF file", 0, (long)size);
    const char *text = data;
    size_t length = size;
    bool good =
        !path_has_end(path, ".fbx") ||
        fail(error, ERROR_INPUT,
             "%s: expected glTF, got FBX: export it from Blender as glTF, or run tools/from-fbx.sh on it", path);
    if (good && size >= 4 && word_at(data) == GLB_MAGIC) {
        enum { START = HEADER + CHUNK_HEADER };
        good = (size >= START && word_at(data + 4) == 2) || expected(glb, "a binary glTF 2.0 file (.glb)", error);
        text = data + START;
        length = good ? word_at(data + HEADER) : 0;
        const size_t end = START + length;
        if (good && (word_at(data + 8) > size || end > size))
            good = fail(error, ERROR_INPUT, "%s: expected a file of %u bytes, got %zu: the file is cut off", path,
                        word_at(data + 8), size);
        if (good && word_at(data + HEADER + 4) != GLB_JSON) good = expected(glb, "JSON in the first chunk", error);
        if (good && end + CHUNK_HEADER <= size && word_at(data + end + 4) == GLB_BIN) {
            glb->chunk = (struct glb_bytes){(const unsigned char *)data + end + CHUNK_HEADER, word_at(data + end)};
            good = glb->chunk.size <= size - end - CHUNK_HEADER ||
                   expected(glb, "a binary chunk as long as it says", error);
        }
    }
    good = good && read_json(glb, text, length, error) &&
           (json_is_object(glb->json) || expected(glb, "a JSON object", error));
    if (!good) glb_close(glb);
    return good;
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
    if (strncmp(uri, "data:", 5) == 0) {
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
    if (!decode_name(uri, name) || !path_folder(glb->path, folder) ||
        snprintf(path, sizeof path, "%s%s%s", folder, folder[0] ? "/" : "", name) >= (int)sizeof path)
        return fail(error, ERROR_INPUT,
                    "expected a data URI or a file's name, from the folder of this one, got '%.80s'", uri);
    char *data;
    size_t size;
    if (!file_read(path, GLB_FILE_LIMIT, &data, &size, error)) return false;
    glb->room += GLB_GROWTH * size;
    progress_report("reading a glTF file", 0, (long)size);
    *buffer = (struct glb_buffer){{(unsigned char *)data, size}, data};
    return true;
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

bool glb_numbers(const struct glb *glb, int64_t index, struct pool *pool, struct glb_numbers *numbers,
                 struct error *error)
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
    numbers->values = pool_try(pool, (size_t)count * (size_t)e.components, sizeof *numbers->values);
    if (!numbers->values) return fail_no_memory(error, glb->path);
    const size_t total = (size_t)count * (size_t)e.components;
    for (size_t n = 0; e.bytes && n < total; n++) // without a buffer view (and bytes) all are zero
        numbers->values[n] = (float)element_at(&e, (int)(n / (size_t)e.components), (int)(n % (size_t)e.components));
    const json_t *sparse = json_object_get(accessor, "sparse");
    const json_t *places = json_object_get(sparse, "indices");
    const int64_t changes = sparse ? glb_integer(sparse, "count", -1) : 0;
    struct elements indices = {.type = (enum number_type)glb_integer(places, "componentType", -1), .components = 1};
    bool read = !sparse || (changes >= 0 && changes <= count && find_elements(glb, places, changes, &indices) &&
                            find_elements(glb, json_object_get(sparse, "values"), changes, &e));
    for (int i = 0; read && i < (int)changes; i++) {
        const double at = element_at(&indices, i, 0);
        read = at >= 0 && at < numbers->count;
        for (int k = 0; read && k < e.components; k++)
            numbers->values[(size_t)at * (size_t)e.components + (size_t)k] = (float)element_at(&e, i, k);
    }
    bool finite = read;
    for (size_t n = 0; finite && n < total; n++) finite = isfinite(numbers->values[n]);
    if (finite) return true;
    if (!read) return outside(glb, index, error);
    return fail(error, ERROR_INPUT, "%s: accessors[%lld]: expected finite numbers, got NaN or infinity", glb->path,
                (long long)index);
}

// --- compressed meshes: KHR_draco_mesh_compression and EXT_meshopt_compression
//
// They are decompressed as soon as a file is read, in its JSON and its bytes: all other code reads and writes plain files.

/// Limits: decompressed bytes per byte of the file, bytes that Draco allocates and bytes that a reader makes per decompressed byte, and
/// attributes of a mesh with its corners.
enum { MOST_BYTES = 128, DRACO_WORK = 8, UNPACKED_GROWTH = 8, PARTS = 32 };

static const char draco[] = "KHR_draco_mesh_compression", meshopt[] = "EXT_meshopt_compression";

const char *glb_missing_codec(const char *extension)
{
#ifndef WITH_DRACO
    if (strcmp(extension, draco) == 0) return "g++ and libdraco-dev";
#endif
#ifndef WITH_MESHOPT
    if (strcmp(extension, meshopt) == 0) return "libmeshoptimizer-dev";
#endif
    return strcmp(extension, "KHR_meshopt_compression") == 0 ? "" : NULL; // newer than the library
}

static bool can_unpack(const char *extension)
{
    return (strcmp(extension, draco) == 0 || strcmp(extension, meshopt) == 0) && !glb_missing_codec(extension);
}

struct unpacking {
    struct glb *glb;
    size_t room;            ///< bytes that may still be allocated
    struct gltf_file plain; ///< the views, accessors and bytes of the plain file
    size_t view_count;      ///< of the compressed file
    bool *is_spent;         ///< of each of its views: whether it held a Draco mesh
};

static json_t *extension_of(const json_t *object, const char *name)
{
    return can_unpack(name) ? json_object_get(json_object_get(object, "extensions"), name) : NULL;
}

static void drop_extension(json_t *object, const char *name)
{
    json_t *extensions = json_object_get(object, "extensions");
    json_object_del(extensions, name);
    if (json_object_size(extensions) == 0) json_object_del(object, "extensions");
}

bool glb_is_packed(const struct glb *glb)
{
    size_t i;
    json_t *name;
    json_array_foreach(json_object_get(glb->json, "extensionsUsed"), i, name)
    {
        if (json_is_string(name) && can_unpack(json_string_value(name))) return true;
    }
    return false;
}

/// Zeroed memory; NULL if it is too much for a file of this size.
static void *allocate(void *user, size_t count, size_t size)
{
    struct unpacking *u = user;
    if (count > u->room / size) return NULL;
    u->room -= count * size;
    void *memory = calloc(count + 1, size);
    if (!memory) u->plain.without_memory = true;
    return memory;
}

// --- Draco: the attributes and corners of a primitive, all in one view

#ifndef WITH_DRACO
bool draco_decode(const void *data, size_t size, size_t room, struct draco_part *parts, int part_count,
                  draco_memory *memory, void *user)
{
    (void)data, (void)size, (void)room, (void)parts, (void)part_count, (void)memory, (void)user;
    return false;
}
#endif

static bool unpack_primitive(struct unpacking *u, const json_t *primitive, const json_t *packed)
{
    json_t *ids = json_object_get(packed, "attributes"), *id, *accessors[PARTS];
    const json_t *attributes = json_object_get(primitive, "attributes");
    const int64_t view = glb_integer(packed, "bufferView", -1);
    struct draco_part parts[PARTS] = {{.attribute = -1, .type = NUMBER_UINT32, .components = 1, .stride = 4}};
    struct glb_bytes bytes = {0};
    const char *name;
    int count = 1;
    accessors[0] =
        json_array_get(json_object_get(u->glb->json, "accessors"), (size_t)glb_integer(primitive, "indices", -1));
    bool done = json_is_object(accessors[0]) && glb_view(u->glb, view, &bytes) && view < (int64_t)u->view_count &&
                json_object_size(ids) < PARTS;
    json_object_foreach(ids, name, id)
    {
        if (!done) break;
        accessors[count] =
            json_array_get(json_object_get(u->glb->json, "accessors"), (size_t)glb_integer(attributes, name, -1));
        struct draco_part *part = &parts[count++];
        part->type = (int)glb_integer(accessors[count - 1], "componentType", -1);
        part->components = components_of(accessors[count - 1]);
        const size_t size = (size_t)(size_of_type(part->type) * part->components);
        part->attribute = glb_integer(ids, name, -1);
        part->stride = (size + 3) / 4 * 4;
        done = size > 0 && part->components <= 4 && part->attribute >= 0; // else Draco cannot have them
    }
    if (done && json_object_get(accessors[1 % count], "bufferView"))
        return true; // an earlier mesh shares them, or the file also has them uncompressed
    done = done && draco_decode(bytes.at, bytes.size, DRACO_WORK * u->room, parts, count, allocate, u);
    for (int i = 0; i < count; i++) {
        const struct draco_part *part = &parts[i];
        if (done) { // give the accessor its elements in a new view
            struct gltf_file *plain = &u->plain;
            const json_int_t own = gltf_file_add_bytes(plain, part->values, part->count * part->stride);
            if (part->attribute >= 0)
                gltf_set(plain, json_array_get(json_object_get(plain->root, "bufferViews"), (size_t)own),
                         "byteStride", json_integer((json_int_t)part->stride));
            gltf_set(plain, accessors[i], "bufferView", json_integer(own));
            gltf_set(plain, accessors[i], "count", json_integer((json_int_t)part->count));
            gltf_set(plain, accessors[i], "componentType", json_integer(part->type));
            json_object_del(accessors[i], "byteOffset");
            const bool bounded = part->type == NUMBER_FLOAT32 && json_object_get(accessors[i], "min");
            json_object_del(accessors[i], "min"); // Draco moves vertices a little
            json_object_del(accessors[i], "max");
            if (bounded)
                gltf_file_bound(plain, accessors[i], (const float *)(const void *)part->values, part->count,
                                part->components);
        }
        free(part->values);
    }
    if (done) u->is_spent[view] = true;
    return done;
}

// --- meshoptimizer: a buffer view

static bool decode(const json_t *packed, struct glb_bytes from, size_t count, size_t stride, void *to)
{
#ifdef WITH_MESHOPT
    const char *mode = json_string_value(json_object_get(packed, "mode"));
    const char *filter = json_string_value(json_object_get(packed, "filter"));
    const bool attributes = mode && strcmp(mode, "ATTRIBUTES") == 0, is_index = stride == 2 || stride == 4;
    if (attributes ? stride % 4 != 0 || stride > 256 : !is_index) return false;
    if (mode && strcmp(mode, "TRIANGLES") == 0)
        return count % 3 == 0 && meshopt_decodeIndexBuffer(to, count, stride, from.at, from.size) == 0;
    if (mode && strcmp(mode, "INDICES") == 0)
        return meshopt_decodeIndexSequence(to, count, stride, from.at, from.size) == 0;
    if (!attributes || meshopt_decodeVertexBuffer(to, count, stride, from.at, from.size) != 0) return false;
    if (!filter || strcmp(filter, "NONE") == 0) return true;
    if (strcmp(filter, "OCTAHEDRAL") == 0 && (stride == 4 || stride == 8))
        meshopt_decodeFilterOct(to, count, stride);
    else if (strcmp(filter, "QUATERNION") == 0 && stride == 8)
        meshopt_decodeFilterQuat(to, count, stride);
    else if (strcmp(filter, "EXPONENTIAL") == 0)
        meshopt_decodeFilterExp(to, count, stride);
    else
        return false;
    return true;
#else
    (void)packed, (void)from, (void)count, (void)stride, (void)to;
    return false;
#endif
}

static void drop_names(json_t *root, const char *array)
{
    json_t *names = json_object_get(root, array);
    for (size_t i = json_array_size(names); i-- > 0;) {
        const char *name = json_string_value(json_array_get(names, i));
        if (name && can_unpack(name)) json_array_remove(names, i);
    }
    if (json_array_size(names) == 0) json_object_del(root, array);
}

static bool unpack(struct glb *glb, struct error *error)
{
    struct unpacking u = {.glb = glb, .room = GLB_ROOM + MOST_BYTES / GLB_GROWTH * (glb->room - GLB_ROOM)};
    size_t m, p;
    json_t *mesh, *primitive;
    if (!glb_is_packed(glb)) return true;
    json_t *views = json_object_get(glb->json, "bufferViews");
    u.plain.root = json_incref(glb->json);
    u.view_count = json_array_size(views);
    u.is_spent = calloc(u.view_count + 1, sizeof *u.is_spent);
    bool done = u.is_spent;
    json_array_foreach(json_object_get(glb->json, "meshes"), m, mesh)
    {
        json_array_foreach(json_object_get(mesh, "primitives"), p, primitive)
        {
            const json_t *packed = done ? extension_of(primitive, draco) : NULL;
            if (!packed) continue;
            done = unpack_primitive(&u, primitive, packed) ||
                   fail(error, ERROR_INPUT,
                        "%s: meshes[%zu].primitives[%zu]: expected a Draco mesh that a file of this size can hold, "
                        "got something else",
                        glb->path, m, p);
            if (done) drop_extension(primitive, draco);
        }
    }
    for (size_t i = 0; done && i < u.view_count; i++) {
        json_t *view = json_array_get(views, i);
        const json_t *packed = extension_of(view, meshopt);
        const int64_t count = glb_integer(packed, "count", -1), stride = glb_integer(packed, "byteStride", -1);
        struct glb_bytes from;
        const bool is_there = !u.is_spent[i] && glb_bytes(glb, packed ? packed : view, &from) &&
                              (!packed || (count >= 1 && stride >= 1));
        const size_t size = !is_there ? 0 : packed ? (size_t)(count * stride) : from.size;
        void *bytes = is_there ? allocate(&u, size, 1) : NULL;
        if (bytes && !packed) memcpy(bytes, from.at, size);
        const bool unpacked = bytes && (!packed || decode(packed, from, (size_t)count, (size_t)stride, bytes));
        if (unpacked) {
            gltf_set(&u.plain, view, "buffer", json_integer(0));
            gltf_set(&u.plain, view, "byteOffset", json_integer((json_int_t)gltf_file_append(&u.plain, bytes, size)));
            gltf_set(&u.plain, view, "byteLength", json_integer((json_int_t)size));
            drop_extension(view, meshopt);
        } else if (u.is_spent[i]) { // keep its number: repeat another view in its place
            json_array_set_new(views, i, json_deep_copy(json_array_get(views, u.view_count)));
        } else {
            done = fail(error, ERROR_INPUT,
                        "%s: bufferViews[%zu]: expected data within the file, plain or compressed by meshoptimizer, "
                        "got something else",
                        glb->path, i);
        }
        free(bytes);
    }
    if (done && !u.plain.without_memory) { // the decompressed bytes become the only buffer
        for (int i = 0; i < glb->buffer_count; i++) free(glb->buffers[i].owned);
        glb->buffers[0] = (struct glb_buffer){{(unsigned char *)u.plain.data, u.plain.size}, u.plain.data};
        glb->buffer_count = 1;
        glb->room += UNPACKED_GROWTH * u.plain.size;
        gltf_set(&u.plain, glb->json, "buffers", json_pack("[{s:I}]", "byteLength", (json_int_t)u.plain.size));
        drop_names(glb->json, "extensionsUsed");
        drop_names(glb->json, "extensionsRequired");
        u.plain.data = NULL;
    }
    if (!u.is_spent || u.plain.without_memory) done = fail_no_memory(error, glb->path);
    gltf_file_free(&u.plain);
    free(u.is_spent);
    return done;
}

bool glb_read_buffers(struct glb *glb, struct error *error)
{
    const json_t *buffers = json_object_get(glb->json, "buffers");
    size_t total = 0;
    glb->buffers = calloc(json_array_size(buffers) + 1, sizeof *glb->buffers);
    if (!glb->buffers) return fail_no_memory(error, glb->path);
    for (size_t i = 0; i < json_array_size(buffers); i++) {
        struct glb_buffer *buffer = &glb->buffers[glb->buffer_count++];
        const json_t *described = json_array_get(buffers, i);
        const char *uri = json_string_value(json_object_get(described, "uri"));
        struct error why = {0};
        // It may only hold the place of decompressed bytes, and have none.
        if (json_is_true(json_object_get(extension_of(described, meshopt), "fallback"))) continue;
        size_t same = 0; // an earlier buffer that is the same file
        while (uri && same < i) {
            const char *other = json_string_value(json_object_get(json_array_get(buffers, same), "uri"));
            if (strncmp(uri, "data:", 5) != 0 && other && strcmp(other, uri) == 0) break;
            same++;
        }
        if (uri && same < i) {
            buffer->bytes = glb->buffers[same].bytes;
        } else if (!uri) {
            if (i == 0) buffer->bytes = glb->chunk;
        } else if (!glb_read_uri(glb, uri, buffer, &why)) {
            return fail(error, why.kind, "%s: buffers[%zu].uri: %s", glb->path, i, why.text);
        }
        const int64_t length = glb_integer(described, "byteLength", 0);
        if (length < 0 || length > (int64_t)buffer->bytes.size)
            return fail(error, ERROR_INPUT,
                        "%s: buffers[%zu].byteLength: expected at most the %zu bytes that are there, got %lld",
                        glb->path, i, buffer->bytes.size, (long long)length);
        if (buffer->owned) total += buffer->bytes.size;
        if (total > GLB_FILE_LIMIT)
            return fail(error, ERROR_INPUT, "%s: buffers[%zu]: expected at most %d MiB in all, got more", glb->path,
                        i, GLB_FILE_LIMIT >> 20);
    }
    return unpack(glb, error);
}

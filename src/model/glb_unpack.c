/// Decompresses meshes as soon as a file is read, in its JSON and its bytes: KHR_draco_mesh_compression and EXT_meshopt_compression.
/// All other code reads and writes plain files.
#include "base/npy.h"
#include "model/draco.h"
#include "model/glb.h"
#include "model/gltf_write.h"
#include <stdlib.h>
#include <string.h>
#ifdef WITH_MESHOPT
#include <meshoptimizer.h>
#endif

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
    struct error *error;
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

bool glb_is_fallback(const json_t *buffer)
{
    return json_is_true(json_object_get(extension_of(buffer, meshopt), "fallback"));
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

/// Describes the elements of an accessor. False if Draco cannot have them.
static bool describe(const json_t *accessor, int64_t attribute, struct draco_part *part)
{
    const size_t size = glb_element(accessor, &part->type, &part->components);
    part->attribute = attribute;
    part->stride = (size + 3) / 4 * 4;
    return size > 0 && part->components <= 4 && attribute >= 0;
}

/// Gives an accessor its elements in a new view.
static void put(struct unpacking *u, json_t *accessor, const struct draco_part *part)
{
    const json_int_t view = gltf_file_add_bytes(&u->plain, part->values, part->count * part->stride);
    if (part->attribute >= 0)
        gltf_set(&u->plain, json_array_get(u->plain.views, (size_t)view), "byteStride",
                 json_integer((json_int_t)part->stride));
    gltf_set(&u->plain, accessor, "bufferView", json_integer(view));
    gltf_set(&u->plain, accessor, "count", json_integer((json_int_t)part->count));
    gltf_set(&u->plain, accessor, "componentType", json_integer(part->type));
    json_object_del(accessor, "byteOffset");
    const bool bounded = part->type == NUMBER_FLOAT32 && json_object_get(accessor, "min");
    json_object_del(accessor, "min"); // Draco moves vertices a little
    json_object_del(accessor, "max");
    if (bounded)
        gltf_file_bound(&u->plain, accessor, (const float *)(const void *)part->values, part->count,
                        part->components);
}

static bool unpack_primitive(struct unpacking *u, const json_t *primitive, const json_t *packed)
{
    json_t *ids = json_object_get(packed, "attributes"), *id, *accessors[PARTS];
    const json_t *attributes = json_object_get(primitive, "attributes");
    const int64_t view = glb_integer(packed, "bufferView", -1);
    struct draco_part parts[PARTS] = {{.attribute = -1, .type = NUMBER_UINT32, .components = 1, .stride = 4}};
    struct glb_bytes bytes = {0};
    const char *name;
    int count = 1;
    accessors[0] = json_array_get(u->plain.accessors, (size_t)glb_integer(primitive, "indices", -1));
    bool done = json_is_object(accessors[0]) && glb_view(u->glb, view, &bytes) && view < (int64_t)u->view_count &&
                json_object_size(ids) < PARTS;
    json_object_foreach(ids, name, id)
    {
        if (!done) break;
        accessors[count] = json_array_get(u->plain.accessors, (size_t)glb_integer(attributes, name, -1));
        done = describe(accessors[count], glb_integer(ids, name, -1), &parts[count]);
        count++;
    }
    if (done && json_object_get(accessors[1 % count], "bufferView"))
        return true; // an earlier mesh shares them, or the file also has them uncompressed
    done = done && draco_decode(bytes.at, bytes.size, DRACO_WORK * u->room, parts, count, allocate, u);
    for (int i = 0; i < count; i++) {
        if (done) put(u, accessors[i], &parts[i]);
        free(parts[i].values);
    }
    if (done) u->is_spent[view] = true;
    return done;
}

static bool unpack_meshes(struct unpacking *u)
{
    size_t m, p;
    json_t *mesh, *primitive;
    json_array_foreach(json_object_get(u->glb->json, "meshes"), m, mesh)
    {
        json_array_foreach(json_object_get(mesh, "primitives"), p, primitive)
        {
            const json_t *packed = extension_of(primitive, draco);
            if (packed && !unpack_primitive(u, primitive, packed))
                return fail(
                    u->error, ERROR_INPUT,
                    "%s: meshes[%zu].primitives[%zu]: expected a Draco mesh that a file of this size can hold, "
                    "got something else",
                    u->glb->path, m, p);
            if (packed) drop_extension(primitive, draco);
        }
    }
    return true;
}

// --- meshoptimizer: a buffer view

#ifdef WITH_MESHOPT
static bool decode(const json_t *packed, struct glb_bytes from, size_t count, size_t stride, void *to)
{
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
}
#else
static bool decode(const json_t *packed, struct glb_bytes from, size_t count, size_t stride, void *to)
{
    (void)packed, (void)from, (void)count, (void)stride, (void)to;
    return false;
}
#endif

/// The decompressed bytes of a view, which the caller frees; NULL if there are none.
static void *bytes_of(struct unpacking *u, const json_t *view, size_t *size)
{
    const json_t *packed = extension_of(view, meshopt);
    const int64_t count = glb_integer(packed, "count", -1), stride = glb_integer(packed, "byteStride", -1);
    struct glb_bytes from;
    if (!glb_bytes(u->glb, packed ? packed : view, &from) || (packed && (count < 1 || stride < 1))) return NULL;
    *size = packed ? (size_t)(count * stride) : from.size;
    void *bytes = allocate(u, *size, 1);
    if (bytes && !packed) return memcpy(bytes, from.at, *size);
    if (bytes && decode(packed, from, (size_t)count, (size_t)stride, bytes)) return bytes;
    free(bytes);
    return NULL;
}

static bool unpack_views(struct unpacking *u)
{
    for (size_t i = 0; i < u->view_count; i++) {
        json_t *view = json_array_get(u->plain.views, i);
        size_t size;
        void *bytes = u->is_spent[i] ? NULL : bytes_of(u, view, &size);
        if (bytes) {
            gltf_set(&u->plain, view, "buffer", json_integer(0));
            gltf_set(&u->plain, view, "byteOffset",
                     json_integer((json_int_t)gltf_file_append(&u->plain, bytes, size)));
            gltf_set(&u->plain, view, "byteLength", json_integer((json_int_t)size));
            drop_extension(view, meshopt);
        } else if (u->is_spent[i]) { // keep its number: repeat another view in its place
            json_array_set_new(u->plain.views, i, json_deep_copy(json_array_get(u->plain.views, u->view_count)));
        } else {
            return fail(u->error, ERROR_INPUT,
                        "%s: bufferViews[%zu]: expected data within the file, plain or compressed by meshoptimizer, "
                        "got something else",
                        u->glb->path, i);
        }
        free(bytes);
    }
    return true;
}

// --- the file

static void drop_names(json_t *root, const char *array)
{
    json_t *names = json_object_get(root, array);
    for (size_t i = json_array_size(names); i-- > 0;) {
        const char *name = json_string_value(json_array_get(names, i));
        if (name && can_unpack(name)) json_array_remove(names, i);
    }
    if (json_array_size(names) == 0) json_object_del(root, array);
}

/// Makes the decompressed bytes the only buffer.
static void replace_buffers(struct unpacking *u)
{
    struct glb *glb = u->glb;
    for (int i = 0; i < glb->buffer_count; i++) free(glb->buffers[i].owned);
    glb->buffers[0] = (struct glb_buffer){{(unsigned char *)u->plain.data, u->plain.size}, u->plain.data};
    glb->buffer_count = 1;
    glb->room += UNPACKED_GROWTH * u->plain.size;
    gltf_set(&u->plain, glb->json, "buffers", json_pack("[{s:I}]", "byteLength", (json_int_t)u->plain.size));
    drop_names(glb->json, "extensionsUsed");
    drop_names(glb->json, "extensionsRequired");
    u->plain.data = NULL;
}

bool glb_unpack(struct glb *glb, struct error *error)
{
    struct unpacking u = {
        .glb = glb, .error = error, .room = GLB_ROOM + MOST_BYTES / GLB_GROWTH * (glb->room - GLB_ROOM)};
    if (!glb_is_packed(glb)) return true;
    gltf_file_continue(&u.plain, glb->json);
    u.view_count = json_array_size(u.plain.views);
    u.is_spent = calloc(u.view_count + 1, sizeof *u.is_spent);
    bool done = u.is_spent && unpack_meshes(&u) && unpack_views(&u);
    if (done && !u.plain.without_memory) replace_buffers(&u);
    if (!u.is_spent || u.plain.without_memory) done = fail_no_memory(error, glb->path);
    gltf_file_free(&u.plain);
    free(u.is_spent);
    return done;
}

/// Writes the dog to a .glb: one skinned mesh with a primitive per material, its skeleton, its clips.
#include "base/file.h"
#include "model/dog.h"
#include "model/glb.h"
#include "model/vector.h"
#include <math.h>
#include <stb/stb_image_write.h>
#include <stdlib.h>

enum { BYTE = 5121, SHORT = 5123, VERTICES = 34962, INDICES = 34963 };
enum { TAG_PIXELS = 64, KEY_LIMIT = 256 };

/// A file being written. The first node is the root of the skeleton, then come its joints, then the mesh.
struct output {
    const struct dog_skeleton *skeleton;
    const struct dog_pieces *pieces;
    FILE *binary;
    size_t size;
    json_t *views, *accessors;
    bool failed; ///< memory ran short
};

/// A vertex as the file has it.
struct packed {
    float position[3], normal[3];
    uint16_t uv[2];
    unsigned char color[4], joints[DOG_INFLUENCES];
    uint16_t weights[DOG_INFLUENCES];
};

/// What an accessor's elements are.
struct shape {
    const char *name; ///< SCALAR, VEC3 …
    int type;         ///< of its components
    bool normalized;
    size_t offset; ///< in a vertex
};

static const struct {
    const char *name;
    struct shape shape;
} attributes[] = {
    {"POSITION", {"VEC3", GLB_FLOAT, false, offsetof(struct packed, position)}},
    {"NORMAL", {"VEC3", GLB_FLOAT, false, offsetof(struct packed, normal)}},
    {"TEXCOORD_0", {"VEC2", SHORT, true, offsetof(struct packed, uv)}},
    {"COLOR_0", {"VEC4", BYTE, true, offsetof(struct packed, color)}},
    {"JOINTS_0", {"VEC4", BYTE, false, offsetof(struct packed, joints)}},
    {"WEIGHTS_0", {"VEC4", SHORT, true, offsetof(struct packed, weights)}},
};

enum { PLACED = 0, PICTURED = 2 };

/// Adds a buffer view; views start at multiples of 4 bytes.
static json_int_t add_view(struct output *o, const void *bytes, size_t size, int target)
{
    json_t *view =
        json_pack("{s:i, s:I, s:I}", "buffer", 0, "byteOffset", (json_int_t)o->size, "byteLength", (json_int_t)size);
    if (target) json_object_set_new(view, "target", json_integer(target));
    json_array_append_new(o->views, view);
    const size_t padding = (4 - size % 4) % 4;
    if (!bytes || fwrite(bytes, 1, size, o->binary) != size || fwrite("\0\0\0", 1, padding, o->binary) != padding)
        o->failed = true;
    o->size += size + padding;
    return (json_int_t)json_array_size(o->views) - 1;
}

static json_int_t add_accessor(struct output *o, json_int_t view, int count, const struct shape *shape)
{
    json_t *accessor =
        json_pack("{s:I, s:I, s:i, s:i, s:s}", "bufferView", view, "byteOffset", (json_int_t)shape->offset,
                  "componentType", shape->type, "count", count, "type", shape->name);
    if (shape->normalized) json_object_set_new(accessor, "normalized", json_true());
    json_array_append_new(o->accessors, accessor);
    return (json_int_t)json_array_size(o->accessors) - 1;
}

/// Floats in a view of their own.
static json_int_t add_floats(struct output *o, const float *numbers, int count, int components, const char *name)
{
    const json_int_t view = add_view(o, numbers, (size_t)(count * components) * sizeof *numbers, 0);
    return add_accessor(o, view, count, &(struct shape){.name = name, .type = GLB_FLOAT});
}

/// What positions and key times must state; the next element follows after `stride` floats.
static void add_bounds(struct output *o, json_int_t accessor, const float *numbers, int count, int components,
                       int stride)
{
    json_t *low = json_array(), *high = json_array(), *object = json_array_get(o->accessors, (size_t)accessor);
    for (int k = 0; k < components; k++) {
        float least = INFINITY, most = -INFINITY;
        for (int i = 0; i < count; i++) {
            least = fminf(least, numbers[i * stride + k]);
            most = fmaxf(most, numbers[i * stride + k]);
        }
        json_array_append_new(low, json_real((double)least));
        json_array_append_new(high, json_real((double)most));
    }
    json_object_set_new(object, "min", low);
    json_object_set_new(object, "max", high);
}

/// Weights as shorts whose sum is exactly 65535.
static void pack_influences(const struct output *o, const struct dog_piece *piece, struct packed *packed)
{
    struct dog_influences influences = {.joint = {piece->joint}, .weight = {1}};
    if (piece->joint < 0) dog_influences(o->skeleton, packed->position, &influences);
    int left = UINT16_MAX;
    for (int n = DOG_INFLUENCES - 1; n >= 0; n--) {
        const int weight = n ? (int)lrintf(influences.weight[n] * (float)UINT16_MAX) : left;
        packed->joints[n] = (unsigned char)(weight ? influences.joint[n] : 0);
        packed->weights[n] = (uint16_t)weight;
        left -= weight;
    }
}

static void pack(const struct output *o, const struct dog_piece *piece, const struct vertex *vertex,
                 struct packed *packed)
{
    memcpy(packed->position, vertex->position, sizeof packed->position);
    memcpy(packed->normal, vertex->normal, sizeof packed->normal);
    for (int k = 0; k < 2; k++) {
        const float off = (vertex->position[k] - o->pieces->tag_middle[k]) / o->pieces->tag_radius;
        packed->uv[k] = (uint16_t)lrintf(UINT16_MAX * glm_clamp(0.5f + (k ? -0.5f : 0.5f) * off, 0, 1));
    }
    for (int k = 0; k < 3; k++) packed->color[k] = (unsigned char)lrintf(255.0f * glm_clamp(vertex->color[k], 0, 1));
    packed->color[3] = 255;
    pack_influences(o, piece, packed);
}

/// All pieces of one material.
static json_t *make_primitive(struct output *o, enum dog_material material)
{
    const struct dog_pieces *pieces = o->pieces;
    size_t vertices = 0, indices = 0, vertex = 0, index = 0;
    for (int p = 0; p < pieces->count; p++) {
        if (pieces->pieces[p].material != material) continue;
        vertices += (size_t)pieces->pieces[p].mesh.vertex_count;
        indices += (size_t)pieces->pieces[p].mesh.index_count;
    }
    struct packed *packed = malloc(vertices * sizeof *packed);
    uint16_t *corners = malloc(indices * sizeof *corners);
    o->failed = o->failed || !packed || !corners || vertices > UINT16_MAX;
    for (int p = 0; p < pieces->count && !o->failed; p++) {
        const struct mesh *mesh = &pieces->pieces[p].mesh;
        if (pieces->pieces[p].material != material) continue;
        for (int i = 0; i < mesh->index_count; i++) corners[index++] = (uint16_t)(vertex + mesh->indices[i]);
        for (int v = 0; v < mesh->vertex_count; v++)
            pack(o, &pieces->pieces[p], &mesh->vertices[v], &packed[vertex++]);
    }
    json_t *named = json_object();
    const json_int_t view = add_view(o, packed, vertex * sizeof *packed, VERTICES);
    json_object_set_new(json_array_get(o->views, (size_t)view), "byteStride", json_integer(sizeof *packed));
    for (size_t a = 0; a < sizeof attributes / sizeof *attributes; a++) {
        if (a == PICTURED && material != DOG_TAG) continue;
        const json_int_t accessor = add_accessor(o, view, (int)vertex, &attributes[a].shape);
        if (a == PLACED && packed)
            add_bounds(o, accessor, packed->position, (int)vertex, 3, sizeof *packed / sizeof(float));
        json_object_set_new(named, attributes[a].name, json_integer(accessor));
    }
    const json_int_t triangles = add_view(o, corners, index * sizeof *corners, INDICES);
    const json_int_t order = add_accessor(o, triangles, (int)index, &(struct shape){.name = "SCALAR", .type = SHORT});
    free(packed);
    free(corners);
    return json_pack("{s:o, s:I, s:i}", "attributes", named, "indices", order, "material", (int)material);
}

static json_t *make_materials(void)
{
    static const struct {
        const char *name;
        double color[3], roughness;
    } materials[DOG_MATERIALS] = {
        [DOG_COAT] = {"coat", {1, 1, 1}, 0.85},
        [DOG_WHITE] = {"eye", {0.90, 0.88, 0.84}, 0.3},
        [DOG_IRIS] = {"iris", {0.20, 0.075, 0.025}, 0.3},
        [DOG_DARK] = {"pupil and nose", {0.016, 0.011, 0.010}, 0.3},
        [DOG_GLINT] = {"glint", {1, 1, 1}, 1},
        [DOG_TONGUE] = {"tongue", {0.75, 0.17, 0.20}, 0.5},
        [DOG_COLLAR] = {"collar", {0.02, 0.30, 0.33}, 0.6},
        [DOG_TAG] = {"tag", {1, 1, 1}, 0.4},
    };
    json_t *array = json_array();
    for (int m = 0; m < DOG_MATERIALS; m++) {
        const double *rgb = materials[m].color;
        json_t *look = json_pack("{s:[f, f, f, i], s:i, s:f}", "baseColorFactor", rgb[0], rgb[1], rgb[2], 1,
                                 "metallicFactor", 0, "roughnessFactor", materials[m].roughness);
        if (m == DOG_TAG) json_object_set_new(look, "baseColorTexture", json_pack("{s:i}", "index", 0));
        json_t *material = json_pack("{s:s, s:o}", "name", materials[m].name, "pbrMetallicRoughness", look);
        if (m == DOG_GLINT) json_object_set_new(material, "emissiveFactor", json_pack("[i, i, i]", 1, 1, 1));
        json_array_append_new(array, material);
    }
    return array;
}

/// The encoder hands the whole file over.
static void add_png(void *output, void *data, int size) { add_view(output, data, (size_t)size, 0); }

/// The tag's picture: brass with a swing that dies away, the mark of wiggly. Returns its buffer view.
static json_int_t add_picture(struct output *o)
{
    unsigned char pixels[TAG_PIXELS][TAG_PIXELS][3];
    for (int y = 0; y < TAG_PIXELS; y++) {
        for (int x = 0; x < TAG_PIXELS; x++) {
            const float u = ((float)x + 0.5f) / TAG_PIXELS * 2 - 1, v = 1 - ((float)y + 0.5f) / TAG_PIXELS * 2;
            const float wave = 0.42f * expf(-1.1f * (u + 0.7f)) * cosf(7.5f * (u + 0.7f)), edge = hypotf(u, v);
            const bool mark = (fabsf(v - wave) < 0.12f && fabsf(u) < 0.68f) || edge > 0.88f;
            const unsigned char brass[3] = {240, 186, 74}, dark[3] = {112, 66, 22};
            memcpy(pixels[y][x], mark ? dark : brass, 3);
        }
    }
    stbi_write_png_to_func(add_png, o, TAG_PIXELS, TAG_PIXELS, 3, pixels, 3 * TAG_PIXELS);
    return (json_int_t)json_array_size(o->views) - 1;
}

static json_t *vector_json(const float *numbers, int count)
{
    json_t *array = json_array();
    for (int k = 0; k < count; k++) json_array_append_new(array, json_real((double)numbers[k]));
    return array;
}

/// Node 0 is the root, node j + 1 joint j.
static json_t *make_nodes(const struct output *o)
{
    const struct dog_skeleton *s = o->skeleton;
    json_t *nodes = json_pack("[{s:s}]", "name", "root");
    for (int j = 0; j < s->count; j++) {
        const struct dog_joint *joint = &s->joints[j];
        vec3s at = vec3_from(joint->position);
        versors q, parent = glms_quat_identity();
        memcpy(q.raw, joint->rotation, sizeof q.raw);
        if (joint->parent >= 0) {
            memcpy(parent.raw, s->joints[joint->parent].rotation, sizeof parent.raw);
            at = glms_vec3_sub(at, vec3_from(s->joints[joint->parent].position));
        }
        at = glms_quat_rotatev(glms_quat_inv(parent), at);
        q = glms_quat_normalize(glms_quat_mul(glms_quat_inv(parent), q));
        json_t *node = json_pack("{s:s, s:o, s:o}", "name", joint->name, "translation", vector_json(at.raw, 3),
                                 "rotation", vector_json(q.raw, 4));
        json_array_append_new(nodes, node);
        json_t *above = json_array_get(nodes, (size_t)(joint->parent + 1));
        if (!json_object_get(above, "children")) json_object_set_new(above, "children", json_array());
        json_array_append_new(json_object_get(above, "children"), json_integer(j + 1));
    }
    json_array_append_new(nodes, json_pack("{s:s, s:i, s:i}", "name", "dog", "mesh", 0, "skin", 0));
    return nodes;
}

static json_t *make_skin(struct output *o)
{
    const struct dog_skeleton *s = o->skeleton;
    float inverse[DOG_MAX_JOINTS][16];
    json_t *joints = json_array();
    for (int j = 0; j < s->count; j++) {
        versors q;
        memcpy(q.raw, s->joints[j].rotation, sizeof q.raw);
        const mat4s world = glms_mat4_mul(glms_translate_make(vec3_from(s->joints[j].position)), glms_quat_mat4(q));
        const mat4s back = glms_mat4_inv(world);
        memcpy(inverse[j], &back, sizeof inverse[j]);
        for (int row = 0; row < 4; row++) inverse[j][4 * row + 3] = row == 3 ? 1.0f : 0.0f;
        json_array_append_new(joints, json_integer(j + 1));
    }
    const json_int_t accessor = add_floats(o, inverse[0], s->count, 16, "MAT4");
    return json_pack("{s:s, s:o, s:I, s:i}", "name", "dog", "joints", joints, "inverseBindMatrices", accessor,
                     "skeleton", 0);
}

static void add_channel(json_t *animation, int node, const char *path, json_int_t times, json_int_t values)
{
    json_t *samplers = json_object_get(animation, "samplers");
    const json_int_t sampler = (json_int_t)json_array_size(samplers);
    json_array_append_new(samplers,
                          json_pack("{s:I, s:I, s:s}", "input", times, "output", values, "interpolation", "LINEAR"));
    json_array_append_new(json_object_get(animation, "channels"),
                          json_pack("{s:I, s:{s:i, s:s}}", "sampler", sampler, "target", "node", node, "path", path));
}

/// Whether any key differs from the first; makes each rotation the one of two equal quaternions that is nearer to the one before.
static bool moves(float (*keys)[4], int count)
{
    bool any = false;
    for (int k = 1; k < count; k++) {
        float dot = 0.0f, difference = 0.0f;
        for (int n = 0; n < 4; n++) dot += keys[k][n] * keys[k - 1][n];
        for (int n = 0; n < 4; n++) {
            if (dot < 0.0f) keys[k][n] = -keys[k][n];
            difference = fmaxf(difference, fabsf(keys[k][n] - keys[0][n]));
        }
        any = any || difference > 1e-5f;
    }
    return any;
}

static json_t *make_clip(struct output *o, int clip, const struct dog_pose *poses)
{
    const int keys = dog_clips[clip].frames + 1;
    float times[KEY_LIMIT], hips[KEY_LIMIT][3], rotations[KEY_LIMIT][4];
    for (int k = 0; k < keys; k++) {
        times[k] = (float)k / DOG_FPS;
        memcpy(hips[k], poses[k].hips, sizeof hips[k]);
    }
    const json_int_t input = add_floats(o, times, keys, 1, "SCALAR");
    add_bounds(o, input, times, keys, 1, 1);
    json_t *animation = json_pack("{s:s, s:[], s:[]}", "name", dog_clips[clip].name, "channels", "samplers");
    add_channel(animation, 1, "translation", input, add_floats(o, hips[0], keys, 3, "VEC3"));
    for (int j = 0; j < o->skeleton->count; j++) {
        for (int k = 0; k < keys; k++) memcpy(rotations[k], poses[k].rotation[j], sizeof rotations[k]);
        if (!moves(rotations, keys)) continue;
        add_channel(animation, j + 1, "rotation", input, add_floats(o, rotations[0], keys, 4, "VEC4"));
    }
    return animation;
}

/// NULL where a leg does not reach its paw, with the error set.
static json_t *make_clips(struct output *o, struct error *error)
{
    static struct dog_pose poses[KEY_LIMIT];
    json_t *array = json_array();
    for (int clip = 0; clip < DOG_CLIPS; clip++) {
        const int frames = dog_clips[clip].frames;
        for (int k = 0; k <= frames; k++) {
            if (dog_pose(o->skeleton, clip, (float)(k % frames) / (float)frames, &poses[k])) continue;
            json_decref(array);
            fail(error, ERROR_INPUT, "clip %s, frame %d: a leg does not reach its paw", dog_clips[clip].name, k);
            return NULL;
        }
        json_array_append_new(array, make_clip(o, clip, poses));
    }
    return array;
}

static json_t *make_json(struct output *o, struct error *error)
{
    o->views = json_array();
    o->accessors = json_array();
    json_t *primitives = json_array();
    for (int m = 0; m < DOG_MATERIALS; m++)
        json_array_append_new(primitives, make_primitive(o, (enum dog_material)m));
    json_t *skin = make_skin(o), *clips = make_clips(o, error);
    const json_int_t picture = add_picture(o);
    return json_pack(
        "{s:{s:s, s:s}, s:i, s:[{s:[i, i]}], s:o, s:[{s:s, s:o}], s:[o], s:o, s:o, s:[{s:i, s:i}], s:[{s:i, s:i}], "
        "s:[{s:s, s:I, s:s}], s:[{s:I}], s:o, s:o}",
        "asset", "version", "2.0", "generator", "wiggly", "scene", 0, "scenes", "nodes", 0, o->skeleton->count + 1,
        "nodes", make_nodes(o), "meshes", "name", "dog", "primitives", primitives, "skins", skin, "materials",
        make_materials(), "animations", clips, "textures", "source", 0, "sampler", 0, "samplers", "magFilter", 9729,
        "minFilter", 9987, "images", "name", "tag", "bufferView", picture, "mimeType", "image/png", "buffers",
        "byteLength", (json_int_t)o->size, "bufferViews", o->views, "accessors", o->accessors);
}

static bool write_chunks(const char *path, const char *text, const char *binary, size_t size, struct error *error)
{
    const size_t length = strlen(text), padded = (length + 3) / 4 * 4;
    const uint32_t head[5] = {GLB_MAGIC, 2, (uint32_t)(12 + 8 + padded + 8 + size), (uint32_t)padded, GLB_JSON};
    const uint32_t next[2] = {(uint32_t)size, GLB_BIN};
    struct file_output file;
    if (!file_output_open(&file, path, error)) return false;
    fwrite(head, sizeof head, 1, file.stream);
    fprintf(file.stream, "%s%*s", text, (int)(padded - length), "");
    fwrite(next, sizeof next, 1, file.stream);
    fwrite(binary, 1, size, file.stream);
    return file_output_commit(&file, error);
}

bool dog_write(const char *path, const struct dog_skeleton *skeleton, const struct dog_pieces *pieces,
               struct error *error)
{
    struct output o = {.skeleton = skeleton, .pieces = pieces};
    struct error clip_error = {0};
    char *binary = NULL;
    size_t size = 0;
    o.binary = open_memstream(&binary, &size);
    if (!o.binary) return fail_no_memory(error, path);
    json_t *json = make_json(&o, &clip_error);
    char *text = json ? json_dumps(json, JSON_COMPACT | JSON_REAL_PRECISION(9)) : NULL;
    json_decref(json);
    bool good = fclose(o.binary) == 0 && text && !o.failed;
    if (!good) {
        good = clip_error.kind ? fail(error, clip_error.kind, "%s: %s", path, clip_error.text)
                               : fail_no_memory(error, path);
    } else {
        good = write_chunks(path, text, binary, size, error);
    }
    free(text);
    free(binary);
    return good;
}

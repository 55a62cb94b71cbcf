/// dog_glb OUT.glb: makes assets/models/dog.glb: one skinned mesh with a primitive per material, its skeleton and clips.
#include "base/need.h"
#include "base/png.h"
#include "model/vector.h"
#include "models/dog.h"
#include <assert.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { BYTE = 5121, SHORT = 5123, FLOAT = 5126, ARRAY_BUFFER = 34962 };
enum { COAT_TRIANGLES = 14200, TAG_PIXELS = 64, KEY_LIMIT = 256 };

/// A file being written. Its nodes are the skeleton's root, the joints, and the mesh.
struct output {
    const struct dog_skeleton *skeleton;
    const struct dog_pieces *pieces;
    struct gltf_file file;
    json_int_t picture; ///< its buffer view
};

/// A vertex in the file's layout.
struct packed {
    float position[3], normal[3];
    uint16_t uv[2];
    unsigned char color[4], joints[DOG_INFLUENCES];
    uint16_t weights[DOG_INFLUENCES];
};

/// A member of it, with OpenGL's type.
static const struct column {
    const char *name, *shape;
    int type;
    bool normalized;
    size_t offset;
} columns[] = {
    {"POSITION", "VEC3", FLOAT, false, offsetof(struct packed, position)},
    {"NORMAL", "VEC3", FLOAT, false, offsetof(struct packed, normal)},
    {"TEXCOORD_0", "VEC2", SHORT, true, offsetof(struct packed, uv)},
    {"COLOR_0", "VEC4", BYTE, true, offsetof(struct packed, color)},
    {"JOINTS_0", "VEC4", BYTE, false, offsetof(struct packed, joints)},
    {"WEIGHTS_0", "VEC4", SHORT, true, offsetof(struct packed, weights)},
};

enum { PLACED, PICTURED = 2 };

/// Converts weights to shorts with a sum of exactly 65535.
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

static void add_bounds(struct output *o, json_t *accessor, const struct packed *rows, size_t count)
{
    vec3s lo = glms_vec3_fill(INFINITY), hi = glms_vec3_fill(-INFINITY);
    for (size_t v = 0; v < count; v++) {
        lo = glms_vec3_minv(lo, vec3_from(rows[v].position));
        hi = glms_vec3_maxv(hi, vec3_from(rows[v].position));
    }
    gltf_set(&o->file, accessor, "min", gltf_numbers(&o->file, lo.raw, 3));
    gltf_set(&o->file, accessor, "max", gltf_numbers(&o->file, hi.raw, 3));
}

/// Vertex rows, and an accessor for each column.
static json_t *make_attributes(struct output *o, const struct packed *rows, size_t count, bool pictured)
{
    const json_int_t number = gltf_file_add_bytes(&o->file, rows, count * sizeof *rows);
    json_t *view = json_array_get(json_object_get(o->file.root, "bufferViews"), (size_t)number),
           *named = json_object();
    gltf_set(&o->file, view, "target", json_integer(ARRAY_BUFFER));
    gltf_set(&o->file, view, "byteStride", json_integer(sizeof *rows));
    for (int c = 0; c < (int)(sizeof columns / sizeof *columns); c++) {
        if (c == PICTURED && !pictured) continue;
        json_t *accessor =
            json_pack("{s:I, s:I, s:i, s:I, s:s}", "bufferView", number, "byteOffset", (json_int_t)columns[c].offset,
                      "componentType", columns[c].type, "count", (json_int_t)count, "type", columns[c].shape);
        if (columns[c].normalized) gltf_set(&o->file, accessor, "normalized", json_true());
        if (c == PLACED) add_bounds(o, accessor, rows, count);
        gltf_set(&o->file, named, columns[c].name,
                 json_integer(gltf_append_to(&o->file, o->file.root, "accessors", accessor)));
    }
    return named;
}

/// All pieces of a material.
static json_t *make_primitive(struct output *o, enum dog_material material)
{
    const struct dog_pieces *pieces = o->pieces;
    size_t vertices = 0, indices = 0, vertex = 0, index = 0;
    for (int p = 0; p < pieces->count; p++) {
        if (pieces->pieces[p].material != material) continue;
        vertices += (size_t)pieces->pieces[p].mesh.vertex_count;
        indices += (size_t)pieces->pieces[p].mesh.index_count;
    }
    struct packed *packed = need(vertices, sizeof *packed);
    uint16_t *corners = need(indices, sizeof *corners);
    assert(vertices <= UINT16_MAX);
    for (int p = 0; p < pieces->count; p++) {
        const struct mesh *mesh = &pieces->pieces[p].mesh;
        if (pieces->pieces[p].material != material) continue;
        for (int i = 0; i < mesh->index_count; i++) corners[index++] = (uint16_t)(vertex + mesh->indices[i]);
        for (int v = 0; v < mesh->vertex_count; v++)
            pack(o, &pieces->pieces[p], &mesh->vertices[v], &packed[vertex++]);
    }
    json_t *named = make_attributes(o, packed, vertex, material == DOG_TAG);
    const json_int_t order = gltf_file_add(&o->file, ELEMENTS_SHORT_INDICES, corners, index, false);
    free(packed);
    free(corners);
    return json_pack("{s:o, s:I, s:i}", "attributes", named, "indices", order, "material", (int)material);
}

static json_t *make_materials(struct output *o)
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
        if (m == DOG_TAG) gltf_set(&o->file, look, "baseColorTexture", json_pack("{s:i}", "index", 0));
        json_t *material = json_pack("{s:s, s:o}", "name", materials[m].name, "pbrMetallicRoughness", look);
        if (m == DOG_GLINT) gltf_set(&o->file, material, "emissiveFactor", json_pack("[i, i, i]", 1, 1, 1));
        gltf_append(&o->file, array, material);
    }
    return array;
}

/// The tag's picture: brass with a decaying swing, wiggly's mark.
static void add_picture(struct output *o)
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
    int size;
    const struct png_picture picture = {TAG_PIXELS, TAG_PIXELS, 3, &pixels[0][0][0]};
    unsigned char *png = png_encode(&picture, PNG_SMALL, &size);
    o->picture = gltf_file_add_bytes(&o->file, png, (size_t)size);
    free(png);
}

/// Node 0 is the root, node j + 1 is joint j.
static json_t *make_nodes(struct output *o)
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
        json_t *node = json_pack("{s:s, s:o, s:o}", "name", joint->name, "translation",
                                 gltf_numbers(&o->file, at.raw, 3), "rotation", gltf_numbers(&o->file, q.raw, 4));
        gltf_append(&o->file, nodes, node);
        gltf_append_to(&o->file, json_array_get(nodes, (size_t)(joint->parent + 1)), "children", json_integer(j + 1));
    }
    gltf_append(&o->file, nodes, json_pack("{s:s, s:i, s:i}", "name", "dog", "mesh", 0, "skin", 0));
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
        gltf_append(&o->file, joints, json_integer(j + 1));
    }
    const json_int_t accessor = gltf_file_add(&o->file, ELEMENTS_MATRICES, inverse, (size_t)s->count, false);
    return json_pack("{s:s, s:o, s:I, s:i}", "name", "dog", "joints", joints, "inverseBindMatrices", accessor,
                     "skeleton", 0);
}

static void add_channel(struct output *o, json_t *animation, int node, const char *path, json_int_t times,
                        json_int_t values)
{
    json_t *samplers = json_object_get(animation, "samplers");
    const json_int_t sampler = (json_int_t)json_array_size(samplers);
    gltf_append(&o->file, samplers,
                json_pack("{s:I, s:I, s:s}", "input", times, "output", values, "interpolation", "LINEAR"));
    gltf_append(&o->file, json_object_get(animation, "channels"),
                json_pack("{s:I, s:{s:i, s:s}}", "sampler", sampler, "target", "node", node, "path", path));
}

/// Whether any key differs from the first. Replaces each rotation by the one of two equal quaternions nearer to the previous one.
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
    const size_t count = (size_t)keys;
    const json_int_t input = gltf_file_add(&o->file, ELEMENTS_KEYS, times, count, true);
    json_t *animation = json_pack("{s:s, s:[], s:[]}", "name", dog_clips[clip].name, "channels", "samplers");
    add_channel(o, animation, 1, "translation", input,
                gltf_file_add(&o->file, ELEMENTS_KEY_VECTORS, hips, count, false));
    for (int j = 0; j < o->skeleton->count; j++) {
        for (int k = 0; k < keys; k++) memcpy(rotations[k], poses[k].rotation[j], sizeof rotations[k]);
        if (!moves(rotations, keys)) continue;
        add_channel(o, animation, j + 1, "rotation", input,
                    gltf_file_add(&o->file, ELEMENTS_TURNS, rotations, count, false));
    }
    return animation;
}

static json_t *make_clips(struct output *o)
{
    static struct dog_pose poses[KEY_LIMIT];
    json_t *array = json_array();
    for (int clip = 0; clip < DOG_CLIPS; clip++) {
        const int frames = dog_clips[clip].frames;
        for (int k = 0; k <= frames; k++) dog_pose(o->skeleton, clip, (float)(k % frames) / (float)frames, &poses[k]);
        gltf_append(&o->file, array, make_clip(o, clip, poses));
    }
    return array;
}

/// NULL if memory runs out.
static json_t *make_json(struct output *o)
{
    json_t *primitives = json_array();
    for (int m = 0; m < DOG_MATERIALS; m++)
        gltf_append(&o->file, primitives, make_primitive(o, (enum dog_material)m));
    json_t *skin = make_skin(o), *clips = make_clips(o);
    add_picture(o);
    return json_pack(
        "{s:{s:s, s:s}, s:i, s:[{s:[i, i]}], s:o, s:[{s:s, s:o}], s:[o], s:o, s:o, s:[{s:i, s:i}], s:[{s:i, s:i}], "
        "s:[{s:s, s:I, s:s}]}",
        "asset", "version", "2.0", "generator", "wiggly", "scene", 0, "scenes", "nodes", 0, o->skeleton->count + 1,
        "nodes", make_nodes(o), "meshes", "name", "dog", "primitives", primitives, "skins", skin, "materials",
        make_materials(o), "animations", clips, "textures", "source", 0, "sampler", 0, "samplers", "magFilter", 9729,
        "minFilter", 9987, "images", "name", "tag", "bufferView", o->picture, "mimeType", "image/png");
}

int main(int argc, char **argv)
{
    if (argc != 2) {
        fputs("usage: dog_glb OUT.glb\n", stderr);
        return ERROR_USAGE;
    }
    struct dog_skeleton skeleton;
    struct dog_pieces pieces = {.count = 1, .pieces = {{.material = DOG_COAT, .joint = -1}}};
    struct error error = {0};
    dog_skeleton_make(&skeleton);
    dog_coat(COAT_TRIANGLES, &pieces.pieces[0].mesh);
    dog_face(&skeleton, &pieces);
    int vertices = 0, triangles = 0;
    for (int p = 0; p < pieces.count; p++) {
        vertices += pieces.pieces[p].mesh.vertex_count;
        triangles += pieces.pieces[p].mesh.index_count / 3;
    }
    struct output o = {.skeleton = &skeleton, .pieces = &pieces, .file = {.root = json_object()}};
    if (model_write(argv[1], &o.file, make_json(&o), &error))
        printf("%s: %d joints, %d vertices, %d triangles\n", argv[1], skeleton.count, vertices, triangles);
    for (int p = 0; p < pieces.count; p++) mesh_free(&pieces.pieces[p].mesh);
    if (error.kind != ERROR_NONE) fprintf(stderr, "dog_glb: %s\n", error.text);
    return (int)error.kind;
}

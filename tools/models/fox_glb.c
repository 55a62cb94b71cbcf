/// fox_glb OUT.glb: makes assets/models/fox.glb: the skin at several levels of detail (the scene shows the first) and the skeleton.
#include "base/need.h"
#include "model/fox.h"
#include "model/vector.h"
#include "models/fox_maker.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { JOINTS = 24 }; ///< of the tail
enum { COAT, FACE, MATERIALS };

/// A node's parent; a node's place in bind space.
static int parent_of(int node)
{
    static const int parents[LIMBS] = {-1, LIMB_BODY, LIMB_BODY, LIMB_HEAD, LIMB_HEAD, LIMB_EAR, LIMB_EAR + 1};
    const int limb = node - FOX_FIRST_LIMB;
    if (limb >= LIMBS) return node > FOX_FIRST_JOINT ? node - 1 : 0;
    return parents[limb] < 0 ? 0 : FOX_FIRST_LIMB + parents[limb];
}

static vec3s place_of(int node)
{
    float pivot[LIMBS][3];
    const float along = FOX_TAIL_LENGTH * (float)(node - FOX_FIRST_JOINT) / (float)JOINTS;
    fox_pivots(pivot);
    return node >= FOX_FIRST_JOINT ? (vec3s){{0, 0, along}} : vec3_from(pivot[node - FOX_FIRST_LIMB]);
}

/// Copies a vertex without the tail's weights.
static void add_vertex(struct gltf_part *part, const struct vertex *vertex)
{
    const int v = part->vertex_count++;
    memcpy(part->position[v], vertex->position, sizeof part->position[v]);
    const vec3s normal = glms_vec3_normalize(vec3_from(vertex->normal));
    memcpy(part->normal[v], normal.raw, sizeof part->normal[v]);
    memcpy(part->color[v], vertex->color, sizeof vertex->color);
    memcpy(part->mark[v], vertex->mark, sizeof part->mark[v]);
    part->color[v][3] = 1.0f;
    part->fur[v][0] = vertex->bend;
    part->fur[v][1] = vertex->open;
    for (int k = 0; k < 2; k++) {
        part->weights[v][k] = k ? vertex->limb[2] : 1.0f - vertex->limb[2];
        part->joints[v][k] = part->weights[v][k] > 0.0f ? (uint16_t)vertex->limb[k] : 0;
    }
}

/// Keeps so many binary places: what is finer, nobody sees, and it would not compress.
static void round_to(int places, float *numbers, int count)
{
    for (int i = 0; i < count; i++) numbers[i] = ldexpf(rintf(ldexpf(numbers[i], places)), -places) + 0.0f;
}

/// Positions in steps of 15 micrometres, normals of 0.014 degrees, colours of a sixteenth of a screen's.
static void round_vertex(struct gltf_part *part, int v)
{
    round_to(16, part->position[v], 3);
    round_to(12, part->normal[v], 3);
    round_to(14, part->color[v], 3);
    round_to(14, part->mark[v], 3);
    round_to(12, part->fur[v], 2);
}

/// Their sum stays 1.
static void round_weights(float weights[GLTF_INFLUENCES])
{
    int most = 0;
    float rest = 1.0f;
    round_to(14, weights, GLTF_INFLUENCES);
    for (int k = 0; k < GLTF_INFLUENCES; k++) {
        rest -= weights[k];
        if (weights[k] > weights[most]) most = k;
    }
    weights[most] += rest;
}

static void part_create(struct gltf_part *part, struct pool *pool, size_t vertices, size_t indices)
{
    *part = (struct gltf_part){.position = pool_take(pool, vertices, sizeof *part->position),
                               .normal = pool_take(pool, vertices, sizeof *part->normal),
                               .color = pool_take(pool, vertices, sizeof *part->color),
                               .mark = pool_take(pool, vertices, sizeof *part->mark),
                               .fur = pool_take(pool, vertices, sizeof *part->fur),
                               .joints = pool_take(pool, vertices, sizeof *part->joints),
                               .weights = pool_take(pool, vertices, sizeof *part->weights),
                               .along = pool_take(pool, vertices, sizeof *part->along),
                               .indices = pool_take(pool, indices, sizeof *part->indices)};
}

/// A material's triangles in the mesh's order, with their vertices.
static void part_fill(const struct mesh *mesh, int material, struct pool *pool, struct gltf_part *part)
{
    const size_t vertices = (size_t)mesh->vertex_count;
    int *number = need(vertices, sizeof *number);
    part_create(part, pool, vertices, (size_t)mesh->index_count);
    for (size_t v = 0; v < vertices; v++) number[v] = -1;
    for (int i = 0; i < mesh->index_count; i++) {
        const uint32_t v = mesh->indices[i];
        if (fox_is_face(mesh, mesh->indices + i - i % 3) != (material == FACE)) continue;
        if (number[v] < 0) {
            number[v] = part->vertex_count;
            add_vertex(part, &mesh->vertices[v]);
            round_vertex(part, number[v]);
        }
        part->indices[part->index_count++] = (uint32_t)number[v];
    }
    free(number);
    fox_hang(part, JOINTS);
    for (int v = 0; v < part->vertex_count; v++) round_weights(part->weights[v]);
}

/// The first `size` bytes of each row, `stride` apart.
static json_int_t add_rows(struct gltf_file *file, enum gltf_elements elements, const void *rows, size_t size,
                           size_t stride, size_t count, bool bounds)
{
    char *packed = need(count, size);
    for (size_t v = 0; v < count; v++) memcpy(packed + v * size, (const char *)rows + v * stride, size);
    const json_int_t accessor = gltf_file_add(file, elements, packed, count, bounds);
    free(packed);
    return accessor;
}

static json_t *make_primitive(struct gltf_file *file, const struct mesh *mesh, int material)
{
    struct gltf_part part;
    struct pool pool = {0};
    part_fill(mesh, material, &pool, &part);
    const size_t count = (size_t)part.vertex_count, indices = (size_t)part.index_count;
    const struct {
        const char *name;
        enum gltf_elements elements;
        const void *rows;
        size_t size, stride;
    } columns[] = {
        {"POSITION", ELEMENTS_VECTORS, part.position, sizeof(float[3]), sizeof *part.position},
        {"NORMAL", ELEMENTS_VECTORS, part.normal, sizeof(float[3]), sizeof *part.normal},
        {"COLOR_0", ELEMENTS_VECTORS, part.color, sizeof(float[3]), sizeof *part.color},
        {"JOINTS_0", ELEMENTS_JOINTS, part.joints, sizeof(uint16_t[4]), sizeof *part.joints},
        {"WEIGHTS_0", ELEMENTS_WEIGHTS, part.weights, sizeof(float[4]), sizeof *part.weights},
        {"_MARK", ELEMENTS_VECTORS, part.mark, sizeof(float[3]), sizeof *part.mark},
        {"_FUR", ELEMENTS_UVS, part.fur, sizeof(float[2]), sizeof *part.fur},
    };
    json_t *attributes = json_object();
    for (size_t c = 0; c < sizeof columns / sizeof *columns; c++)
        gltf_set(file, attributes, columns[c].name,
                 json_integer(add_rows(file, columns[c].elements, columns[c].rows, columns[c].size, columns[c].stride,
                                       count, c == 0)));
    const json_int_t order =
        add_rows(file, ELEMENTS_INDICES, part.indices, sizeof(uint32_t), sizeof *part.indices, indices, false);
    pool_free(&pool);
    return json_pack("{s:o, s:I, s:i}", "attributes", attributes, "indices", order, "material", material);
}

static json_t *make_meshes(struct gltf_file *file)
{
    json_t *meshes = json_array();
    for (int level = 0; level < FOX_LEVELS; level++) {
        struct mesh mesh = {0};
        mesh_fox(level, &mesh);
        json_t *primitives = json_array();
        for (int m = 0; m < MATERIALS; m++) gltf_append(file, primitives, make_primitive(file, &mesh, m));
        gltf_append(file, meshes, json_pack("{s:s, s:o}", "name", "fox", "primitives", primitives));
        printf("level %d: %d vertices, %d triangles\n", level, mesh.vertex_count, mesh.index_count / 3);
        mesh_free(&mesh);
    }
    return meshes;
}

/// The skeleton, then the nodes that show the mesh.
static json_t *make_nodes(struct gltf_file *file, json_t *joints, float (*inverse)[16])
{
    static const char *const names[LIMBS] = {"body", "chest", "head", "ear_l", "ear_r", "ear_tip_l", "ear_tip_r"};
    json_t *nodes = json_pack("[{s:s}]", "name", "fox");
    vec3s place[FOX_FIRST_JOINT + JOINTS] = {{{0}}};
    for (int n = FOX_FIRST_LIMB; n < FOX_FIRST_JOINT + JOINTS; n++) {
        char name[32];
        const int tail = n - FOX_FIRST_JOINT, parent = parent_of(n);
        place[n] = place_of(n);
        if (tail < 0) {
            snprintf(name, sizeof name, "%s", names[n - FOX_FIRST_LIMB]);
        } else {
            snprintf(name, sizeof name, "tail_%d", tail);
        }
        const vec3s from_parent = glms_vec3_sub(place[n], place[parent]);
        const mat4s back = glms_translate_make(glms_vec3_negate(place[n]));
        memcpy(inverse[n - FOX_FIRST_LIMB], back.raw, sizeof *inverse);
        gltf_append(file, nodes,
                    json_pack("{s:s, s:o}", "name", name, "translation", gltf_numbers(file, from_parent.raw, 3)));
        gltf_append_to(file, json_array_get(nodes, (size_t)parent), "children", json_integer(n));
        gltf_append(file, joints, json_integer(n));
    }
    gltf_append(file, nodes, json_pack("{s:s, s:i, s:i}", "name", "skin", "mesh", 0, "skin", 0));
    return nodes;
}

static json_t *make_material(const char *name)
{
    return json_pack("{s:s, s:{s:i, s:f}}", "name", name, "pbrMetallicRoughness", "metallicFactor", 0,
                     "roughnessFactor", 0.9);
}

static json_t *make_json(struct gltf_file *file)
{
    float inverse[LIMBS + JOINTS][16];
    json_t *joints = json_array(), *meshes = make_meshes(file), *nodes = make_nodes(file, joints, inverse);
    const json_int_t back = gltf_file_add(file, ELEMENTS_MATRICES, inverse, LIMBS + JOINTS, false);
    return json_pack("{s:{s:s, s:s}, s:i, s:[{s:[i, i]}], s:o, s:o, s:[{s:o, s:I, s:i}], s:[o, o]}", "asset",
                     "version", "2.0", "generator", "wiggly", "scene", 0, "scenes", "nodes", 0,
                     FOX_FIRST_JOINT + JOINTS, "nodes", nodes, "meshes", meshes, "skins", "joints", joints,
                     "inverseBindMatrices", back, "skeleton", 0, "materials", make_material("coat"),
                     make_material("face"));
}

int main(int argc, char **argv)
{
    struct error error = {0};
    struct gltf_file file = {.root = json_object()};
    if (argc != 2) {
        fputs("usage: fox_glb OUT.glb\n", stderr);
        return ERROR_USAGE;
    }
    model_write(argv[1], &file, make_json(&file), &error);
    if (error.kind != ERROR_NONE) fprintf(stderr, "fox_glb: %s\n", error.text);
    return (int)error.kind;
}

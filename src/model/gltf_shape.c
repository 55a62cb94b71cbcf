/// Writes meshes, materials and pictures of glTF files.
#include "model/gltf_shape.h"
#include "base/need.h"
#include "model/adjacency.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

struct gltf_picture {
    const unsigned char *bytes;
    size_t size;
};

// --- materials

/// The texture of a picture, made if it is new.
static json_int_t find_texture(struct gltf_looks *l, const struct looks_material *material, const char *kind)
{
    const size_t count = json_array_size(l->textures);
    for (size_t t = 0; t < count; t++) {
        const struct gltf_picture *known = &l->pictures[t];
        if (known->size == material->image_size && memcmp(known->bytes, material->image, known->size) == 0)
            return (json_int_t)t;
    }
    l->pictures = need_more(l->pictures, count + 1, sizeof *l->pictures);
    l->pictures[count] = (struct gltf_picture){material->image, material->image_size};
    const json_int_t view = gltf_file_add_bytes(l->file, material->image, material->image_size);
    const json_int_t image = gltf_append(l->file, l->images,
                                         json_pack("{s:s, s:I, s:o}", "name", material->name, "bufferView", view,
                                                   "mimeType", json_sprintf("image/%s", kind)));
    return gltf_append(l->file, l->textures, json_pack("{s:I}", "source", image));
}

static json_int_t add_material(struct gltf_looks *l, const struct looks_material *material)
{
    const float *c = material->color;
    const char *kind = material->image ? looks_image_kind(material->image, material->image_size) : NULL;
    json_t *base = json_pack("{s:f, s:f}", "metallicFactor", 0.0, "roughnessFactor", 0.8);
    if (c[0] != 1 || c[1] != 1 || c[2] != 1 || c[3] != 1)
        gltf_set(l->file, base, "baseColorFactor",
                 json_pack("[f, f, f, f]", (double)c[0], (double)c[1], (double)c[2], (double)c[3]));
    if (kind)
        gltf_set(l->file, base, "baseColorTexture", json_pack("{s:I}", "index", find_texture(l, material, kind)));
    json_t *json = json_pack("{s:s, s:o}", "name", material->name, "pbrMetallicRoughness", base);
    if (c[3] < 1) gltf_set(l->file, json, "alphaMode", json_string("BLEND"));
    if (l->is_open) gltf_set(l->file, json, "doubleSided", json_true());
    return gltf_append(l->file, l->materials, json);
}

static json_int_t plain_material(struct gltf_looks *l)
{
    char name[] = "skin";
    const struct looks_material skin = {.name = name, .color = {1, 1, 1, 1}};
    if (!l->has_plain[l->is_open]) l->plain[l->is_open] = add_material(l, &skin);
    l->has_plain[l->is_open] = true;
    return l->plain[l->is_open];
}

// --- triangles

/// The triangles of a fan starting at corner `turn`; every triangle begins with that corner.
static size_t add_fan(const uint32_t *fan, size_t triangles, size_t turn, uint32_t *out)
{
    const size_t count = triangles + 2;
    // Corners of the fan: the first triangle's, then the last of each other.
    for (size_t t = 0; t < triangles; t++) {
        const size_t places[3] = {turn, turn + t + 1, turn + t + 2};
        for (int k = 0; k < 3; k++) {
            const size_t place = places[k] % count;
            *out++ = place < 3 ? fan[place] : fan[3 * (place - 2) + 2];
        }
    }
    return 3 * triangles;
}

/// The number of triangles from `first` on that form a polygon of one material.
static size_t polygon_at(const struct gltf_shape *shape, size_t first)
{
    const struct looks *looks = shape->looks;
    const size_t count = (size_t)shape->index_count / 3;
    size_t end = first + 1;
    while (looks && looks->joined && end < count && looks->joined[end] &&
           (!looks->material || looks->material[end] == looks->material[first]))
        end++;
    return end - first;
}

static uint32_t material_of(const struct looks *looks, size_t triangle)
{
    if (!looks || !looks->material || looks->material[triangle] >= (uint32_t)looks->material_count) return LOOKS_NONE;
    return looks->material[triangle];
}

/// The corners of one material; returns how many. Successive polygons begin at different corners, so that readers can tell them apart.
static size_t collect(const struct gltf_shape *shape, uint32_t material, uint32_t *corners)
{
    const bool polygons = shape->looks && shape->looks->joined;
    const size_t count = (size_t)shape->index_count / 3;
    size_t used = 0, size;
    for (size_t t = 0; t < count; t += size) {
        const uint32_t *fan = shape->indices + 3 * t;
        size = polygon_at(shape, t);
        if (material_of(shape->looks, t) != material) continue;
        const bool same = polygons && used > 0 && corners[used - 3] == fan[0];
        used += add_fan(fan, size, same, corners + used);
    }
    return used;
}

static void add_primitive(struct gltf_looks *l, json_t *primitives, const struct gltf_shape *shape,
                          json_int_t indices, json_int_t material, json_t *attributes, json_t *targets)
{
    json_t *primitive =
        json_pack("{s:O, s:I, s:I}", "attributes", attributes, "indices", indices, "material", material);
    if (json_array_size(targets) > 0) gltf_set(l->file, primitive, "targets", json_incref(targets));
    if (shape->looks && shape->looks->joined) {
        gltf_set(l->file, primitive, "extensions", json_pack("{s:{}}", GLTF_POLYGONS));
        l->has_polygons = true;
    }
    gltf_append(l->file, primitives, primitive);
}

/// A primitive per material of the triangles, and one for triangles without.
static json_t *make_primitives(struct gltf_looks *l, const struct gltf_shape *shape, json_t *attributes,
                               json_t *targets)
{
    const struct looks *looks = shape->looks;
    const uint32_t materials = looks ? (uint32_t)looks->material_count : 0;
    uint32_t *corners = need((size_t)shape->index_count, sizeof *corners);
    json_t *primitives = json_array();
    if (!l->materials) l->materials = json_array();
    if (!l->textures) l->textures = json_array();
    if (!l->images) l->images = json_array();
    if (!attributes) l->file->without_memory = true;
    for (uint32_t m = 0; attributes && m <= materials; m++) {
        const bool none = m == materials;
        const size_t count = collect(shape, none ? LOOKS_NONE : m, corners);
        if (count == 0) continue;
        const json_int_t indices = gltf_file_add(l->file, ELEMENTS_INDICES, corners, count, false);
        const json_int_t material = none ? plain_material(l) : add_material(l, &looks->materials[m]);
        add_primitive(l, primitives, shape, indices, material, attributes, targets);
    }
    free(corners);
    return primitives;
}

// --- vertices

/// A copy of vectors for the file's vertices, times `scale`, within [lowest, highest].
static json_int_t add_vectors(struct gltf_looks *l, const struct gltf_shape *shape, const float (*vectors)[3],
                              float scale, const float range[2], bool bounds)
{
    const size_t count = (size_t)shape->vertex_count;
    float(*copy)[3] = need(count, sizeof *copy);
    for (size_t i = 0; i < count; i++) {
        const float *vector = vectors[shape->source ? shape->source[i] : i];
        for (int k = 0; k < 3; k++) copy[i][k] = fminf(fmaxf(scale * vector[k], range[0]), range[1]);
    }
    const json_int_t accessor = gltf_file_add(l->file, ELEMENTS_VECTORS, copy, count, bounds);
    free(copy);
    return accessor;
}

static const float any[2] = {-INFINITY, INFINITY}, unit[2] = {-1, 1}, share[2] = {0, 1};

static bool has_colors(const struct gltf_shape *shape)
{
    for (int n = 0; n < 3 * shape->vertex_count; n++) {
        const size_t i = shape->source ? shape->source[n / 3] : (size_t)(n / 3);
        if (shape->color[i][n % 3] != 1) return true;
    }
    return false;
}

static void add_attribute(struct gltf_looks *l, json_t *attributes, const char *name, enum gltf_elements elements,
                          const void *data, int count)
{
    if (!data) return;
    gltf_set(l->file, attributes, name, json_integer(gltf_file_add(l->file, elements, data, (size_t)count, false)));
}

static json_t *make_attributes(struct gltf_looks *l, const struct gltf_shape *shape)
{
    const json_int_t position = add_vectors(l, shape, shape->position, 1, any, true);
    const json_int_t normal = add_vectors(l, shape, shape->normal, 1, unit, false);
    json_t *attributes = json_pack("{s:I, s:I}", "POSITION", position, "NORMAL", normal);
    if (has_colors(shape))
        gltf_set(l->file, attributes, "COLOR_0", json_integer(add_vectors(l, shape, shape->color, 1, share, false)));
    add_attribute(l, attributes, "TEXCOORD_0", ELEMENTS_UVS, shape->uv, shape->vertex_count);
    add_attribute(l, attributes, "JOINTS_0", ELEMENTS_JOINTS, shape->joints, shape->vertex_count);
    add_attribute(l, attributes, "WEIGHTS_0", ELEMENTS_WEIGHTS, shape->weights, shape->vertex_count);
    return attributes;
}

static json_t *make_targets(struct gltf_looks *l, const struct gltf_shape *shape)
{
    json_t *targets = json_array();
    for (int t = 0; t < shape->target_count; t++) {
        const struct gltf_shape_target *target = &shape->targets[t];
        json_t *json =
            json_pack("{s:I}", "POSITION", add_vectors(l, shape, target->position, target->scale, any, true));
        if (target->normal)
            gltf_set(l->file, json, "NORMAL",
                     json_integer(add_vectors(l, shape, target->normal, target->turn, any, false)));
        gltf_append(l->file, targets, json);
    }
    return targets;
}

/// The extras that model/character.h reads: names of targets and properties of each coordinate.
static json_t *make_extras(struct gltf_looks *l, const struct gltf_shape *shape)
{
    json_t *names = json_array(), *coordinates = json_array();
    for (int t = 0; t < shape->target_count; t++) gltf_append(l->file, names, json_string(shape->targets[t].name));
    for (int i = 0; shape->character && i < shape->character->coordinate_count; i++) {
        const struct coordinate *c = &shape->character->coordinates[i];
        json_t *known = json_pack("{s:s, s:f, s:f, s:f, s:f, s:f}", "name", c->name, "frequency", c->frequency,
                                  "damping", c->damping, "explained", c->explained, "pca1", c->pca1, "pca2", c->pca2);
        const double scale = (double)shape->targets[2 * i].scale;
        if (scale != 1) gltf_set(l->file, known, "scale", json_real(scale));
        gltf_append(l->file, coordinates, known);
    }
    return json_pack("{s:o, s:{s:o}}", "targetNames", names, "wiggly", "coordinates", coordinates);
}

/// Whether the back of a shape can be seen, as a flag's: a triangle has none across an edge.
static bool is_open(const struct gltf_shape *shape)
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

json_t *gltf_shape_json(struct gltf_looks *l, const struct gltf_shape *shape)
{
    l->is_open = is_open(shape);
    json_t *attributes = make_attributes(l, shape), *targets = make_targets(l, shape);
    json_t *mesh =
        json_pack("{s:s, s:o}", "name", shape->name, "primitives", make_primitives(l, shape, attributes, targets));
    for (int t = 0; t < shape->target_count; t++) gltf_append_to(l->file, mesh, "weights", json_integer(0));
    if (shape->target_count > 0) gltf_set(l->file, mesh, "extras", make_extras(l, shape));
    if (!targets) l->file->without_memory = true;
    json_decref(attributes);
    json_decref(targets);
    return mesh;
}

// --- the rest of the file

void gltf_looks_complete(struct gltf_looks *l, json_t *root)
{
    const struct {
        const char *key;
        json_t *array;
    } members[] = {{"materials", l->materials}, {"textures", l->textures}, {"images", l->images}};
    for (size_t i = 0; i < sizeof members / sizeof *members; i++) {
        if (json_array_size(members[i].array) > 0)
            gltf_set(l->file, root, members[i].key, json_incref(members[i].array));
    }
    if (l->has_polygons) gltf_set(l->file, root, "extensionsUsed", json_pack("[s]", GLTF_POLYGONS));
}

void gltf_looks_free(struct gltf_looks *l)
{
    json_decref(l->materials);
    json_decref(l->textures);
    json_decref(l->images);
    free(l->pictures);
    *l = (struct gltf_looks){0};
}

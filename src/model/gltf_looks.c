/// Writes materials, pictures and triangles of glTF files.
#include "model/gltf_looks.h"
#include "model/mtl.h"
#include <stdlib.h>
#include <string.h>

struct gltf_picture {
    const unsigned char *bytes;
    size_t size;
};

// --- materials

/// The texture of a picture, made where it is new.
static json_int_t find_texture(struct gltf_looks *l, const struct looks_material *material, const char *kind)
{
    const size_t count = json_array_size(l->textures);
    for (size_t t = 0; t < count; t++) {
        const struct gltf_picture *known = &l->pictures[t];
        if (known->size == material->image_size && memcmp(known->bytes, material->image, known->size) == 0)
            return (json_int_t)t;
    }
    struct gltf_picture *larger = realloc(l->pictures, (count + 1) * sizeof *larger);
    if (!larger) {
        l->file->without_memory = true;
        return 0;
    }
    l->pictures = larger;
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
    return gltf_append(l->file, l->materials, json);
}

static json_int_t plain_material(struct gltf_looks *l)
{
    char name[] = "skin";
    const struct looks_material skin = {.name = name, .color = {1, 1, 1, 1}};
    if (!l->has_plain) l->plain = add_material(l, &skin);
    l->has_plain = true;
    return l->plain;
}

// --- triangles

/// The triangles of a fan from its corner number `turn` on, one corner of which each triangle begins with.
static size_t add_fan(const uint32_t *fan, size_t triangles, size_t turn, uint32_t *out)
{
    const size_t count = triangles + 2;
    // Corners of the fan: the first triangle's, and the last of each that follows.
    for (size_t t = 0; t < triangles; t++) {
        const size_t places[3] = {turn, turn + t + 1, turn + t + 2};
        for (int k = 0; k < 3; k++) {
            const size_t place = places[k] % count;
            *out++ = place < 3 ? fan[place] : fan[3 * (place - 2) + 2];
        }
    }
    return 3 * triangles;
}

/// How many triangles from number `first` on are a polygon of one material.
static size_t polygon_at(const struct gltf_triangles *triangles, size_t first)
{
    const struct looks *looks = triangles->looks;
    const size_t count = (size_t)triangles->corner_count / 3;
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

/// The corners of one material; returns how many. Of two polygons in a row each begins elsewhere, so that they are told apart.
static size_t collect(const struct gltf_triangles *triangles, uint32_t material, uint32_t *corners)
{
    const bool polygons = triangles->looks && triangles->looks->joined;
    const size_t count = (size_t)triangles->corner_count / 3;
    size_t used = 0, size;
    for (size_t t = 0; t < count; t += size) {
        const uint32_t *fan = triangles->corners + 3 * t;
        size = polygon_at(triangles, t);
        if (material_of(triangles->looks, t) != material) continue;
        const bool same = polygons && used > 0 && corners[used - 3] == fan[0];
        used += add_fan(fan, size, same, corners + used);
    }
    return used;
}

static void add_primitive(struct gltf_looks *l, json_t *primitives, const struct gltf_triangles *triangles,
                          json_int_t indices, json_int_t material, json_t *attributes, json_t *targets)
{
    json_t *primitive =
        json_pack("{s:O, s:I, s:I}", "attributes", attributes, "indices", indices, "material", material);
    if (json_array_size(targets) > 0) gltf_set(l->file, primitive, "targets", json_incref(targets));
    if (triangles->looks && triangles->looks->joined) {
        gltf_set(l->file, primitive, "extensions", json_pack("{s:{}}", GLTF_POLYGONS));
        l->has_polygons = true;
    }
    gltf_append(l->file, primitives, primitive);
}

json_t *gltf_looks_primitives(struct gltf_looks *l, const struct gltf_triangles *triangles, json_t *attributes,
                              json_t *targets)
{
    const struct looks *looks = triangles->looks;
    const uint32_t materials = looks ? (uint32_t)looks->material_count : 0;
    uint32_t *corners = malloc(((size_t)triangles->corner_count + 1) * sizeof *corners);
    json_t *primitives = json_array();
    if (!l->materials) l->materials = json_array();
    if (!l->textures) l->textures = json_array();
    if (!l->images) l->images = json_array();
    if (!corners || !attributes) l->file->without_memory = true;
    for (uint32_t m = 0; corners && attributes && m <= materials; m++) {
        const bool none = m == materials;
        const size_t count = collect(triangles, none ? LOOKS_NONE : m, corners);
        if (count == 0) continue;
        const json_int_t indices = gltf_file_add(l->file, ELEMENTS_INDICES, corners, count, false);
        const json_int_t material = none ? plain_material(l) : add_material(l, &looks->materials[m]);
        add_primitive(l, primitives, triangles, indices, material, attributes, targets);
    }
    free(corners);
    return primitives;
}

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

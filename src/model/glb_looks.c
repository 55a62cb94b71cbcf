/// Reads how a character in a .glb looks.
#include "model/glb_looks.h"
#include "model/gltf.h"
#include "model/mtl.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const json_t *element(const struct glb *glb, const char *array, int64_t index)
{
    return index < 0 ? NULL : json_array_get(json_object_get(glb->json, array), (size_t)index);
}

static const json_t *base_texture(const json_t *material)
{
    return json_object_get(json_object_get(material, "pbrMetallicRoughness"), "baseColorTexture");
}

/// The bytes of the picture of a material's base colour, as long as there is room for them.
static bool read_picture(struct glb *glb, const json_t *json, struct looks_material *material, struct error *error)
{
    const json_t *texture = element(glb, "textures", glb_integer(base_texture(json), "index", -1));
    const json_t *image = element(glb, "images", glb_integer(texture, "source", -1));
    struct glb_bytes bytes;
    if (!glb_view(glb, glb_integer(image, "bufferView", -1), &bytes) || !looks_image_kind(bytes.at, bytes.size))
        return true;
    if (!glb_take_room(glb, bytes.size, 1, error)) return false;
    material->image = malloc(bytes.size);
    if (!material->image) return fail_no_memory(error, glb->path);
    memcpy(material->image, bytes.at, bytes.size);
    material->image_size = bytes.size;
    return true;
}

static bool read_material(struct glb *glb, const json_t *json, int number, struct looks_material *material,
                          struct error *error)
{
    const char *name = json_string_value(json_object_get(json, "name"));
    const json_t *color = json_object_get(json_object_get(json, "pbrMetallicRoughness"), "baseColorFactor");
    char made[32];
    snprintf(made, sizeof made, "material %d", number);
    *material = (struct looks_material){.name = strdup(name && name[0] ? name : made), .color = {1, 1, 1, 1}};
    if (!material->name) return fail_no_memory(error, glb->path);
    for (size_t k = 0; k < 4 && json_array_size(color) == 4; k++) {
        const double value = json_number_value(json_array_get(color, k));
        material->color[k] = value > 0 ? value < 1 ? (float)value : 1 : 0;
    }
    return read_picture(glb, json, material, error);
}

bool glb_read_materials(struct glb *glb, struct looks *looks, struct error *error)
{
    const json_t *materials = json_object_get(glb->json, "materials"), *material;
    size_t i;
    if (!glb_take_room(glb, json_array_size(materials), sizeof *looks->materials, error)) return false;
    looks->materials = calloc(json_array_size(materials) + 1, sizeof *looks->materials);
    if (!looks->materials) return fail_no_memory(error, glb->path);
    json_array_foreach(materials, i, material)
    {
        if (!read_material(glb, material, (int)i, &looks->materials[looks->material_count++], error)) return false;
    }
    return true;
}

/// The set of texture coordinates that the primitive's material wants.
static int64_t find_uvs(const struct glb *glb, const json_t *primitive)
{
    const json_t *material = element(glb, "materials", glb_integer(primitive, "material", -1));
    const int64_t set = glb_integer(base_texture(material), "texCoord", 0);
    char name[32];
    snprintf(name, sizeof name, "TEXCOORD_%d", (int)set);
    return glb_integer(json_object_get(primitive, "attributes"), name, -1);
}

static bool read_uvs(struct glb *glb, const struct glb_piece *piece, struct looks *looks, struct error *error)
{
    struct glb_numbers numbers;
    const int64_t accessor = find_uvs(glb, piece->primitive);
    if (accessor < 0 || piece->vertex_count == 0) return true;
    if (!looks->uv) looks->uv = calloc((size_t)looks->uv_count, sizeof *looks->uv);
    if (!looks->uv) return fail_no_memory(error, glb->path);
    if (!glb_numbers(glb, accessor, &numbers, error)) return false;
    const bool fits = numbers.components == 2 && numbers.count == piece->vertex_count;
    for (int n = 0; fits && n < 2 * numbers.count; n++)
        looks->uv[piece->first_vertex + n / 2][n % 2] = (float)numbers.values[n];
    free(numbers.values);
    return fits || fail(error, ERROR_INPUT, "%s: accessors[%lld]: expected %d elements of 2 numbers, got %d of %d",
                        glb->path, (long long)accessor, piece->vertex_count, numbers.count, numbers.components);
}

/// An array by triangle, made longer.
static bool lengthen(void *array, size_t triangles, size_t size)
{
    void *block;
    memcpy(&block, array, sizeof block);
    block = realloc(block, (triangles + 1) * size);
    if (block) memcpy(array, &block, sizeof block);
    return block;
}

bool glb_read_looks(struct glb *glb, const struct glb_piece *piece, struct surface *s, struct error *error)
{
    struct looks *looks = &s->looks;
    const size_t triangles = (size_t)s->index_count / 3, first = (size_t)piece->first_index / 3;
    const int64_t material = glb_integer(piece->primitive, "material", -1);
    const bool known = material >= 0 && material < looks->material_count;
    const bool polygons = json_object_get(json_object_get(piece->primitive, "extensions"), GLTF_POLYGONS);
    if (!lengthen(&looks->material, triangles, sizeof *looks->material) ||
        !lengthen(&looks->joined, triangles, sizeof *looks->joined))
        return fail_no_memory(error, glb->path);
    for (size_t t = first; t < triangles; t++) {
        const uint32_t *corner = s->indices + 3 * t;
        looks->material[t] = known ? (uint32_t)material : LOOKS_NONE;
        looks->joined[t] = polygons && t > first && corner[0] == corner[-3] && corner[1] == corner[-1];
    }
    return read_uvs(glb, piece, looks, error);
}

/// Reads materials: base colour, its texture, and what is transparent.
#include "model/gltf_read.h"
#include <stdlib.h>
#include <string.h>

/// What a material may have that is not shown, where it lies and how it is called.
static const struct {
    const char *key, *name;
} ignored[] = {
    {"normalTexture", "normal maps"}, {"occlusionTexture", "occlusion maps"}, {"emissiveTexture", "emission"}};

static const struct gltf_sampler usual = {
    .wrap = {GLTF_REPEATED, GLTF_REPEATED}, .far = GLTF_READ_BETWEEN, .near = GLTF_READ_LINEAR};

/// Sets a number of a sampler that glTF knows. What another program writes there besides does not keep a character from being shown.
static void take(const json_t *json, const char *key, const int *known, int *number)
{
    const int64_t value = glb_integer(json, key, *number);
    for (; *known; known++) {
        if (value == *known) *number = *known;
    }
}

static void read_sampler(const json_t *json, struct gltf_sampler *sampler)
{
    static const int wraps[] = {GLTF_REPEATED, GLTF_MIRRORED, GLTF_CLAMPED, 0};
    static const int filters[] = {GLTF_READ_NEAREST,
                                  GLTF_READ_LINEAR,
                                  GLTF_READ_SMALLER,
                                  GLTF_READ_SMALLER + 1,
                                  GLTF_READ_SMALLER + 2,
                                  GLTF_READ_BETWEEN,
                                  0};
    static const int near[] = {GLTF_READ_NEAREST, GLTF_READ_LINEAR, 0};
    take(json, "wrapS", wraps, &sampler->wrap[0]);
    take(json, "wrapT", wraps, &sampler->wrap[1]);
    take(json, "minFilter", filters, &sampler->far);
    take(json, "magFilter", near, &sampler->near);
}

static bool read_texture(struct gltf_reader *r, const json_t *info, struct gltf_uv *uv,
                         struct gltf_material *material)
{
    const json_t *textures = gltf_array(r, "textures"), *images = gltf_array(r, "images");
    const json_t *transform = json_object_get(json_object_get(info, "extensions"), "KHR_texture_transform");
    float rotation = (float)json_number_value(json_object_get(transform, "rotation"));
    const json_t *samplers = gltf_array(r, "samplers");
    int texture, source, sampler;
    if (!gltf_index(r, info, "index", (int)json_array_size(textures), &texture)) return false;
    if (texture < 0) return true;
    int64_t set = glb_integer(transform, "texCoord", glb_integer(info, "texCoord", 0));
    if (set < 0) return gltf_bad(r, ".texCoord: expected the number of a set of coordinates, got something else");
    uv->set = (int)set;
    uv->rotation = rotation;
    if (!gltf_reals(r, transform, "offset", uv->offset, 2) || !gltf_reals(r, transform, "scale", uv->scale, 2))
        return false;
    gltf_at(r, "textures[%d]", texture);
    const json_t *described = json_array_get(textures, (size_t)texture);
    if (!gltf_index(r, described, "source", (int)json_array_size(images), &source) ||
        !gltf_index(r, described, "sampler", (int)json_array_size(samplers), &sampler))
        return false;
    if (sampler >= 0) read_sampler(json_array_get(samplers, (size_t)sampler), &material->sampler);
    return source < 0 || gltf_read_image(r, source, &material->image);
}

/// The base colour, which the older of two ways of describing materials calls diffuse.
static bool read_color(struct gltf_reader *r, const json_t *json, struct gltf_material *material, struct gltf_uv *uv)
{
    const json_t *metal = json_object_get(json, "pbrMetallicRoughness"),
                 *extensions = json_object_get(json, "extensions");
    const json_t *gloss = json_object_get(extensions, "KHR_materials_pbrSpecularGlossiness");
    if (json_object_get(metal, "metallicRoughnessTexture") && !gltf_not_shown(r, "metal and roughness maps"))
        return false;
    if (metal || !gloss)
        return gltf_reals(r, metal, "baseColorFactor", material->color, 4) &&
               read_texture(r, json_object_get(metal, "baseColorTexture"), uv, material);
    return gltf_reals(r, gloss, "diffuseFactor", material->color, 4) &&
           read_texture(r, json_object_get(gloss, "diffuseTexture"), uv, material);
}

/// A factor, which is 1 where it is missing.
static double number_of(const json_t *object, const char *key)
{
    const json_t *number = json_object_get(object, key);
    return number ? json_number_value(number) : 1;
}

static bool read_material(struct gltf_reader *r, const json_t *json, size_t number, struct gltf_material *material,
                          struct gltf_uv *uv)
{
    const char *mode = json_string_value(json_object_get(json, "alphaMode"));
    const json_t *cutoff = json_object_get(json, "alphaCutoff");
    *material = (struct gltf_material){.color = {1, 1, 1, 1}, .image = -1, .sampler = usual};
    *uv = (struct gltf_uv){.scale = {1, 1}};
    material->name = gltf_name(r, json, "material", number);
    if (!material->name) return false;
    const json_t *metal = json_object_get(json, "pbrMetallicRoughness");
    material->shines = metal && !json_object_get(metal, "metallicRoughnessTexture");
    material->metallic = number_of(metal, "metallicFactor");
    material->roughness = number_of(metal, "roughnessFactor");
    material->double_sided = json_is_true(json_object_get(json, "doubleSided"));
    material->blended = mode && strcmp(mode, "BLEND") == 0;
    if (mode && strcmp(mode, "MASK") == 0) material->cutoff = cutoff ? (float)json_number_value(cutoff) : 0.5f;
    for (size_t i = 0; i < sizeof ignored / sizeof *ignored; i++) {
        if (json_object_get(json, ignored[i].key) && !gltf_not_shown(r, "%s", ignored[i].name)) return false;
    }
    return read_color(r, json, material, uv);
}

bool gltf_read_materials(struct gltf_reader *r)
{
    const json_t *materials = gltf_array(r, "materials"), *material;
    size_t i, count = json_array_size(materials), images = json_array_size(gltf_array(r, "images"));
    gltf_at(r, "materials");
    r->gltf->materials = gltf_make(r, count, sizeof *r->gltf->materials);
    r->uvs = r->gltf->materials ? gltf_make(r, count, sizeof *r->uvs) : NULL;
    r->gltf->images = r->uvs ? gltf_make(r, images, sizeof *r->gltf->images) : NULL;
    r->image_of = r->gltf->images ? gltf_make(r, images, sizeof *r->image_of) : NULL;
    if (!r->image_of) return false;
    for (i = 0; i < images; i++) r->image_of[i] = -2;
    json_array_foreach(materials, i, material)
    {
        gltf_at(r, "materials[%zu]", i);
        struct gltf_material *to = &r->gltf->materials[r->gltf->material_count++];
        if (!read_material(r, material, i, to, &r->uvs[i])) return false;
    }
    return true;
}

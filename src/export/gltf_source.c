/// Looks things up in the JSON of an imported character's file.
#include "export/gltf_source.h"
#include "model/glb.h"
#include <stdlib.h>

enum { CLAMP = 33071, MIRROR = 33648, REPEAT = 10497 };

struct gltf_source {
    struct glb file;
};

struct gltf_source *gltf_source_open(const char *path, struct error *error)
{
    struct gltf_source *source = calloc(1, sizeof *source);
    if (!source) {
        fail_no_memory(error, path);
        return NULL;
    }
    if (glb_open(&source->file, path, error)) {
        if (glb_read_buffers(&source->file, error)) return source;
        glb_close(&source->file);
    }
    free(source);
    return NULL;
}

void gltf_source_close(struct gltf_source *source)
{
    glb_close(&source->file);
    free(source);
}

static const json_t *element(const struct gltf_source *source, const char *array, int64_t index)
{
    return index < 0 ? NULL : json_array_get(json_object_get(source->file.json, array), (size_t)index);
}

static const char *name_of(const json_t *json)
{
    const char *name = json_string_value(json_object_get(json, "name"));
    return name && name[0] ? name : NULL;
}

const char *gltf_source_material(const struct gltf_source *source, int material)
{
    return name_of(element(source, "materials", material));
}

const char *gltf_source_target(const struct gltf_source *source, int mesh, int target)
{
    const json_t *names = json_object_get(json_object_get(element(source, "meshes", mesh), "extras"), "targetNames");
    return json_string_value(json_array_get(names, (size_t)target));
}

bool gltf_source_shine(const struct gltf_source *source, int material, double *metallic, double *roughness)
{
    const json_t *metal = json_object_get(element(source, "materials", material), "pbrMetallicRoughness");
    const json_t *metal_factor = json_object_get(metal, "metallicFactor"),
                 *rough_factor = json_object_get(metal, "roughnessFactor");
    *metallic = metal_factor ? json_number_value(metal_factor) : 1;
    *roughness = rough_factor ? json_number_value(rough_factor) : 1;
    return metal && !json_object_get(metal, "metallicRoughnessTexture");
}

/// The texture's JSON; the older of two ways of describing materials calls base colour diffuse.
static const json_t *texture_of(const struct gltf_source *source, int material)
{
    const json_t *json = element(source, "materials", material);
    const json_t *metal = json_object_get(json, "pbrMetallicRoughness");
    const json_t *gloss = json_object_get(json_object_get(json, "extensions"), "KHR_materials_pbrSpecularGlossiness");
    const json_t *info =
        metal || !gloss ? json_object_get(metal, "baseColorTexture") : json_object_get(gloss, "diffuseTexture");
    return element(source, "textures", glb_integer(info, "index", -1));
}

static const char *wrap_of(const json_t *sampler, const char *key)
{
    const int64_t wrap = glb_integer(sampler, key, REPEAT);
    return wrap == CLAMP ? "clamp" : wrap == MIRROR ? "mirror" : "repeat";
}

bool gltf_source_texture(struct gltf_source *source, int material, struct gltf_texture *texture, struct error *error)
{
    const json_t *json = texture_of(source, material);
    const json_t *sampler = element(source, "samplers", glb_integer(json, "sampler", -1));
    const int64_t number = glb_integer(json, "source", -1);
    const json_t *image = element(source, "images", number);
    const char *uri = json_string_value(json_object_get(image, "uri"));
    struct glb_buffer bytes = {0};
    struct error why = {.text = "expected its bytes in the file, got none"};
    if (!(uri ? glb_read_uri(&source->file, uri, &bytes, &why)
              : glb_view(&source->file, glb_integer(image, "bufferView", -1), &bytes.bytes)))
        return fail(error, ERROR_INPUT, "%s: images[%d]: %s", source->file.path, (int)number, why.text);
    *texture = (struct gltf_texture){.image = (int)number,
                                     .name = name_of(image),
                                     .wrap = {wrap_of(sampler, "wrapS"), wrap_of(sampler, "wrapT")},
                                     .at = bytes.bytes.at,
                                     .size = bytes.bytes.size,
                                     .owned = bytes.owned};
    return true;
}

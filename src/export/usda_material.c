/// The materials of an imported character in a .usda file, and the files of their textures.
#include "export/usda_model.h"
#include <stdlib.h>
#include <string.h>

/// What stands in the source file about the texture of a material's base colour, which the older of two ways calls diffuse.
static const json_t *texture_of(const struct glb *source, int material)
{
    const json_t *json = json_array_get(json_object_get(source->json, "materials"), (size_t)material);
    const json_t *metal = json_object_get(json, "pbrMetallicRoughness");
    const json_t *gloss = json_object_get(json_object_get(json, "extensions"), "KHR_materials_pbrSpecularGlossiness");
    const json_t *info =
        metal || !gloss ? json_object_get(metal, "baseColorTexture") : json_object_get(gloss, "diffuseTexture");
    const int64_t index = glb_integer(info, "index", -1);
    return index < 0 ? NULL : json_array_get(json_object_get(source->json, "textures"), (size_t)index);
}

/// The bytes of a picture; `owned` is the caller's.
static bool read_picture(struct glb *source, int64_t index, struct glb_buffer *bytes, struct error *error)
{
    const json_t *image = json_array_get(json_object_get(source->json, "images"), (size_t)index);
    const char *uri = json_string_value(json_object_get(image, "uri"));
    struct error why = {0};
    *bytes = (struct glb_buffer){0};
    if (uri ? glb_read_uri(source, uri, bytes, &why)
            : glb_view(source, glb_integer(image, "bufferView", -1), &bytes->bytes))
        return true;
    return fail(error, ERROR_INPUT, "%s: images[%d]: %s", source->path, (int)index,
                uri ? why.text : "expected its bytes in the file, got none");
}

/// "coat.png": as the picture is called, or its texture's material.
static void name_file(const struct usda_model *model, const struct glb *source, int material, int64_t index,
                      struct glb_bytes bytes, char name[FORM_NAME])
{
    const json_t *image = json_array_get(json_object_get(source->json, "images"), (size_t)index);
    const char *known = json_string_value(json_object_get(image, "name"));
    char stem[FORM_NAME];
    usda_identifier(known && known[0] ? known : model->materials[material], stem);
    snprintf(name, FORM_NAME, "%.40s_%d.%s", stem, (int)index, bytes.size > 0 && bytes.at[0] == 0xFF ? "jpg" : "png");
}

/// The folder beside the file that is written: "walk.usda" → "walk_textures".
static void name_folder(const char *path, char folder[PATH_LIMIT])
{
    const char *dot = strrchr(path, '.');
    snprintf(folder, PATH_LIMIT, "%.*s_textures", dot ? (int)(dot - path) : (int)strlen(path), path);
}

/// Writes a picture into the folder, once. `reference`: how the .usda names it.
static bool write_picture(const struct usda_model *model, struct glb *source, int material, int64_t index,
                          char reference[PATH_LIMIT], struct error *error)
{
    struct beside *beside = &model->take->beside;
    struct glb_buffer bytes;
    char name[FORM_NAME], folder[PATH_LIMIT];
    if (!read_picture(source, index, &bytes, error)) return false;
    name_file(model, source, material, index, bytes.bytes, name);
    name_folder(model->take->path, folder);
    const char *slash = strrchr(folder, '/');
    const bool fits = snprintf(reference, PATH_LIMIT, "./%s/%s", slash ? slash + 1 : folder, name) < PATH_LIMIT;
    const bool done = fits ? beside_add(beside, folder, name, bytes.bytes.at, bytes.bytes.size, error)
                           : fail(error, ERROR_INPUT, "%s: the path is too long", folder);
    free(bytes.owned);
    return done;
}

static const char *wrap_of(const struct glb *source, const json_t *texture, const char *key)
{
    const int64_t sampler = glb_integer(texture, "sampler", -1);
    const json_t *json =
        sampler < 0 ? NULL : json_array_get(json_object_get(source->json, "samplers"), (size_t)sampler);
    const int64_t wrap = glb_integer(json, key, 10497);
    return wrap == 33071 ? "clamp" : wrap == 33648 ? "mirror" : "repeat";
}

static void begin_shader(FILE *out, const char *name, const char *id)
{
    fprintf(out, "\n                def Shader \"%s\"\n                {\n", name);
    fprintf(out, "                    uniform token info:id = \"%s\"\n", id);
}

static void write_texture(const struct usda_model *model, const struct glb *source, int material,
                          const char *reference)
{
    const float *c = model->gltf->materials[material].color;
    const json_t *texture = texture_of(source, material);
    const char *quote = strchr(reference, '@') ? "@@@" : "@", *name = model->materials[material];
    FILE *out = model->out;
    begin_shader(out, "texture", "UsdUVTexture");
    fprintf(out, "                    asset inputs:file = %s%s%s\n", quote, reference, quote);
    fprintf(out, "                    float4 inputs:scale = (%.9g, %.9g, %.9g, %.9g)\n", (double)c[0], (double)c[1],
            (double)c[2], (double)c[3]);
    fputs("                    token inputs:sourceColorSpace = \"sRGB\"\n", out);
    fprintf(out, "                    float2 inputs:st.connect = </scene/%s/materials/%s/st.outputs:result>\n",
            model->name, name);
    fprintf(out, "                    token inputs:wrapS = \"%s\"\n", wrap_of(source, texture, "wrapS"));
    fprintf(out, "                    token inputs:wrapT = \"%s\"\n", wrap_of(source, texture, "wrapT"));
    fputs("                    float outputs:a\n                    float3 outputs:rgb\n                }\n", out);
    begin_shader(out, "st", "UsdPrimvarReader_float2");
    fputs("                    string inputs:varname = \"st\"\n", out);
    fputs("                    float2 outputs:result\n                }\n", out);
}

/// Colours by vertex hold the material's own.
static void write_color_reader(const struct usda_model *model)
{
    begin_shader(model->out, "color", "UsdPrimvarReader_float3");
    fputs("                    string inputs:varname = \"displayColor\"\n", model->out);
    fputs("                    float3 outputs:result\n                }\n", model->out);
}

/// What the source file says of shine, unless a picture says it.
static void write_shine(const struct usda_model *model, const struct glb *source, int material)
{
    const json_t *json = json_array_get(json_object_get(source->json, "materials"), (size_t)material);
    const json_t *metal = json_object_get(json, "pbrMetallicRoughness");
    const json_t *metallic = json_object_get(metal, "metallicFactor"),
                 *rough = json_object_get(metal, "roughnessFactor");
    if (!metal || json_object_get(metal, "metallicRoughnessTexture")) return;
    fprintf(model->out, "                    float inputs:metallic = %.9g\n",
            metallic ? json_number_value(metallic) : 1);
    fprintf(model->out, "                    float inputs:roughness = %.9g\n", rough ? json_number_value(rough) : 1);
}

static void write_surface(const struct usda_model *model, const struct glb *source, int material, bool textured)
{
    const struct gltf_material *m = &model->gltf->materials[material];
    const char *name = model->materials[material], *input = textured ? "texture.outputs:rgb" : "color.outputs:result";
    FILE *out = model->out;
    begin_shader(out, "surface", "UsdPreviewSurface");
    fprintf(out, "                    color3f inputs:diffuseColor.connect = </scene/%s/materials/%s/%s>\n",
            model->name, name, input);
    if ((m->blended || m->cutoff > 0) && textured) {
        fprintf(out,
                "                    float inputs:opacity.connect = </scene/%s/materials/%s/texture.outputs:a>\n",
                model->name, name);
    } else if (m->blended) {
        fprintf(out, "                    float inputs:opacity = %.9g\n", (double)m->color[3]);
    }
    if (m->cutoff > 0) fprintf(out, "                    float inputs:opacityThreshold = %.9g\n", (double)m->cutoff);
    write_shine(model, source, material);
    fputs("                    token outputs:surface\n                }\n", out);
}

static void write_material(const struct usda_model *model, const struct glb *source, int material,
                           const char *reference)
{
    const char *name = model->materials[material];
    fprintf(model->out, "            def Material \"%s\"\n            {\n", name);
    fprintf(model->out,
            "                token outputs:surface.connect = </scene/%s/materials/%s/surface.outputs:surface>\n",
            model->name, name);
    write_surface(model, source, material, *reference);
    if (*reference) {
        write_texture(model, source, material, reference);
    } else {
        write_color_reader(model);
    }
    fputs("            }\n\n", model->out);
}

bool usda_write_materials(struct usda_model *model, struct glb *source, struct error *error)
{
    const json_t *materials = json_object_get(source->json, "materials");
    const int count = model->gltf->material_count;
    char(*references)[PATH_LIMIT] = calloc((size_t)model->gltf->image_count + 1, sizeof *references);
    bool done = references || fail_no_memory(error, source->path);
    fputs("        def Scope \"materials\"\n        {\n", model->out);
    for (int m = 0; done && m < count; m++) {
        const char *name = json_string_value(json_object_get(json_array_get(materials, (size_t)m), "name"));
        const int image = model->gltf->materials[m].image; // −1: none, or it could not be shown
        char *reference = references[image >= 0 ? image + 1 : 0];
        usda_unique(model->materials, m, name ? name : "material", model->materials[m]);
        if (image >= 0 && !*reference)
            done =
                write_picture(model, source, m, glb_integer(texture_of(source, m), "source", -1), reference, error);
        if (done) write_material(model, source, m, reference);
    }
    fputs("        }\n", model->out);
    free(references);
    return done;
}

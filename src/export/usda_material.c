/// The materials of an imported character in a .usda file, and the files of their textures.
#include "export/usda_model.h"
#include <stdlib.h>
#include <string.h>

/// A texture of the .usda: which file, and what happens past its edges.
struct texture {
    char file[PATH_LIMIT]; ///< "./walk_textures/coat_0.png", or empty: none
    const char *wrap[2];
};

/// The folder beside the file that is written: "walk.usda" → "walk_textures".
static void name_folder(const char *path, char folder[PATH_LIMIT])
{
    const char *dot = strrchr(path, '.');
    snprintf(folder, PATH_LIMIT, "%.*s_textures", dot ? (int)(dot - path) : (int)strlen(path), path);
}

/// Writes a picture into the folder: as it is called, or its material.
static bool write_picture(const struct usda_model *model, int material, const struct gltf_texture *picture,
                          struct texture *texture, struct error *error)
{
    char stem[FORM_NAME], name[FORM_NAME], folder[PATH_LIMIT];
    usda_identifier(picture->name ? picture->name : model->materials[material], stem);
    snprintf(name, sizeof name, "%.40s_%d.%s", stem, picture->image,
             picture->size > 0 && picture->at[0] == 0xFF ? "jpg" : "png");
    name_folder(model->shot->path, folder);
    const char *slash = strrchr(folder, '/');
    if (snprintf(texture->file, PATH_LIMIT, "./%s/%s", slash ? slash + 1 : folder, name) >= PATH_LIMIT)
        return fail(error, ERROR_INPUT, "%s: the path is too long", folder);
    return beside_add(&model->shot->beside, folder, name, picture->at, picture->size, error);
}

static bool add_texture(struct usda_model *model, int material, struct texture *texture, struct error *error)
{
    struct gltf_texture picture;
    if (!gltf_source_texture(model->source, material, &picture, error)) return false;
    const bool done = texture->file[0] || write_picture(model, material, &picture, texture, error);
    memcpy(texture->wrap, picture.wrap, sizeof picture.wrap);
    free(picture.owned);
    return done;
}

static void begin_shader(FILE *out, const char *name, const char *id)
{
    fprintf(out, "\n                def Shader \"%s\"\n                {\n", name);
    fprintf(out, "                    uniform token info:id = \"%s\"\n", id);
}

static void write_texture(const struct usda_model *model, int material, const struct texture *texture)
{
    const float *c = model->gltf->materials[material].color;
    const char *quote = strchr(texture->file, '@') ? "@@@" : "@", *name = model->materials[material];
    FILE *out = model->out;
    begin_shader(out, "texture", "UsdUVTexture");
    fprintf(out, "                    asset inputs:file = %s%s%s\n", quote, texture->file, quote);
    fprintf(out, "                    float4 inputs:scale = (%.9g, %.9g, %.9g, %.9g)\n", (double)c[0], (double)c[1],
            (double)c[2], (double)c[3]);
    fputs("                    token inputs:sourceColorSpace = \"sRGB\"\n", out);
    fprintf(out, "                    float2 inputs:st.connect = </scene/%s/materials/%s/st.outputs:result>\n",
            model->name, name);
    fprintf(out, "                    token inputs:wrapS = \"%s\"\n", texture->wrap[0]);
    fprintf(out, "                    token inputs:wrapT = \"%s\"\n", texture->wrap[1]);
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

static void write_surface(const struct usda_model *model, int material, bool textured)
{
    const struct gltf_material *m = &model->gltf->materials[material];
    const char *name = model->materials[material], *input = textured ? "texture.outputs:rgb" : "color.outputs:result";
    double metallic, roughness;
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
    if (gltf_source_shine(model->source, material, &metallic, &roughness)) {
        fprintf(out, "                    float inputs:metallic = %.9g\n", metallic);
        fprintf(out, "                    float inputs:roughness = %.9g\n", roughness);
    }
    fputs("                    token outputs:surface\n                }\n", out);
}

static void write_material(const struct usda_model *model, int material, const struct texture *texture)
{
    const char *name = model->materials[material];
    fprintf(model->out, "            def Material \"%s\"\n            {\n", name);
    fprintf(model->out,
            "                token outputs:surface.connect = </scene/%s/materials/%s/surface.outputs:surface>\n",
            model->name, name);
    write_surface(model, material, texture);
    if (texture) {
        write_texture(model, material, texture);
    } else {
        write_color_reader(model);
    }
    fputs("            }\n\n", model->out);
}

bool usda_write_materials(struct usda_model *model, struct error *error)
{
    const struct gltf *gltf = model->gltf;
    struct texture *textures = calloc((size_t)gltf->image_count + 1, sizeof *textures); // a picture is written once
    bool done = textures || fail_no_memory(error, gltf->path);
    fputs("        def Scope \"materials\"\n        {\n", model->out);
    for (int m = 0; done && m < gltf->material_count; m++) {
        const char *name = gltf_source_material(model->source, m);
        const int image = gltf->materials[m].image; // −1: none, or it could not be shown
        usda_unique(model->materials, m, name ? name : "material", model->materials[m]);
        done = image < 0 || add_texture(model, m, &textures[image], error);
        if (done) write_material(model, m, image >= 0 ? &textures[image] : NULL);
    }
    fputs("        }\n", model->out);
    free(textures);
    return done;
}

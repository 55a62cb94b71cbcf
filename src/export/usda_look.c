/// Writes materials of .usda files.
#include "export/usda_look.h"
#include "base/path.h"
#include <string.h>

/// The folder beside the file that is written: "walk.usda" → "walk_textures".
static void name_folder(const char *path, char folder[PATH_LIMIT])
{
    const char *dot = strrchr(path, '.');
    snprintf(folder, PATH_LIMIT, "%.*s_textures", dot ? (int)(dot - path) : (int)strlen(path), path);
}

bool usda_write_picture(struct shot *shot, const struct usda_picture *picture, char file[PATH_LIMIT],
                        struct error *error)
{
    char stem[FORM_NAME], name[FORM_NAME], folder[PATH_LIMIT];
    usda_identifier(picture->stem, stem);
    snprintf(name, sizeof name, "%.40s_%d.%s", stem, picture->number,
             picture->size > 0 && picture->at[0] == 0xFF ? "jpg" : "png");
    name_folder(shot->path, folder);
    if (snprintf(file, PATH_LIMIT, "./%s/%s", path_name(folder), name) >= PATH_LIMIT)
        return fail(error, ERROR_INPUT, "%s: the path is too long", folder);
    return beside_add(&shot->beside, folder, name, picture->at, picture->size, error);
}

static void begin_shader(FILE *out, const char *name, const char *id)
{
    fprintf(out, "\n                def Shader \"%s\"\n                {\n", name);
    fprintf(out, "                    uniform token info:id = \"%s\"\n", id);
}

static void write_texture(FILE *out, const struct usda_look *look)
{
    const struct usda_texture *texture = look->texture;
    const float *c = look->color;
    const char *quote = strchr(texture->file, '@') ? "@@@" : "@";
    begin_shader(out, "texture", "UsdUVTexture");
    fprintf(out, "                    asset inputs:file = %s%s%s\n", quote, texture->file, quote);
    fprintf(out, "                    float4 inputs:scale = (%.9g, %.9g, %.9g, %.9g)\n", (double)c[0], (double)c[1],
            (double)c[2], (double)c[3]);
    fputs("                    token inputs:sourceColorSpace = \"sRGB\"\n", out);
    fprintf(out, "                    float2 inputs:st.connect = </scene/%s/materials/%s/st.outputs:result>\n",
            look->rig, look->name);
    fprintf(out, "                    token inputs:wrapS = \"%s\"\n", texture->wrap[0]);
    fprintf(out, "                    token inputs:wrapT = \"%s\"\n", texture->wrap[1]);
    fputs("                    float outputs:a\n                    float3 outputs:rgb\n                }\n", out);
    begin_shader(out, "st", "UsdPrimvarReader_float2");
    fputs("                    string inputs:varname = \"st\"\n", out);
    fputs("                    float2 outputs:result\n                }\n", out);
}

/// Colours by vertex hold the material's own.
static void write_color_reader(FILE *out)
{
    begin_shader(out, "color", "UsdPrimvarReader_float3");
    fputs("                    string inputs:varname = \"displayColor\"\n", out);
    fputs("                    float3 outputs:result\n                }\n", out);
}

static void write_surface(FILE *out, const struct usda_look *look)
{
    const char *input = look->texture ? "texture.outputs:rgb" : "color.outputs:result";
    begin_shader(out, "surface", "UsdPreviewSurface");
    if (look->is_plain && !look->texture) {
        fprintf(out, "                    color3f inputs:diffuseColor = (%.9g, %.9g, %.9g)\n", (double)look->color[0],
                (double)look->color[1], (double)look->color[2]);
    } else {
        fprintf(out, "                    color3f inputs:diffuseColor.connect = </scene/%s/materials/%s/%s>\n",
                look->rig, look->name, input);
    }
    if ((look->is_blended || look->cutoff > 0) && look->texture) {
        fprintf(out,
                "                    float inputs:opacity.connect = </scene/%s/materials/%s/texture.outputs:a>\n",
                look->rig, look->name);
    } else if (look->is_blended) {
        fprintf(out, "                    float inputs:opacity = %.9g\n", (double)look->color[3]);
    }
    if (look->cutoff > 0)
        fprintf(out, "                    float inputs:opacityThreshold = %.9g\n", (double)look->cutoff);
    if (look->shines) {
        fprintf(out, "                    float inputs:metallic = %.9g\n", look->metallic);
        fprintf(out, "                    float inputs:roughness = %.9g\n", look->roughness);
    }
    fputs("                    token outputs:surface\n                }\n", out);
}

void usda_write_look(FILE *out, const struct usda_look *look)
{
    fprintf(out, "            def Material \"%s\"\n            {\n", look->name);
    fprintf(out, "                token outputs:surface.connect = </scene/%s/materials/%s/surface.outputs:surface>\n",
            look->rig, look->name);
    write_surface(out, look);
    if (look->texture) {
        write_texture(out, look);
    } else if (!look->is_plain) {
        write_color_reader(out);
    }
    fputs("            }\n\n", out);
}

void usda_begin_subset(FILE *out, int number)
{
    fprintf(out, "\n            def GeomSubset \"part_%d\" (\n", number);
    fputs("                prepend apiSchemas = [\"MaterialBindingAPI\"]\n            )\n            {\n", out);
    fputs("                uniform token elementType = \"face\"\n", out);
    fputs("                uniform token familyName = \"materialBind\"\n                int[] indices = [", out);
}

void usda_end_subset(FILE *out, const char *rig, const char *material)
{
    fputs("]\n", out);
    if (material) fprintf(out, "                rel material:binding = </scene/%s/materials/%s>\n", rig, material);
    fputs("            }\n", out);
}

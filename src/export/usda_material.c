/// The materials of a rig in a .usda file, and the files of their textures, in a folder beside it.
#include "base/file.h"
#include "base/need.h"
#include "export/usda.h"
#include <stdlib.h>
#include <string.h>

/// A material being written; `file` is that of its texture, or empty.
struct usda_look {
    const struct usda_model *model;
    const struct gltf_material *material;
    const char *name, *file;
    bool is_plain; ///< no vertex of it has a colour of its own
};

/// Writes a picture's file, into a folder called as the .usda: "walk.usda" → "walk_textures". False with a sentence.
static bool write_picture(const struct usda_model *model, const char *stem, const struct gltf_image *image,
                          char file[PATH_LIMIT], struct error *error)
{
    const char *path = model->range->path, *dot = strrchr(path, '.');
    char name[80], folder[PATH_LIMIT];
    struct names none = usda_names();
    snprintf(name, sizeof name, "%s_%d.%s", usda_name(&none, stem, false), model->range->sidecars.count,
             image->bytes[0] == 0xFF ? "jpg" : "png");
    names_free(&none);
    char *stem_name = name_from(path_name(path), dot ? (size_t)(dot - path_name(path)) : strlen(path_name(path)));
    snprintf(folder, PATH_LIMIT, "%.*s%s_textures", (int)(path_name(path) - path), path, stem_name);
    free(stem_name);
    if (snprintf(file, PATH_LIMIT, "./%s/%s", path_name(folder), name) >= PATH_LIMIT)
        return fail(error, ERROR_INPUT, "%s: the path is too long", folder);
    return sidecars_add(&model->range->sidecars, folder, name, image->bytes, image->size, error);
}

static void begin_shader(FILE *out, const char *name, const char *id)
{
    fprintf(out, "\n                def Shader \"%s\"\n                {\n", name);
    fprintf(out, "                    uniform token info:id = \"%s\"\n", id);
}

/// "name.connect = </…>", to an output of another shader of the material.
static void connect(const struct usda_look *look, const char *name, const char *output)
{
    fprintf(look->model->out, "                    %s.connect = </scene/%s/materials/%s/%s>\n", name,
            look->model->name, look->name, output);
}

static const char *wrap_of(int wrap)
{
    return wrap == GLTF_CLAMPED ? "clamp" : wrap == GLTF_MIRRORED ? "mirror" : "repeat";
}

static void write_texture(const struct usda_look *look)
{
    FILE *out = look->model->out;
    const float *c = look->material->color;
    const char *quote = strchr(look->file, '@') ? "@@@" : "@";
    begin_shader(out, "texture", "UsdUVTexture");
    fprintf(out, "                    asset inputs:file = %s%s%s\n", quote, look->file, quote);
    fprintf(out, "                    float4 inputs:scale = (%.9g, %.9g, %.9g, %.9g)\n", (double)c[0], (double)c[1],
            (double)c[2], (double)c[3]);
    fputs("                    token inputs:sourceColorSpace = \"sRGB\"\n", out);
    connect(look, "float2 inputs:st", "st.outputs:result");
    fprintf(out, "                    token inputs:wrapS = \"%s\"\n", wrap_of(look->material->sampler.wrap[0]));
    fprintf(out, "                    token inputs:wrapT = \"%s\"\n", wrap_of(look->material->sampler.wrap[1]));
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

static void write_surface(const struct usda_look *look)
{
    FILE *out = look->model->out;
    const struct gltf_material *m = look->material;
    begin_shader(out, "surface", "UsdPreviewSurface");
    if (look->is_plain && !look->file[0]) {
        usda_vector(out, "                    color3f inputs:diffuseColor = ", m->color);
        fputc('\n', out);
    } else {
        connect(look, "color3f inputs:diffuseColor", look->file[0] ? "texture.outputs:rgb" : "color.outputs:result");
    }
    if ((m->blended || m->cutoff > 0) && look->file[0]) {
        connect(look, "float inputs:opacity", "texture.outputs:a");
    } else if (m->blended) {
        fprintf(out, "                    float inputs:opacity = %.9g\n", (double)m->color[3]);
    }
    if (m->cutoff > 0) fprintf(out, "                    float inputs:opacityThreshold = %.9g\n", (double)m->cutoff);
    if (m->shines) {
        fprintf(out, "                    float inputs:metallic = %.9g\n", m->metallic);
        fprintf(out, "                    float inputs:roughness = %.9g\n", m->roughness);
    }
    fputs("                    token outputs:surface\n                }\n", out);
}

static void write_material(const struct usda_look *look)
{
    FILE *out = look->model->out;
    usda_begin(out, 12, "Material", look->name, look->material->name, NULL);
    fprintf(out, "                token outputs:surface.connect = </scene/%s/materials/%s/surface.outputs:surface>\n",
            look->model->name, look->name);
    write_surface(look);
    if (look->file[0]) {
        write_texture(look);
    } else if (!look->is_plain) {
        write_color_reader(out);
    }
    fputs("            }\n\n", out);
}

/// Marks the materials of vertices that have colours of their own.
static void mark_colored(const struct gltf *gltf, bool *colored)
{
    for (int m = 0; m < gltf->mesh_count; m++) {
        for (int p = 0; p < gltf->meshes[m].part_count; p++) {
            const struct gltf_part *part = &gltf->meshes[m].parts[p];
            bool *is_colored = part->material >= 0 && part->color ? &colored[part->material] : NULL;
            for (int i = 0; is_colored && !*is_colored && i < part->vertex_count; i++) {
                const float *c = part->color[i];
                *is_colored = c[0] != 1 || c[1] != 1 || c[2] != 1;
            }
        }
    }
}

bool usda_write_materials(struct usda_model *model, struct error *error)
{
    const struct gltf *gltf = model->gltf;
    char(*files)[PATH_LIMIT] = need_zeroed((size_t)gltf->image_count + 1, sizeof *files); // a picture is written once
    bool *colored = need_zeroed((size_t)gltf->material_count + 1, sizeof *colored);
    bool done = true;
    mark_colored(gltf, colored);
    fputs("        def Scope \"materials\"\n        {\n", model->out);
    for (int m = 0; done && m < gltf->material_count; m++) {
        model->materials[m] = usda_name(&model->material_prims, gltf->materials[m].name, false);
        struct usda_look look = {model, &gltf->materials[m], model->materials[m], "", !colored[m]};
        const int number = look.material->image; // −1: none, or it could not be shown
        const struct gltf_image *image = number >= 0 ? &gltf->images[number] : NULL;
        if (image) look.file = files[number];
        if (image && !look.file[0])
            done = write_picture(model, image->name ? image->name : look.name, image, files[number], error);
        if (done) write_material(&look);
    }
    fputs("        }\n", model->out);
    free(colored);
    free(files);
    return done;
}

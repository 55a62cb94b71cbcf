/// The materials of an imported character in a .usda file, and the files of their textures.
#include "export/usda_look.h"
#include "export/usda_model.h"
#include <stdlib.h>
#include <string.h>

/// Writes the picture's file the first time: as the picture is called, or its material.
static bool add_texture(struct usda_model *model, int material, struct usda_texture *texture, struct error *error)
{
    struct gltf_texture of;
    if (!gltf_source_texture(model->source, material, &of, error)) return false;
    const struct usda_picture picture = {of.name ? of.name : model->materials[material], of.image, of.at, of.size};
    const bool done = texture->file[0] || usda_write_picture(model->shot, &picture, texture->file, error);
    memcpy(texture->wrap, of.wrap, sizeof of.wrap);
    free(of.owned);
    return done;
}

static void write_material(const struct usda_model *model, int material, const struct usda_texture *texture)
{
    const struct gltf_material *m = &model->gltf->materials[material];
    struct usda_look look = {.rig = model->name,
                             .name = model->materials[material],
                             .texture = texture,
                             .is_blended = m->blended,
                             .cutoff = m->cutoff};
    memcpy(look.color, m->color, sizeof look.color);
    look.shines = gltf_source_shine(model->source, material, &look.metallic, &look.roughness);
    usda_write_look(model->out, &look);
}

bool usda_write_materials(struct usda_model *model, struct error *error)
{
    const struct gltf *gltf = model->gltf;
    struct usda_texture *textures =
        calloc((size_t)gltf->image_count + 1, sizeof *textures); // a picture is written once
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

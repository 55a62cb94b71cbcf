/// Writes the faces, colours and materials of forms as USD.
#include "export/usda_form.h"
#include "model/surface.h"
#include <stdlib.h>
#include <string.h>

// --- materials

static bool write_material(const struct usda_form *f, struct shot *shot, int number, bool colored,
                           struct error *error)
{
    const struct looks_material *material = &f->form->looks->materials[number];
    struct usda_texture texture = {.wrap = {"repeat", "repeat"}};
    struct usda_look look = {.rig = f->rig,
                             .name = f->materials[number],
                             .is_blended = material->color[3] < 1,
                             .is_plain = !colored,
                             .shines = true,
                             .roughness = 0.8};
    memcpy(look.color, material->color, sizeof look.color);
    if (material->image) {
        const struct usda_picture picture = {look.name, shot->beside.count, material->image, material->image_size};
        if (!usda_write_picture(shot, &picture, texture.file, error)) return false;
        look.texture = &texture;
    }
    usda_write_look(f->out, &look);
    return true;
}

/// Whether vertices have colours of their own.
static bool has_colors(const struct form *form)
{
    for (int i = 0; i < 3 * form->vertex_count; i++) {
        if (form->color[i / 3][i % 3] != 1) return true;
    }
    return false;
}

bool usda_form_open(struct usda_form *f, struct shot *shot, struct error *error)
{
    const struct looks *looks = f->form->looks;
    if (!looks || !looks_show(looks)) return true; // what is white everywhere says nothing
    const bool colored = has_colors(f->form);
    f->materials = calloc((size_t)looks->material_count, sizeof *f->materials);
    if (!f->materials) return fail_no_memory(error, f->form->name);
    fputs("        def Scope \"materials\"\n        {\n", f->out);
    for (int m = 0; m < looks->material_count; m++) {
        usda_unique(f->materials, m, looks->materials[m].name, f->materials[m]);
        if (!write_material(f, shot, m, colored, error)) return false;
    }
    fputs("        }\n\n", f->out);
    return true;
}

void usda_form_close(struct usda_form *f)
{
    free(f->materials);
    f->materials = NULL;
}

// --- faces

/// The triangle behind the polygon that begins with this one.
static int polygon_end(const struct form *form, int triangle)
{
    const struct looks *looks = form->looks;
    int end = triangle + 1;
    while (looks && looks->joined && end < form->index_count / 3 && looks->joined[end]) end++;
    return end;
}

static void write_polygons(const struct usda_form *f)
{
    const struct form *form = f->form;
    const int triangles = form->index_count / 3;
    const char *before = "";
    fputs("            int[] faceVertexCounts = [", f->out);
    for (int t = 0, end; t < triangles; t = end, before = ", ") {
        end = polygon_end(form, t);
        fprintf(f->out, "%s%d", before, end - t + 2);
    }
    fputs("]\n            int[] faceVertexIndices = [", f->out);
    for (int t = 0, end; t < triangles; t = end) {
        end = polygon_end(form, t);
        fprintf(f->out, "%s%u, %u", t > 0 ? ", " : "", form->indices[3 * t], form->indices[3 * t + 1]);
        for (int n = t; n < end; n++) fprintf(f->out, ", %u", form->indices[3 * n + 2]);
    }
    fputs("]\n            uniform token subdivisionScheme = \"none\"\n", f->out);
}

/// The colours of the vertices times those of their materials, for who has no materials: where two meet, that of the later triangle.
static void write_colors(const struct usda_form *f)
{
    const struct form *form = f->form;
    float(*tint)[3] = f->materials ? malloc((size_t)form->vertex_count * sizeof *tint) : NULL;
    if (tint) memcpy(tint, form->color, (size_t)form->vertex_count * sizeof *tint);
    for (int i = 0; tint && i < form->index_count; i++) {
        const uint32_t vertex = form->indices[i], material = form->looks->material[i / 3];
        for (int k = 0; material < (uint32_t)form->looks->material_count && k < 3; k++)
            tint[vertex][k] = form->color[vertex][k] * form->looks->materials[material].color[k];
    }
    usda_vectors(f->out, "color3f[] primvars:displayColor", tint ? (const float(*)[3])tint : form->color,
                 form->vertex_count);
    usda_by_vertex(f->out, 0);
    free(tint);
}

/// USD counts upwards.
static void write_uvs(const struct usda_form *f)
{
    const float(*uv)[2] = f->form->looks ? (const float(*)[2])f->form->looks->uv : NULL;
    if (!uv) return;
    fputs("            texCoord2f[] primvars:st = [", f->out);
    for (int i = 0; i < f->form->vertex_count; i++)
        fprintf(f->out, "%s(%.9g, %.9g)", i > 0 ? ", " : "", (double)uv[i][0], 1 - (double)uv[i][1]);
    fputs("]", f->out);
    usda_by_vertex(f->out, 0);
}

void usda_form_faces(const struct usda_form *f)
{
    write_colors(f);
    write_uvs(f);
    write_polygons(f);
}

void usda_form_subsets(const struct usda_form *f)
{
    const struct form *form = f->form;
    if (!f->materials) return;
    fputs("            uniform token subsetFamily:materialBind:familyType = \"nonOverlapping\"\n", f->out);
    for (int m = 0; m < form->looks->material_count; m++) {
        const char *before = "";
        usda_begin_subset(f->out, m + 1);
        for (int t = 0, face = 0; t < form->index_count / 3; t = polygon_end(form, t), face++) {
            if (form->looks->material[t] != (uint32_t)m) continue;
            fprintf(f->out, "%s%d", before, face);
            before = ", ";
        }
        usda_end_subset(f->out, f->rig, f->materials[m]);
    }
}

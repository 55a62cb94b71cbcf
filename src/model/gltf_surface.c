/// Makes one surface of all that a glTF file shows at rest.
#include "model/gltf.h"
#include "model/surface_readers.h"
#include "model/vector.h"
#include <stdlib.h>
#include <string.h>

/// The base colour and, where that takes no more than `room`, the bytes of its picture.
static bool copy_look(const struct gltf *gltf, int number, size_t room, struct looks_material *look)
{
    const struct gltf_material *material = &gltf->materials[number];
    for (int k = 0; k < 4; k++) look->color[k] = glm_clamp(material->color[k], 0, 1);
    const struct gltf_image *image = material->image >= 0 ? &gltf->images[material->image] : NULL;
    if (look->image || !image || image->size > room || !looks_image_kind(image->bytes, image->size)) return true;
    look->image = malloc(image->size);
    if (!look->image) return false;
    memcpy(look->image, image->bytes, image->size);
    look->image_size = image->size;
    return true;
}

bool gltf_copy_looks(const struct gltf *gltf, struct looks *looks)
{
    size_t room = LOOKS_IMAGES_LIMIT;
    looks->materials = calloc((size_t)gltf->material_count + 1, sizeof *looks->materials);
    if (!looks->materials) return false;
    for (int m = 0; m < gltf->material_count; m++) {
        struct looks_material *look = &looks->materials[looks->material_count++];
        look->name = strdup(gltf->materials[m].name);
        if (!look->name || !copy_look(gltf, m, room, look)) return false;
        room -= look->image_size;
    }
    return true;
}

static uint32_t add_material(struct surface_builder *b, const struct gltf *gltf, int number)
{
    const uint32_t index = builder_material(b, gltf->materials[number].name);
    if (index == LOOKS_NONE) return index;
    const size_t used = looks_image_bytes(&b->surface->looks);
    const size_t room = used < LOOKS_IMAGES_LIMIT ? LOOKS_IMAGES_LIMIT - used : 0;
    b->failed = b->failed || !copy_look(gltf, number, room, &b->surface->looks.materials[index]);
    return index;
}

static void add_part(struct surface_builder *b, const struct gltf *gltf, const struct gltf_part *part,
                     float (*position)[3])
{
    const int first = b->surface->vertex_count, first_uv = b->surface->looks.uv_count;
    b->material = part->material >= 0 ? add_material(b, gltf, part->material) : LOOKS_NONE;
    for (int i = 0; i < part->vertex_count && !b->failed; i++) {
        const double p[3] = {(double)position[i][0], (double)position[i][1], (double)position[i][2]};
        builder_vertex(b, p);
        if (part->color) {
            const float *c = part->color[i];
            const float rgb[3] = {glm_clamp(c[0], 0, 1), glm_clamp(c[1], 0, 1), glm_clamp(c[2], 0, 1)};
            builder_linear_color(b, rgb);
        }
        if (part->uv) builder_uv(b, (double)part->uv[i][0], (double)part->uv[i][1]);
    }
    for (int i = 0; i + 2 < part->index_count && !b->failed; i += 3) {
        const uint32_t *corner = part->indices + i;
        const bool joined = gltf_joins(part, i);
        if (!joined) builder_end_polygon(b);
        for (int k = joined ? 2 : 0; k < 3; k++)
            builder_corner(b, (uint32_t)first + corner[k], part->uv ? (uint32_t)first_uv + corner[k] : LOOKS_NONE);
    }
    builder_end_polygon(b);
}

static bool add_nodes(struct surface_builder *b, const struct gltf *gltf, const struct gltf_pose *pose)
{
    for (int n = 0; n < gltf->node_count; n++) {
        const int count = gltf_vertex_count(gltf, n);
        if (count == 0) continue;
        float(*position)[3] = malloc((size_t)count * sizeof *position);
        if (!position) return false;
        gltf_pose_vertices(gltf, pose, n, position, NULL);
        const struct gltf_mesh *mesh = &gltf->meshes[gltf->nodes[n].mesh];
        for (int p = 0, first = 0; p < mesh->part_count; first += mesh->parts[p++].vertex_count)
            add_part(b, gltf, &mesh->parts[p], position + first);
        free(position);
    }
    return true;
}

bool gltf_surface_read(const char *path, struct surface *surface, struct error *error)
{
    struct gltf gltf;
    struct gltf_pose pose;
    *surface = (struct surface){0};
    if (!gltf_read_stored(path, &gltf, error)) return false;
    struct surface_builder builder = {.surface = surface, .material = LOOKS_NONE};
    if (gltf_pose_create(&gltf, &pose)) {
        gltf_pose_clip(&gltf, -1, 0, &pose);
        gltf_pose_world(&gltf, &pose);
        builder.failed = !add_nodes(&builder, &gltf, &pose) || builder.failed;
        gltf_pose_free(&pose);
    } else {
        builder.failed = true;
    }
    gltf_free(&gltf);
    return builder_finish(&builder, path, "a glTF file", error);
}

/// Makes one surface of all that a glTF file shows at rest.
#include "base/png.h"
#include "model/gltf.h"
#include "model/surface_readers.h"
#include "model/vector.h"
#include <stdlib.h>
#include <string.h>

struct encoded {
    unsigned char *bytes;
    size_t size;
};

/// The encoder hands the whole file over.
static void keep_png(void *user, const void *bytes, size_t size)
{
    struct encoded *encoded = user;
    encoded->bytes = malloc(size);
    if (!encoded->bytes) return;
    memcpy(encoded->bytes, bytes, size);
    encoded->size = size;
}

static uint32_t add_material(struct surface_builder *b, const struct gltf *gltf, int number)
{
    const uint32_t index = builder_material(b, gltf->materials[number].name);
    if (index == LOOKS_NONE) return index;
    struct looks_material *to = &b->surface->looks.materials[index];
    const struct gltf_material *from = &gltf->materials[number];
    memcpy(to->color, from->color, sizeof to->color);
    const bool room = looks_image_bytes(&b->surface->looks) < LOOKS_IMAGES_LIMIT / 2;
    if (to->image || from->image < 0 || !room) return index;
    const struct gltf_image *image = &gltf->images[from->image];
    struct encoded encoded = {0};
    png_encode(keep_png, &encoded, image->width, image->height, 4, image->pixels, PNG_SMALL);
    b->failed = b->failed || !encoded.bytes;
    to->image = encoded.bytes;
    to->image_size = encoded.size;
    return index;
}

static void add_part(struct surface_builder *b, const struct gltf *gltf, const struct gltf_part *part,
                     float (*position)[3])
{
    const int first = b->surface->vertex_count, first_uv = b->surface->looks.uv_count;
    const int first_index = b->surface->index_count;
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
        const bool joined =
            part->has_polygons && i > 0 && corner[0] == corner[-3] && corner[1] == corner[-1]; // goes on with the fan
        if (!joined) builder_end_polygon(b);
        for (int k = joined ? 2 : 0; k < 3; k++)
            builder_corner(b, (uint32_t)first + corner[k], part->uv ? (uint32_t)first_uv + corner[k] : LOOKS_NONE);
    }
    builder_end_polygon(b);
    if (part->flat && !b->failed)
        builder_merge(b, first, first_index); // the reader has given each triangle vertices of its own
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
    if (!gltf_read(path, &gltf, error)) return false;
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

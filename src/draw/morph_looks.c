/// Uploads the pictures of soft characters, and sorts their triangles by material.
#include "draw/morph_looks.h"
#include "base/need.h"
#include "model/gltf.h"
#include <stdlib.h>
#include <string.h>

enum { PIXEL_ROOM = 256 << 20 };

/// The material before number m that has the same picture, or −1.
static int same_picture(const struct looks *looks, int m)
{
    const struct looks_material *own = &looks->materials[m];
    for (int other = 0; other < m; other++) {
        const struct looks_material *o = &looks->materials[other];
        if (o->image && o->image_size == own->image_size && memcmp(o->image, own->image, own->image_size) == 0)
            return other;
    }
    return -1;
}

/// What cannot be decoded, or is larger than the driver takes, stays white.
static long upload_picture(struct morph_looks *looks, const struct looks *from, int m, size_t *room)
{
    const struct looks_material *material = &from->materials[m];
    const int other = material->image ? same_picture(from, m) : -1, largest = gl_largest_texture();
    struct gltf_image image = {0};
    looks->pictures[m] = looks->pictures[from->material_count];
    if (other >= 0) looks->pictures[m] = looks->pictures[other];
    if (!material->image || other >= 0) return 0;
    if (!gltf_decode_image(material->image, material->image_size, *room, &image, NULL)) return 0;
    const long bytes = 4L * image.width * image.height;
    const bool fits = image.width <= largest && image.height <= largest;
    if (fits) looks->pictures[m] = gl_picture(image.pixels, image.width, image.height);
    free(image.pixels);
    *room -= (size_t)bytes;
    return fits ? bytes : 0;
}

long morph_looks_create(struct morph_looks *looks, const struct figure *figure)
{
    const struct looks *from = &figure->character.looks;
    size_t room = PIXEL_ROOM;
    long bytes = 0;
    *looks = (struct morph_looks){0};
    if (!looks_show(from)) return 0;
    looks->pictures = need_zeroed((size_t)from->material_count + 1, sizeof *looks->pictures);
    looks->picture_count = from->material_count + 1;
    looks->pictures[from->material_count] = gl_white();
    for (int m = 0; m < from->material_count; m++) bytes += upload_picture(looks, from, m, &room);
    for (int coarse = 0; coarse < 2; coarse++)
        looks->ranges[coarse] = need_zeroed((size_t)looks->picture_count, sizeof *looks->ranges[coarse]);
    looks->range_count = looks->picture_count;
    return bytes;
}

void morph_looks_free(struct morph_looks *looks)
{
    glDeleteTextures(looks->picture_count, looks->pictures); // of one name twice the second is no texture any more
    for (int coarse = 0; coarse < 2; coarse++) free(looks->ranges[coarse]);
    free(looks->pictures);
    *looks = (struct morph_looks){0};
}

uint32_t *morph_looks_sort(struct morph_looks *looks, const struct figure *figure, bool coarse)
{
    const struct character *c = &figure->character;
    const uint32_t *indices = coarse ? figure->coarse : c->indices, *material = c->looks.material;
    const int count = coarse ? figure->coarse_count : c->index_count, materials = c->looks.material_count;
    uint32_t *sorted = need((size_t)count + 1, sizeof *sorted);
    GLsizei used = 0;
    for (int m = 0; m <= materials; m++) {
        struct morph_range *range = &looks->ranges[coarse][m];
        *range = (struct morph_range){.first = used, .color = {1, 1, 1, 1}, .picture = looks->pictures[m]};
        if (m < materials) memcpy(range->color, c->looks.materials[m].color, sizeof range->color);
        for (int i = 0; i < count; i += 3) {
            const uint32_t of = material[coarse ? figure->coarse_from[i / 3] : (uint32_t)i / 3];
            if ((of < (uint32_t)materials ? of : (uint32_t)materials) != (uint32_t)m) continue;
            memcpy(sorted + used, indices + i, 3 * sizeof *sorted);
            used += 3;
        }
        range->count = used - range->first;
    }
    return sorted;
}

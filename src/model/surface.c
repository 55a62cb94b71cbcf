/// Measures and frees surfaces.
#include "model/surface.h"
#include "base/need.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

uint8_t *surface_used_vertices(const struct surface *surface)
{
    uint8_t *used = need_zeroed((size_t)surface->vertex_count + 1, 1);
    for (int i = 0; i < surface->index_count; i++) used[surface->indices[i]] = 1;
    return used;
}

void surface_bounds(const struct surface *surface, double lo[3], double hi[3])
{
    for (int c = 0; c < 3; c++) {
        lo[c] = INFINITY;
        hi[c] = -INFINITY;
    }
    for (int i = 0; i < surface->index_count; i++) {
        const float *p = surface->position[surface->indices[i]];
        for (int c = 0; c < 3; c++) {
            lo[c] = fmin(lo[c], (double)p[c]);
            hi[c] = fmax(hi[c], (double)p[c]);
        }
    }
}

void surface_free(struct surface *surface)
{
    free(surface->position);
    free(surface->color);
    free(surface->indices);
    looks_free(&surface->looks);
    *surface = (struct surface){0};
}

const char *looks_image_kind(const unsigned char *bytes, size_t size)
{
    if (size > 8 && memcmp(bytes, "\x89PNG\r\n\x1a\n", 8) == 0) return "png";
    return size > 3 && memcmp(bytes, "\xFF\xD8\xFF", 3) == 0 ? "jpeg" : NULL;
}

size_t looks_image_bytes(const struct looks *looks)
{
    size_t sum = 0;
    for (int m = 0; m < looks->material_count; m++) sum += looks->materials[m].image_size;
    return sum;
}

void looks_free(struct looks *looks)
{
    for (int m = 0; m < looks->material_count; m++) {
        free(looks->materials[m].name);
        free(looks->materials[m].image);
    }
    free(looks->materials);
    free(looks->uv);
    free(looks->corner);
    free(looks->material);
    free(looks->joined);
    free(looks->left_out);
    *looks = (struct looks){0};
}

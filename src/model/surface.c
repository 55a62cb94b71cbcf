/// Reads surfaces of any format, and copies, measures and frees surfaces.
#include "model/surface.h"
#include "base/file.h"
#include "base/need.h"
#include "model/surface_readers.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { FILE_LIMIT = 1 << 30 };

bool surface_read(const char *path, struct surface *surface, struct error *error)
{
    static const struct {
        const char *end, *kind;
        bool (*read)(struct words *words, struct surface_builder *builder);
    } formats[] = {{".stl", "an STL file", stl_read},           {".ply", "a PLY file", ply_read},
                   {".off", "an OFF file", off_read},           {".glb", "a glTF file", gltf_surface_read},
                   {".gltf", "a glTF file", gltf_surface_read}, {"", "an OBJ file", obj_read}};
    struct words words = {.path = path, .line = 1, .error = error};
    struct surface_builder builder = {.surface = surface, .material = LOOKS_NONE};
    char *data = NULL;
    size_t size = 0;
    int i = 0;
    *surface = (struct surface){0};
    while (formats[i].end[0] && !path_has_end(path, formats[i].end)) i++;
    if (formats[i].read != gltf_surface_read && !file_read_text(path, FILE_LIMIT, &data, &size, error)) return false;
    if (data) words.at = data, words.end = data + size; // the glTF reader opens the file itself
    const bool done = formats[i].read(&words, &builder);
    free(data);
    if (done) return builder_finish(&builder, path, formats[i].kind, error);
    surface_free(surface);
    return false;
}

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

void looks_drop_unused(struct looks *looks, int triangles)
{
    bool dressed = false, polygons = false;
    for (int t = 0; t < triangles; t++) {
        dressed = dressed || looks->material[t] < (uint32_t)looks->material_count;
        polygons = polygons || looks->joined[t];
    }
    if (!dressed) {
        free(looks->material);
        looks->material = NULL;
    }
    if (!polygons) {
        free(looks->joined);
        looks->joined = NULL;
    }
}

bool looks_show(const struct looks *looks)
{
    for (int m = 0; looks->material && m < looks->material_count; m++) {
        const float *c = looks->materials[m].color;
        if (looks->materials[m].image || c[0] != 1 || c[1] != 1 || c[2] != 1 || c[3] != 1) return true;
    }
    return false;
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

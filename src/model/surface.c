/// Measures and frees surfaces; builds them vertex by vertex and polygon by polygon, and splits text into words and numbers, for their readers.
#include "model/surface.h"
#include "base/names.h"
#include "base/need.h"
#include "base/png.h"
#include "model/adjacency.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

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

// --- building

enum { COUNT_LIMIT = 1 << 28, COLOR_LIMIT = 1000 };

/// array[count] = *value, in an array that grows. The caller counts. After running out of memory nothing is added.
static bool put(struct surface_builder *b, void *array, int count, int *capacity, const void *value, size_t size)
{
    char *block;
    if (b->failed) return false;
    memcpy(&block, array, sizeof block);
    if (count == *capacity) {
        const int wanted = *capacity ? 2 * *capacity : 256;
        block = count < COUNT_LIMIT ? realloc(block, size * (size_t)wanted) : NULL;
        b->failed = !block;
        if (b->failed) return false;
        *capacity = wanted;
        memcpy(array, &block, sizeof block);
    }
    memcpy(block + (size_t)count * size, value, size);
    return true;
}

void builder_linear_color(struct surface_builder *b, const float rgb[3])
{
    static const float white[3] = {1, 1, 1};
    struct surface *s = b->surface;
    if (s->vertex_count == 0) return;
    for (int i = s->color ? s->vertex_count - 1 : 0; i < s->vertex_count; i++) {
        const float *color = i + 1 < s->vertex_count ? white : rgb;
        if (!put(b, &s->color, i, &b->colors, color, sizeof *s->color)) return;
    }
}

const double *builder_wrong_color(const double srgb[3])
{
    for (int k = 0; k < 3; k++) {
        if (!(fabs(srgb[k]) <= COLOR_LIMIT)) return &srgb[k];
    }
    return NULL;
}

void builder_color(struct surface_builder *b, const double srgb[3])
{
    float rgb[3];
    for (int k = 0; k < 3; k++) rgb[k] = srgb_to_linear((float)srgb[k]);
    builder_linear_color(b, rgb);
}

void builder_vertex(struct surface_builder *b, const double position[3])
{
    static const float white[3] = {1, 1, 1};
    struct surface *s = b->surface;
    const float p[3] = {(float)position[0], (float)position[1], (float)position[2]};
    if (!put(b, &s->position, s->vertex_count, &b->vertices, p, sizeof p)) return;
    s->vertex_count++;
    if (s->color) builder_linear_color(b, white);
}

void builder_uv(struct surface_builder *b, double u, double v)
{
    struct looks *looks = &b->surface->looks;
    const float uv[2] = {(float)u, (float)v};
    if (put(b, &looks->uv, looks->uv_count, &b->uvs, uv, sizeof uv)) looks->uv_count++;
}

void builder_corner(struct surface_builder *b, uint32_t vertex, uint32_t uv)
{
    const uint32_t corner[2] = {vertex, uv}, *const corners[3] = {b->first, b->last, corner};
    struct surface *s = b->surface;
    struct looks *looks = &s->looks;
    const uint8_t joined = b->polygon > 2;
    bool added = b->polygon >= 2;
    for (int k = 0; k < 3; k++) {
        const int at = s->index_count + k;
        added = added && put(b, &s->indices, at, &b->indices, corners[k], sizeof(uint32_t)) &&
                put(b, &looks->corner, at, &b->corners, corners[k] + 1, sizeof(uint32_t));
    }
    if (added && put(b, &looks->material, s->index_count / 3, &b->materials_of, &b->material, sizeof b->material) &&
        put(b, &looks->joined, s->index_count / 3, &b->joins, &joined, sizeof joined))
        s->index_count += 3;
    memcpy(b->polygon ? b->last : b->first, corner, sizeof corner);
    b->polygon++;
}

int builder_end_polygon(struct surface_builder *b)
{
    const int corners = b->polygon;
    b->polygon = 0;
    return corners;
}

uint32_t builder_material(struct surface_builder *b, const char *name)
{
    struct looks *looks = &b->surface->looks;
    const struct looks_material material = {.name = name_from(name, strlen(name)), .color = {1, 1, 1, 1}};
    int m = 0;
    while (m < looks->material_count && strcmp(looks->materials[m].name, material.name) != 0) m++;
    if (m == looks->material_count &&
        put(b, &looks->materials, looks->material_count, &b->materials, &material, sizeof material))
        return (uint32_t)looks->material_count++;
    free(material.name);
    b->failed |= m == looks->material_count;
    return b->failed ? LOOKS_NONE : (uint32_t)m;
}

void builder_merge(struct surface_builder *b)
{
    struct surface *s = b->surface;
    const size_t count = (size_t)s->vertex_count;
    struct spot *spots = malloc((count + 1) * sizeof *spots);
    uint32_t *name =
        malloc((count + 1) * sizeof *name); // first each vertex's earliest at its place, then that one's new number
    if (spots && name) {
        spots_sort((const float(*)[3])s->position, s->vertex_count, spots);
        spots_first(spots, s->vertex_count, name);
        s->vertex_count = 0;
        for (size_t i = 0; i < count; i++) {
            const bool is_first = name[i] == (uint32_t)i;
            if (is_first) memmove(s->position[s->vertex_count], s->position[i], sizeof *s->position);
            name[i] = is_first ? (uint32_t)s->vertex_count++ : name[name[i]];
        }
        for (int i = 0; i < s->index_count; i++) s->indices[i] = name[s->indices[i]];
    } else {
        b->failed = true;
    }
    free(spots);
    free(name);
}

bool builder_finish(struct surface_builder *b, const char *path, const char *kind, struct error *error)
{
    struct surface *s = b->surface;
    struct looks *looks = &s->looks;
    const char *missing = s->vertex_count == 0 ? "vertices" : s->index_count == 0 ? "faces" : NULL;
    int kept = 0;
    bool begun = false,
         textured = false; // whether a triangle of the polygon was kept: the rest stays one if it is still a fan
    for (int t = 0; !b->failed && t < s->index_count / 3; t++) {
        const uint32_t *corner = s->indices + 3 * t;
        begun = begun && looks->joined[t];
        if (triangle_repeats(corner)) continue;
        looks->joined[kept] =
            begun && corner[1] == s->indices[3 * kept - 1] && looks->corner[3 * t + 1] == looks->corner[3 * kept - 1];
        looks->material[kept] = looks->material[t];
        memmove(s->indices + 3 * kept, corner, 3 * sizeof *s->indices);
        memmove(looks->corner + 3 * kept, looks->corner + 3 * t, 3 * sizeof *looks->corner);
        begun = true;
        kept++;
    }
    s->index_count = 3 * kept;
    if (b->failed || missing || kept == 0) {
        surface_free(s);
        if (b->failed) return fail_no_memory(error, path);
        if (missing) return fail(error, ERROR_INPUT, "%s: expected %s with %s, got none", path, kind, missing);
        return fail(error, ERROR_INPUT, "%s: expected %s with faces of three different vertices, got others alone",
                    path, kind);
    }

    for (int i = 0; i < s->index_count; i++) textured = textured || looks->corner[i] != LOOKS_NONE;
    if (!textured) {
        free(looks->uv);
        free(looks->corner);
        looks->uv = NULL;
        looks->corner = NULL;
        looks->uv_count = 0;
    }
    looks_drop_unused(looks, kept);
    return true;
}

// --- the words of a text

enum { SHOWN_MAX = 24 };

void words_skip(struct words *w) { w->at += strcspn(w->at, " \t\r\n"); }
void words_skip_line(struct words *w) { w->at += strcspn(w->at, "\n"); }

bool words_more(struct words *w)
{
    for (;; w->at++) {
        if (*w->at == '#') words_skip_line(w);
        if (!*w->at) return false;
        if (*w->at == '\n') w->line++;
        if (!strchr(" \t\r\n\f\v", *w->at)) return true;
    }
}

bool words_expected(struct words *w, const char *what)
{
    if (!words_more(w))
        return fail(w->error, ERROR_INPUT, "%s:%d: expected %s, got the end of the file", w->path, w->line, what);
    int shown = (int)strcspn(w->at, " \t\r\n");
    if (shown > SHOWN_MAX) shown = SHOWN_MAX;
    return fail(w->error, ERROR_INPUT, "%s:%d: expected %s, got '%.*s'", w->path, w->line, what, shown, w->at);
}

bool words_take(struct words *w, const char *word)
{
    const size_t length = strlen(word);
    if (!words_more(w) || strncasecmp(w->at, word, length) != 0 || !strchr(" \t\r\n", w->at[length])) return false;
    w->at += length;
    return true;
}

bool words_number(struct words *w, const char *what, double *number)
{
    if (!words_more(w)) return words_expected(w, what);
    char *end;
    *number = strtod(w->at, &end);
    if (end == w->at || !strchr(" \t\r\n", *end) || !(fabs(*number) < 1e38)) return words_expected(w, what);
    w->at = end;
    return true;
}

bool words_integer(struct words *w, const char *what, long least, long most, long *number)
{
    if (!words_more(w)) return words_expected(w, what);
    char *end;
    *number = strtol(w->at, &end, 10);
    if (end == w->at || !strchr(" \t\r\n", *end) || *number < least || *number > most) return words_expected(w, what);
    w->at = end;
    return true;
}

/// Makes, checks and frees characters.
#include "model/character.h"
#include "model/vector.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/// Normals from the triangles, weighted by their area; (0, 1, 0) where there are none.
static void compute_normals(struct character *c)
{
    memset(c->normal, 0, (size_t)c->vertex_count * sizeof *c->normal);
    for (int i = 0; i + 2 < c->index_count; i += 3) {
        const uint32_t *corner = c->indices + i;
        vec3s normal = triangle_normal(c->position[corner[0]], c->position[corner[1]], c->position[corner[2]]);
        for (int k = 0; k < 3; k++) glm_vec3_add(c->normal[corner[k]], normal.raw, c->normal[corner[k]]);
    }
    for (int i = 0; i < c->vertex_count; i++) {
        float *n = c->normal[i];
        double length = sqrt((double)n[0] * n[0] + (double)n[1] * n[1] + (double)n[2] * n[2]);
        bool known = length > 0 && isfinite(length);
        for (int k = 0; k < 3; k++) n[k] = known ? (float)(n[k] / length) : (float)(k == 1);
    }
}

static float (*white(int count))[3]
{
    float(*color)[3] = malloc((size_t)count * sizeof *color);
    for (int n = 0; color && n < 3 * count; n++) color[n / 3][n % 3] = 1;
    return color;
}

static bool create_coordinates(struct character *c, int count)
{
    size_t vertices = (size_t)c->vertex_count;
    bool whole = true;
    c->coordinates = calloc((size_t)count + 1, sizeof *c->coordinates);
    if (!c->coordinates) return false;
    c->coordinate_count = count;
    for (int i = 0; i < count; i++) {
        c->coordinates[i].re = calloc(vertices, sizeof *c->coordinates[i].re);
        c->coordinates[i].im = calloc(vertices, sizeof *c->coordinates[i].im);
        whole = whole && c->coordinates[i].re && c->coordinates[i].im;
    }
    return whole;
}

bool character_create(struct character *c, struct surface *surface, int coordinates)
{
    *c = (struct character){
        .vertex_count = surface->vertex_count,
        .index_count = surface->index_count,
        .position = surface->position,
        .normal = malloc((size_t)surface->vertex_count * sizeof *c->normal),
        .color = surface->color ? surface->color : white(surface->vertex_count),
        .indices = surface->indices,
        .looks = surface->looks,
    };
    *surface = (struct surface){0};
    if (c->normal && c->color && create_coordinates(c, coordinates)) {
        compute_normals(c);
        return true;
    }
    character_free(c);
    return false;
}

void character_free(struct character *c)
{
    for (int i = 0; i < c->coordinate_count; i++) {
        free(c->coordinates[i].name);
        free(c->coordinates[i].re);
        free(c->coordinates[i].im);
    }
    free(c->coordinates);
    free(c->position);
    free(c->normal);
    free(c->color);
    free(c->indices);
    looks_free(&c->looks);
    *c = (struct character){0};
}

/// Finds the outlines of soft characters.
#include "base/need.h"
#include "draw/skirt.h"
#include "model/adjacency.h"
#include <stdlib.h>

static const uint32_t *indices_of(const struct morph_skirt *skirt, const struct figure *figure, bool coarse)
{
    if (skirt->sorted[coarse]) return skirt->sorted[coarse];
    return coarse ? figure->coarse : figure->character.indices;
}

int morph_skirt_count(const struct figure *figure, bool coarse)
{
    return coarse ? figure->coarse_count : figure->character.index_count;
}

static void cut(const struct figure *figure, const struct morph_looks *looks, bool coarse, const uint32_t *indices,
                int *neighbours)
{
    const struct character *c = &figure->character;
    const int count = morph_skirt_count(figure, coarse);
    uint32_t *look = need((size_t)count + 1, sizeof *look);
    for (int i = 0, r = 0; i < count; i++) {
        while (r < looks->range_count && i >= looks->ranges[coarse][r].first + looks->ranges[coarse][r].count) r++;
        look[i] = neighbours_look(r, c->color[indices[i]]);
    }
    neighbours_cut((const float(*)[3])c->position, indices, look, count, neighbours);
    free(look);
}

static void find_across(struct morph_skirt *skirt, const struct figure *figure, const struct morph_looks *looks,
                        bool coarse)
{
    const struct character *c = &figure->character;
    const int count = morph_skirt_count(figure, coarse);
    const uint32_t *indices = indices_of(skirt, figure, coarse);
    int *neighbours = skirt->neighbours[coarse] = need((size_t)count + 1, sizeof *neighbours);
    neighbours_find((const float(*)[3])c->position, c->vertex_count, indices, count, neighbours);
    cut(figure, looks, coarse, indices, neighbours);
}

void morph_skirt_create(struct morph_skirt *skirt, const struct figure *figure, const struct morph_looks *looks)
{
    const struct character *c = &figure->character;
    skirt->place = need((size_t)c->vertex_count + 1, sizeof *skirt->place);
    skirt->normal = need((size_t)c->vertex_count + 1, sizeof *skirt->normal);
    skirt->front = need((size_t)c->index_count / 3 + 1, sizeof *skirt->front);
    for (int coarse = 0; coarse < 2; coarse++) find_across(skirt, figure, looks, coarse);
}

void morph_skirt_free(struct morph_skirt *skirt)
{
    for (int coarse = 0; coarse < 2; coarse++) {
        free(skirt->sorted[coarse]);
        free(skirt->neighbours[coarse]);
    }
    free(skirt->place);
    free(skirt->normal);
    free(skirt->front);
}

struct skirt_mesh morph_skirt_mesh(const struct morph_skirt *skirt, const struct figure *figure, bool coarse)
{
    return (struct skirt_mesh){.indices = indices_of(skirt, figure, coarse),
                               .neighbours = skirt->neighbours[coarse],
                               .place = (const float(*)[3])skirt->place,
                               .front = skirt->front};
}

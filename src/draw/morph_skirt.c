/// Finds the outlines of soft characters, and what skirts show there.
#include "base/need.h"
#include "draw/skirt.h"
#include "model/adjacency.h"
#include "ui/theme.h"
#include <stdlib.h>
#include <string.h>

static const uint32_t *indices_of(const struct morph_skirt *skirt, const struct figure *figure, bool coarse)
{
    if (skirt->sorted[coarse]) return skirt->sorted[coarse];
    return coarse ? figure->coarse : figure->character.indices;
}

static int count_of(const struct figure *figure, bool coarse)
{
    return coarse ? figure->coarse_count : figure->character.index_count;
}

static void cut(const struct figure *figure, const struct morph_looks *looks, bool coarse, const uint32_t *indices,
                int *neighbours)
{
    const struct character *c = &figure->character;
    const int count = count_of(figure, coarse);
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
    const int count = count_of(figure, coarse);
    const uint32_t *indices = indices_of(skirt, figure, coarse);
    int *neighbours = skirt->neighbours[coarse] = need((size_t)count + 1, sizeof *neighbours);
    neighbours_find((const float(*)[3])c->position, c->vertex_count, indices, count, neighbours);
    cut(figure, looks, coarse, indices, neighbours);
}

void morph_skirt_create(struct morph_skirt *skirt, const struct figure *figure, const struct morph_looks *looks)
{
    const struct character *c = &figure->character;
    skirt->place = need((size_t)c->vertex_count + 1, sizeof *skirt->place);
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
    free(skirt->front);
}

struct look {
    const struct stage_character *shown;
    const float *base; ///< its material's colour
};

/// As mapped_color() in stage_character.vert.
static void map_color(const struct figure *figure, const float phase[2], float color[3])
{
    float mapped[3];
    const float luminance = 0.2126f * color[0] + 0.7152f * color[1] + 0.0722f * color[2];
    const float share = glm_smoothstep(0.3f * figure->dark, figure->dark, luminance);
    phase_color_linear(phase[0], phase[1], mapped);
    glm_vec3_lerp(color, mapped, share, color);
}

static void look_at(const void *context, uint32_t vertex, struct skirt_vertex *out)
{
    const struct look *look = context;
    const struct figure *figure = look->shown->figure;
    const struct character *c = &figure->character;
    const int map = look->shown->map_coordinate, axis = look->shown->map_axis;
    float place[3];
    *out = (struct skirt_vertex){0};
    morph_vertex(figure, &look->shown->morph, (int)vertex, place, out->normal);
    memcpy(out->color, c->color[vertex], sizeof c->color[vertex]);
    if (map >= 0) {
        const float largest = figure->largest[map][axis], scale = largest > 0.0f ? 1.0f / largest : 0.0f;
        out->phase[0] = scale * c->coordinates[map].re[vertex][axis];
        out->phase[1] = scale * c->coordinates[map].im[vertex][axis];
        map_color(figure, out->phase, out->color);
    }
    for (int k = 0; k < 3; k++) out->color[k] *= look->base[k];
    out->color[3] = look->base[3];
    if (c->looks.uv && !c->looks.corner) memcpy(out->uv, c->looks.uv[vertex], sizeof out->uv);
}

void morph_skirt_draw(const struct morph_skirt *skirt, const struct stage_skirt *program,
                      const struct stage_view *view, const struct stage_character *shown,
                      const struct morph_looks *looks, float seam)
{
    static const float white[4] = {1, 1, 1, 1};
    const bool coarse = shown->coarse;
    const int count = count_of(shown->figure, coarse);
    const struct skirt_mesh mesh = {.indices = indices_of(skirt, shown->figure, coarse),
                                    .neighbours = skirt->neighbours[coarse],
                                    .place = (const float(*)[3])skirt->place,
                                    .front = skirt->front};
    morph_places(shown->figure, &shown->morph, shown->position, skirt->place);
    skirt_face(&mesh, 0, count, view->eye);
    if (shown->map_coordinate >= 0 || looks->range_count == 0) {
        const struct look look = {shown, white};
        stage_skirt_draw(program, &mesh, 0, count, false, view->eye, seam, look_at, &look);
        return;
    }
    for (int r = 0; r < looks->range_count; r++) {
        const struct morph_range *range = &looks->ranges[coarse][r];
        const struct look look = {shown, range->color};
        glUniform1i(program->at.blended, range->color[3] < 1.0f);
        glBindTexture(GL_TEXTURE_2D, range->picture);
        stage_skirt_draw(program, &mesh, range->first, range->first + range->count, false, view->eye, seam, look_at,
                         &look);
    }
}

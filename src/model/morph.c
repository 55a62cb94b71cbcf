/// Moves single points of a character by its morph, on the CPU.
#include "model/morph.h"
#include "model/vector.h"
#include <math.h>
#include <string.h>

/// sum += Re(z (re + j·im))
static void add_real_part(const float z[2], const float re[3], const float im[3], float sum[3])
{
    for (int k = 0; k < 3; k++) sum[k] += z[0] * re[k] - z[1] * im[k];
}

static void morph_normal(const struct figure *figure, const struct morph *morph, int vertex, float normal[3])
{
    const float *n = figure->character.normal[vertex];
    float u[3], v[3];
    memcpy(u, figure->tangent[vertex], sizeof u);
    vector_cross(n, u, v);
    for (int k = 0; k < morph->count; k++) {
        const struct slope *s = &figure->slopes[morph->coordinate[k] * figure->character.vertex_count + vertex];
        add_real_part(morph->weight[k], s->re_u, s->im_u, u);
        add_real_part(morph->weight[k], s->re_v, s->im_v, v);
    }
    vector_cross(u, v, normal);
    const float length = sqrtf(vector_dot(normal, normal));
    for (int k = 0; k < 3; k++) normal[k] /= fmaxf(length, 1e-9f); // squeezed flat: no direction, and not NaN
}

void morph_vertex(const struct figure *figure, const struct morph *morph, int vertex, float position[3],
                  float normal[3])
{
    memcpy(position, figure->character.position[vertex], 3 * sizeof *position);
    for (int k = 0; k < morph->count; k++) {
        const struct coordinate *c = &figure->character.coordinates[morph->coordinate[k]];
        add_real_part(morph->weight[k], c->re[vertex], c->im[vertex], position);
    }
    if (normal) morph_normal(figure, morph, vertex, normal);
}

void morph_bounds(const struct figure *figure, const struct morph *morph, float lo[3], float hi[3])
{
    for (int k = 0; k < 3; k++) {
        lo[k] = INFINITY;
        hi[k] = -INFINITY;
    }
    for (int i = 0; i < figure->character.vertex_count; i++) {
        float p[3];
        morph_vertex(figure, morph, i, p, NULL);
        for (int k = 0; k < 3; k++) {
            lo[k] = fminf(lo[k], p[k]);
            hi[k] = fmaxf(hi[k], p[k]);
        }
    }
}

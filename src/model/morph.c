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
    vec3s u = vec3_from(figure->tangent[vertex]), v = glms_vec3_cross(vec3_from(figure->character.normal[vertex]), u);
    for (int k = 0; k < morph->count; k++) {
        const struct slope *s = &figure->slopes[morph->coordinate[k] * figure->character.vertex_count + vertex];
        add_real_part(morph->weight[k], s->re_u, s->im_u, u.raw);
        add_real_part(morph->weight[k], s->re_v, s->im_v, v.raw);
    }
    vec3s n = glms_vec3_cross(u, v);
    n = glms_vec3_divs(n, fmaxf(glms_vec3_norm(n), 1e-9f)); // squeezed flat: no direction, and not NaN
    glm_vec3_copy(n.raw, normal);
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

void morph_places(const struct figure *figure, const struct morph *morph, const float position[3], float (*places)[3])
{
    for (int i = 0; i < figure->character.vertex_count; i++) {
        morph_vertex(figure, morph, i, places[i], NULL);
        places[i][0] += position[0];
        places[i][1] += position[1] - figure->lo[1];
        places[i][2] += position[2];
    }
}

void morph_bounds(const struct figure *figure, const struct morph *morph, float lo[3], float hi[3])
{
    glm_vec3_fill(lo, INFINITY);
    glm_vec3_fill(hi, -INFINITY);
    for (int i = 0; i < figure->character.vertex_count; i++) {
        float p[3];
        morph_vertex(figure, morph, i, p, NULL);
        glm_vec3_minv(p, lo, lo);
        glm_vec3_maxv(p, hi, hi);
    }
}

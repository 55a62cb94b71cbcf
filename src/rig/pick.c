/// Intersects a ray with triangles.
#include "rig/pick.h"
#include "model/vector.h"
#include <math.h>
#include <string.h>

static const float SLACK = 1e-4f; ///< of a triangle: rounding must not leave gaps between neighbours

/// Möller and Trumbore 1997.
float pick_triangle(const float *const corner[3], const float eye[3], const float direction[3], float uv[2])
{
    const vec3s first = vec3_from(corner[0]), along = vec3_from(direction);
    const vec3s side = glms_vec3_sub(vec3_from(corner[1]), first), other = glms_vec3_sub(vec3_from(corner[2]), first);
    const vec3s p = glms_vec3_cross(along, other);
    const float determinant = glms_vec3_dot(side, p);
    if (!(determinant > 0.0f)) return -1; // edge on, or its back
    const vec3s from = glms_vec3_sub(vec3_from(eye), first);
    uv[0] = glms_vec3_dot(from, p);
    const float slack = SLACK * determinant;
    if (uv[0] < -slack || uv[0] > determinant + slack) return -1;
    const vec3s q = glms_vec3_cross(from, side);
    uv[1] = glms_vec3_dot(along, q);
    if (uv[1] < -slack || uv[0] + uv[1] > determinant + slack) return -1;
    uv[0] /= determinant;
    uv[1] /= determinant;
    return glms_vec3_dot(other, q) / determinant;
}

bool pick_ray(const struct figure *figure, const float (*posed)[3], const float eye[3], const float direction[3],
              struct surface_spot *spot)
{
    const uint32_t *indices = figure->character.indices;
    float nearest = INFINITY;
    for (int t = 0; t < figure->character.index_count; t += 3) {
        const float *const corner[3] = {posed[indices[t]], posed[indices[t + 1]], posed[indices[t + 2]]};
        float uv[2];
        const float distance = pick_triangle(corner, eye, direction, uv);
        if (!(distance > 0.0f && distance < nearest)) continue;
        nearest = distance;
        memcpy(spot->corner, indices + t, sizeof spot->corner);
        spot->weight[0] = 1.0f - uv[0] - uv[1];
        spot->weight[1] = uv[0];
        spot->weight[2] = uv[1];
    }
    return nearest < INFINITY;
}

/// Finds outlines, and which way skirts hang.
#include "draw/skirt.h"
#include "model/adjacency.h"
#include "model/vector.h"
#include <string.h>

/// Whether a triangle faces the eye, or nearly: the rasteriser, which rounds, has the last word.
static bool is_front(const float a[3], const float b[3], const float c[3], const float eye[3], float sign)
{
    static const float slack = 1e-6f; // the square of a cosine
    const vec3s normal = triangle_normal(a, b, c);
    const vec3s to_eye = glms_vec3_sub(vec3_from(eye), vec3_from(a));
    const float facing = sign * glms_vec3_dot(normal, to_eye);
    return facing >= 0.0f || facing * facing < slack * glms_vec3_norm2(normal) * glms_vec3_norm2(to_eye);
}

void skirt_face(const struct skirt_mesh *mesh, int first, int end, const float eye[3])
{
    const float(*place)[3] = mesh->place;
    for (int i = first; i < end; i += 3) {
        const uint32_t *corner = mesh->indices + i;
        mesh->front[i / 3] =
            is_front(place[corner[0]], place[corner[1]], place[corner[2]], eye, mesh->mirrored ? -1.0f : 1.0f);
    }
}

int skirt_next(const struct skirt_mesh *mesh, int first, int end, bool both_sides)
{
    for (int i = first; i < end; i++) {
        const int other = mesh->neighbours[i];
        const bool front = mesh->front[i / 3];
        if (other < 0 ? front || both_sides : front && !mesh->front[other]) return i;
    }
    return end;
}

/// Along the vertex's normal, so that the skirts of edges that follow each other meet; but off the edge, where the normal does not point away from it.
static vec3s outwards(vec3s ray, const float normal[3], vec3s off_edge)
{
    const float depth = glms_vec3_dot(vec3_from(normal), ray) / glms_vec3_norm2(ray);
    const vec3s out = glms_vec3_normalize(glms_vec3_sub(vec3_from(normal), glms_vec3_scale(ray, depth)));
    return glms_vec3_dot(out, off_edge) < 0.3f ? off_edge : out;
}

void skirt_out(const struct skirt_mesh *mesh, int corner, const float normal[2][3], const float eye[3], float pixel,
               float out[2][3])
{
    const float *end[2] = {mesh->place[mesh->indices[corner]], mesh->place[mesh->indices[next_corner(corner)]]};
    const vec3s edge = glms_vec3_sub(vec3_from(end[1]), vec3_from(end[0]));
    const float side =
        mesh->front[corner / 3] == mesh->mirrored ? -1.0f : 1.0f; // the triangle lies to the left of its edge
    for (int e = 0; e < 2; e++) {
        const vec3s ray = glms_vec3_sub(vec3_from(end[e]), vec3_from(eye));
        const vec3s off_edge = glms_vec3_scale(glms_vec3_normalize(glms_vec3_cross(ray, edge)), side);
        vec3s step = mesh->neighbours[corner] < 0 ? off_edge : outwards(ray, normal[e], off_edge);
        step = glms_vec3_scale(step, pixel * glms_vec3_norm(ray));
        memcpy(out[e], step.raw, sizeof out[e]);
    }
}

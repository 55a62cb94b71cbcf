/// Finds outlines and builds their skirts.
#include "draw/posed.h"
#include "model/adjacency.h"

/// Pixels towards the eye for skirts on a continuing surface, which may itself lean towards the eye.
static const float LIFT = 2.0f;

/// Whether a triangle faces the eye, or nearly. Near the limit the rasteriser decides, because it rounds.
static bool is_front(const float a[3], const float b[3], const float c[3], const float eye[3], float sign)
{
    static const float slack = 1e-6f; // squared cosine
    const vec3s normal = triangle_normal(a, b, c);
    const vec3s to_eye = glms_vec3_sub(vec3_from(eye), vec3_from(a));
    const float facing = sign * glms_vec3_dot(normal, to_eye);
    return facing >= 0.0f || facing * facing < slack * glms_vec3_norm2(normal) * glms_vec3_norm2(to_eye);
}

void posed_face(struct posed *mesh, const float eye[3])
{
    const float(*place)[3] = (const float(*)[3])mesh->place;
    for (int p = 0; p < mesh->part_count; p++) {
        const struct posed_part *part = &mesh->parts[p];
        for (int i = part->first; i < part->end; i += 3) {
            const uint32_t *corner = mesh->indices + i;
            mesh->front[i / 3] =
                is_front(place[corner[0]], place[corner[1]], place[corner[2]], eye, part->mirrored ? -1.0f : 1.0f);
        }
    }
}

int skirt_next(const struct posed *mesh, const struct posed_part *part, int from)
{
    for (int i = from; i < part->end; i++) {
        const int other = mesh->neighbours[i];
        const bool front = mesh->front[i / 3];
        if (other < 0 ? front || part->both_sides : front && !mesh->front[other]) return i;
    }
    return part->end;
}

/// Along the vertex normal, so that skirts of consecutive edges meet. If the normal does not point away from the edge, across the edge.
static vec3s outwards(vec3s ray, const float normal[3], vec3s off_edge)
{
    const float depth = glms_vec3_dot(vec3_from(normal), ray) / glms_vec3_norm2(ray);
    const vec3s out = glms_vec3_normalize(glms_vec3_sub(vec3_from(normal), glms_vec3_scale(ray, depth)));
    return glms_vec3_dot(out, off_edge) < 0.3f ? off_edge : out;
}

/// The skirt's offset at one end of an edge: one pixel, across the line of sight. `side` points away from the triangle.
static vec3s step_out(const struct skirt_vertex *end, vec3s edge, float side, bool open, const float eye[3],
                      float seam)
{
    const vec3s ray = glms_vec3_sub(vec3_from(end->place), vec3_from(eye));
    const vec3s off_edge = glms_vec3_scale(glms_vec3_normalize(glms_vec3_cross(ray, edge)), side);
    return glms_vec3_scale(open ? off_edge : outwards(ray, end->normal, off_edge), seam * glms_vec3_norm(ray));
}

/// The surface at one end of an edge, with the normal towards the eye if `back`. Without normals it is the triangle's.
static void look_at(const struct posed *mesh, const struct posed_part *part, int corner, bool back,
                    struct skirt_vertex *out)
{
    const uint32_t vertex = mesh->indices[corner], *const triangle = mesh->indices + corner / 3 * 3;
    vec3s normal = vec3_from(mesh->normal[vertex]);
    if (glms_vec3_norm2(normal) == 0)
        normal = glms_vec3_scale(glms_vec3_normalize(triangle_normal(
                                     mesh->place[triangle[0]], mesh->place[triangle[1]], mesh->place[triangle[2]])),
                                 part->mirrored ? -1.0f : 1.0f);
    *out = (struct skirt_vertex){.look = mesh->looks[vertex]};
    for (int k = 0; k < 3; k++) {
        out->place[k] = mesh->place[vertex][k];
        out->normal[k] = back ? -normal.raw[k] : normal.raw[k];
    }
}

/// Moves the texture coordinate half a pixel into the triangle: a lookup at its edge may hit the opposite side of the picture.
static void pull_in(const struct posed *mesh, int corner, const float eye[3], float seam, struct skirt_vertex ends[2])
{
    const uint32_t third = mesh->indices[next_corner(next_corner(corner))];
    const vec3s from = vec3_from(ends[0].place), edge = glms_vec3_sub(vec3_from(ends[1].place), from);
    const float area = glms_vec3_norm(glms_vec3_cross(edge, glms_vec3_sub(vec3_from(mesh->place[third]), from)));
    const float pixel = seam * glms_vec3_distance(from, vec3_from(eye));
    const float share = fminf(0.5f * pixel * glms_vec3_norm(edge) / fmaxf(area, 1e-12f), 0.5f);
    for (int e = 0; e < 2; e++) {
        for (int k = 0; k < 2; k++) ends[e].look.uv[k] += share * (mesh->looks[third].uv[k] - ends[e].look.uv[k]);
    }
}

void skirt_hang(const struct posed *mesh, const struct posed_part *part, int corner, const float eye[3], float seam,
                struct skirt_vertex out[SKIRT_CORNERS])
{
    const bool front = mesh->front[corner / 3], open = mesh->neighbours[corner] < 0;
    const float side = front == part->mirrored ? -1.0f : 1.0f; // the triangle is to the left of its edge
    look_at(mesh, part, corner, !front, &out[0]);
    look_at(mesh, part, next_corner(corner), !front, &out[1]);
    pull_in(mesh, corner, eye, seam, out);
    const vec3s edge = glms_vec3_sub(vec3_from(out[1].place), vec3_from(out[0].place));
    for (int e = 0; e < 2; e++) {
        const vec3s off = step_out(&out[e], edge, side, open, eye, seam);
        struct skirt_vertex *outer = &out[3 - e];
        *outer = out[e];
        outer->look.cover = 0.0f;
        for (int k = 0; k < 3; k++) outer->place[k] += off.raw[k];
    }
    for (int c = 0; mesh->neighbours[corner] == NEIGHBOUR_CUT && c < SKIRT_CORNERS; c++) {
        for (int k = 0; k < 3; k++) out[c].place[k] += LIFT * seam * (eye[k] - out[c].place[k]);
    }
}

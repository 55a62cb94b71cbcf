/// Moves the animal's skin, and finds which triangles of it are seen.
#include "draw/stage_skin.h"
#include "model/creature.h"
#include "model/tail_skin.h"
#include "model/vector.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static enum region region_of(const struct mesh *mesh, const uint32_t corners[3])
{
    float lo[3] = {INFINITY, INFINITY, INFINITY}, hi[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (int c = 0; c < 3; c++) {
        const struct vertex *vertex = &mesh->vertices[corners[c]];
        float place[3];
        if (vertex->bend > 0.0f) return REGION_COAT;
        creature_into_head(vertex->position, place);
        glm_vec3_minv(lo, place, lo);
        glm_vec3_maxv(hi, place, hi);
    }
    for (int k = 0; k < 3; k++) {
        if (lo[k] > creature_face_hi[k] || hi[k] < creature_face_lo[k]) return REGION_COAT;
    }
    return REGION_FACE;
}

/// Sorts a mesh's triangles by region; false if memory runs out.
static bool sort_triangles(struct skin_mesh *skin)
{
    struct mesh *mesh = &skin->mesh;
    const size_t size = (size_t)mesh->index_count * sizeof *mesh->indices;
    uint32_t *sorted = malloc(size);
    int count = 0;
    for (int region = 0; sorted && region < REGIONS; region++) {
        skin->first[region] = count;
        for (int i = 0; i < mesh->index_count; i += 3) {
            if (region_of(mesh, mesh->indices + i) != (enum region)region) continue;
            memcpy(sorted + count, mesh->indices + i, 3 * sizeof *sorted);
            count += 3;
        }
    }
    skin->first[REGIONS] = count;
    if (sorted) memcpy(mesh->indices, sorted, size);
    free(sorted);
    return sorted;
}

bool stage_skin_create(struct skin_mesh *skin, int level)
{
    mesh_creature(level, &skin->mesh);
    if (skin->mesh.failed) return false;
    return sort_triangles(skin);
}

void stage_skin_pose(const struct skin_mesh *mesh, const struct pose *pose, const float eye[3],
                     const struct skin *skin)
{
    tail_skin(pose, &mesh->mesh, skin->place, skin->normal);
    for (int i = 0; i < mesh->mesh.vertex_count; i++) {
        const vec3s to_eye = glms_vec3_sub(vec3_from(eye), vec3_from(skin->place[i]));
        skin->facing[i] = glms_vec3_dot(vec3_from(skin->normal[i]), to_eye) / glms_vec3_norm(to_eye);
    }
}

/// Whether a triangle faces the eye, or nearly: the rasteriser, which rounds, has the last word.
static bool is_front(const struct skin *skin, const uint32_t corner[3], const float eye[3])
{
    static const float slack = 1e-6f; // the square of a cosine
    const vec3s a = vec3_from(skin->place[corner[0]]), to_eye = glms_vec3_sub(vec3_from(eye), a);
    const vec3s normal = glms_vec3_cross(glms_vec3_sub(vec3_from(skin->place[corner[1]]), a),
                                         glms_vec3_sub(vec3_from(skin->place[corner[2]]), a));
    const float facing = glms_vec3_dot(normal, to_eye);
    return facing >= 0.0f || facing * facing < slack * glms_vec3_norm2(normal) * glms_vec3_norm2(to_eye);
}

/// The largest curvature along a triangle's edges, squared.
static float curvature2(const struct skin *skin, const uint32_t corner[3])
{
    float largest = 0.0f;
    for (int e = 0; e < 3; e++) {
        const uint32_t a = corner[e], b = corner[(e + 1) % 3];
        const float turn2 = glms_vec3_distance2(vec3_from(skin->normal[a]), vec3_from(skin->normal[b]));
        const float edge2 = glms_vec3_distance2(vec3_from(skin->place[a]), vec3_from(skin->place[b]));
        largest = fmaxf(largest, turn2 / fmaxf(edge2, 1e-12f));
    }
    return largest;
}

/// Whether a triangle of the second, larger skin may stick out from behind the first. On a shape of radius R that is larger by d, what faces
/// the eye by a cosine below √(1 − R²/(R + d)²) does; what faces away is transparent.
static bool is_near_silhouette(const struct skin *skin, const uint32_t corner[3], const float eye[3], float seam)
{
    static const float larger = 3.0f, slack = 0.08f; // pixels, twice as many as it is; for facets that are no arcs
    const float *f = skin->facing;
    const float low = fminf(fminf(f[corner[0]], f[corner[1]]), f[corner[2]]);
    const float high = fmaxf(fmaxf(f[corner[0]], f[corner[1]]), f[corner[2]]);
    if (high < -0.02f) return false;
    if (low < slack) return true;
    const float pixel = seam * glms_vec3_distance(vec3_from(eye), vec3_from(skin->place[corner[0]]));
    const float share = 1.0f + larger * pixel * sqrtf(curvature2(skin, corner));
    return (low - slack) * (low - slack) < 1.0f - 1.0f / (share * share);
}

int stage_skin_seen(const struct skin_mesh *mesh, const struct skin *skin, enum region region, const float eye[3],
                    float seam, uint32_t *indices)
{
    int count = 0;
    for (int i = mesh->first[region]; i < mesh->first[region + 1]; i += 3) {
        const uint32_t *corner = mesh->mesh.indices + i;
        if (seam > 0.0f ? !is_near_silhouette(skin, corner, eye, seam) : !is_front(skin, corner, eye)) continue;
        memcpy(indices + count, corner, 3 * sizeof *corner);
        count += 3;
    }
    return count;
}

/// Moves the animal's skin, and finds which triangles of it are seen and where its outlines are.
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
    const bool made = sorted != NULL;
    if (made) memcpy(mesh->indices, sorted, size);
    free(sorted);
    return made;
}

/// The corner after a corner in its triangle.
static int next_corner(int i) { return i % 3 == 2 ? i - 2 : i + 1; }

/// Finds the triangles across edges: an edge a → b is b → a there. Corners are chained by their vertex in `chain`, from `last` of each.
static void find_across(struct skin_mesh *skin, int *last, int *chain)
{
    const struct mesh *mesh = &skin->mesh;
    for (int v = 0; v < mesh->vertex_count; v++) last[v] = -1;
    for (int i = 0; i < mesh->index_count; i++) {
        chain[i] = last[mesh->indices[i]];
        last[mesh->indices[i]] = i;
    }
    for (int i = 0; i < mesh->index_count; i++) {
        int other = last[mesh->indices[next_corner(i)]];
        while (other >= 0 && mesh->indices[next_corner(other)] != mesh->indices[i]) other = chain[other];
        skin->across[i] = other < 0 ? -1 : other / 3;
    }
}

/// False if memory runs out.
static bool join_triangles(struct skin_mesh *skin)
{
    const size_t indices = (size_t)skin->mesh.index_count;
    int *last = malloc((size_t)skin->mesh.vertex_count * sizeof *last), *chain = malloc(indices * sizeof *chain);
    skin->across = malloc(indices * sizeof *skin->across);
    const bool made = last && chain && skin->across;
    if (made) find_across(skin, last, chain);
    free(last);
    free(chain);
    return made;
}

bool stage_skin_create(struct skin_mesh *skin, int level)
{
    mesh_creature(level, &skin->mesh);
    if (skin->mesh.failed) return false;
    return sort_triangles(skin) && join_triangles(skin);
}

void stage_skin_destroy(struct skin_mesh *skin)
{
    mesh_free(&skin->mesh);
    free(skin->across);
}

/// Whether a triangle faces the eye, or nearly: the rasteriser, which rounds, has the last word.
static bool is_front(const struct skin *skin, const uint32_t corner[3], const float eye[3])
{
    static const float slack = 1e-6f; // the square of a cosine
    const float *a = skin->place[corner[0]];
    const vec3s normal = triangle_normal(a, skin->place[corner[1]], skin->place[corner[2]]);
    const vec3s to_eye = glms_vec3_sub(vec3_from(eye), vec3_from(a));
    const float facing = glms_vec3_dot(normal, to_eye);
    return facing >= 0.0f || facing * facing < slack * glms_vec3_norm2(normal) * glms_vec3_norm2(to_eye);
}

void stage_skin_pose(const struct skin_mesh *mesh, const struct pose *pose, const float eye[3],
                     const struct skin *skin)
{
    tail_skin(pose, &mesh->mesh, skin->place, skin->normal);
    for (int i = 0; i < mesh->mesh.index_count; i += 3)
        skin->front[i / 3] = is_front(skin, mesh->mesh.indices + i, eye);
}

int stage_skin_seen(const struct skin_mesh *mesh, const struct skin *skin, enum region region, uint32_t *indices)
{
    int count = 0;
    for (int i = mesh->first[region]; i < mesh->first[region + 1]; i += 3) {
        if (!skin->front[i / 3]) continue;
        memcpy(indices + count, mesh->mesh.indices + i, 3 * sizeof *indices);
        count += 3;
    }
    return count;
}

/// A pixel away from the skin at one end of an edge, across the line of sight: along the vertex's normal, so that the skirts of edges that
/// follow each other meet; but off the edge, where the normal does not point away from it.
static vec3s outwards(const struct skin *skin, uint32_t vertex, vec3s edge, const float eye[3], float pixel)
{
    const vec3s ray = glms_vec3_sub(vec3_from(skin->place[vertex]), vec3_from(eye));
    const vec3s normal = vec3_from(skin->normal[vertex]);
    const vec3s off_edge = glms_vec3_normalize(glms_vec3_cross(ray, edge));
    vec3s out = glms_vec3_normalize(
        glms_vec3_sub(normal, glms_vec3_scale(ray, glms_vec3_dot(normal, ray) / glms_vec3_norm2(ray))));
    if (glms_vec3_dot(out, off_edge) < 0.3f) out = off_edge;
    return glms_vec3_scale(out, pixel * glms_vec3_norm(ray));
}

static struct skirt_corner corner_on(const struct skin_mesh *mesh, const struct skin *skin, uint32_t v)
{
    const struct vertex *vertex = &mesh->mesh.vertices[v];
    struct skirt_corner corner = {.bend = vertex->bend, .open = vertex->open, .opacity = 1.0f};
    memcpy(corner.position, vertex->position, sizeof corner.position);
    memcpy(corner.mark, vertex->mark, sizeof corner.mark);
    memcpy(corner.place, skin->place[v], sizeof corner.place);
    memcpy(corner.normal, skin->normal[v], sizeof corner.normal);
    return corner;
}

/// The skirt along the edge from a to b of a triangle, which lies to the left of it as the eye sees it.
static void hang_skirt(const struct skin_mesh *mesh, const struct skin *skin, const uint32_t ends[2],
                       const float eye[3], float pixel, struct skirt_corner corners[SKIRT_CORNERS])
{
    static const struct {
        int end;
        bool off;
    } places[SKIRT_CORNERS] = {{0, false}, {0, true}, {1, true}, {0, false}, {1, true}, {1, false}};
    const vec3s edge = glms_vec3_sub(vec3_from(skin->place[ends[1]]), vec3_from(skin->place[ends[0]]));
    const vec3s out[2] = {outwards(skin, ends[0], edge, eye, pixel), outwards(skin, ends[1], edge, eye, pixel)};
    for (int c = 0; c < SKIRT_CORNERS; c++) {
        const int end = places[c].end;
        corners[c] = corner_on(mesh, skin, ends[end]);
        if (!places[c].off) continue;
        for (int k = 0; k < 3; k++) corners[c].place[k] += out[end].raw[k];
        corners[c].opacity = 0.0f;
    }
}

int stage_skin_skirt(const struct skin_mesh *mesh, const struct skin *skin, enum region region, const float eye[3],
                     float pixel, struct skirt_corner *corners, int room)
{
    int count = 0;
    for (int i = mesh->first[region]; i < mesh->first[region + 1]; i++) {
        const int other = mesh->across[i];
        if (!skin->front[i / 3] || other < 0 || skin->front[other]) continue;
        if (count == room) break;
        const uint32_t ends[2] = {mesh->mesh.indices[i], mesh->mesh.indices[next_corner(i)]};
        hang_skirt(mesh, skin, ends, eye, pixel, corners + SKIRT_CORNERS * count);
        count++;
    }
    return count;
}

/// Moves the animal's skin, and finds which triangles of it are seen and where its outlines are.
#include "draw/stage_skin.h"
#include "base/need.h"
#include "draw/skirt.h"
#include "model/adjacency.h"
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

/// Sorts a mesh's triangles by region.
static void sort_triangles(struct skin_mesh *skin)
{
    struct mesh *mesh = &skin->mesh;
    const size_t size = (size_t)mesh->index_count * sizeof *mesh->indices;
    uint32_t *sorted = need(size, 1);
    int count = 0;
    for (int region = 0; region < REGIONS; region++) {
        skin->first[region] = count;
        for (int i = 0; i < mesh->index_count; i += 3) {
            if (region_of(mesh, mesh->indices + i) != (enum region)region) continue;
            memcpy(sorted + count, mesh->indices + i, 3 * sizeof *sorted);
            count += 3;
        }
    }
    skin->first[REGIONS] = count;
    memcpy(mesh->indices, sorted, size);
    free(sorted);
}

void stage_skin_create(struct skin_mesh *skin, int level)
{
    struct mesh *mesh = &skin->mesh;
    mesh_creature(level, mesh);
    sort_triangles(skin);
    float(*rest)[3] = need((size_t)mesh->vertex_count, sizeof *rest);
    skin->neighbours = need((size_t)mesh->index_count, sizeof *skin->neighbours);
    for (int v = 0; v < mesh->vertex_count; v++) memcpy(rest[v], mesh->vertices[v].position, sizeof *rest);
    neighbours_find((const float(*)[3])rest, mesh->vertex_count, mesh->indices, mesh->index_count, skin->neighbours);
    free(rest);
}

void stage_skin_destroy(struct skin_mesh *skin)
{
    mesh_free(&skin->mesh);
    free(skin->neighbours);
}

static struct skirt_mesh standing(const struct skin_mesh *mesh, const struct skin *skin)
{
    return (struct skirt_mesh){mesh->mesh.indices, mesh->neighbours, (const float(*)[3])skin->place, skin->front,
                               false};
}

void stage_skin_pose(const struct skin_mesh *mesh, const struct pose *pose, const float eye[3],
                     const struct skin *skin)
{
    tail_skin(pose, &mesh->mesh, skin->place, skin->normal);
    const struct skirt_mesh as_it_stands = standing(mesh, skin);
    skirt_face(&as_it_stands, 0, mesh->mesh.index_count, eye);
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

static void hang_skirt(const struct skin_mesh *mesh, const struct skin *skin, const uint32_t ends[2],
                       const float out[2][3], struct skirt_corner corners[SKIRT_CORNERS])
{
    static const struct {
        int end;
        bool off;
    } places[SKIRT_CORNERS] = {{0, false}, {0, true}, {1, true}, {0, false}, {1, true}, {1, false}};
    for (int c = 0; c < SKIRT_CORNERS; c++) {
        const int end = places[c].end;
        corners[c] = corner_on(mesh, skin, ends[end]);
        if (!places[c].off) continue;
        for (int k = 0; k < 3; k++) corners[c].place[k] += out[end][k];
        corners[c].opacity = 0.0f;
    }
}

int stage_skin_skirt(const struct skin_mesh *mesh, const struct skin *skin, enum region region, const float eye[3],
                     float pixel, struct skirt_corner *corners, int room)
{
    const struct skirt_mesh as_it_stands = standing(mesh, skin);
    const int end = mesh->first[region + 1];
    int count = 0, i = mesh->first[region] - 1;
    while (count < room && (i = skirt_next(&as_it_stands, i + 1, end, false)) < end) {
        const uint32_t ends[2] = {mesh->mesh.indices[i], mesh->mesh.indices[next_corner(i)]};
        float normal[2][3], out[2][3];
        for (int e = 0; e < 2; e++) memcpy(normal[e], skin->normal[ends[e]], sizeof normal[e]);
        skirt_out(&as_it_stands, i, (const float(*)[3])normal, eye, pixel, out);
        hang_skirt(mesh, skin, ends, (const float(*)[3])out, corners + SKIRT_CORNERS * count++);
    }
    return count;
}

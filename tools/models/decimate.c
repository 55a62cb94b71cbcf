/// Decimates a mesh by half-edge collapses in rounds. In each round every removable vertex picks its cheapest neighbour to collapse onto;
/// the collapses are done from the cheapest on, except those that touch changed triangles.
#include "base/need.h"
#include "model/character.h"
#include "model/surface.h"
#include "model/vector.h"
#include "models/dog.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_RING = 24, MAX_ROUNDS = 24 };

#define COLOR_WEIGHT 0.02f /* metres equivalent to a full change of colour */
#define FLATTEST 0.35f     /* cosine of the largest turn of a triangle */

/// A vertex and the neighbour onto which it would collapse.
struct collapse {
    uint32_t from, to;
    float cost;
};

struct work {
    const struct character *character;
    uint32_t *indices;
    int index_count;
    int *first;   ///< of the vertex's triangles in `around`, per vertex and one more
    int *around;  ///< triangles by vertex
    bool *locked; ///< touched in this round
    struct collapse *collapses;
};

/// The vertices around v, each once; 0 if there are too many or v is at an edge of the surface (each neighbour must be in two of its
/// triangles).
static int ring_of(const struct work *work, uint32_t v, uint32_t ring[MAX_RING])
{
    int count = 0, seen[MAX_RING] = {0};
    for (int a = work->first[v]; a < work->first[v + 1]; a++) {
        const uint32_t *corner = work->indices + 3 * work->around[a];
        for (int k = 0; k < 3; k++) {
            if (corner[k] == v) continue;
            int at = 0;
            while (at < count && ring[at] != corner[k]) at++;
            if (at == MAX_RING) return 0;
            if (at == count) ring[count++] = corner[k];
            seen[at]++;
        }
    }
    for (int i = 0; i < count; i++) {
        if (seen[i] != 2) return 0;
    }
    return count;
}

/// INFINITY if v cannot collapse onto `to`: the surface would fold, or two sheets would meet (the two must share exactly the vertices of the
/// triangles on their edge).
static float cost_of(const struct work *work, uint32_t v, uint32_t to, const uint32_t *ring, int count)
{
    float(*const p)[3] = work->character->position;
    uint32_t other[MAX_RING];
    const int other_count = ring_of(work, to, other);
    int shared = 0;
    for (int i = 0; i < count * other_count; i++) shared += ring[i / other_count] == other[i % other_count];
    if (shared != 2) return INFINITY;
    float largest = 0.0f, color = 0.0f;
    for (int a = work->first[v]; a < work->first[v + 1]; a++) {
        const uint32_t *corner = work->indices + 3 * work->around[a];
        if (corner[0] == to || corner[1] == to || corner[2] == to) continue;
        const float *moved[3];
        for (int k = 0; k < 3; k++) moved[k] = p[corner[k] == v ? to : corner[k]];
        const vec3s before = triangle_normal(p[corner[0]], p[corner[1]], p[corner[2]]);
        const vec3s after = triangle_normal(moved[0], moved[1], moved[2]);
        const float area = glms_vec3_norm(after);
        if (!(glms_vec3_dot(before, after) > FLATTEST * area * glms_vec3_norm(before))) return INFINITY;
        const vec3s way = glms_vec3_sub(vec3_from(p[v]), vec3_from(moved[0]));
        largest = fmaxf(largest, fabsf(glms_vec3_dot(way, after)) / area); // the surface's distance from v
    }
    for (int k = 0; k < 3; k++)
        color = fmaxf(color, fabsf(work->character->color[v][k] - work->character->color[to][k]));
    return largest + COLOR_WEIGHT * color + 0.02f * glms_vec3_distance(vec3_from(p[v]), vec3_from(p[to]));
}

static int compare_collapses(const void *a, const void *b)
{
    const struct collapse *x = a, *y = b;
    if (x->cost != y->cost) return x->cost < y->cost ? -1 : 1;
    return x->from < y->from ? -1 : x->from > y->from;
}

void decimate(const struct character *character, int triangles, uint32_t *indices, int *index_count)
{
    const size_t vertices = (size_t)character->vertex_count, corners = (size_t)character->index_count;
    struct work work = {.character = character, .indices = indices, .index_count = character->index_count};
    struct pool pool = {0};
    work.first = pool_take(&pool, vertices + 2, sizeof *work.first);
    work.around = pool_take(&pool, corners, sizeof *work.around);
    work.locked = pool_take(&pool, vertices, sizeof *work.locked);
    work.collapses = pool_take(&pool, vertices, sizeof *work.collapses);
    memcpy(indices, character->indices, corners * sizeof *indices);
    for (int round = 0; round < MAX_ROUNDS && work.index_count > 3 * triangles; round++) {
        const int most = (work.index_count / 3 - triangles + 1) / 2; // collapses: each removes two triangles
        memset(work.first, 0, (vertices + 2) * sizeof *work.first);
        for (int i = 0; i < work.index_count; i++) work.first[work.indices[i] + 2]++;
        for (size_t v = 0; v < vertices; v++) work.first[v + 2] += work.first[v + 1];
        for (int i = 0; i < work.index_count; i++) work.around[work.first[work.indices[i] + 1]++] = i / 3;
        memset(work.locked, 0, vertices * sizeof *work.locked);

        int found = 0, done = 0;
        for (int v = 0; v < character->vertex_count; v++) {
            uint32_t ring[MAX_RING];
            const int count = ring_of(&work, (uint32_t)v, ring);
            struct collapse best = {(uint32_t)v, 0, INFINITY};
            for (int i = 0; i < count; i++) {
                const float cost = cost_of(&work, (uint32_t)v, ring[i], ring, count);
                if (cost < best.cost) best.to = ring[i], best.cost = cost;
            }
            if (best.cost < INFINITY) work.collapses[found++] = best;
        }
        qsort(work.collapses, (size_t)found, sizeof *work.collapses, compare_collapses);
        for (int i = 0; i < found && done < most; i++) {
            const uint32_t from = work.collapses[i].from, to = work.collapses[i].to;
            uint32_t ring[MAX_RING], other[MAX_RING];
            const int count = ring_of(&work, from, ring), other_count = ring_of(&work, to, other);
            bool free = !work.locked[from] && !work.locked[to];
            for (int k = 0; k < count; k++) free = free && !work.locked[ring[k]];
            for (int k = 0; k < other_count; k++) free = free && !work.locked[other[k]];
            if (!free) continue;

            // Its triangles move over, and everything around is locked, so that the round's other costs stay valid.
            for (int k = 0; k < count; k++) work.locked[ring[k]] = true;
            for (int k = 0; k < other_count; k++) work.locked[other[k]] = true;
            for (int a = work.first[from]; a < work.first[from + 1]; a++) {
                uint32_t *corner = work.indices + 3 * work.around[a];
                for (int k = 0; k < 3; k++) {
                    if (corner[k] == from) corner[k] = to;
                }
            }
            done++;
        }

        int kept = 0; // without those that have become flat
        for (int t = 0; t < work.index_count; t += 3) {
            if (triangle_repeats(work.indices + t)) continue;
            for (int k = 0; k < 3; k++) work.indices[kept++] = work.indices[t + k];
        }
        work.index_count = kept;
        if (done == 0) break;
    }
    *index_count = work.index_count;
    pool_free(&pool);
}

/// Half-edge collapses in rounds. In each round every removable vertex picks its cheapest neighbour to collapse onto; the collapses are done
/// from the cheapest on, except those that touch changed triangles.
#include "model/figure.h"
#include "model/vector.h"
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
    size_t vertex_count;
    uint32_t *indices, *sources;
    int index_count;
    int *first;   ///< of the vertex's triangles in `around`, per vertex and one more
    int *around;  ///< triangles by vertex
    bool *locked; ///< touched in this round
    struct collapse *collapses;
};

static void index_triangles(struct work *work)
{
    const int vertices = work->character->vertex_count;
    memset(work->first, 0, ((size_t)vertices + 2) * sizeof *work->first);
    for (int i = 0; i < work->index_count; i++) work->first[work->indices[i] + 2]++;
    for (int v = 0; v < vertices; v++) work->first[v + 2] += work->first[v + 1];
    for (int i = 0; i < work->index_count; i++) work->around[work->first[work->indices[i] + 1]++] = i / 3;
}

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

/// The effect on a triangle of moving corner v to `to`: false if it folds over; else the surface's distance from v, metres.
static bool moved_triangle(const struct work *work, const uint32_t corner[3], uint32_t v, uint32_t to,
                           float *distance)
{
    float(*const p)[3] = work->character->position;
    const float *moved[3];
    for (int k = 0; k < 3; k++) moved[k] = p[corner[k] == v ? to : corner[k]];
    const vec3s before = triangle_normal(p[corner[0]], p[corner[1]], p[corner[2]]);
    const vec3s after = triangle_normal(moved[0], moved[1], moved[2]);
    const float area = glms_vec3_norm(after);
    if (!(glms_vec3_dot(before, after) > FLATTEST * area * glms_vec3_norm(before))) return false;
    *distance = fabsf(glms_vec3_dot(glms_vec3_sub(vec3_from(p[v]), vec3_from(moved[0])), after)) / area;
    return true;
}

/// Number of vertices common to two rings.
static int shared(const uint32_t *a, int a_count, const uint32_t *b, int b_count)
{
    int count = 0;
    for (int i = 0; i < a_count; i++) {
        for (int k = 0; k < b_count; k++) count += a[i] == b[k];
    }
    return count;
}

/// INFINITY if v cannot collapse onto `to`: the surface would fold, or two sheets would meet (the two must share exactly the vertices of the
/// triangles on their edge).
static float cost_of(const struct work *work, uint32_t v, uint32_t to, const uint32_t *ring, int count)
{
    uint32_t other[MAX_RING];
    const int other_count = ring_of(work, to, other);
    if (other_count == 0 || shared(ring, count, other, other_count) != 2) return INFINITY;
    float largest = 0.0f, color = 0.0f;
    for (int a = work->first[v]; a < work->first[v + 1]; a++) {
        const uint32_t *corner = work->indices + 3 * work->around[a];
        float distance;
        if (corner[0] == to || corner[1] == to || corner[2] == to) continue;
        if (!moved_triangle(work, corner, v, to, &distance)) return INFINITY;
        largest = fmaxf(largest, distance);
    }
    for (int k = 0; k < 3; k++)
        color = fmaxf(color, fabsf(work->character->color[v][k] - work->character->color[to][k]));
    const vec3s from = vec3_from(work->character->position[v]), onto = vec3_from(work->character->position[to]);
    return largest + COLOR_WEIGHT * color + 0.02f * glms_vec3_distance(from, onto);
}

static int compare_collapses(const void *a, const void *b)
{
    const struct collapse *x = a, *y = b;
    if (x->cost != y->cost) return x->cost < y->cost ? -1 : 1;
    return x->from < y->from ? -1 : x->from > y->from;
}

static int find_collapses(const struct work *work)
{
    int found = 0;
    for (int v = 0; v < work->character->vertex_count; v++) {
        uint32_t ring[MAX_RING];
        const int count = ring_of(work, (uint32_t)v, ring);
        struct collapse best = {(uint32_t)v, 0, INFINITY};
        for (int i = 0; i < count; i++) {
            const float cost = cost_of(work, (uint32_t)v, ring[i], ring, count);
            if (cost < best.cost) best.to = ring[i], best.cost = cost;
        }
        if (best.cost < INFINITY) work->collapses[found++] = best;
    }
    qsort(work->collapses, (size_t)found, sizeof *work->collapses, compare_collapses);
    return found;
}

/// Moves v's triangles over and locks everything around, so that the round's other costs stay valid.
static bool carry_out(struct work *work, const struct collapse *collapse)
{
    uint32_t ring[MAX_RING], other[MAX_RING];
    const int count = ring_of(work, collapse->from, ring), other_count = ring_of(work, collapse->to, other);
    bool free = !work->locked[collapse->from] && !work->locked[collapse->to];
    for (int i = 0; i < count; i++) free = free && !work->locked[ring[i]];
    for (int i = 0; i < other_count; i++) free = free && !work->locked[other[i]];
    if (!free) return false;
    for (int i = 0; i < count; i++) work->locked[ring[i]] = true;
    for (int i = 0; i < other_count; i++) work->locked[other[i]] = true;
    for (int a = work->first[collapse->from]; a < work->first[collapse->from + 1]; a++) {
        uint32_t *corner = work->indices + 3 * work->around[a];
        for (int k = 0; k < 3; k++) {
            if (corner[k] == collapse->from) corner[k] = collapse->to;
        }
    }
    return true;
}

static void drop_flat(struct work *work)
{
    int kept = 0;
    for (int t = 0; t < work->index_count; t += 3) {
        if (triangle_repeats(work->indices + t)) continue;
        if (work->sources) work->sources[kept / 3] = work->sources[t / 3];
        for (int k = 0; k < 3; k++) work->indices[kept++] = work->indices[t + k];
    }
    work->index_count = kept;
}

/// One round of at most `most` collapses, each removing two triangles; returns how many there were.
static int collapse_round(struct work *work, int most)
{
    index_triangles(work);
    memset(work->locked, 0, work->vertex_count * sizeof *work->locked);
    const int found = find_collapses(work);
    int done = 0;
    for (int i = 0; i < found && done < most; i++) done += carry_out(work, &work->collapses[i]);
    drop_flat(work);
    return done;
}

void decimate(const struct character *character, int triangles, uint32_t *indices, uint32_t *sources,
              int *index_count)
{
    const size_t vertices = (size_t)character->vertex_count, count = (size_t)character->index_count;
    struct work work = {.character = character,
                        .vertex_count = vertices,
                        .indices = indices,
                        .sources = sources,
                        .index_count = character->index_count};
    struct pool pool = {0};
    work.first = pool_take(&pool, vertices + 2, sizeof *work.first);
    work.around = pool_take(&pool, count, sizeof *work.around);
    work.locked = pool_take(&pool, vertices, sizeof *work.locked);
    work.collapses = pool_take(&pool, vertices, sizeof *work.collapses);
    memcpy(indices, character->indices, count * sizeof *indices);
    for (uint32_t t = 0; sources && t < (uint32_t)count / 3; t++) sources[t] = t;
    for (int round = 0; round < MAX_ROUNDS && work.index_count > 3 * triangles; round++) {
        if (collapse_round(&work, (work.index_count / 3 - triangles + 1) / 2) == 0) break;
    }
    *index_count = work.index_count;
    pool_free(&pool);
}

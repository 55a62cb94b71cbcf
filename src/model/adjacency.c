/// Lists the neighbours of every vertex, and the triangles across edges.
#include "model/adjacency.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static int compare_spots(const void *a, const void *b)
{
    const struct spot *p = a, *q = b;
    for (int k = 0; k < 3; k++) {
        if (p->position[k] != q->position[k]) return p->position[k] < q->position[k] ? -1 : 1;
    }
    return p->vertex < q->vertex ? -1 : p->vertex > q->vertex;
}

bool spots_meet(const struct spot *a, const struct spot *b)
{
    return memcmp(a->position, b->position, sizeof a->position) == 0;
}

void spots_sort(const float (*position)[3], int count, struct spot *spots)
{
    for (int i = 0; i < count; i++) {
        for (int k = 0; k < 3; k++) spots[i].position[k] = position[i][k] + 0.0f; // −0 becomes 0
        spots[i].vertex = (uint32_t)i;
    }
    qsort(spots, (size_t)count, sizeof *spots, compare_spots);
}

void spots_first(const struct spot *spots, int count, uint32_t *first)
{
    for (int i = 0; i < count; i++) {
        const bool same = i > 0 && spots_meet(&spots[i - 1], &spots[i]);
        first[spots[i].vertex] = same ? first[spots[i - 1].vertex] : spots[i].vertex;
    }
}

/// Counts both directions of an edge if there is no list yet, else enters them at `fill`. Both ends may be twins of one vertex, which is then
/// its own neighbour.
static void add_edge(struct adjacency *adjacency, int *fill, uint32_t i, uint32_t j)
{
    if (i == j) return;
    if (adjacency->other) {
        adjacency->other[fill[i]] = j;
        adjacency->other[fill[j]] = i;
    }
    fill[i]++;
    fill[j]++;
}

struct edges {
    const uint32_t *indices;
    int index_count;
    const struct spot *spots;
    uint32_t *twin; ///< per vertex: the next one that differs only in its texture coordinates, in a ring
    int vertex_count;
};

/// As many vertices at one place are not a seam but a collapsed mesh.
enum { TWINS_MAX = 16 };

static void add_edges(struct adjacency *adjacency, const struct edges *edges, int *fill)
{
    for (int t = 0; t < edges->index_count; t++) {
        const uint32_t i = edges->indices[t], j = edges->indices[next_corner(t)];
        add_edge(adjacency, fill, i, j); // and to all twins of both its ends
        for (uint32_t twin = edges->twin[i]; twin != i; twin = edges->twin[twin]) add_edge(adjacency, fill, twin, j);
        for (uint32_t twin = edges->twin[j]; twin != j; twin = edges->twin[twin]) add_edge(adjacency, fill, i, twin);
    }
    for (int i = 0; i + 1 < edges->vertex_count; i++) {
        const struct spot *a = &edges->spots[i], *b = a + 1;
        if (spots_meet(a, b)) add_edge(adjacency, fill, a->vertex, b->vertex);
    }
}

static int compare_vertices(const void *a, const void *b)
{
    const uint32_t *p = a, *q = b;
    return *p < *q ? -1 : *p > *q;
}

struct adjacency adjacency_create(struct pool *pool, const float (*position)[3], const float (*normal)[3],
                                  int vertex_count, const uint32_t *indices, int index_count)
{
    const size_t room = (size_t)vertex_count + 1;
    struct pool work = {0};
    struct adjacency adjacency = {0};
    struct spot *spots = pool_take(&work, room, sizeof *spots);
    int *fill = pool_take(&work, room, sizeof *fill);
    const struct edges edges = {indices, index_count, spots, pool_take(&work, room, sizeof *edges.twin),
                                vertex_count};
    adjacency.first = pool_take(pool, room, sizeof *adjacency.first);
    spots_sort(position, vertex_count, spots);
    for (int i = 0, end; i < vertex_count; i = end) {
        const struct spot *first = &spots[i];
        end = i + 1;
        while (end < vertex_count && spots_meet(first, &spots[end]) &&
               memcmp(normal[first->vertex], normal[spots[end].vertex], sizeof *normal) == 0)
            end++;
        for (int n = i; n < end; n++) {
            const int next = end - i > TWINS_MAX ? n : n + 1 < end ? n + 1 : i;
            edges.twin[spots[n].vertex] = spots[next].vertex;
        }
    }
    add_edges(&adjacency, &edges, fill);
    for (int i = 0; i < vertex_count; i++) adjacency.first[i + 1] = adjacency.first[i] + fill[i];
    memcpy(fill, adjacency.first, (size_t)vertex_count * sizeof *fill);
    adjacency.other = pool_take(pool, (size_t)adjacency.first[vertex_count], sizeof *adjacency.other);
    add_edges(&adjacency, &edges, fill);

    // Sort each vertex's neighbours and remove duplicates (most edges are in two triangles).
    int kept = 0;
    for (int i = 0; i < vertex_count; i++) {
        const int begin = adjacency.first[i], end = adjacency.first[i + 1];
        uint32_t *list = adjacency.other + begin;
        qsort(list, (size_t)(end - begin), sizeof *list, compare_vertices);
        adjacency.first[i] = kept;
        for (int n = 0; n < end - begin; n++) {
            if (n > 0 && list[n] == list[n - 1]) continue;
            adjacency.other[kept++] = list[n];
        }
    }
    adjacency.first[vertex_count] = kept;
    pool_free(&work);
    return adjacency;
}

// --- triangles across edges: an edge a → b is b → a there

/// Corners tried for one edge: more at one place are a collapsed mesh.
enum { CORNERS_MAX = 64 };

/// Rounds places to a grid so fine that it joins only vertices meant to be one, such as the ends of a ring that differ by rounding.
static float (*snap(struct pool *work, const float (*position)[3], int count))[3]
{
    static const float CELLS = 1 << 20;
    float(*snapped)[3] = pool_take(work, (size_t)count, sizeof *snapped), largest = 0.0f;
    for (int i = 0; i < 3 * count; i++) largest = fmaxf(largest, fabsf(position[i / 3][i % 3]));
    const float cell = largest / CELLS;
    for (int i = 0; i < 3 * count; i++) {
        const float place = position[i / 3][i % 3];
        snapped[i / 3][i % 3] = cell > 0.0f ? cell * roundf(place / cell) : place;
    }
    return snapped;
}

static int corner_before(int i) { return i % 3 == 0 ? i + 2 : i - 1; }

void neighbours_find(const float (*position)[3], int vertex_count, const uint32_t *indices, int index_count,
                     int *neighbours)
{
    const size_t vertices = (size_t)vertex_count;
    struct pool work = {0};
    float(*snapped)[3] = snap(&work, position, vertex_count);
    struct spot *spots = pool_take(&work, vertices, sizeof *spots);
    uint32_t *spot = pool_take(&work, vertices, sizeof *spot); // per vertex: the first one at its place
    int *last = pool_take(&work, vertices, sizeof *last);      // per such vertex: a corner there, and how many
    int *many = pool_take(&work, vertices, sizeof *many);
    int *before = pool_take(&work, (size_t)index_count, sizeof *before); // per corner: another there, −1: none
    spots_sort((const float(*)[3])snapped, vertex_count, spots);
    spots_first(spots, vertex_count, spot);
    for (int v = 0; v < vertex_count; v++) last[v] = -1;
    for (int i = 0; i < index_count; i++) {
        before[i] = last[spot[indices[i]]];
        last[spot[indices[i]]] = i;
        many[spot[indices[i]]]++;
    }
    for (int i = 0; i < index_count; i++) {
        // Tries the end with fewer corners, so that the centre of a large fan costs nothing.
        const uint32_t from = spot[indices[i]], to = spot[indices[next_corner(i)]];
        const bool at_end = many[to] <= many[from];
        neighbours[i] = NEIGHBOUR_NONE;
        for (int n = 0, other = last[at_end ? to : from]; other >= 0 && n < CORNERS_MAX; n++, other = before[other]) {
            const int begins = at_end ? other : corner_before(other), ends = next_corner(begins);
            if (spot[indices[begins]] != to || spot[indices[ends]] != from) continue;
            neighbours[i] = begins / 3;
            if (spot[indices[next_corner(ends)]] != spot[indices[corner_before(i)]]) break; // else its own back
        }
    }
    pool_free(&work);
}

void neighbours_cut(const float (*position)[3], const uint32_t *indices, const uint32_t *look, int index_count,
                    int *neighbours)
{
    for (int i = 0; i < index_count; i++) {
        const int other = neighbours[i], ends[2] = {i, next_corner(i)};
        if (other < 0 || other > i / 3) continue;
        for (int e = 0; e < 2; e++) {
            const float *place = position[indices[ends[e]]];
            int there = 3 * other; // the nearest corner of that triangle
            float least = INFINITY;
            for (int c = 3 * other; c < 3 * other + 3; c++) {
                const float *own = position[indices[c]];
                const float x = own[0] - place[0], y = own[1] - place[1], z = own[2] - place[2];
                const float distance = x * x + y * y + z * z;
                if (distance >= least) continue;
                least = distance;
                there = c;
            }
            if (look[there] != look[ends[e]]) neighbours[i] = NEIGHBOUR_CUT;
        }
    }
}

uint32_t neighbours_look(int material, const float color[3])
{
    uint32_t look = (uint32_t)material;
    for (int k = 0; k < 3; k++) look = look << 4 | (uint32_t)lroundf(8.0f * fminf(fmaxf(color[k], 0.0f), 1.0f));
    return look;
}

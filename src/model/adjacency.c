/// Lists the neighbours of every vertex.
#include "model/adjacency.h"
#include "base/need.h"
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
        for (int k = 0; k < 3; k++) spots[i].position[k] = position[i][k] + 0.0f; // −0 is 0
        spots[i].vertex = (uint32_t)i;
    }
    qsort(spots, (size_t)count, sizeof *spots, compare_spots);
}

/// Both directions of an edge: only counted while there is no list yet, else entered at `fill`. Twins may be the ends of one, so a vertex may
/// be its own other end.
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
    uint32_t *twin; ///< of each vertex: the next one that is the same but for its texture coordinates, in a ring
    int vertex_count;
};

/// Vertices as many as these at one place are no seam, but a mesh that has collapsed.
enum { TWINS_MAX = 16 };

static void find_twins(const struct edges *edges, const float (*normal)[3])
{
    for (int i = 0, end; i < edges->vertex_count; i = end) {
        const struct spot *first = &edges->spots[i];
        end = i + 1;
        while (end < edges->vertex_count && spots_meet(first, &edges->spots[end]) &&
               memcmp(normal[first->vertex], normal[edges->spots[end].vertex], sizeof *normal) == 0)
            end++;
        for (int n = i; n < end; n++) {
            const int next = end - i > TWINS_MAX ? n : n + 1 < end ? n + 1 : i;
            edges->twin[edges->spots[n].vertex] = edges->spots[next].vertex;
        }
    }
}

/// An edge, which the twins of both its ends share.
static void add_shared(struct adjacency *adjacency, const struct edges *edges, int *fill, uint32_t i, uint32_t j)
{
    add_edge(adjacency, fill, i, j);
    for (uint32_t twin = edges->twin[i]; twin != i; twin = edges->twin[twin]) add_edge(adjacency, fill, twin, j);
    for (uint32_t twin = edges->twin[j]; twin != j; twin = edges->twin[twin]) add_edge(adjacency, fill, i, twin);
}

static void add_edges(struct adjacency *adjacency, const struct edges *edges, int *fill)
{
    for (int t = 0; t < edges->index_count; t++) {
        add_shared(adjacency, edges, fill, edges->indices[t], edges->indices[t % 3 == 2 ? t - 2 : t + 1]);
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

/// Sorts each vertex's neighbours and removes duplicates: most edges belong to two triangles.
static void tidy(struct adjacency *adjacency, int vertex_count)
{
    int kept = 0;
    for (int i = 0; i < vertex_count; i++) {
        const int begin = adjacency->first[i], end = adjacency->first[i + 1];
        uint32_t *list = adjacency->other + begin;
        qsort(list, (size_t)(end - begin), sizeof *list, compare_vertices);
        adjacency->first[i] = kept;
        for (int n = 0; n < end - begin; n++) {
            if (n > 0 && list[n] == list[n - 1]) continue;
            adjacency->other[kept++] = list[n];
        }
    }
    adjacency->first[vertex_count] = kept;
}

void adjacency_create(struct adjacency *adjacency, const float (*position)[3], const float (*normal)[3],
                      int vertex_count, const uint32_t *indices, int index_count)
{
    const size_t room = (size_t)vertex_count + 1;
    *adjacency = (struct adjacency){0};
    struct spot *spots = need(room, sizeof *spots);
    int *fill = need_zeroed(room, sizeof *fill);
    const struct edges edges = {indices, index_count, spots, need(room, sizeof *edges.twin), vertex_count};
    adjacency->first = need_zeroed(room, sizeof *adjacency->first);
    spots_sort(position, vertex_count, spots);
    find_twins(&edges, normal);
    add_edges(adjacency, &edges, fill);
    for (int i = 0; i < vertex_count; i++) adjacency->first[i + 1] = adjacency->first[i] + fill[i];
    memcpy(fill, adjacency->first, (size_t)vertex_count * sizeof *fill);
    adjacency->other = need((size_t)adjacency->first[vertex_count] + 1, sizeof *adjacency->other);
    add_edges(adjacency, &edges, fill);
    tidy(adjacency, vertex_count);
    free(spots);
    free(edges.twin);
    free(fill);
}

void adjacency_free(struct adjacency *adjacency)
{
    free(adjacency->first);
    free(adjacency->other);
    *adjacency = (struct adjacency){0};
}

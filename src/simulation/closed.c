/// Counts the edges of a surface that lack a partner.
#include "simulation/closed.h"
#include "model/adjacency.h"
#include <stdlib.h>

/// name[i]: one number for all vertices at the same place.
static bool weld(const struct surface *surface, uint32_t *name)
{
    struct spot *spots = spots_sort((const float(*)[3])surface->position, surface->vertex_count);
    if (!spots) return false;
    for (int i = 0, first = 0; i < surface->vertex_count; i++) {
        if (!spots_meet(&spots[first], &spots[i])) first = i;
        name[spots[i].vertex] = (uint32_t)first;
    }
    free(spots);
    return true;
}

/// An edge with its smaller end first, and the direction in which a triangle runs along it.
struct edge {
    uint64_t key;
    int direction;
};

static int compare_edges(const void *a, const void *b)
{
    const struct edge *x = a, *y = b;
    return x->key < y->key ? -1 : x->key > y->key;
}

static int count_open(const struct surface *surface, const uint32_t *name, struct edge *edges)
{
    size_t count = 0;
    for (int i = 0; i < surface->index_count; i++) {
        uint64_t from = name[surface->indices[i]], to = name[surface->indices[i % 3 == 2 ? i - 2 : i + 1]];
        if (from == to) continue;
        edges[count++] = from < to ? (struct edge){from << 32 | to, 1} : (struct edge){to << 32 | from, -1};
    }
    qsort(edges, count, sizeof *edges, compare_edges);
    int open = 0, sum = 0;
    for (size_t i = 0; i < count; i++) {
        sum += edges[i].direction;
        if (i + 1 < count && edges[i + 1].key == edges[i].key) continue;
        open += sum != 0;
        sum = 0;
    }
    return open;
}

int surface_open_edges(const struct surface *surface)
{
    uint32_t *name = calloc((size_t)surface->vertex_count + 1, sizeof *name);
    struct edge *edges = calloc((size_t)surface->index_count + 1, sizeof *edges);
    int open = name && edges && weld(surface, name) ? count_open(surface, name, edges) : -1;
    free(name);
    free(edges);
    return open;
}

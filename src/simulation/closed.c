/// Counts the edges of a surface that lack a partner.
#include "simulation/closed.h"
#include <stdlib.h>
#include <string.h>

struct place {
    float position[3];
    uint32_t index;
};

static int compare_places(const void *a, const void *b)
{
    const struct place *p = a, *q = b;
    for (int k = 0; k < 3; k++) {
        if (p->position[k] != q->position[k]) return p->position[k] < q->position[k] ? -1 : 1;
    }
    return 0;
}

/// name[i]: one number for all vertices at the same place.
static bool weld(const struct surface *surface, uint32_t *name)
{
    const size_t count = (size_t)surface->vertex_count;
    struct place *places = calloc(count + 1, sizeof *places);
    if (!places) return false;
    for (size_t i = 0; i < count; i++) {
        memcpy(places[i].position, surface->position[i], sizeof places[i].position);
        places[i].index = (uint32_t)i;
    }
    qsort(places, count, sizeof *places, compare_places);
    for (size_t i = 0, first = 0; i < count; i++) {
        if (compare_places(&places[first], &places[i]) != 0) first = i;
        name[places[i].index] = (uint32_t)first;
    }
    free(places);
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

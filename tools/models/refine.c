/// Splits triangles that are too flat or too large.
#include "base/need.h"
#include "model/vector.h"
#include "models/isosurface.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define WHOLE UINT32_MAX
#define MAX_CONTRAST 0.25f /* of linear colours: only eyes, nose and the edges of markings have more */

/// An undirected edge and the vertex that halves it.
struct edge {
    uint32_t low, high, middle;
};

static int compare_edges(const void *a, const void *b)
{
    const struct edge *x = a, *y = b;
    if (x->low != y->low) return x->low < y->low ? -1 : 1;
    return x->high < y->high ? -1 : x->high > y->high;
}

static struct edge edge_between(uint32_t a, uint32_t b) { return (struct edge){a < b ? a : b, a < b ? b : a, WHOLE}; }

/// The edges of `count` triangles, sorted and without duplicates; returns their number.
static size_t collect_edges(const uint32_t *triangles, size_t count, struct edge *edges)
{
    for (size_t t = 0; t < count; t++) {
        const uint32_t *v = triangles + 3 * t;
        for (size_t e = 0; e < 3; e++) edges[3 * t + e] = edge_between(v[e], v[(e + 1) % 3]);
    }
    qsort(edges, 3 * count, sizeof *edges, compare_edges);
    size_t unique = 0;
    for (size_t e = 0; e < 3 * count; e++) {
        if (unique == 0 || compare_edges(&edges[unique - 1], &edges[e]) != 0) edges[unique++] = edges[e];
    }
    return unique;
}

/// Height above the edge of a circular arc with both ends' normals: length · angle/8.
static float sagitta(const struct vertex *a, const struct vertex *b)
{
    const float length = glms_vec3_distance2(vec3_from(a->position), vec3_from(b->position));
    const float turn = glms_vec3_distance2(vec3_from(a->normal), vec3_from(b->normal));
    return 0.125f * sqrtf(length * turn);
}

/// Whether the ends' colours differ so much that the edge would blur detail between them.
static bool blurs(const struct vertex *a, const struct vertex *b)
{
    return glms_vec3_norm_inf(glms_vec3_sub(vec3_from(a->color), vec3_from(b->color))) > MAX_CONTRAST;
}

/// Adds a middle on the surface to every edge that is too flat; returns whether there was one.
static bool halve_edges(const struct solid *solid, float tolerance, struct edge *edges, size_t count,
                        struct mesh *mesh)
{
    bool any = false;
    for (size_t e = 0; e < count; e++) {
        const struct vertex a = mesh->vertices[edges[e].low], b = mesh->vertices[edges[e].high];
        if (sagitta(&a, &b) <= tolerance && !blurs(&a, &b)) continue;
        struct vertex middle = {0};
        vec3s from = vec3_from(a.position), to = vec3_from(b.position);
        glm_vec3_center(from.raw, to.raw, middle.position);
        surface_place(solid, 0.5f * glms_vec3_distance(from, to), &middle);
        edges[e].middle = mesh_vertex(mesh, &middle);
        any = true;
    }
    return any;
}

/// A triangle with a middle or WHOLE on each edge v[e] → v[e + 1]; becomes one to four.
static void split(const uint32_t v[3], const uint32_t middle[3], struct mesh *mesh)
{
    const int halved = (middle[0] != WHOLE) + (middle[1] != WHOLE) + (middle[2] != WHOLE);
    if (halved == 0) {
        mesh_triangle(mesh, v[0], v[1], v[2]);
    } else if (halved == 3) {
        for (int e = 0; e < 3; e++) mesh_triangle(mesh, v[e], middle[e], middle[(e + 2) % 3]);
        mesh_triangle(mesh, middle[0], middle[1], middle[2]);
    } else {
        // Start at the halved edge after a whole one.
        int s = 0;
        while (middle[s] == WHOLE || middle[(s + 2) % 3] != WHOLE) s++;
        const uint32_t a = v[s], b = v[(s + 1) % 3], c = v[(s + 2) % 3], ab = middle[s], bc = middle[(s + 1) % 3];
        const uint32_t cut = halved == 2 ? bc : c;
        mesh_triangle(mesh, ab, b, cut);
        mesh_triangle(mesh, a, ab, cut);
        if (halved == 2) mesh_triangle(mesh, a, bc, c);
    }
}

/// Splits the triangles along their halved edges.
static void split_all(const uint32_t *triangles, size_t count, const struct edge *edges, size_t edge_count,
                      struct mesh *mesh)
{
    for (size_t t = 0; t < count; t++) {
        const uint32_t *v = triangles + 3 * t;
        uint32_t middle[3];
        for (size_t e = 0; e < 3; e++) {
            const struct edge key = edge_between(v[e], v[(e + 1) % 3]);
            const struct edge *found = bsearch(&key, edges, edge_count, sizeof *edges, compare_edges);
            middle[e] = found->middle;
        }
        split(v, middle, mesh);
    }
}

void refine(const struct solid *solid, float tolerance, int rounds, int first_index, struct mesh *mesh)
{
    for (bool any = true; any && rounds > 0; rounds--) {
        const size_t indices = (size_t)(mesh->index_count - first_index);
        uint32_t *triangles = need(indices, sizeof *triangles);
        struct edge *edges = need(indices, sizeof *edges);
        memcpy(triangles, mesh->indices + first_index, indices * sizeof *triangles);
        const size_t edge_count = collect_edges(triangles, indices / 3, edges);
        any = halve_edges(solid, tolerance, edges, edge_count, mesh);
        mesh->index_count = first_index;
        split_all(triangles, indices / 3, edges, edge_count, mesh);
        free(triangles);
        free(edges);
    }
}

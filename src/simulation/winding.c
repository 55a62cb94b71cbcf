/// A tree of triangles, and sums over it.
#include "base/need.h"
#include "simulation/linear.h"
#include "simulation/solid.h"
#include <math.h>
#include <stdlib.h>

enum { LEAF = 8, DEPTH_MAX = 64 };

// At this many radii a node counts as a dipole: the sum is then off by less than 0.01.
static const double FAR = 4;

void triangle_measure(const struct surface *surface, int triangle, double normal[3], double middle[3])
{
    double p[3][3], edge[2][3];
    triangle_corners(surface, triangle, p);
    for (int c = 0; c < 3; c++) {
        for (int k = 0; k < 2; k++) edge[k][c] = p[k + 1][c] - p[0][c];
        middle[c] = p[0][c] + p[1][c] + p[2][c];
    }
    vec3_cross(edge[0], edge[1], normal);
}

/// A triangle's area vector and centre.
static void weigh_triangle(const struct surface *surface, int triangle, double area[3], double middle[3])
{
    triangle_measure(surface, triangle, area, middle);
    for (int c = 0; c < 3; c++) {
        area[c] /= 2;
        middle[c] /= 3;
    }
}

static void measure_node(const struct winding *w, struct winding_node *node, double lo[3], double hi[3])
{
    double total = 0;
    for (int c = 0; c < 3; c++) {
        lo[c] = INFINITY;
        hi[c] = -INFINITY;
    }
    for (int i = node->first; i < node->first + node->count; i++) {
        double area[3], middle[3];
        weigh_triangle(w->surface, w->order[i], area, middle);
        const double size = fmax(vec3_length(area), 1e-300);
        total += size;
        for (int c = 0; c < 3; c++) {
            node->area[c] += area[c];
            node->middle[c] += size * middle[c];
            lo[c] = fmin(lo[c], middle[c]);
            hi[c] = fmax(hi[c], middle[c]);
        }
    }
    for (int c = 0; c < 3; c++) node->middle[c] /= total;
    for (int i = node->first; i < node->first + node->count; i++) {
        double p[3][3];
        triangle_corners(w->surface, w->order[i], p);
        for (int k = 0; k < 3; k++) {
            const double away[3] = {p[k][0] - node->middle[0], p[k][1] - node->middle[1], p[k][2] - node->middle[2]};
            node->radius = fmax(node->radius, vec3_length(away));
        }
    }
}

/// Moves triangles whose centre is below `at` on an axis to the front; returns how many there are.
static int part(const struct winding *w, int first, int count, int axis, double at)
{
    int below = 0;
    for (int i = first; i < first + count; i++) {
        double area[3], middle[3];
        weigh_triangle(w->surface, w->order[i], area, middle);
        if (!(middle[axis] < at)) continue;
        const int swap = w->order[i];
        w->order[i] = w->order[first + below];
        w->order[first + below++] = swap;
    }
    return below;
}

/// Halves the box of the centres; if all are in one half, halves the list.
static int build(struct winding *w, int first, int count, int depth)
{
    const int number = w->node_count++;
    struct winding_node *node = &w->nodes[number];
    double lo[3], hi[3];
    *node = (struct winding_node){.first = first, .count = count};
    measure_node(w, node, lo, hi);
    if (count <= LEAF || depth + 1 >= DEPTH_MAX) return number;
    int axis = 0;
    for (int c = 1; c < 3; c++) axis = hi[c] - lo[c] > hi[axis] - lo[axis] ? c : axis;
    int below = part(w, first, count, axis, (lo[axis] + hi[axis]) / 2);
    if (below == 0 || below == count) below = count / 2;
    build(w, first, below, depth + 1);
    w->nodes[number].second = build(w, first + below, count - below, depth + 1);
    return number;
}

void winding_create(struct winding *winding, const struct surface *surface)
{
    const int triangles = surface->index_count / 3;
    *winding = (struct winding){.surface = surface};
    winding->order = need((size_t)triangles + 1, sizeof *winding->order);
    winding->nodes = need(2 * (size_t)triangles + 1, sizeof *winding->nodes);
    for (int i = 0; i < triangles; i++) winding->order[i] = i;
    if (triangles > 0) build(winding, 0, triangles, 0);
}

void winding_free(struct winding *winding)
{
    free(winding->order);
    free(winding->nodes);
    *winding = (struct winding){0};
}

/// Half the solid angle of a triangle (van Oosterom and Strackee).
static double half_angle(const struct surface *surface, int triangle, const double point[3])
{
    double p[3][3], length[3], across[3];
    triangle_corners(surface, triangle, p);
    for (int k = 0; k < 3; k++) {
        for (int c = 0; c < 3; c++) p[k][c] -= point[c];
        length[k] = vec3_length(p[k]);
    }
    vec3_cross(p[1], p[2], across);
    return atan2(vec3_dot(p[0], across), length[0] * length[1] * length[2] + vec3_dot(p[0], p[1]) * length[2] +
                                             vec3_dot(p[1], p[2]) * length[0] + vec3_dot(p[2], p[0]) * length[1]);
}

double winding_at(const struct winding *winding, const double point[3])
{
    const double pi = 3.14159265358979323846;
    double angle = 0; // half the solid angle
    int waiting[DEPTH_MAX + 2], count = 0;
    if (winding->node_count > 0) waiting[count++] = 0;
    while (count > 0) {
        const int number = waiting[--count];
        const struct winding_node *node = &winding->nodes[number];
        const double to[3] = {node->middle[0] - point[0], node->middle[1] - point[1], node->middle[2] - point[2]};
        const double square = vec3_dot(to, to);
        if (square > FAR * FAR * node->radius * node->radius) {
            angle += vec3_dot(to, node->area) / (2 * square * sqrt(square));
        } else if (node->second) {
            waiting[count++] = node->second;
            waiting[count++] = number + 1;
        } else {
            for (int i = node->first; i < node->first + node->count; i++)
                angle += half_angle(winding->surface, winding->order[i], point);
        }
    }
    return angle / (2 * pi);
}

/// Turns a surface's triangles to face outwards, finds where it is open, and fills it with voxels.
#include "base/need.h"
#include "base/progress.h"
#include "model/adjacency.h"
#include "simulation/body.h"
#include "simulation/lattice.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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

// --- winding numbers: a tree of triangles, and sums over it

enum { LEAF = 8, DEPTH_MAX = 64 };

// At this many radii a node counts as a dipole: the sum is then off by less than 0.01.
static const double FAR = 4;

/// A triangle's area vector and centre.
static void weigh_triangle(const struct surface *surface, int triangle, double area[3], double middle[3])
{
    triangle_measure(surface, triangle, area, middle);
    for (int c = 0; c < 3; c++) {
        area[c] /= 2;
        middle[c] /= 3;
    }
}

/// Measures a node, and halves the box of the centres for its children; if all are in one half, halves the list.
static int build_node(struct winding *w, int first, int count, int depth)
{
    const int number = w->node_count++;
    struct winding_node *node = &w->nodes[number];
    double lo[3] = {INFINITY, INFINITY, INFINITY}, hi[3] = {-INFINITY, -INFINITY, -INFINITY}, total = 0;
    *node = (struct winding_node){.first = first, .count = count};
    for (int i = first; i < first + count; i++) {
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
    for (int i = first; i < first + count; i++) {
        double p[3][3];
        triangle_corners(w->surface, w->order[i], p);
        for (int k = 0; k < 3; k++) {
            const double away[3] = {p[k][0] - node->middle[0], p[k][1] - node->middle[1], p[k][2] - node->middle[2]};
            node->radius = fmax(node->radius, vec3_length(away));
        }
    }
    if (count <= LEAF || depth + 1 >= DEPTH_MAX) return number;
    int axis = 0;
    for (int c = 1; c < 3; c++) axis = hi[c] - lo[c] > hi[axis] - lo[axis] ? c : axis;
    const double at = (lo[axis] + hi[axis]) / 2;
    int below = 0;
    for (int i = first; i < first + count; i++) { // centres below go to the front
        double area[3], middle[3];
        weigh_triangle(w->surface, w->order[i], area, middle);
        if (!(middle[axis] < at)) continue;
        const int swap = w->order[i];
        w->order[i] = w->order[first + below];
        w->order[first + below++] = swap;
    }
    if (below == 0 || below == count) below = count / 2;
    build_node(w, first, below, depth + 1);
    w->nodes[number].second = build_node(w, first + below, count - below, depth + 1);
    return number;
}

void winding_create(struct winding *winding, struct pool *pool, const struct surface *surface)
{
    const int triangles = surface->index_count / 3;
    *winding = (struct winding){.surface = surface};
    winding->order = pool_take(pool, (size_t)triangles + 1, sizeof *winding->order);
    winding->nodes = pool_take(pool, 2 * (size_t)triangles + 1, sizeof *winding->nodes);
    for (int i = 0; i < triangles; i++) winding->order[i] = i;
    if (triangles > 0) build_node(winding, 0, triangles, 0);
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
            for (int i = node->first; i < node->first + node->count; i++) { // by van Oosterom and Strackee
                double p[3][3], length[3], across[3];
                triangle_corners(winding->surface, winding->order[i], p);
                for (int k = 0; k < 3; k++) {
                    for (int c = 0; c < 3; c++) p[k][c] -= point[c];
                    length[k] = vec3_length(p[k]);
                }
                vec3_cross(p[1], p[2], across);
                angle += atan2(vec3_dot(p[0], across),
                               length[0] * length[1] * length[2] + vec3_dot(p[0], p[1]) * length[2] +
                                   vec3_dot(p[1], p[2]) * length[0] + vec3_dot(p[2], p[0]) * length[1]);
            }
        }
    }
    return angle / (2 * pi);
}

// --- repair

enum { RAYS = 64, RAYS_MIN = 8 };

// Ray-triangle tests for all patches together, about two seconds. A patch with less than LEAST_AREA of the area is left as it is.
static const double TESTS_TOGETHER = 8e7, LEAST_AREA = 1e-3;

/// A triangle's edge: its ends, the smaller name first, and whether the triangle runs that way.
struct edge {
    uint64_t ends;
    int triangle, direction;
};

struct repair {
    struct surface *shape;
    uint32_t *name;    ///< per vertex: one number for all vertices at the same place
    struct edge *edge; ///< sorted by ends
    int edge_count;
    int *next; ///< per triangle: its neighbours across edges that exactly two share, as join_triangles() writes them
    uint8_t *turned; ///< per triangle
    int *patch;      ///< triangles, patch by patch
};

struct corners {
    uint32_t name[3]; ///< ascending
    int triangle;
};

static int compare_corners(const void *a, const void *b)
{
    const struct corners *x = a, *y = b;
    for (int k = 0; k < 3; k++) {
        if (x->name[k] != y->name[k]) return x->name[k] < y->name[k] ? -1 : 1;
    }
    return x->triangle - y->triangle;
}

static int compare_edges(const void *a, const void *b)
{
    const struct edge *x = a, *y = b;
    if (x->ends != y->ends) return x->ends < y->ends ? -1 : 1;
    return x->triangle - y->triangle;
}

/// The first edge after those with the same ends as edge i.
static int end_of_group(const struct repair *r, int i)
{
    const uint64_t ends = r->edge[i].ends;
    while (i < r->edge_count && r->edge[i].ends == ends) i++;
    return i;
}

/// Lists a neighbour of a triangle: twice its number, plus 1 if their sides disagree.
static void join_triangles(struct repair *r, int triangle, int other, bool agree)
{
    for (int k = 0; k < 3; k++) {
        int *next = &r->next[3 * triangle + k];
        if (*next >= 0) continue;
        *next = 2 * other + !agree;
        return;
    }
}

static void turn_patch(struct repair *r, int first, int count)
{
    for (int i = first; i < first + count; i++) r->turned[r->patch[i]] ^= 1;
}

static double whole_area(const struct surface *s)
{
    double sum = 0, normal[3], middle[3];
    for (int t = 0; t < s->index_count / 3; t++) {
        triangle_measure(s, t, normal, middle);
        sum += vec3_length(normal);
    }
    return sum;
}

static double random_of(uint32_t *seed)
{
    *seed = 1664525u * *seed + 1013904223u;
    return (*seed >> 8) / 16777216.0;
}

/// Whether a patch's triangles face inwards: lines through it vote. In front of an outward face a line crosses the surface an even
/// number of times, behind it an odd number, not counting the face itself.
static bool faces_inwards(const struct repair *r, int first, int count, int rays)
{
    const struct surface *s = r->shape;
    uint32_t seed = 1;
    int votes = 0;
    for (int ray = 0; ray < rays; ray++) {
        const int own = r->patch[first + (int)(random_of(&seed) * count)];
        double direction[3], normal[3], middle[3];
        triangle_measure(s, own, normal, middle);
        for (int c = 0; c < 3; c++) {
            middle[c] /= 3;
            direction[c] = random_of(&seed) - 0.5;
        }
        const bool along = (vec3_dot(direction, normal) > 0) != r->turned[own];
        int ahead = 0, behind = 0;
        for (int t = 0; t < s->index_count / 3; t++) { // where the line crosses (Möller and Trumbore)
            double p[3][3], edge[2][3], away[3], h[3], q[3];
            if (t == own) continue;
            triangle_corners(s, t, p);
            for (int c = 0; c < 3; c++) {
                for (int k = 0; k < 2; k++) edge[k][c] = p[k + 1][c] - p[0][c];
                away[c] = middle[c] - p[0][c];
            }
            vec3_cross(direction, edge[1], h);
            const double determinant = vec3_dot(edge[0], h);
            if (determinant == 0) continue;
            const double u = vec3_dot(away, h) / determinant;
            vec3_cross(away, edge[0], q);
            const double v = vec3_dot(direction, q) / determinant;
            if (u < 0 || v < 0 || u + v > 1) continue;
            *(vec3_dot(edge[1], q) / determinant > 0 ? &ahead : &behind) += 1;
        }
        const int front = along ? ahead : behind, back = along ? behind : ahead;
        votes += front % 2 ? 1 : -1;
        votes += back % 2 ? -1 : 1;
    }
    return votes > 0;
}

static void turn_patches(struct repair *r)
{
    const int triangles = r->shape->index_count / 3;
    uint8_t *reached = need_zeroed((size_t)triangles + 1, 1);
    const double whole = whole_area(r->shape);
    int left = (int)(TESTS_TOGETHER / (triangles + 40000));
    for (int start = 0, first = 0; start < triangles; start++) {
        if (reached[start]) continue;

        // The triangles connected with the patch's first one are turned to agree with it.
        int count = 1;
        r->patch[first] = start;
        reached[start] = 1;
        for (int i = first; i < first + count; i++) {
            const int t = r->patch[i];
            for (int k = 0; k < 3; k++) {
                const int other = r->next[3 * t + k] / 2, disagree = r->next[3 * t + k] % 2;
                if (r->next[3 * t + k] < 0 || reached[other]) continue;
                reached[other] = 1;
                r->turned[other] = r->turned[t] ^ (uint8_t)disagree;
                r->patch[first + count++] = other;
            }
        }

        // Then the patch faces as most of its area does in the file.
        double area = 0, turned = 0, volume = 0, middle[3] = {0}, normal[3], at[3];
        for (int i = first; i < first + count; i++) {
            triangle_measure(r->shape, r->patch[i], normal, at);
            const double size = vec3_length(normal); // twice the area
            area += size;
            turned += r->turned[r->patch[i]] ? size : 0;
            for (int c = 0; c < 3; c++) middle[c] += size * at[c] / 3;
        }
        if (turned > area / 2) turn_patch(r, first, count);

        // The volume between it and its centre is positive if it bulges the way its triangles face.
        for (int i = first; area > 0 && i < first + count; i++) {
            triangle_measure(r->shape, r->patch[i], normal, at);
            for (int c = 0; c < 3; c++) at[c] = at[c] / 3 - middle[c] / area;
            volume += vec3_dot(normal, at) / 6 * (r->turned[r->patch[i]] ? -1 : 1);
        }
        const int rays = left / 8 < RAYS ? left / 8 : RAYS;
        if (volume < 0 && area > LEAST_AREA * whole && rays >= RAYS_MIN) {
            left -= rays;
            if (faces_inwards(r, first, count, rays)) turn_patch(r, first, count);
        }
        first += count;
    }
    free(reached);
}

/// Reports progress; the parts of the repair take about equally long.
static void report_repair(long parts) { progress_report("mending the mesh", parts, 5); }

void solid_create(struct solid *solid, const struct surface *surface, double thickness)
{
    const size_t indices = (size_t)surface->index_count + 1;
    struct pool work = {0};
    *solid = (struct solid){.shape = *surface, .thickness = thickness};
    solid->shape.indices = pool_take(&solid->pool, indices, sizeof *solid->shape.indices);
    struct repair r = {.shape = &solid->shape,
                       .name = pool_take(&work, (size_t)surface->vertex_count + 1, sizeof *r.name),
                       .edge = pool_take(&work, indices, sizeof *r.edge),
                       .next = pool_take(&work, indices, sizeof *r.next),
                       .turned = pool_take(&work, indices, sizeof *r.turned),
                       .patch = pool_take(&work, indices, sizeof *r.patch)};
    memcpy(solid->shape.indices, surface->indices, (indices - 1) * sizeof *surface->indices);

    report_repair(0); // vertices at the same place get one name
    struct spot *spots = pool_take(&work, (size_t)surface->vertex_count, sizeof *spots);
    spots_sort((const float(*)[3])surface->position, surface->vertex_count, spots);
    for (int i = 0, first = 0; i < surface->vertex_count; i++) {
        if (!spots_meet(&spots[first], &spots[i])) first = i;
        r.name[spots[i].vertex] = (uint32_t)first;
    }
    report_repair(1); // triangles without area go, and all but the first of those with the same corners
    struct surface *s = &solid->shape;
    const int triangles = s->index_count / 3;
    struct corners *all = pool_take(&work, (size_t)triangles + 1, sizeof *all);
    uint8_t *dropped = pool_take(&work, (size_t)triangles + 1, 1);
    int different = 0, kept = 0;
    for (int t = 0; t < triangles; t++) {
        struct corners c = {.triangle = t};
        for (int k = 0; k < 3; k++) {
            const uint32_t name = r.name[s->indices[3 * t + k]];
            int at = k;
            for (; at > 0 && c.name[at - 1] > name; at--) c.name[at] = c.name[at - 1];
            c.name[at] = name;
        }
        dropped[t] = c.name[0] == c.name[1] || c.name[1] == c.name[2];
        if (!dropped[t]) all[different++] = c;
    }
    qsort(all, (size_t)different, sizeof *all, compare_corners);
    for (int i = 1; i < different; i++) {
        if (memcmp(all[i].name, all[i - 1].name, sizeof all->name) != 0) continue;
        dropped[all[i].triangle] = 1;
        solid->duplicates++;
    }
    for (int t = 0; t < triangles; t++) {
        if (!dropped[t]) memmove(s->indices + 3 * kept++, s->indices + 3 * t, 3 * sizeof *s->indices);
    }
    s->index_count = 3 * kept;

    report_repair(2); // edges with the same ends lie together; two triangles that share one are neighbours
    uint32_t *corner = solid->shape.indices;
    r.edge_count = solid->shape.index_count;
    for (int i = 0; i < r.edge_count; i++) {
        const uint64_t from = r.name[corner[i]], to = r.name[corner[i % 3 == 2 ? i - 2 : i + 1]];
        r.edge[i] = from < to ? (struct edge){from << 32 | to, i / 3, 1} : (struct edge){to << 32 | from, i / 3, -1};
    }
    qsort(r.edge, (size_t)r.edge_count, sizeof *r.edge, compare_edges);
    memset(r.next, 0xFF, (size_t)r.edge_count * sizeof *r.next); // −1
    for (int i = 0, end; i < r.edge_count; i = end) {
        end = end_of_group(&r, i);
        if (end - i != 2) continue;
        const struct edge *a = &r.edge[i], *b = a + 1;
        join_triangles(&r, a->triangle, b->triangle, a->direction != b->direction);
        join_triangles(&r, b->triangle, a->triangle, a->direction != b->direction);
    }
    report_repair(3);
    turn_patches(&r);
    for (int i = 0, end; !(thickness > 0) && i < r.edge_count; i = end) { // a closed surface runs each edge both ways
        int sum = 0;
        end = end_of_group(&r, i);
        for (int k = i; k < end; k++) sum += r.edge[k].direction * (r.turned[r.edge[k].triangle] ? -1 : 1);
        solid->open += sum != 0;
    }
    for (int i = 0; i < solid->shape.index_count; i += 3) {
        if (!r.turned[i / 3]) continue;
        const uint32_t swap = corner[i + 1];
        corner[i + 1] = corner[i + 2];
        corner[i + 2] = swap;
        solid->turned++;
    }
    report_repair(4);
    solid->area = whole_area(&solid->shape) / 2;
    if (solid->open > 0) winding_create(&solid->winding, &solid->pool, &solid->shape);
    report_repair(5);
    pool_free(&work);
}

double solid_certainty(const struct solid *solid)
{
    enum { SAMPLES = 512 };
    static const double BEHIND = 1e-4; // relative to the size
    const struct surface *s = &solid->shape;
    double passed = 0, sum = 0, normal[3], at[3];
    int taken = 0;
    if (solid->open == 0) return 1;
    for (int t = 0; t < s->index_count / 3; t++) {
        triangle_measure(s, t, normal, at);
        const double length = vec3_length(normal);
        passed += length / 2;
        const int due =
            (int)fmin(SAMPLES, SAMPLES * passed / solid->area) - taken; // so many samples are in this triangle
        if (due <= 0) continue;
        for (int c = 0; c < 3; c++) at[c] = at[c] / 3 - BEHIND * sqrt(solid->area) * normal[c] / length;
        sum += due * fmin(1, fmax(0, winding_at(&solid->winding, at)));
        taken += due;
    }
    return taken > 0 ? sum / taken : 0;
}

void solid_describe(const struct solid *solid, char text[160])
{
    int at = 0;
    text[0] = '\0';
    if (solid->thickness > 0) return;
    if (solid->duplicates > 0) at += snprintf(text, 160, "%d duplicate triangles left out", solid->duplicates);
    if (solid->turned > 0)
        at += snprintf(text + at, (size_t)(160 - at), "%s%d triangles turned to face outwards", at ? ", " : "",
                       solid->turned);
    if (solid->open > 0)
        snprintf(text + at, (size_t)(160 - at),
                 "%sopen at %d edges: inside is where its winding number exceeds a half", at ? ", " : "",
                 solid->open);
}

// --- voxels: winding numbers along columns
//
// A column of voxel centres along z is a ray; each triangle that it passes through changes the winding number by one.
// In the (x, y) plane all coordinates are rounded to a grid of 2⁻²⁴ of the largest side, so that the test of a point against an
// edge is exact in 64-bit integers. A point on an edge counts as moved by (ε, ε²). So no ray slips between two triangles or hits
// both, and the winding number returns to 0 in every column.

enum { TELLING = 3 << 16 }; ///< corners between two progress reports

struct crossing {
    int column; ///< i·size[1] + j
    int turn;   ///< +1 or −1
    double z;   ///< in voxels from the origin
};

struct crossings {
    struct crossing *items;
    size_t count, capacity;
};

struct point {
    int64_t x, y;
};

/// Twice the signed area of (a, b, p): positive where p is on the left.
static int64_t area_of(struct point a, struct point b, struct point p)
{
    return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

/// Whether p, moved by (ε, ε²), is on the left of a → b.
static bool left_of(struct point a, struct point b, struct point p)
{
    int64_t side = area_of(a, b, p);
    if (side != 0) return side > 0;
    return a.y != b.y ? b.y < a.y : b.x > a.x;
}

/// How the rounded plane lies over the voxels.
struct raster {
    const struct voxels *voxels;
    double scale; ///< grid steps a metre
};

static struct point rounded(const struct raster *raster, double x, double y)
{
    const double *origin = raster->voxels->origin;
    return (struct point){llround((x - origin[0]) * raster->scale), llround((y - origin[1]) * raster->scale)};
}

/// Records where columns pass through a triangle.
static void rasterise(const struct raster *raster, const struct surface *surface, const uint32_t index[3],
                      struct crossings *list)
{
    const struct voxels *v = raster->voxels;
    struct point p[3];
    double z[3];
    int lo[2] = {v->size[0], v->size[1]}, hi[2] = {-1, -1};
    for (int k = 0; k < 3; k++) {
        const float *at = surface->position[index[k]];
        p[k] = rounded(raster, (double)at[0], (double)at[1]);
        z[k] = (double)at[2];
        for (int c = 0; c < 2; c++) {
            double place = ((double)at[c] - v->origin[c]) / v->spacing - 0.5; // the margin covers rounding
            lo[c] = (int)fmax(0, fmin(lo[c], floor(place - 0.01)));
            hi[c] = (int)fmin(v->size[c] - 1, fmax(hi[c], ceil(place + 0.01)));
        }
    }
    if (area_of(p[0], p[1], p[2]) == 0) return; // edge-on or degenerate: no ray passes through
    for (int i = lo[0]; i <= hi[0]; i++) {
        for (int j = lo[1]; j <= hi[1]; j++) {
            const double x = v->origin[0] + (i + 0.5) * v->spacing, y = v->origin[1] + (j + 0.5) * v->spacing;
            const struct point at = rounded(raster, x, y);
            const int lefts = left_of(p[0], p[1], at) + left_of(p[1], p[2], at) + left_of(p[2], p[0], at);
            if (lefts != 0 && lefts != 3) continue; // the column passes by
            double sum = 0, height = 0;
            for (int k = 0; k < 3; k++) {
                const double weight = (double)area_of(p[(k + 1) % 3], p[(k + 2) % 3], at);
                sum += weight;
                height += weight * z[k];
            }
            height /= sum;
            if (list->count == list->capacity) {
                list->capacity = list->capacity ? 2 * list->capacity : 4096;
                list->items = need_more(list->items, list->capacity, sizeof *list->items);
            }
            list->items[list->count++] =
                (struct crossing){i * v->size[1] + j, lefts ? 1 : -1, (height - v->origin[2]) / v->spacing};
        }
    }
}

static int compare_crossings(const void *a, const void *b)
{
    const struct crossing *x = a, *y = b;
    if (x->column != y->column) return x->column < y->column ? -1 : 1;
    return x->z < y->z ? -1 : x->z > y->z;
}

/// One column of an open surface. The winding number w changes by one at each triangle crossed; w − `crossed` changes smoothly, so
/// that few samples are enough.
struct column {
    struct voxels *voxels;
    const struct winding *winding;
    int i, j;
    int *crossed; ///< per voxel: times the column has entered below, less times it has left
};

static double smooth_at(const struct column *c, int k)
{
    const struct voxels *v = c->voxels;
    const int at[3] = {c->i, c->j, k};
    double point[3];
    for (int a = 0; a < 3; a++) point[a] = v->origin[a] + (at[a] + 0.5) * v->spacing;
    return winding_at(c->winding, point) - c->crossed[k];
}

/// Marks the voxels from k up to `end` (exclusive). Between them the smooth part goes linearly from `from` to `to`.
static void fill_smooth(const struct column *c, int k, double from, int end, double to)
{
    uint8_t *inside = c->voxels->inside + (size_t)(c->i * c->voxels->size[1] + c->j) * (size_t)c->voxels->size[2];
    for (int n = k; n < end; n++) inside[n] = from + (to - from) * (n - k) / (end - k) + c->crossed[n] > 0.5;
}

/// The same, halving the range until the smooth part is linear.
static void fill_between(const struct column *c, int k, double from, int end, double to)
{
    static const double CURVED = 0.02;
    const int middle = (k + end) / 2;
    if (middle == k) {
        fill_smooth(c, k, from, end, to);
        return;
    }
    const double there = smooth_at(c, middle), line = from + (to - from) * (middle - k) / (end - k);
    const bool straight = fabs(there - line) < CURVED;
    void (*const half)(const struct column *, int, double, int, double) = straight ? fill_smooth : fill_between;
    half(c, k, from, middle, there);
    half(c, middle, there, end, to);
}

/// Outside the surface's box everything is outside.
static void fill_open(struct voxels *v, const struct solid *solid, const struct crossings *list)
{
    enum { STEP = 16 };
    int lo[3], hi[3];
    double least[3], most[3];
    struct column c = {.voxels = v, .winding = &solid->winding};
    c.crossed = need((size_t)v->size[2], sizeof *c.crossed);
    surface_bounds(&solid->shape, least, most);
    for (int a = 0; a < 3; a++) { // without the grid's border
        lo[a] = (int)fmax(1, floor((least[a] - v->origin[a]) / v->spacing));
        hi[a] = (int)fmin(v->size[a] - 1, ceil((most[a] - v->origin[a]) / v->spacing));
    }
    size_t next = 0;
    for (c.i = lo[0]; c.i < hi[0]; c.i++) {
        progress_report("looking for the inside of the open mesh", c.i - lo[0], hi[0] - lo[0]);
        for (c.j = lo[1]; c.j < hi[1]; c.j++) {
            const int column = c.i * v->size[1] + c.j;
            int sum = 0;
            while (next < list->count && list->items[next].column < column) next++;
            for (int k = 0; k < v->size[2]; k++) {
                for (; next < list->count && list->items[next].column == column && list->items[next].z < k + 0.5;
                     next++)
                    sum -= list->items[next].turn; // a triangle that faces up ends the inside
                c.crossed[k] = sum;
            }
            double from = smooth_at(&c, lo[2]);
            for (int k = lo[2]; k < hi[2]; k += STEP) {
                const int end = k + STEP < hi[2] ? k + STEP : hi[2];
                const double to = smooth_at(&c, end);
                fill_between(&c, k, from, end, to);
                from = to;
            }
        }
    }
    progress_report("looking for the inside of the open mesh", 1, 1);
    free(c.crossed);
}

static void fill_sheet(struct voxels *v, const struct solid *solid)
{
    const double reach = (1 + 1e-6) * sheet_thickness(solid, v) / 2;
    const int triangles = solid->shape.index_count / 3;
    for (int t = 0; t < triangles; t++) {
        double corner[3][3], edge[3][3], normal[3];
        int lo[3], hi[3];
        if (t % TELLING == 0) progress_report("cutting the mesh into tetrahedra", t, triangles);
        triangle_corners(&solid->shape, t, corner);
        for (int c = 0; c < 3; c++) {
            const double low = fmin(corner[0][c], fmin(corner[1][c], corner[2][c])) - reach - v->origin[c];
            const double high = fmax(corner[0][c], fmax(corner[1][c], corner[2][c])) + reach - v->origin[c];
            lo[c] = (int)ceil(low / v->spacing - 0.5);
            hi[c] = (int)floor(high / v->spacing - 0.5);
            for (int k = 0; k < 3; k++) edge[k][c] = corner[(k + 1) % 3][c] - corner[k][c];
        }
        vec3_cross(edge[0], edge[1], normal);
        const double size = vec3_dot(normal, normal);
        for (int i = lo[0]; i <= hi[0]; i++) {
            for (int j = lo[1]; j <= hi[1]; j++) {
                uint8_t *inside = v->inside + (size_t)(i * v->size[1] + j) * (size_t)v->size[2];
                for (int k = lo[2]; k <= hi[2]; k++) {
                    // Squared distance from the triangle: from its plane above it, else from its nearest edge.
                    const int at[3] = {i, j, k};
                    double away[3][3], across[3], height = 0, nearest = INFINITY;
                    bool above = size > 0;
                    if (inside[k]) continue;
                    for (int n = 0; n < 9; n++)
                        away[n / 3][n % 3] = v->origin[n % 3] + (at[n % 3] + 0.5) * v->spacing - corner[n / 3][n % 3];
                    height = vec3_dot(normal, away[0]);
                    for (int n = 0; n < 3; n++) {
                        const double length = fmax(vec3_dot(edge[n], edge[n]), 1e-300);
                        const double along = fmin(1, fmax(0, vec3_dot(edge[n], away[n]) / length));
                        vec3_cross(edge[n], away[n], across);
                        above = above && vec3_dot(across, normal) >= 0;
                        for (int c = 0; c < 3; c++) away[n][c] -= along * edge[n][c];
                        nearest = fmin(nearest, vec3_dot(away[n], away[n]));
                    }
                    inside[k] = (above ? height * height / size : nearest) <= reach * reach;
                }
            }
        }
    }
}

void voxels_fill(struct voxels *voxels, const struct solid *solid)
{
    const struct surface *surface = &solid->shape;
    struct crossings list = {0};
    voxels->inside = pool_take(&voxels->pool, voxels_count(voxels), 1);
    if (solid->thickness > 0) {
        fill_sheet(voxels, solid);
        return;
    }
    struct raster raster = {.voxels = voxels};
    raster.scale = (1 << 24) / (voxels->spacing * fmax(voxels->size[0], voxels->size[1]));
    for (int i = 0; i < surface->index_count; i += 3) {
        if (i % TELLING == 0) progress_report("cutting the mesh into tetrahedra", i, surface->index_count);
        rasterise(&raster, surface, surface->indices + i, &list);
    }
    progress_report("cutting the mesh into tetrahedra", surface->index_count, surface->index_count);
    if (list.count) qsort(list.items, list.count, sizeof *list.items, compare_crossings);
    if (solid->open) fill_open(voxels, solid, &list);

    int winding = 0;
    for (size_t i = 0; !solid->open && i + 1 < list.count; i++) {
        const struct crossing *here = &list.items[i], *next = here + 1;
        winding += here->turn;
        voxels->overlaps |= abs(winding) > 1 && next->column == here->column && next->z > here->z;
        if (next->column != here->column) {
            winding = 0;
        } else if (winding != 0) {
            const int first = (int)fmax(0, ceil(here->z - 0.5)),
                      end = (int)fmin(voxels->size[2], ceil(next->z - 0.5));
            uint8_t *column = voxels->inside + (size_t)here->column * (size_t)voxels->size[2];
            if (end > first) memset(column + first, 1, (size_t)(end - first));
        }
    }
    free(list.items);
}

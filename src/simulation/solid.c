/// Turns a surface's triangles to face outwards, and finds where it is open.
#include "simulation/solid.h"
#include "base/need.h"
#include "base/progress.h"
#include "model/adjacency.h"
#include "simulation/linear.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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
    int *next;       ///< per triangle and corner: the triangle across that edge if exactly two share it, else −1
    uint8_t *turned; ///< per triangle
    int *patch;      ///< triangles, patch by patch
};

static void weld(const struct surface *surface, uint32_t *name)
{
    struct spot *spots = need((size_t)surface->vertex_count, sizeof *spots);
    spots_sort((const float(*)[3])surface->position, surface->vertex_count, spots);
    for (int i = 0, first = 0; i < surface->vertex_count; i++) {
        if (!spots_meet(&spots[first], &spots[i])) first = i;
        name[spots[i].vertex] = (uint32_t)first;
    }
    free(spots);
}

// --- triangles with the same corners

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

/// Marks triangles without area, and all but the first of those with the same corners, as left out.
static void leave_out(struct repair *r, int *duplicates)
{
    struct surface *s = r->shape;
    const int triangles = s->index_count / 3;
    struct corners *all = need((size_t)triangles + 1, sizeof *all);
    uint8_t *dropped = need_zeroed((size_t)triangles + 1, 1);
    int count = 0, kept = 0;
    for (int t = 0; t < triangles; t++) {
        struct corners c = {.triangle = t};
        for (int k = 0; k < 3; k++) {
            const uint32_t name = r->name[s->indices[3 * t + k]];
            int at = k;
            for (; at > 0 && c.name[at - 1] > name; at--) c.name[at] = c.name[at - 1];
            c.name[at] = name;
        }
        dropped[t] = c.name[0] == c.name[1] || c.name[1] == c.name[2];
        if (!dropped[t]) all[count++] = c;
    }
    qsort(all, (size_t)count, sizeof *all, compare_corners);
    for (int i = 1; i < count; i++) {
        if (memcmp(all[i].name, all[i - 1].name, sizeof all->name) != 0) continue;
        dropped[all[i].triangle] = 1;
        ++*duplicates;
    }
    for (int t = 0; t < triangles; t++) {
        if (!dropped[t]) memmove(s->indices + 3 * kept++, s->indices + 3 * t, 3 * sizeof *s->indices);
    }
    s->index_count = 3 * kept;
    free(all);
    free(dropped);
}

// --- edges

static int compare_edges(const void *a, const void *b)
{
    const struct edge *x = a, *y = b;
    if (x->ends != y->ends) return x->ends < y->ends ? -1 : 1;
    return x->triangle - y->triangle;
}

static void list_edges(struct repair *r)
{
    const struct surface *s = r->shape;
    r->edge_count = s->index_count;
    for (int i = 0; i < s->index_count; i++) {
        const uint64_t from = r->name[s->indices[i]], to = r->name[s->indices[i % 3 == 2 ? i - 2 : i + 1]];
        r->edge[i] = from < to ? (struct edge){from << 32 | to, i / 3, 1} : (struct edge){to << 32 | from, i / 3, -1};
    }
    qsort(r->edge, (size_t)r->edge_count, sizeof *r->edge, compare_edges);
}

/// The first edge after those with the same ends as edge i.
static int end_of_group(const struct repair *r, int i)
{
    const uint64_t ends = r->edge[i].ends;
    while (i < r->edge_count && r->edge[i].ends == ends) i++;
    return i;
}

static int count_open(const struct repair *r)
{
    int open = 0;
    for (int i = 0, end; i < r->edge_count; i = end) {
        int sum = 0;
        end = end_of_group(r, i);
        for (int k = i; k < end; k++) sum += r->edge[k].direction * (r->turned[r->edge[k].triangle] ? -1 : 1);
        open += sum != 0;
    }
    return open;
}

// --- patches

static void join(struct repair *r, int triangle, int other, bool agree)
{
    for (int k = 0; k < 3; k++) {
        int *next = &r->next[3 * triangle + k];
        if (*next >= 0) continue;
        *next = 2 * other + !agree;
        return;
    }
}

/// Lists the neighbours of each triangle: twice their number, plus 1 if their sides disagree.
static void join_neighbours(struct repair *r)
{
    memset(r->next, 0xFF, (size_t)r->edge_count * sizeof *r->next); // −1
    for (int i = 0, end; i < r->edge_count; i = end) {
        end = end_of_group(r, i);
        if (end - i != 2) continue;
        const struct edge *a = &r->edge[i], *b = a + 1;
        join(r, a->triangle, b->triangle, a->direction != b->direction);
        join(r, b->triangle, a->triangle, a->direction != b->direction);
    }
}

/// Turns the triangles connected with the first one of a patch to agree with it; returns how many there are.
static int spread(struct repair *r, uint8_t *reached, int first)
{
    int count = 1;
    reached[r->patch[first]] = 1;
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
    return count;
}

static void turn_patch(struct repair *r, int first, int count)
{
    for (int i = first; i < first + count; i++) r->turned[r->patch[i]] ^= 1;
}

/// A patch turned like most of its area in the file.
struct settled {
    double area;   ///< twice it
    double volume; ///< between the patch and its centre: positive if it bulges the way its triangles face
};

static struct settled settle_patch(struct repair *r, int first, int count)
{
    struct settled patch = {0};
    double middle[3] = {0}, turned = 0, normal[3], at[3];
    for (int i = first; i < first + count; i++) {
        triangle_measure(r->shape, r->patch[i], normal, at);
        const double area = vec3_length(normal);
        patch.area += area;
        turned += r->turned[r->patch[i]] ? area : 0;
        for (int c = 0; c < 3; c++) middle[c] += area * at[c] / 3;
    }
    if (turned > patch.area / 2) turn_patch(r, first, count);
    for (int i = first; patch.area > 0 && i < first + count; i++) {
        triangle_measure(r->shape, r->patch[i], normal, at);
        for (int c = 0; c < 3; c++) at[c] = at[c] / 3 - middle[c] / patch.area;
        patch.volume += vec3_dot(normal, at) / 6 * (r->turned[r->patch[i]] ? -1 : 1);
    }
    return patch;
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

/// How a ray from `from` crosses a triangle: 1 ahead, −1 behind, 0 not (Möller and Trumbore).
static int crosses(const struct surface *s, int triangle, const double from[3], const double direction[3])
{
    double p[3][3], edge[2][3], away[3], h[3], q[3];
    triangle_corners(s, triangle, p);
    for (int c = 0; c < 3; c++) {
        for (int k = 0; k < 2; k++) edge[k][c] = p[k + 1][c] - p[0][c];
        away[c] = from[c] - p[0][c];
    }
    vec3_cross(direction, edge[1], h);
    const double determinant = vec3_dot(edge[0], h);
    if (determinant == 0) return 0;
    const double u = vec3_dot(away, h) / determinant;
    vec3_cross(away, edge[0], q);
    const double v = vec3_dot(direction, q) / determinant;
    if (u < 0 || v < 0 || u + v > 1) return 0;
    return vec3_dot(edge[1], q) / determinant > 0 ? 1 : -1;
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
        for (int t = 0; t < s->index_count / 3; t++) {
            const int side = t == own ? 0 : crosses(s, t, middle, direction);
            ahead += side > 0;
            behind += side < 0;
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
        r->patch[first] = start;
        const int count = spread(r, reached, first);
        const struct settled patch = settle_patch(r, first, count);
        const int rays = left / 8 < RAYS ? left / 8 : RAYS;
        if (patch.volume < 0 && patch.area > LEAST_AREA * whole && rays >= RAYS_MIN) {
            left -= rays;
            if (faces_inwards(r, first, count, rays)) turn_patch(r, first, count);
        }
        first += count;
    }
    free(reached);
}

static int apply_turns(struct repair *r)
{
    int turned = 0;
    for (int t = 0; t < r->shape->index_count / 3; t++) {
        uint32_t *corner = r->shape->indices + 3 * t, swap = corner[1];
        if (!r->turned[t]) continue;
        corner[1] = corner[2];
        corner[2] = swap;
        turned++;
    }
    return turned;
}

/// Reports progress; the parts of the repair take about equally long.
static void tell(long parts) { stage_tell("mending the mesh", parts, 5); }

static void repair(struct solid *solid, struct repair *r)
{
    tell(0);
    weld(&solid->shape, r->name);
    tell(1);
    leave_out(r, &solid->duplicates);
    tell(2);
    list_edges(r);
    join_neighbours(r);
    tell(3);
    turn_patches(r);
    solid->open = solid->thickness > 0 ? 0 : count_open(r);
    solid->turned = apply_turns(r);
    tell(4);
    solid->area = whole_area(&solid->shape) / 2;
    if (solid->open > 0) winding_create(&solid->winding, &solid->shape);
    tell(5);
}

void solid_create(struct solid *solid, const struct surface *surface, double thickness)
{
    const size_t indices = (size_t)surface->index_count + 1;
    *solid = (struct solid){.shape = *surface, .thickness = thickness};
    solid->shape.indices = need(indices, sizeof *solid->shape.indices);
    struct repair r = {.shape = &solid->shape,
                       .name = need((size_t)surface->vertex_count + 1, sizeof *r.name),
                       .edge = need(indices, sizeof *r.edge),
                       .next = need(indices, sizeof *r.next),
                       .turned = need_zeroed(indices, sizeof *r.turned),
                       .patch = need(indices, sizeof *r.patch)};
    memcpy(solid->shape.indices, surface->indices, (indices - 1) * sizeof *surface->indices);
    repair(solid, &r);
    free(r.name);
    free(r.edge);
    free(r.next);
    free(r.turned);
    free(r.patch);
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

void solid_free(struct solid *solid)
{
    winding_free(&solid->winding);
    free(solid->shape.indices);
    *solid = (struct solid){0};
}

void solid_describe(const struct solid *solid, char text[160])
{
    const char *then = "";
    int at = 0;
    text[0] = '\0';
    if (solid->thickness > 0) return;
    if (solid->duplicates > 0) {
        at += snprintf(text + at, (size_t)(160 - at), "%d duplicate triangles left out", solid->duplicates);
        then = ", ";
    }
    if (solid->turned > 0) {
        at += snprintf(text + at, (size_t)(160 - at), "%s%d triangles turned to face outwards", then, solid->turned);
        then = ", ";
    }
    if (solid->open > 0)
        snprintf(text + at, (size_t)(160 - at),
                 "%sopen at %d edges: inside is where its winding number exceeds a half", then, solid->open);
}

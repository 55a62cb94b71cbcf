/// Winding numbers along columns.
///
/// A column of voxel centres along z is a ray; each triangle that it passes through changes the winding number by one.
/// In the (x, y) plane all coordinates are rounded to a grid of 2⁻²⁴ of the largest side, so that the test of a point against an
/// edge is exact in 64-bit integers. A point on an edge counts as moved by (ε, ε²). So no ray slips between two triangles or hits
/// both, and the winding number returns to 0 in every column.
#include "base/need.h"
#include "base/progress.h"
#include "simulation/linear.h"
#include "simulation/solid.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

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

static void push(struct crossings *list, struct crossing crossing)
{
    if (list->count == list->capacity) {
        list->capacity = list->capacity ? 2 * list->capacity : 4096;
        list->items = need_more(list->items, list->capacity, sizeof *list->items);
    }
    list->items[list->count++] = crossing;
}

/// Twice the signed area of (a, b, p): positive where p is on the left.
static int64_t area(struct point a, struct point b, struct point p)
{
    return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

/// Whether p, moved by (ε, ε²), is on the left of a → b.
static bool left_of(struct point a, struct point b, struct point p)
{
    int64_t side = area(a, b, p);
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

/// Records where the column passes through the triangle, if it does.
static void cross(const struct raster *raster, const struct point p[3], const double z[3], int i, int j,
                  struct crossings *list)
{
    const struct voxels *v = raster->voxels;
    struct point at = rounded(raster, v->origin[0] + (i + 0.5) * v->spacing, v->origin[1] + (j + 0.5) * v->spacing);
    int lefts = left_of(p[0], p[1], at) + left_of(p[1], p[2], at) + left_of(p[2], p[0], at);
    if (lefts != 0 && lefts != 3) return;
    double weight[3], sum = 0, height = 0;
    for (int k = 0; k < 3; k++) {
        weight[k] = (double)area(p[(k + 1) % 3], p[(k + 2) % 3], at);
        sum += weight[k];
        height += weight[k] * z[k];
    }
    height /= sum;
    push(list, (struct crossing){i * v->size[1] + j, lefts ? 1 : -1, (height - v->origin[2]) / v->spacing});
}

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
    if (area(p[0], p[1], p[2]) == 0) return; // edge-on or degenerate: no ray passes through
    for (int i = lo[0]; i <= hi[0]; i++) {
        for (int j = lo[1]; j <= hi[1]; j++) cross(raster, p, z, i, j, list);
    }
}

static int compare(const void *a, const void *b)
{
    const struct crossing *x = a, *y = b;
    if (x->column != y->column) return x->column < y->column ? -1 : 1;
    return x->z < y->z ? -1 : x->z > y->z;
}

/// Marks the voxels between two crossings of a column.
static void fill(struct voxels *voxels, int column, double from, double to)
{
    int first = (int)fmax(0, ceil(from - 0.5)), end = (int)fmin(voxels->size[2], ceil(to - 0.5));
    uint8_t *start = voxels->inside + (size_t)column * (size_t)voxels->size[2];
    if (end > first) memset(start + first, 1, (size_t)(end - first));
}

/// All crossings, column by column upwards.
static void find_crossings(const struct voxels *voxels, const struct surface *surface, struct crossings *list)
{
    double side = voxels->spacing * fmax(voxels->size[0], voxels->size[1]);
    struct raster raster = {.voxels = voxels, .scale = (1 << 24) / side};
    for (int i = 0; i < surface->index_count; i += 3) {
        if (i % TELLING == 0) stage_tell("cutting the mesh into tetrahedra", i, surface->index_count);
        rasterise(&raster, surface, surface->indices + i, list);
    }
    stage_tell("cutting the mesh into tetrahedra", surface->index_count, surface->index_count);
    if (list->count) qsort(list->items, list->count, sizeof *list->items, compare);
}

static void fill_closed(struct voxels *voxels, const struct crossings *list)
{
    int winding = 0;
    for (size_t i = 0; i + 1 < list->count; i++) {
        const struct crossing *here = &list->items[i], *next = here + 1;
        winding += here->turn;
        voxels->overlaps |= abs(winding) > 1 && next->column == here->column && next->z > here->z;
        if (next->column != here->column) {
            winding = 0;
        } else if (winding != 0) {
            fill(voxels, here->column, here->z, next->z);
        }
    }
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

/// Voxels lo ≤ i < hi within the surface's box, without the grid's border.
static void find_range(const struct voxels *v, const struct surface *surface, int lo[3], int hi[3])
{
    double least[3], most[3];
    surface_bounds(surface, least, most);
    for (int c = 0; c < 3; c++) {
        lo[c] = (int)fmax(1, floor((least[c] - v->origin[c]) / v->spacing));
        hi[c] = (int)fmin(v->size[c] - 1, ceil((most[c] - v->origin[c]) / v->spacing));
    }
}

/// Outside the surface's box everything is outside.
static void fill_open(struct voxels *v, const struct solid *solid, const struct crossings *list)
{
    enum { STEP = 16 };
    int lo[3], hi[3];
    struct column c = {.voxels = v, .winding = &solid->winding};
    c.crossed = need((size_t)v->size[2], sizeof *c.crossed);
    find_range(v, &solid->shape, lo, hi);
    size_t next = 0;
    for (c.i = lo[0]; c.i < hi[0]; c.i++) {
        stage_tell("looking for the inside of the open mesh", c.i - lo[0], hi[0] - lo[0]);
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
    stage_tell("looking for the inside of the open mesh", 1, 1);
    free(c.crossed);
}

/// Squared distance of a point from a triangle: from its plane if it lies above it, else from its nearest edge.
static double distance_squared(const double corner[3][3], const double at[3])
{
    double edge[3][3], away[3][3], normal[3], across[3], nearest = INFINITY;
    for (int k = 0; k < 9; k++) {
        edge[k / 3][k % 3] = corner[(k / 3 + 1) % 3][k % 3] - corner[k / 3][k % 3];
        away[k / 3][k % 3] = at[k % 3] - corner[k / 3][k % 3];
    }
    vec3_cross(edge[0], edge[1], normal);
    const double size = vec3_dot(normal, normal), height = vec3_dot(normal, away[0]);
    bool above = size > 0;
    for (int k = 0; k < 3; k++) {
        const double length = fmax(vec3_dot(edge[k], edge[k]), 1e-300);
        const double along = fmin(1, fmax(0, vec3_dot(edge[k], away[k]) / length));
        vec3_cross(edge[k], away[k], across);
        above = above && vec3_dot(across, normal) >= 0;
        for (int c = 0; c < 3; c++) away[k][c] -= along * edge[k][c];
        nearest = fmin(nearest, vec3_dot(away[k], away[k]));
    }
    return above ? height * height / size : nearest;
}

static void fill_near(struct voxels *v, const double corner[3][3], double reach)
{
    int lo[3], hi[3];
    double at[3];
    for (int c = 0; c < 3; c++) {
        const double low = fmin(corner[0][c], fmin(corner[1][c], corner[2][c])) - reach - v->origin[c];
        const double high = fmax(corner[0][c], fmax(corner[1][c], corner[2][c])) + reach - v->origin[c];
        lo[c] = (int)ceil(low / v->spacing - 0.5);
        hi[c] = (int)floor(high / v->spacing - 0.5);
    }
    for (int i = lo[0]; i <= hi[0]; i++) {
        at[0] = v->origin[0] + (i + 0.5) * v->spacing;
        for (int j = lo[1]; j <= hi[1]; j++) {
            uint8_t *inside = v->inside + (size_t)(i * v->size[1] + j) * (size_t)v->size[2];
            at[1] = v->origin[1] + (j + 0.5) * v->spacing;
            for (int k = lo[2]; k <= hi[2]; k++) {
                at[2] = v->origin[2] + (k + 0.5) * v->spacing;
                if (!inside[k]) inside[k] = distance_squared(corner, at) <= reach * reach;
            }
        }
    }
}

static void fill_sheet(struct voxels *voxels, const struct solid *solid)
{
    const double reach = (1 + 1e-6) * sheet_thickness(solid, voxels) / 2;
    const int triangles = solid->shape.index_count / 3;
    for (int t = 0; t < triangles; t++) {
        double corner[3][3];
        if (t % TELLING == 0) stage_tell("cutting the mesh into tetrahedra", t, triangles);
        triangle_corners(&solid->shape, t, corner);
        fill_near(voxels, (const double(*)[3])corner, reach);
    }
}

void voxels_fill(struct voxels *voxels, const struct solid *solid)
{
    struct crossings list = {0};
    voxels->inside = need_zeroed(voxels_count(voxels), 1);
    if (solid->thickness > 0) {
        fill_sheet(voxels, solid);
        return;
    }
    find_crossings(voxels, &solid->shape, &list);
    if (solid->open)
        fill_open(voxels, solid, &list);
    else
        fill_closed(voxels, &list);
    free(list.items);
}

void voxels_free(struct voxels *voxels)
{
    free(voxels->inside);
    voxels->inside = NULL;
}

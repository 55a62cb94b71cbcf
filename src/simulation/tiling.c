/// Cuts a solid into elements by the tetrahedra of a lattice.
#include "base/need.h"
#include "simulation/lattice.h"
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/// Disjoint sets: the least member of i's set (union by index, path halving). parent[i] = i at the start.
static int union_root(int *parent, int i)
{
    while (parent[i] != i) {
        parent[i] = parent[parent[i]];
        i = parent[i];
    }
    return i;
}

static void union_join(int *parent, int i, int j)
{
    i = union_root(parent, i);
    j = union_root(parent, j);
    if (i < j) {
        parent[j] = i;
    } else {
        parent[i] = j;
    }
}

/// Half of a voxel's 26 neighbours, so that each pair is visited once.
static const int neighbours[13][3] = {{0, 0, 1},  {0, 1, -1}, {0, 1, 0},  {0, 1, 1}, {1, -1, -1},
                                      {1, -1, 0}, {1, -1, 1}, {1, 0, -1}, {1, 0, 0}, {1, 0, 1},
                                      {1, 1, -1}, {1, 1, 0},  {1, 1, 1}};

/// Cubes along a side of the surface's box, with a margin.
static double cells_along(double side, double cell) { return ceil(side / cell) + 2; }

double tiling_voxels(const struct solid *solid, double cell)
{
    double lo[3], hi[3], count = 1;
    surface_bounds(&solid->shape, lo, hi);
    for (int c = 0; c < 3; c++) count *= cells_along(hi[c] - lo[c] + solid->thickness, cell) * VOXELS_A_CELL;
    return count;
}

/// Voxels over the surface's box and margin, centred, so that a symmetric solid is cut symmetrically; then moved up or down by at
/// most a quarter of a cell, so that a layer of nodes lies at `layer`.
static void lay_out(struct voxels *voxels, const struct solid *solid, double cell, double layer)
{
    double lo[3], hi[3];
    surface_bounds(&solid->shape, lo, hi);
    voxels->spacing = cell / VOXELS_A_CELL;
    for (int c = 0; c < 3; c++) {
        int cells = (int)cells_along(hi[c] - lo[c] + solid->thickness, cell);
        voxels->size[c] = cells * VOXELS_A_CELL;
        voxels->origin[c] = (lo[c] + hi[c] - cells * cell) / 2;
    }
    if (isfinite(layer)) voxels->origin[1] += remainder(layer - voxels->origin[1], cell / 2);
}

/// Number of a point of the lattice, given in half cells from the origin.
static int point_key(const struct voxels *voxels, const int p[3])
{
    int ny = voxels->size[1] / VOXELS_A_CELL * 2 + 1, nz = voxels->size[2] / VOXELS_A_CELL * 2 + 1;
    return (p[0] * ny + p[1]) * nz + p[2];
}

void tiling_point(const struct tiling *tiling, int key, double position[3])
{
    const struct voxels *v = &tiling->voxels;
    int ny = v->size[1] / VOXELS_A_CELL * 2 + 1, nz = v->size[2] / VOXELS_A_CELL * 2 + 1;
    const int p[3] = {key / (ny * nz), key / nz % ny, key % nz};
    for (int c = 0; c < 3; c++) position[c] = v->origin[c] + p[c] * v->spacing * VOXELS_A_CELL / 2;
}

/// The tetrahedron that holds a voxel's centre: from the cube's centre towards the nearest face, then towards that face's nearest
/// edge. `key` names its nodes: the two cubes' centres and the edge's ends.
static void tetrahedron_at(const struct voxels *voxels, const int voxel[3], int key[4])
{
    int from_centre[3], centre[3], order[3] = {0, 1, 2}, steps = 0;
    for (int c = 0; c < 3; c++) {
        from_centre[c] = 2 * (voxel[c] % VOXELS_A_CELL) - (VOXELS_A_CELL - 1);
        steps += (abs(from_centre[c]) + 1) / 2;
        centre[c] = 2 * (voxel[c] / VOXELS_A_CELL) + 1;
    }
    // Voxels on a diagonal go to either side in turn, so that no axis gets all of them.
    if (steps % 2 == 1) order[0] = 2, order[2] = 0;
    for (int pass = 0; pass < 3; pass++) { // farthest axis first
        int i = pass % 2, swap = order[i];
        if (abs(from_centre[order[i]]) >= abs(from_centre[order[i + 1]])) continue;
        order[i] = order[i + 1];
        order[i + 1] = swap;
    }
    int k = order[0], u = order[1], w = order[2], toward = from_centre[k] > 0 ? 1 : -1;
    int other[3] = {centre[0], centre[1], centre[2]}, end[3] = {centre[0], centre[1], centre[2]};
    other[k] += 2 * toward;
    end[k] += toward;
    end[u] += from_centre[u] > 0 ? 1 : -1;
    end[w] -= 1;
    // The lower cube's centre first, so that both halves of a tetrahedron give it the same name.
    key[0] = point_key(voxels, toward > 0 ? centre : other);
    key[1] = point_key(voxels, toward > 0 ? other : centre);
    key[2] = point_key(voxels, end);
    end[w] += 2;
    key[3] = point_key(voxels, end);
}

/// Calls `visit` for each pair of neighbouring voxels inside. None is at the grid's border.
static void visit_neighbours(struct tiling *t, int *voxel_set, const uint64_t *tetrahedron,
                             void (*visit)(struct tiling *t, int *set, const uint64_t *tetrahedron, int a, int b))
{
    const int *size = t->voxels.size;
    int count = (int)voxels_count(&t->voxels), offset[13];
    for (int n = 0; n < 13; n++) {
        offset[n] = (neighbours[n][0] * size[1] + neighbours[n][1]) * size[2] + neighbours[n][2];
    }
    for (int i = 0; i < count; i++) {
        if (!t->voxels.inside[i]) continue;
        for (int n = 0; n < 13; n++) {
            if (t->voxels.inside[i + offset[n]]) visit(t, voxel_set, tetrahedron, i, i + offset[n]);
        }
    }
}

static void join_voxels(struct tiling *t, int *set, const uint64_t *tetrahedron, int a, int b)
{
    (void)t;
    if (tetrahedron[a] == tetrahedron[b]) union_join(set, a, b);
}

/// Joins nodes of touching elements that are at the same point.
static void join_nodes(struct tiling *t, int *set, const uint64_t *tetrahedron, int a, int b)
{
    (void)tetrahedron;
    int e = t->element[a], f = t->element[b];
    if (e == f) return;
    for (int k = 0; k < 16; k++) {
        if (t->key[e][k / 4] == t->key[f][k % 4]) union_join(set, 4 * e + k / 4, 4 * f + k % 4);
    }
}

/// Numbers the sets of voxels: each is an element, with nodes and a size.
static void number_elements(struct tiling *t, int *set)
{
    const int *size = t->voxels.size;
    int count = (int)voxels_count(&t->voxels);
    for (int i = 0; i < count; i++) {
        if (t->voxels.inside[i]) t->element[i] = union_root(set, i) == i ? t->count++ : t->element[set[i]];
    }
    size_t n = (size_t)t->count + 1;
    t->filled = need_zeroed(n, sizeof *t->filled);
    t->key = need_zeroed(n, sizeof *t->key);
    t->node = need_zeroed(n, sizeof *t->node);
    t->part = need_zeroed(n, sizeof *t->part);
    for (int i = 0; i < count; i++) {
        if (t->element[i] < 0 || t->filled[t->element[i]]++ > 0) continue;
        const int voxel[3] = {i / (size[1] * size[2]), i / size[2] % size[1], i % size[2]};
        tetrahedron_at(&t->voxels, voxel, t->key[t->element[i]]);
    }
}

/// Each voxel's tetrahedron as one number, from its face's centre and twice its edge's.
static void name_tetrahedra(const struct voxels *voxels, uint64_t *tetrahedron, int *set)
{
    int count = (int)voxels_count(voxels);
    const int *size = voxels->size;
    for (int i = 0; i < count; i++) {
        set[i] = i;
        if (!voxels->inside[i]) continue;
        const int voxel[3] = {i / (size[1] * size[2]), i / size[2] % size[1], i % size[2]};
        int key[4];
        tetrahedron_at(voxels, voxel, key);
        tetrahedron[i] = (uint64_t)(key[2] + key[3]) << 32 | (uint32_t)(key[0] + key[1]);
    }
}

struct face {
    int node[3], element;
};

static int compare_faces(const void *a, const void *b)
{
    const struct face *x = a, *y = b;
    return memcmp(x->node, y->node, sizeof x->node);
}

static struct face face_of(const struct tiling *t, int element, int opposite)
{
    struct face face = {.element = element};
    for (int k = 0; k < 3; k++) face.node[k] = t->node[element][(opposite + 1 + k) % 4];
    for (int pass = 0; pass < 3; pass++) {
        int i = pass % 2, swap = face.node[i];
        if (swap <= face.node[i + 1]) continue;
        face.node[i] = face.node[i + 1];
        face.node[i + 1] = swap;
    }
    return face;
}

/// Puts elements that share a face into one part.
static void find_parts(struct tiling *t)
{
    size_t count = (size_t)t->count * 4;
    struct face *faces = need_zeroed(count + 1, sizeof *faces);
    for (int e = 0; e < t->count; e++) {
        t->part[e] = e;
        for (int a = 0; a < 4; a++) faces[4 * e + a] = face_of(t, e, a);
    }
    qsort(faces, count, sizeof *faces, compare_faces);
    for (size_t i = 1; i < count; i++) {
        if (compare_faces(&faces[i - 1], &faces[i]) == 0) {
            union_join(t->part, faces[i - 1].element, faces[i].element);
        }
    }
    free(faces);
}

/// Drops parts smaller than a hundredth of the whole, but never the largest.
static void drop_crumbs(struct tiling *t)
{
    int *voxels = need_zeroed((size_t)t->count + 1, sizeof *voxels), total = 0, largest = 0;
    for (int e = 0; e < t->count; e++) {
        t->part[e] = union_root(t->part, e);
        voxels[t->part[e]] += t->filled[e];
        total += t->filled[e];
    }
    for (int e = 0; e < t->count; e++) largest = voxels[e] > largest ? voxels[e] : largest;
    for (int e = 0; e < t->count; e++) {
        int size = voxels[t->part[e]];
        bool crumb = size < largest && size < total / 100;
        if (crumb) t->part[e] = -1;
        t->kept += !crumb;
    }
    free(voxels);
    int count = (int)voxels_count(&t->voxels);
    for (int i = 0; i < count; i++) {
        if (t->element[i] >= 0 && t->part[t->element[i]] < 0) t->element[i] = -1;
    }
}

/// Finds elements, nodes and parts; `set` and `tetrahedron` have room for each voxel.
static void cut(struct tiling *t, int *set, uint64_t *tetrahedron)
{
    name_tetrahedra(&t->voxels, tetrahedron, set);
    visit_neighbours(t, set, tetrahedron, join_voxels);
    number_elements(t, set);
    int *nodes = need_zeroed((size_t)t->count * 4 + 1, sizeof *nodes);
    for (int i = 0; i < 4 * t->count; i++) nodes[i] = i;
    visit_neighbours(t, nodes, tetrahedron, join_nodes);
    for (int i = 0; i < 4 * t->count; i++) t->node[i / 4][i % 4] = union_root(nodes, i);
    free(nodes);
    find_parts(t);
    drop_crumbs(t);
}

void tiling_create(struct tiling *t, const struct solid *solid, double cell, double layer)
{
    *t = (struct tiling){0};
    lay_out(&t->voxels, solid, cell, layer);
    voxels_fill(&t->voxels, solid);
    size_t count = voxels_count(&t->voxels);
    int *set = need_zeroed(count, sizeof *set);
    uint64_t *tetrahedron = need_zeroed(count, sizeof *tetrahedron);
    t->element = need(count, sizeof *t->element);
    memset(t->element, 0xFF, count * sizeof *t->element); // −1
    cut(t, set, tetrahedron);
    free(set);
    free(tetrahedron);
}

void tiling_free(struct tiling *t)
{
    voxels_free(&t->voxels);
    free(t->element);
    free(t->filled);
    free(t->key);
    free(t->node);
    free(t->part);
    *t = (struct tiling){0};
}

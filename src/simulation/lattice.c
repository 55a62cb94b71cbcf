/// Cuts a solid into elements by the tetrahedra of a lattice, and embeds the surface in them.
#include "simulation/lattice.h"
#include "base/need.h"
#include "base/progress.h"
#include "simulation/body.h"
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// --- the solid cut into elements by the tetrahedra of the lattice

enum { VOXELS_A_CELL = 8 };

/// One element for each connected piece of the solid in each tetrahedron. All its memory is the voxels' pool.
struct tiling {
    struct voxels voxels;
    int *element;   ///< per voxel: its element, or −1 outside
    int count;      ///< of elements
    int kept;       ///< of those that are not left out
    int *filled;    ///< per element: how many voxels
    int (*key)[4];  ///< per element: which points of the lattice its nodes are at
    int (*node)[4]; ///< per element: its nodes; equal numbers are the same node
    int *part;      ///< per element: an element of the connected part it belongs to; −1: left out
};

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

/// Number of a point of the lattice, given in half cells from the origin.
static int point_key(const struct voxels *voxels, const int p[3])
{
    int ny = voxels->size[1] / VOXELS_A_CELL * 2 + 1, nz = voxels->size[2] / VOXELS_A_CELL * 2 + 1;
    return (p[0] * ny + p[1]) * nz + p[2];
}

/// The tetrahedron that holds a voxel's centre: from the cube's centre towards the nearest face, then towards that face's nearest
/// edge. `key` names its nodes: the two cubes' centres and the edge's ends.
static void tetrahedron_at(const struct voxels *voxels, int index, int key[4])
{
    const int *size = voxels->size,
              voxel[3] = {index / (size[1] * size[2]), index / size[2] % size[1], index % size[2]};
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

struct face {
    int node[3], element;
};

static int compare_faces(const void *a, const void *b)
{
    const struct face *x = a, *y = b;
    return memcmp(x->node, y->node, sizeof x->node);
}

/// Puts elements that share a face into one part. Drops parts smaller than a hundredth of the whole, but never the largest.
static void find_parts(struct tiling *t)
{
    size_t count = (size_t)t->count * 4;
    struct face *faces = need_zeroed(count + 1, sizeof *faces);
    for (int e = 0; e < t->count; e++) {
        t->part[e] = e;
        for (int a = 0; a < 4; a++) { // the nodes of the face opposite node a, ascending
            struct face *face = &faces[4 * e + a];
            face->element = e;
            for (int k = 0; k < 3; k++) face->node[k] = t->node[e][(a + 1 + k) % 4];
            for (int pass = 0; pass < 3; pass++) {
                int i = pass % 2, swap = face->node[i];
                if (swap <= face->node[i + 1]) continue;
                face->node[i] = face->node[i + 1];
                face->node[i + 1] = swap;
            }
        }
    }
    qsort(faces, count, sizeof *faces, compare_faces);
    for (size_t i = 1; i < count; i++) {
        if (compare_faces(&faces[i - 1], &faces[i]) == 0) {
            union_join(t->part, faces[i - 1].element, faces[i].element);
        }
    }
    free(faces);

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
    int voxel_count = (int)voxels_count(&t->voxels);
    for (int i = 0; i < voxel_count; i++) {
        if (t->element[i] >= 0 && t->part[t->element[i]] < 0) t->element[i] = -1;
    }
}

/// Cuts the solid with cubes of edge `cell`, which coarse_enough() allows. Voxels lie over the surface's box and margin, centred, so
/// that a symmetric solid is cut symmetrically; then moved up or down by at most a quarter of a cell, so that a layer of nodes lies
/// at the height `layer` (y), unless that is NAN.
static void tiling_create(struct tiling *t, const struct solid *solid, double cell, double layer)
{
    struct voxels *v = &t->voxels;
    double lo[3], hi[3];
    *t = (struct tiling){.voxels.spacing = cell / VOXELS_A_CELL};
    surface_bounds(&solid->shape, lo, hi);
    for (int c = 0; c < 3; c++) {
        int cells = (int)cells_along(hi[c] - lo[c] + solid->thickness, cell);
        v->size[c] = cells * VOXELS_A_CELL;
        v->origin[c] = (lo[c] + hi[c] - cells * cell) / 2;
    }
    if (isfinite(layer)) v->origin[1] += remainder(layer - v->origin[1], cell / 2);
    voxels_fill(v, solid);

    // Each voxel's tetrahedron as one number, from its face's centre and twice its edge's.
    const int count = (int)voxels_count(v);
    struct pool work = {0};
    int *set = pool_take(&work, (size_t)count, sizeof *set), key[4];
    uint64_t *tetrahedron = pool_take(&work, (size_t)count, sizeof *tetrahedron);
    for (int i = 0; i < count; i++) {
        set[i] = i;
        if (!v->inside[i]) continue;
        tetrahedron_at(v, i, key);
        tetrahedron[i] = (uint64_t)(key[2] + key[3]) << 32 | (uint32_t)(key[0] + key[1]);
    }
    int offset[13]; // from a voxel to its neighbours; no voxel inside is at the grid's border
    for (int n = 0; n < 13; n++) {
        offset[n] = (neighbours[n][0] * v->size[1] + neighbours[n][1]) * v->size[2] + neighbours[n][2];
    }
    for (int i = 0; i < count; i++) {
        for (int n = 0; v->inside[i] && n < 13; n++) {
            const int other = i + offset[n];
            if (v->inside[other] && tetrahedron[i] == tetrahedron[other]) union_join(set, i, other);
        }
    }

    // Each set of voxels is an element, with nodes and a size.
    t->element = pool_take(&v->pool, (size_t)count, sizeof *t->element);
    memset(t->element, 0xFF, (size_t)count * sizeof *t->element); // −1
    for (int i = 0; i < count; i++) {
        if (v->inside[i]) t->element[i] = union_root(set, i) == i ? t->count++ : t->element[set[i]];
    }
    const size_t room = (size_t)t->count + 1;
    t->filled = pool_take(&v->pool, room, sizeof *t->filled);
    t->key = pool_take(&v->pool, room, sizeof *t->key);
    t->node = pool_take(&v->pool, room, sizeof *t->node);
    t->part = pool_take(&v->pool, room, sizeof *t->part);
    for (int i = 0; i < count; i++) {
        const int e = t->element[i];
        if (e >= 0 && t->filled[e]++ == 0) tetrahedron_at(v, i, t->key[e]);
    }

    // Nodes of touching elements at the same point are one.
    int *nodes = pool_take(&work, 4 * room, sizeof *nodes);
    for (int i = 0; i < 4 * t->count; i++) nodes[i] = i;
    for (int i = 0; i < count; i++) {
        for (int n = 0; v->inside[i] && n < 13; n++) {
            const int other = i + offset[n], e = t->element[i], f = t->element[other];
            for (int k = 0; f >= 0 && e != f && k < 16; k++) {
                if (t->key[e][k / 4] == t->key[f][k % 4]) union_join(nodes, 4 * e + k / 4, 4 * f + k % 4);
            }
        }
    }
    for (int i = 0; i < 4 * t->count; i++) t->node[i / 4][i % 4] = union_root(nodes, i);
    pool_free(&work);
    find_parts(t);
}

// --- lattice

// Cutting takes some 13 bytes per voxel. A very thin sheet or needle would need more voxels, and gets fewer tetrahedra instead.
static const double voxels_max = 3e7;

enum { TELLING = 1 << 13 }; ///< vertices between two progress reports

/// Volume inside, m³: the tetrahedra from the first vertex to each triangle; a sheet's without its bends and rim. An open surface gives a
/// guess, at least a hundredth of its box.
static double solid_volume(const struct solid *solid)
{
    const struct surface *surface = &solid->shape;
    double sum = 0, lo[3], hi[3];
    for (int t = 0; t < surface->index_count / 3; t++) {
        double p[3][3], across[3];
        triangle_corners(surface, t, p);
        for (int k = 0; k < 9; k++) p[k / 3][k % 3] -= (double)surface->position[0][k % 3];
        vec3_cross(p[0], p[1], across);
        sum += vec3_dot(across, p[2]) / 6;
    }
    if (solid->thickness > 0) return solid->area * solid->thickness;
    surface_bounds(surface, lo, hi);
    const double box = (hi[0] - lo[0]) * (hi[1] - lo[1]) * (hi[2] - lo[2]);
    return solid->open ? fmin(fmax(fabs(sum), 0.01 * box), box) : fabs(sum);
}

/// The smallest cube edge, at least `cell`, that keeps the voxels within bounds.
static double coarse_enough(const struct solid *solid, double cell)
{
    double lo[3], hi[3];
    surface_bounds(&solid->shape, lo, hi);
    for (;; cell *= 1.1) {
        double voxels = 1; // exceeds any integer for some
        for (int c = 0; c < 3; c++) voxels *= cells_along(hi[c] - lo[c] + solid->thickness, cell) * VOXELS_A_CELL;
        if (!(voxels > voxels_max)) return cell;
    }
}

/// Volume of the elements as a multiple of the solid's.
static double swelling(const struct tiling *t, double volume)
{
    double voxels = 0;
    for (int e = 0; e < t->count; e++) voxels += t->part[e] < 0 ? 0 : t->filled[e];
    return voxels * pow(t->voxels.spacing, 3) / volume;
}

enum { LEVELS = 26 }; ///< of halving the longest side; there are fewer than 2²⁵ voxels

/// Which blocks of 2, 4, 8 … voxels hold some of the lattice: level l has those of 2ˡ.
struct pyramid {
    const struct tiling *tiling;
    int top, size[LEVELS][3];
    uint8_t *any[LEVELS]; ///< from level 1 on
};

static int block_index(const struct pyramid *p, int level, const int block[3])
{
    return (block[0] * p->size[level][1] + block[1]) * p->size[level][2] + block[2];
}

/// A search for the voxel of the lattice nearest to a point given in voxels.
struct nearest {
    const struct pyramid *pyramid;
    double at[3], distance;
    int middle[3],
        ring; ///< the voxel that holds the point, and the largest of the three steps from there to the found one
    int found;
};

/// Searches a block. Of voxels equally far the one in the inner ring is found, then the first.
static void search(struct nearest *n, int level, const int block[3])
{
    const struct pyramid *p = n->pyramid;
    const int index = block_index(p, level, block);
    double away[3];
    int ring = 0, toward[3];
    if (level > 0 ? !p->any[level][index] : p->tiling->element[index] < 0) return;
    for (int c = 0; c < 3; c++) {
        const int first = block[c] << level, end = (block[c] + 1) << level;
        away[c] = fmax(0, fmax(first + 0.5 - n->at[c], n->at[c] - (end - 0.5)));
        toward[c] = n->at[c] >= (first + end) / 2;
    }
    const double distance = vec3_length(away);
    if (distance > n->distance) return;
    if (level > 0) {
        for (int child = 0; child < 8; child++) { // first the one on the point's side
            int part[3];
            bool exists = true;
            for (int c = 0; c < 3; c++) {
                part[c] = 2 * block[c] + ((child >> c & 1) ^ toward[c]);
                exists = exists && part[c] < p->size[level - 1][c];
            }
            if (exists) search(n, level - 1, part);
        }
        return;
    }
    for (int c = 0; c < 3; c++) {
        const int steps = abs(block[c] - n->middle[c]);
        ring = steps > ring ? steps : ring;
    }
    const bool is_first = ring < n->ring || (ring == n->ring && index < n->found);
    if (distance == n->distance && !is_first) return;
    n->distance = distance;
    n->ring = ring;
    n->found = index;
}

/// Numbers what is kept of the tiling consecutively. Places each vertex in the element of the nearest voxel, starting half a voxel
/// under the surface: not in the next limb's.
static void build_lattice(struct lattice *lattice, const struct tiling *t, const struct surface *surface,
                          const struct solid *solid)
{
    const double whole = VOXELS_A_CELL * VOXELS_A_CELL * VOXELS_A_CELL / 12.0; // a tetrahedron's volume in voxels
    const size_t kept = (size_t)t->kept, count = (size_t)surface->vertex_count;
    const struct voxels *v = &t->voxels;
    const int ny = v->size[1] / VOXELS_A_CELL * 2 + 1, nz = v->size[2] / VOXELS_A_CELL * 2 + 1;
    struct pool work = {0};
    int *index = pool_take(&work, (size_t)t->count + 1, sizeof *index); // per element: its new number
    int *node_number = pool_take(&work, (size_t)t->count * 4 + 1, sizeof *node_number);
    memset(node_number, 0xFF, (size_t)t->count * 4 * sizeof *node_number); // −1
    lattice->node = pool_take(&lattice->pool, 4 * kept + 1, sizeof *lattice->node);
    lattice->tet = pool_take(&lattice->pool, kept + 1, sizeof *lattice->tet);
    lattice->fraction = pool_take(&lattice->pool, kept + 1, sizeof *lattice->fraction);
    lattice->part = pool_take(&lattice->pool, kept + 1, sizeof *lattice->part);
    for (int e = 0; e < t->count; e++) {
        if (t->part[e] < 0) continue;
        int k = index[e] = lattice->tet_count++;
        lattice->fraction[k] = t->filled[e] / whole;
        lattice->part[k] = t->part[e] == e ? lattice->part_count++ : lattice->part[index[t->part[e]]];
        for (int a = 0; a < 4; a++) {
            int *known = &node_number[t->node[e][a]];
            if (*known < 0) {
                *known = lattice->node_count++;
                const int key = t->key[e][a], // as point_key() makes it
                    point[3] = {key / (ny * nz), key / nz % ny, key % nz};
                for (int c = 0; c < 3; c++)
                    lattice->node[*known][c] = v->origin[c] + point[c] * v->spacing * VOXELS_A_CELL / 2;
            }
            lattice->tet[k][a] = *known;
        }
    }

    double(*normal)[3] =
        pool_take(&work, count + 1, sizeof *normal); // not normalised; 0 if its triangles are left out
    for (int i = 0; i < solid->shape.index_count; i++) {
        double across[3], middle[3];
        triangle_measure(&solid->shape, i / 3, across, middle);
        for (int c = 0; c < 3; c++) normal[solid->shape.indices[i]][c] += across[c];
    }
    lattice->vertex_count = surface->vertex_count;
    lattice->host = pool_take(&lattice->pool, count + 1, sizeof *lattice->host);
    lattice->weight = pool_take(&lattice->pool, count + 1, sizeof *lattice->weight);
    uint8_t *used = surface_used_vertices(surface);
    struct pyramid pyramid = {.tiling = t};
    struct pyramid *p = &pyramid;
    memcpy(p->size[0], v->size, sizeof p->size[0]);
    while (p->size[p->top][0] > 1 || p->size[p->top][1] > 1 || p->size[p->top][2] > 1) {
        const int below = p->top++, *from = p->size[below];
        int *size = p->size[p->top], at = 0;
        for (int c = 0; c < 3; c++) size[c] = (from[c] + 1) / 2;
        p->any[p->top] = pool_take(&work, (size_t)size[0] * (size_t)size[1] * (size_t)size[2], 1);
        for (int i = 0; i < from[0]; i++) {
            for (int j = 0; j < from[1]; j++) {
                for (int k = 0; k < from[2]; k++, at++) {
                    const bool any = below > 0 ? p->any[below][at] : t->element[at] >= 0;
                    if (any) p->any[p->top][block_index(p, p->top, (const int[3]){i / 2, j / 2, k / 2})] = 1;
                }
            }
        }
    }
    for (int i = 0; i < surface->vertex_count; i++) {
        const double length = vec3_length(normal[i]);
        struct nearest n = {.pyramid = &pyramid, .distance = INFINITY, .found = -1};
        lattice->host[i] = -1;
        if (i % TELLING == 0) progress_report("placing the vertices", i, surface->vertex_count);
        if (!used[i]) continue;
        for (int c = 0; c < 3; c++) {
            double inward = length > 0 ? 0.5 * normal[i][c] / length : 0;
            n.at[c] = ((double)surface->position[i][c] - v->origin[c]) / v->spacing - inward;
            n.middle[c] = (int)fmax(0, fmin(v->size[c] - 1, floor(n.at[c])));
        }
        search(&n, pyramid.top, (const int[3]){0, 0, 0});
        lattice->host[i] = index[t->element[n.found]];

        const int *node = lattice->tet[lattice->host[i]]; // its barycentric coordinates there
        struct element element;
        double away[3];
        element_init(&element, node, (const double(*)[3])lattice->node, 1);
        for (int c = 0; c < 3; c++) away[c] = (double)surface->position[i][c] - lattice->node[node[0]][c];
        for (int a = 0; a < 4; a++) lattice->weight[i][a] = (a == 0) + vec3_dot(element.gradient[a], away);
    }
    progress_report("placing the vertices", surface->vertex_count, surface->vertex_count);
    free(used);
    pool_free(&work);
}

bool lattice_create(struct lattice *lattice, const struct surface *surface, const struct lattice_options *options,
                    const char *name, struct error *error)
{
    enum { TRIES = 8 };
    static const double SURE = 0.85, LEAST = 0.65, little = 0.01, progress = 0.9;
    struct solid solid;
    struct tiling tiling = {0}, tried;
    *lattice = (struct lattice){0};
    solid_create(&solid, surface, fmax(0, options->thickness));
    solid_describe(&solid, lattice->repair);
    const double volume = solid_volume(&solid), fitting = sqrt(solid.area) / 25;
    const double certainty = volume > 0 ? solid_certainty(&solid) : 0;
    bool good =
        certainty >= (options->thickness >= 0 ? LEAST : SURE) ||
        fail(error, ERROR_INPUT, "%s: the mesh has no clear inside: --thickness %.1g makes it a sheet of %.1g m%s",
             name, fitting, fitting, certainty >= LEAST ? ", --thickness 0 closes its openings" : "");

    // Tries cubes of several sizes until the number of tetrahedra is within 3 % or stops improving; a cube has about twelve.
    double cell = cbrt(12 * volume / options->target), nearest = INFINITY;
    for (int i = 0; good && i < TRIES && nearest > 0.03; i++) {
        const double allowed = coarse_enough(&solid, cell);
        if (allowed > cell && i > 0) break; // no finer lattice is allowed
        cell = allowed;
        tiling_create(&tried, &solid, cell, options->layer);
        const double ratio = fmax(tried.kept, 1) / options->target;
        if (fabs(log(ratio)) < nearest) {
            nearest = fabs(log(ratio));
            pool_free(&tiling.voxels.pool);
            tiling = tried;
            lattice->cell = cell;
        } else {
            pool_free(&tried.voxels.pool);
        }
        cell *= pow(ratio, 0.4); // the number falls with a power between 2 (all surface) and 3 (all inside)
    }
    if (good && tiling.kept == 0)
        good = fail(error, ERROR_INPUT, "%s: the mesh is too thin for a lattice of %d tetrahedra", name,
                    options->target);
    if (good) {
        // Where parts overlap, the mesh's volume counts the overlap twice.
        const double thick = sheet_thickness(&solid, &tiling.voxels);
        const bool exact = !solid.open && !tiling.voxels.overlaps && thick == solid.thickness;

        // Voxels make a limb up to half a voxel too thick or thin on either side, a tenth of a limb one cube wide, and as much too stiff
        // or soft. Where that does not average out, cubes of a slightly different size give the body the right volume.
        double away = exact ? log(swelling(&tiling, volume)) : 0;
        for (int i = 0; i < TRIES && fabs(away) > little; i++) {
            cell = coarse_enough(&solid, lattice->cell * exp(-away / 3));
            tiling_create(&tried, &solid, cell, options->layer);
            const double now = log(swelling(&tried, volume));
            pool_free(fabs(now) < progress * fabs(away) ? &tiling.voxels.pool : &tried.voxels.pool);
            if (!(fabs(now) < progress * fabs(away))) break;
            away = now;
            lattice->cell = cell;
            tiling = tried;
        }
        if (thick > 0)
            snprintf(lattice->repair, sizeof lattice->repair, "a sheet %.3g m thick%s", thick,
                     exact ? "" : ", as thin as so few tetrahedra can be");
        build_lattice(lattice, &tiling, surface, &solid);
    }
    pool_free(&tiling.voxels.pool);
    pool_free(&solid.pool);
    return good;
}

void lattice_embed(const struct lattice *lattice, const double (*x)[3], float (*position)[3])
{
    for (int i = 0; i < lattice->vertex_count; i++) {
        if (lattice->host[i] < 0) continue;
        const int *node = lattice->tet[lattice->host[i]];
        for (int c = 0; c < 3; c++) {
            double sum = 0;
            for (int a = 0; a < 4; a++) sum += lattice->weight[i][a] * x[node[a]][c];
            position[i][c] = (float)sum;
        }
    }
}

void lattice_spread(const struct lattice *lattice, const double *vertex, double *node)
{
    double *sum = need_zeroed((size_t)lattice->node_count + 1, sizeof *sum);
    double *share = need_zeroed((size_t)lattice->node_count + 1, sizeof *share);
    for (int i = 0; i < lattice->vertex_count; i++) {
        for (int a = 0; lattice->host[i] >= 0 && a < 4; a++) {
            double weight = fmax(0, lattice->weight[i][a]);
            sum[lattice->tet[lattice->host[i]][a]] += weight * vertex[i];
            share[lattice->tet[lattice->host[i]][a]] += weight;
        }
    }
    int missing = 0;
    for (int i = 0; i < lattice->node_count; i++) {
        node[i] = share[i] > 0 ? sum[i] / share[i] : NAN;
        missing += isnan(node[i]);
    }
    for (int before = missing + 1; missing > 0 && missing < before;) {
        before = missing;
        missing = 0; // a node without a number takes the mean of the known ones in its elements
        for (int e = 0; e < lattice->tet_count; e++) {
            for (int k = 0; k < 16; k++) {
                int from = lattice->tet[e][k / 4], to = lattice->tet[e][k % 4];
                if (isnan(node[from]) || !isnan(node[to])) continue;
                sum[to] += node[from];
                share[to] += 1;
            }
        }
        for (int i = 0; i < lattice->node_count; i++) {
            if (isnan(node[i]) && share[i] > 0) node[i] = sum[i] / share[i];
            missing += isnan(node[i]);
        }
    }
    for (int i = 0; i < lattice->node_count; i++) node[i] = isnan(node[i]) ? 0 : node[i]; // a part without vertices
    free(sum);
    free(share);
}

/// Builds the lattice and embeds the surface in it.
#include "simulation/lattice.h"
#include "base/need.h"
#include "base/progress.h"
#include "simulation/element.h"
#include "simulation/linear.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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
    while (tiling_voxels(solid, cell) > voxels_max) cell *= 1.1;
    return cell;
}

/// Tries cubes of several sizes until the number of tetrahedra is within 3 % or stops improving; a cube has about twelve.
static void fit(struct tiling *best, const struct solid *solid, int target, double layer, double *best_cell)
{
    enum { TRIES = 8 };
    double cell = cbrt(12 * solid_volume(solid) / target), nearest = INFINITY;
    *best = (struct tiling){0};
    for (int i = 0; i < TRIES && nearest > 0.03; i++) {
        struct tiling tiling;
        double allowed = coarse_enough(solid, cell);
        if (allowed > cell && i > 0) break; // no finer lattice is allowed
        cell = allowed;
        tiling_create(&tiling, solid, cell, layer);
        double ratio = fmax(tiling.kept, 1) / target;
        if (fabs(log(ratio)) < nearest) {
            nearest = fabs(log(ratio));
            tiling_free(best);
            *best = tiling;
            *best_cell = cell;
        } else {
            tiling_free(&tiling);
        }
        cell *= pow(ratio, 0.4); // the number falls with a power between 2 (all surface) and 3 (all inside)
    }
}

/// Volume of the elements as a multiple of the solid's.
static double swelling(const struct tiling *t, double volume)
{
    double voxels = 0;
    for (int e = 0; e < t->count; e++) voxels += t->part[e] < 0 ? 0 : t->filled[e];
    return voxels * pow(t->voxels.spacing, 3) / volume;
}

/// Voxels make a limb up to half a voxel too thick or thin on either side, a tenth of a limb one cube wide, and as much too stiff or
/// soft. Where that does not average out, cubes of a slightly different size give the body the right volume.
static void fit_volume(struct tiling *best, const struct solid *solid, double layer, double *cell)
{
    enum { TRIES = 8 };
    static const double little = 0.01, progress = 0.9;
    const double volume = solid_volume(solid);
    double away = log(swelling(best, volume));
    for (int i = 0; i < TRIES && fabs(away) > little; i++) {
        struct tiling tiling;
        double tried = coarse_enough(solid, *cell * exp(-away / 3));
        tiling_create(&tiling, solid, tried, layer);
        double now = log(swelling(&tiling, volume));
        if (!(fabs(now) < progress * fabs(away))) {
            tiling_free(&tiling);
            break;
        }
        away = now;
        *cell = tried;
        tiling_free(best);
        *best = tiling;
    }
}

/// Numbers the kept nodes, elements and parts consecutively. index[e] is the new number of element e.
static void number(struct lattice *lattice, const struct tiling *t, int *index, int *node_number)
{
    size_t n = (size_t)t->kept;
    lattice->node = pool_take(&lattice->pool, 4 * n + 1, sizeof *lattice->node);
    lattice->tet = pool_take(&lattice->pool, n + 1, sizeof *lattice->tet);
    lattice->fraction = pool_take(&lattice->pool, n + 1, sizeof *lattice->fraction);
    lattice->part = pool_take(&lattice->pool, n + 1, sizeof *lattice->part);
    const double whole = VOXELS_A_CELL * VOXELS_A_CELL * VOXELS_A_CELL / 12.0; // a tetrahedron's volume in voxels
    for (int e = 0; e < t->count; e++) {
        if (t->part[e] < 0) continue;
        int k = index[e] = lattice->tet_count++;
        lattice->fraction[k] = t->filled[e] / whole;
        lattice->part[k] = t->part[e] == e ? lattice->part_count++ : lattice->part[index[t->part[e]]];
        for (int a = 0; a < 4; a++) {
            int *known = &node_number[t->node[e][a]];
            if (*known < 0) {
                *known = lattice->node_count++;
                tiling_point(t, t->key[e][a], lattice->node[*known]);
            }
            lattice->tet[k][a] = *known;
        }
    }
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

static void pyramid_create(struct pyramid *p, const struct tiling *t)
{
    *p = (struct pyramid){.tiling = t};
    memcpy(p->size[0], t->voxels.size, sizeof p->size[0]);
    while (p->size[p->top][0] > 1 || p->size[p->top][1] > 1 || p->size[p->top][2] > 1) {
        const int below = p->top++, *from = p->size[below];
        for (int c = 0; c < 3; c++) p->size[p->top][c] = (from[c] + 1) / 2;
        const int *size = p->size[p->top];
        p->any[p->top] = need_zeroed((size_t)size[0] * (size_t)size[1] * (size_t)size[2], 1);
        int at = 0;
        for (int i = 0; i < from[0]; i++) {
            for (int j = 0; j < from[1]; j++) {
                for (int k = 0; k < from[2]; k++, at++) {
                    const bool any = below > 0 ? p->any[below][at] : t->element[at] >= 0;
                    if (any) p->any[p->top][block_index(p, p->top, (const int[3]){i / 2, j / 2, k / 2})] = 1;
                }
            }
        }
    }
}

static void pyramid_free(struct pyramid *p)
{
    for (int l = 1; l <= p->top; l++) free(p->any[l]);
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

static int nearest_inside(const struct pyramid *p, const double at[3])
{
    struct nearest n = {.pyramid = p, .at = {at[0], at[1], at[2]}, .distance = INFINITY, .found = -1};
    for (int c = 0; c < 3; c++) n.middle[c] = (int)fmax(0, fmin(p->size[0][c] - 1, floor(at[c])));
    search(&n, p->top, (const int[3]){0, 0, 0});
    return n.found;
}

/// Barycentric coordinates of a point.
static void locate(const struct lattice *lattice, int tet, const float point[3], double weight[4])
{
    struct element element;
    const int *node = lattice->tet[tet];
    double away[3];
    element_init(&element, node, (const double(*)[3])lattice->node, 1);
    for (int c = 0; c < 3; c++) away[c] = (double)point[c] - lattice->node[node[0]][c];
    for (int a = 0; a < 4; a++) weight[a] = (a == 0) + vec3_dot(element.gradient[a], away);
}

/// Each vertex's normal, not normalised; 0 if its triangles are left out.
static double (*normals_of(const struct surface *surface))[3]
{
    double(*normal)[3] = need_zeroed((size_t)surface->vertex_count + 1, sizeof *normal);
    for (int i = 0; i < surface->index_count; i++) {
        double across[3], middle[3];
        triangle_measure(surface, i / 3, across, middle);
        for (int c = 0; c < 3; c++) normal[surface->indices[i]][c] += across[c];
    }
    return normal;
}

/// Places each vertex in the element of the nearest voxel, starting half a voxel under the surface: not in the next limb's.
static void embed(struct lattice *lattice, const struct tiling *t, const int *index, const struct surface *surface,
                  const struct solid *solid)
{
    size_t count = (size_t)surface->vertex_count;
    lattice->vertex_count = surface->vertex_count;
    lattice->host = pool_take(&lattice->pool, count + 1, sizeof *lattice->host);
    lattice->weight = pool_take(&lattice->pool, count + 1, sizeof *lattice->weight);
    double(*normal)[3] = normals_of(&solid->shape);
    uint8_t *used = surface_used_vertices(surface);
    struct pyramid pyramid;
    pyramid_create(&pyramid, t);
    for (int i = 0; i < surface->vertex_count; i++) {
        double at[3], length = vec3_length(normal[i]);
        lattice->host[i] = -1;
        if (i % TELLING == 0) stage_tell("placing the vertices", i, surface->vertex_count);
        if (!used[i]) continue;
        for (int c = 0; c < 3; c++) {
            double inward = length > 0 ? 0.5 * normal[i][c] / length : 0;
            at[c] = ((double)surface->position[i][c] - t->voxels.origin[c]) / t->voxels.spacing - inward;
        }
        lattice->host[i] = index[t->element[nearest_inside(&pyramid, at)]];
        locate(lattice, lattice->host[i], surface->position[i], lattice->weight[i]);
    }
    stage_tell("placing the vertices", surface->vertex_count, surface->vertex_count);
    pyramid_free(&pyramid);
    free(normal);
    free(used);
}

static void build(struct lattice *lattice, const struct tiling *t, const struct surface *surface,
                  const struct solid *solid)
{
    int *index = need_zeroed((size_t)t->count + 1, sizeof *index);
    int *node_number = need((size_t)t->count * 4 + 1, sizeof *node_number);
    memset(node_number, 0xFF, (size_t)t->count * 4 * sizeof *node_number); // −1
    number(lattice, t, index, node_number);
    embed(lattice, t, index, surface, solid);
    free(index);
    free(node_number);
}

/// The lattice of a solid with some volume.
static bool lattice_of(struct lattice *lattice, const struct surface *surface, const struct solid *solid, int target,
                       double layer, const char *name, struct error *error)
{
    struct tiling tiling;
    fit(&tiling, solid, target, layer, &lattice->cell);
    if (tiling.kept == 0) {
        tiling_free(&tiling);
        return fail(error, ERROR_INPUT, "%s: the mesh is too thin for a lattice of %d tetrahedra", name, target);
    }
    // Where parts overlap, the mesh's volume counts the overlap twice.
    const double thickness = sheet_thickness(solid, &tiling.voxels);
    const bool exact = !solid->open && !tiling.voxels.overlaps && thickness == solid->thickness;
    if (exact) fit_volume(&tiling, solid, layer, &lattice->cell);
    if (thickness > 0)
        snprintf(lattice->repair, sizeof lattice->repair, "a sheet %.3g m thick%s", thickness,
                 exact ? "" : ", as thin as so few tetrahedra can be");
    build(lattice, &tiling, surface, solid);
    tiling_free(&tiling);
    return true;
}

/// Offers a thickness for a surface without a clear inside.
static bool check_inside(const struct solid *solid, bool closes, const char *name, struct error *error)
{
    static const double SURE = 0.85, LEAST = 0.65;
    const double certainty = solid_volume(solid) > 0 ? solid_certainty(solid) : 0, fitting = sqrt(solid->area) / 25;
    if (certainty >= (closes ? LEAST : SURE)) return true;
    return fail(error, ERROR_INPUT, "%s: the mesh has no clear inside: --thickness %.1g makes it a sheet of %.1g m%s",
                name, fitting, fitting, certainty >= LEAST ? ", --thickness 0 closes its openings" : "");
}

bool lattice_create(struct lattice *lattice, const struct surface *surface, int target, double layer,
                    double thickness, const char *name, struct error *error)
{
    struct solid solid;
    *lattice = (struct lattice){0};
    solid_create(&solid, surface, fmax(0, thickness));
    solid_describe(&solid, lattice->repair);
    bool good = check_inside(&solid, thickness >= 0, name, error) &&
                lattice_of(lattice, surface, &solid, target, layer, name, error);
    solid_free(&solid);
    return good;
}

void lattice_free(struct lattice *lattice)
{
    pool_free(&lattice->pool);
    *lattice = (struct lattice){0};
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

/// One round of spreading: a node without a number takes the mean of the known ones in its elements. Returns how many remain.
static int spread_further(const struct lattice *lattice, double *node, double *sum, double *share)
{
    int missing = 0;
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
    return missing;
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
        missing = spread_further(lattice, node, sum, share);
    }
    for (int i = 0; i < lattice->node_count; i++) node[i] = isnan(node[i]) ? 0 : node[i]; // a part without vertices
    free(sum);
    free(share);
}

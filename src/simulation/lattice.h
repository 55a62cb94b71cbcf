/// A coarse lattice of tetrahedra around a surface, and the surface's vertices embedded in it.
///
/// The tetrahedra are those of the body-centred cubic lattice: the nodes are the corners and the centres of cubes, and each tetrahedron
/// joins two neighbouring centres with an edge of the face between them. All are congruent and well shaped, and the lattice is
/// symmetric left and right.
///
/// A tetrahedron may be partly filled. The solid is sampled by voxels an eighth of a cube wide. Each connected piece inside a
/// tetrahedron becomes one element, with its own nodes and the volume of its voxels. Nodes of two elements are joined where the
/// pieces touch (the virtual nodes of Molino, Bao and Fedkiw 2004). So an arm beside the trunk moves freely although both lie in the
/// same cubes, unless less than about a voxel separates them, and a sliver has only its own mass and stiffness. Parts that share no
/// face with the rest and fill less than a hundredth of the solid, like the tip of a hair, are dropped; their vertices follow the
/// nearest element.
#ifndef SIMULATION_LATTICE_H
#define SIMULATION_LATTICE_H

#include "base/error.h"
#include "base/need.h"
#include "model/surface.h"
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// The inside of a surface in any state, and which points of a regular grid lie inside.
//
// Vertices at the same place count as one. Of triangles with the same corners one is kept. Neighbours are turned to face the same
// way, as most of the area of their patch does; a patch that is inside out is turned round. If every edge is then used once in each
// direction, the surface is closed. Otherwise generalised winding numbers decide what is inside. A surface with a thickness is a sheet:
// all points within half of it of a triangle, whichever way that faces.

/// A triangle's corners.
static inline void triangle_corners(const struct surface *surface, int triangle, double corner[3][3])
{
    for (int k = 0; k < 3; k++) {
        const float *p = surface->position[surface->indices[3 * triangle + k]];
        for (int c = 0; c < 3; c++) corner[k][c] = (double)p[c];
    }
}
/// A triangle's normal, twice its area long, and three times its centre.
void triangle_measure(const struct surface *surface, int triangle, double normal[3], double middle[3]);

// Generalised winding numbers: how often a surface, even an open one, goes round a point.
//
// Each triangle counts with the solid angle it is seen under, divided by 4π (Jacobson et al. 2013). Inside a closed surface the sum
// is 1, outside 0; near a hole it passes smoothly from one to the other, and ½ closes the hole. Distant small triangles count
// together, as a dipole (Barill et al. 2018).

struct winding_node {
    double middle[3]; ///< of its triangles, weighted by area
    double area[3];   ///< sum of the area vectors
    double radius;    ///< reaches all corners of its triangles
    int first, count; ///< of its triangles in `order`
    int second;       ///< its second child, the first being the next node; 0: a leaf
};

struct winding {
    const struct surface *surface;
    int *order; ///< triangles
    struct winding_node *nodes;
    int node_count;
};

/// The surface must outlive it; its memory is the pool's.
void winding_create(struct winding *winding, struct pool *pool, const struct surface *surface);

double winding_at(const struct winding *winding, const double point[3]);

struct solid {
    struct pool pool;       ///< has the triangles and the tree
    struct surface shape;   ///< the surface with its own triangles; the rest is borrowed
    int duplicates;         ///< triangles left out because another has the same corners
    int turned;             ///< triangles turned round
    int open;               ///< edges not used equally often in both directions; 0: closed
    struct winding winding; ///< of an open one
    double area;            ///< m²
    double thickness;       ///< of a sheet, m; 0: a body
};

/// The surface must outlive the solid. `thickness` 0: a body.
void solid_create(struct solid *solid, const struct surface *surface, double thickness);

/// How sure the inside is: the mean winding number, at most 1, just behind a surface. Near 1: closed but for holes; 1/2: a flat sheet, or
/// one-sided.
double solid_certainty(const struct solid *solid);

/// One sentence, without a full stop, about what was repaired; "" if nothing was.
void solid_describe(const struct solid *solid, char text[160]);

// Which points of a regular grid are inside a solid.

/// Cubes of edge `spacing`; the one at (i, j, k) is number (i·size[1] + j)·size[2] + k and centred at origin + (i + ½, …)·spacing.
struct voxels {
    struct pool pool; ///< has `inside`, and what the caller adds
    int size[3];
    double origin[3], spacing; ///< m
    uint8_t *inside;           ///< 1 where the centre is inside
    bool overlaps;             ///< parts of a closed solid overlap
};

/// How thick a sheet is on the grid; 0: a body. Thinner than half a cell it would fall to pieces between the tetrahedra.
static inline double sheet_thickness(const struct solid *solid, const struct voxels *voxels)
{
    const double least = 4 * voxels->spacing;
    return solid->thickness > 0 && solid->thickness < least ? least : solid->thickness;
}

/// Fills `inside` for the given grid, which must contain the solid: 1 if the winding number is not 0 or, of an open surface, above ½.
void voxels_fill(struct voxels *voxels, const struct solid *solid);

static inline size_t voxels_count(const struct voxels *voxels)
{
    return (size_t)voxels->size[0] * (size_t)voxels->size[1] * (size_t)voxels->size[2];
}

// The lattice.

struct lattice {
    struct pool pool; ///< has all below
    double cell;      ///< edge of the cubes, m
    int node_count, tet_count;
    double (*node)[3];
    int (*tet)[4];
    double *fraction; ///< how much of each tetrahedron the solid fills, 0 … 1
    int *part;        ///< per tetrahedron: which connected part it belongs to
    int part_count;
    int vertex_count;
    int *host;           ///< per vertex: its tetrahedron; −1: it has no triangle and stays where it is
    double (*weight)[4]; ///< and its barycentric coordinates there, a little outside 0 … 1 for some
    char repair[160];    ///< what solid.h repaired in the surface; "": nothing
};

struct lattice_options {
    int target; ///< about so many tetrahedra
    double
        layer; ///< height of a layer of nodes, so that the pinned region ends there at every resolution; NAN: anywhere
    double
        thickness; ///< above 0 the surface is a sheet; 0 closes its openings, however large; below 0 only small ones
};

/// Errors: no volume, a sheet without thickness. `name` is the surface's, for messages.
bool lattice_create(struct lattice *lattice, const struct surface *surface, const struct lattice_options *options,
                    const char *name, struct error *error);

/// Spreads a number per vertex to the nodes: the mean of the vertices around each node, elsewhere of the nodes nearby.
void lattice_spread(const struct lattice *lattice, const double *vertex, double *node);

/// Vertex positions from node positions: Σ_a w_a x_a. Vertices without triangles keep theirs.
void lattice_embed(const struct lattice *lattice, const double (*x)[3], float (*position)[3]);

#endif

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
#include "simulation/solid.h"
#include <stdbool.h>

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
void lattice_free(struct lattice *lattice);

/// Spreads a number per vertex to the nodes: the mean of the vertices around each node, elsewhere of the nodes nearby.
void lattice_spread(const struct lattice *lattice, const double *vertex, double *node);

/// Vertex positions from node positions: Σ_a w_a x_a. Vertices without triangles keep theirs.
void lattice_embed(const struct lattice *lattice, const double (*x)[3], float (*position)[3]);

#endif

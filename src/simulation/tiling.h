/// A solid cut into elements by the tetrahedra of the body-centred cubic lattice; lattice.h says what for.
#ifndef SIMULATION_TILING_H
#define SIMULATION_TILING_H

#include "simulation/solid.h"
#include <stdbool.h>

enum { VOXELS_A_CELL = 8 };

/// One element for each connected piece of the solid in each tetrahedron.
struct tiling {
    struct voxels voxels;
    int *element;   ///< per voxel: its element, or −1 outside
    int count;      ///< of elements
    int kept;       ///< of those that are not left out
    int *filled;    ///< per element: how many voxels
    int (*key)[4];  ///< per element: which points of the lattice its nodes are at
    int (*node)[4]; ///< per element: its nodes; equal numbers are the same node
    int *part; ///< per element: the part it is connected with through faces, by one of its elements; −1 left out
};

/// How many voxels a tiling with cubes of edge `cell` has; as a double, because it may exceed any integer.
double tiling_voxels(const struct surface *surface, double cell);

/// Cuts the solid with cubes of edge `cell`, for which tiling_voxels() must fit an int. A layer of nodes lies at the height
/// `layer` (y), unless that is NAN.
void tiling_create(struct tiling *tiling, const struct solid *solid, double cell, double layer);
void tiling_free(struct tiling *tiling);

/// Where a point of the lattice is, m.
void tiling_point(const struct tiling *tiling, int key, double position[3]);

#endif

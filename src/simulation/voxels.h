/// Which points of a regular grid are inside a solid.
#ifndef SIMULATION_VOXELS_H
#define SIMULATION_VOXELS_H

#include "simulation/solid.h"
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/// Cubes of edge `spacing`; the one at (i, j, k) is number (i·size[1] + j)·size[2] + k and centred at origin + (i + ½, …)·spacing.
struct voxels {
    int size[3];
    double origin[3], spacing; ///< m
    uint8_t *inside;           ///< 1 where the centre is inside
    bool overlaps;             ///< parts of a closed solid lie in each other
};

/// Fills `inside` for the given grid, which must hold the solid: where the winding number is not 0 or, of an open surface, above a half.
void voxels_fill(struct voxels *voxels, const struct solid *solid);
void voxels_free(struct voxels *voxels);

static inline size_t voxels_count(const struct voxels *voxels)
{
    return (size_t)voxels->size[0] * (size_t)voxels->size[1] * (size_t)voxels->size[2];
}

#endif

/// The inside of a surface, in whatever state the surface is, and which points of a regular grid lie there.
///
/// Vertices at the same place count as one. Of triangles with the same corners one is kept. Neighbours are turned to agree about their
/// sides, as most of the area of their patch does, and a patch that is inside out is turned round. If then every edge is used once in each
/// direction, the surface is closed; else generalised winding numbers say what is inside.
#ifndef SIMULATION_SOLID_H
#define SIMULATION_SOLID_H

#include "simulation/winding.h"
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct solid {
    struct surface shape;   ///< the surface with triangles of its own; the rest is borrowed
    int duplicates;         ///< triangles left out because another has the same corners
    int turned;             ///< triangles turned round
    int open;               ///< edges that are not used as often in one direction as in the other; 0: closed
    struct winding winding; ///< of an open one
};

/// The surface must outlive the solid.
void solid_create(struct solid *solid, const struct surface *surface);
void solid_free(struct solid *solid);

/// What was done to the surface as one sentence without a full stop; "" where nothing was.
void solid_describe(const struct solid *solid, char text[160]);

// Which points of a regular grid are inside a solid.

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

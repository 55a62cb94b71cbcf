/// Where a body is held: what --pin says.
#ifndef SIMULATION_REGION_H
#define SIMULATION_REGION_H

#include "base/error.h"
#include "model/surface.h"
#include "simulation/lattice.h"
#include <stdbool.h>
#include <stdint.h>

enum region_kind {
    REGION_FOOT,   ///< up to `size` above the surface's lowest point, below 0: a twentieth of its height
    REGION_NONE,   ///< nowhere
    REGION_PLANE,  ///< behind the plane through `point`, the side that `normal` leads away from
    REGION_SPHERE, ///< within `size` of `point`
    REGION_COLOR,  ///< around vertices of this colour
};

struct region {
    enum region_kind kind;
    double point[3], normal[3], size; ///< m
    uint32_t color;                   ///< 0xRRGGBB, sRGB
};

/// H, none, plane:x,y,z,nx,ny,nz, sphere:x,y,z,r or color:RRGGBB. False if it is none of these.
bool region_parse(const char *text, struct region *region);

/// Which nodes of the lattice are in it, one a node. Errors: no vertex has the colour; `name` is the
/// surface's.
bool region_nodes(const struct region *region, const struct lattice *lattice, const struct surface *surface,
                  const char *name, bool *inside, struct error *error);

#endif

/// Where a body is held and how soft it is: what --pin and --soft say.
#ifndef SIMULATION_REGION_H
#define SIMULATION_REGION_H

#include "base/error.h"
#include "model/surface.h"
#include "simulation/body.h"
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

// How much softer than the material each element is: what --soft says.
//
// A weight w of 0 … 1 makes the stiffness N^−w times the material's, so that equal steps of w are equal ratios.

struct softness {
    const char *from; ///< "distance", "color" or a .npy file; NULL: everywhere the same
    double times;     ///< N: how many times softer where the weight is 1
};

/// Sets the elements' stiffness. distance: w is the way through the body from the pinned nodes, 1 where it is longest. color:
/// how bright the vertex is, 0 black, 1 white or brighter. FILE.npy: one number of 0 … 1 a vertex. Errors: no colours, nothing pinned,
/// a file that does not fit; `name` is the surface's.
bool softness_apply(const struct softness *softness, const struct lattice *lattice, const struct surface *surface,
                    const char *name, struct body *body, struct error *error);

#endif

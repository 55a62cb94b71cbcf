/// Which nodes are pinned and how soft each element is: the options --pin and --soft.
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
    REGION_PLANE,  ///< behind the plane through `point`, on the side opposite to `normal`
    REGION_SPHERE, ///< within `size` of `point`
    REGION_COLOR,  ///< around vertices of this colour
};

struct region {
    enum region_kind kind;
    double point[3], normal[3], size; ///< m
    uint32_t color;                   ///< 0xRRGGBB, sRGB
};

/// What region_parse() takes, for error texts.
#define REGION_FORMS "a height, none, plane:x,y,z,nx,ny,nz, sphere:x,y,z,r or color:RRGGBB"

/// H, none, plane:x,y,z,nx,ny,nz, sphere:x,y,z,r or color:RRGGBB. False if it is none of these.
bool region_parse(const char *text, struct region *region);

/// Whether each node of the lattice is in the region. Error: no vertex has the colour; `name` is the surface's.
bool region_nodes(const struct region *region, const struct lattice *lattice, const struct surface *surface,
                  const char *name, bool *inside, struct error *error);

/// Whether each vertex of the surface is in the region, which is not REGION_NONE; returns how many are.
int region_vertices(const struct region *region, const struct surface *surface, bool *inside);

// How much softer than the material each element is, set by --soft.
//
// A weight w of 0 … 1 makes the stiffness N^−w times the material's: equal steps of w are equal ratios.

struct softness {
    const char *from; ///< "distance", "color" or a .npy file; NULL: the same everywhere
    double times;     ///< N: how many times softer where the weight is 1
};

/// Sets the elements' stiffness. distance: w is the path through the body from the pinned nodes, 1 where it is longest. color:
/// w is the vertex's brightness, 0 black, 1 white or brighter. FILE.npy: one number of 0 … 1 a vertex. Errors: no colours, nothing
/// pinned, a file that does not fit; `name` is the surface's.
bool softness_apply(const struct softness *softness, const struct lattice *lattice, const struct surface *surface,
                    const char *name, struct body *body, struct error *error);

#endif

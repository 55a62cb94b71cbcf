/// How much softer than the material each element is: what --soft says.
///
/// A weight w of 0 … 1 makes the stiffness N^−w times the material's, so that equal steps of w are equal ratios.
#ifndef SIMULATION_SOFTNESS_H
#define SIMULATION_SOFTNESS_H

#include "base/error.h"
#include "model/surface.h"
#include "simulation/body.h"
#include "simulation/lattice.h"

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

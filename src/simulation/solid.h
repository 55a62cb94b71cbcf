/// The inside of a surface, in whatever state the surface is.
///
/// Vertices at the same place count as one. Of triangles with the same corners one is kept. Neighbours are turned to agree about their
/// sides, as most of the area of their patch does, and a patch that is inside out is turned round. If then every edge is used once in each
/// direction, the surface is closed; else generalised winding numbers say what is inside.
#ifndef SIMULATION_SOLID_H
#define SIMULATION_SOLID_H

#include "simulation/winding.h"

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

#endif

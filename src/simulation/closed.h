/// Whether a surface is closed: every edge is used once in each direction.
#ifndef SIMULATION_CLOSED_H
#define SIMULATION_CLOSED_H

#include "model/surface.h"

/// Number of edges that are not used as often in one direction as in the other; 0 for a closed surface. Vertices at the same
/// place count as one. −1 where memory is short.
int surface_open_edges(const struct surface *surface);

#endif

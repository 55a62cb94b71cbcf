/// Classical normal coordinates: K φ = ω² M φ at rest, by simultaneous diagonalisation of stiffness and mass (Goldstein).
#ifndef SIMULATION_MODES_H
#define SIMULATION_MODES_H

#include "simulation/body.h"
#include <stdbool.h>

/// The lowest normal modes. A free body's six rigid ones are skipped.
struct modes {
    int count;
    double *frequency;  ///< Hz, ascending
    double (*shape)[3]; ///< count × node_count rows: mode k of node i at [k · node_count + i]; φᵀMφ = 1
};

/// The `count` lowest ones, or as many as there are.
void modes_create(struct modes *modes, struct body *body, int count);
void modes_free(struct modes *modes);

#endif

/// What acts on a body from outside: gravity, a base that moves, a floor.
///
/// A body is simulated as seen from its base. There a base that accelerates by a is a uniform force −m a on all nodes, and
/// the pinned nodes stand still; the floor moves instead. This is exact, not an approximation.
#ifndef SIMULATION_LOADS_H
#define SIMULATION_LOADS_H

#include "simulation/drive.h"
#include "simulation/floor.h"

/// All zero: nothing.
struct loads {
    double gravity;            ///< down (−y), m/s²
    const struct drive *drive; ///< of the base, or NULL
    struct floor *floor;       ///< or NULL
};

/// Adds the forces at a time and the positions x to `force`. Returns their potential, J.
double loads_forces(const struct loads *loads, const struct body *body, double time, const double (*x)[3],
                    double (*force)[3]);

/// Before a step that ends at `time`: what the floor has to know of it. Nodes at y move with `rate` (y − q) at its end.
void loads_aim(const struct loads *loads, double time, double step, double rate, const double (*q)[3]);

#endif

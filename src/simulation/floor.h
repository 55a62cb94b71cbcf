/// A smooth floor that the surface rests on: a spring under each vertex that pushes once the vertex is below it.
///
/// The springs are part of the potential that a time step minimises, so a stiff floor takes no shorter steps. They belong
/// to vertices, weighted by the area around them, and act on the nodes of the vertex' tetrahedron: their stiffness
/// w_a w_b k y yᵀ has a place in the body's matrix. There is no friction.
#ifndef SIMULATION_FLOOR_H
#define SIMULATION_FLOOR_H

#include "simulation/body.h"
#include "simulation/lattice.h"

struct floor {
    const struct lattice *lattice;
    double height;  ///< y, m
    double *spring; ///< per vertex, N/m
    bool *touched;  ///< per vertex: below the floor at the last floor_push()
};

/// A floor under the lattice's surface, as stiff as ten times the body's material, a cell thick. False where memory is short.
bool floor_create(struct floor *floor, const struct lattice *lattice, const struct surface *surface, double height,
                  double young);
void floor_free(struct floor *floor);

/// Adds to `force` what pushes the nodes up at the positions x, the floor being `risen` m higher. Returns the energy, J.
double floor_push(struct floor *floor, double risen, const double (*x)[3], double (*force)[3]);

/// Adds −∂f/∂x at the last floor_push() to the body's stiffness.
void floor_stiffness(const struct floor *floor, struct body *body);

#endif

/// A smooth floor that the surface rests on: a spring under each vertex that pushes once the vertex is below it.
///
/// The springs are part of the potential that a time step minimises, so a stiff floor takes no shorter steps. They belong
/// to vertices, weighted by the area around them, and act on the nodes of the vertex' tetrahedron: their stiffness
/// w_a w_b k y yᵀ has a place in the body's matrix. There is no friction.
///
/// A vertex that was below at the step's start is damped, too, with the impedance √(E ρ) of its area, by which a floor of the same
/// stuff would swallow a wave; else a vertex that lands lightly would go in and out with every step. Its depth at the step's end
/// being d, the push is
///
///   max(0, k max(d, 0) + c r (d − q)),    r (d − q) the speed by which it sinks
///
/// It grows with d, so it has a convex potential, and it never pulls.
#ifndef SIMULATION_FLOOR_H
#define SIMULATION_FLOOR_H

#include "simulation/body.h"
#include "simulation/lattice.h"

struct floor {
    const struct lattice *lattice;
    double height;  ///< y, m
    double *spring; ///< k per vertex, N/m
    double *damper; ///< c per vertex, N s/m
    bool *touched;  ///< per vertex: below the floor at the last floor_push()
    bool *damped;   ///< per vertex: below the floor at the step's start
    bool *pushed;   ///< per vertex: pushed at the last floor_push()
    double *origin; ///< q per vertex, m
    double rate;    ///< r, 1/s
    double drag;    ///< J: how far the potential of the last floor_push() exceeds the springs' energy
};

/// A floor under the lattice's surface, as stiff as ten times the body's material, a cell thick.
void floor_create(struct floor *floor, const struct lattice *lattice, const struct surface *surface, double height,
                  double young, double density);
void floor_free(struct floor *floor);

/// Notes which vertices are below the floor at a step's start, where floor_push() was called last.
void floor_start(struct floor *floor);

/// Says how fast nodes at y move at the step's end, `rate` (y − q), and the floor, `risen` m higher there, upwards.
void floor_aim(struct floor *floor, double rate, const double (*q)[3], double risen, double speed);

/// Adds to `force` what pushes the nodes up at the positions x, the floor being `risen` m higher. Returns the energy, J.
double floor_push(struct floor *floor, double risen, const double (*x)[3], double (*force)[3]);

/// Adds −∂f/∂x at the last floor_push() to the body's stiffness.
void floor_stiffness(const struct floor *floor, struct body *body);

#endif

/// A smooth floor under the surface: each vertex below it is pushed up by a spring.
///
/// The springs are part of the potential that a time step minimises, so a stiff floor needs no shorter steps. Each spring belongs
/// to a vertex, is weighted by the area around it, and acts on the nodes of that vertex's tetrahedron: its stiffness
/// w_a w_b k y yᵀ fits the pattern of the body's matrix. There is no friction.
///
/// A vertex that was below at the step's start is also damped, by the impedance √(E ρ) of its area: a floor of the same material
/// would absorb a wave like this. Without it, a vertex that lands lightly bounces with every step. With depth d at the step's end
/// the push is
///
///   max(0, k max(d, 0) + c r (d − q)),    r (d − q) the speed by which it sinks
///
/// It grows with d, so it has a convex potential, and it never pulls.
#ifndef SIMULATION_FLOOR_H
#define SIMULATION_FLOOR_H

#include "simulation/body.h"
#include "simulation/lattice.h"

struct floor {
    struct pool pool; ///< has all below
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

/// Call after the floor_push() at a step's start: remembers which vertices are below the floor.
void floor_start(struct floor *floor);

/// Sets the velocities at the step's end: `rate` (y − q) for nodes at y, `speed` upwards for the floor, which is `risen` m higher then.
void floor_aim(struct floor *floor, double rate, const double (*q)[3], double risen, double speed);

/// Adds the springs' forces on the nodes at the positions x to `force`; the floor is `risen` m higher. Returns the energy, J.
double floor_push(struct floor *floor, double risen, const double (*x)[3], double (*force)[3]);

/// Adds −∂f/∂x at the last floor_push() to the body's stiffness.
void floor_stiffness(const struct floor *floor, struct body *body);

#endif

/// Time steps of an elastic body by the generalised-α method (Chung and Hulbert 1993) with ρ∞ = 0.8.
///
/// Second order, one solve a step. Oscillations that the step resolves are nearly undamped (a swing of a fifth of the
/// length at 50 steps a period loses 0.4 % of its energy in 100 periods), those that it does not resolve lose a fifth per
/// step. The midpoint rule, which damps nothing, gains energy from the latter in large deformations until it
/// breaks; BDF2 takes half the energy of that same swing (table in README.md). Yet no such scheme is sure never to raise the
/// energy in large deformations: a step after which there is more than before and the loads' work together is repeated by
/// backward Euler, which lowers it. With x as the unknown a step is
///
///   κ M (x − t) + r C (x − q) = f(x),    κ = (1 − α_m)/((1 − α_f) β h²),    r = γ/(β h)
///
/// with targets t and q from the state before: the gradient of a potential, which Newton's method with a definite
/// matrix and a line search descends however far from rest. Damping is Rayleigh's, C = α M + β K, with the stiffness at
/// the step's start.
#ifndef SIMULATION_INTEGRATOR_H
#define SIMULATION_INTEGRATOR_H

#include "simulation/drive.h"
#include "simulation/floor.h"
#include <stdbool.h>

/// What acts on a body from outside: gravity, a base that moves, a floor. All zero: nothing.
///
/// A body is simulated as seen from its base. There a base that accelerates by a is a uniform force −m a on all nodes, and
/// the pinned nodes stand still; the floor moves instead. This is exact, not an approximation.
struct loads {
    double gravity;            ///< down (−y), m/s²
    const struct drive *drive; ///< of the base, or NULL
    struct floor *floor;       ///< or NULL
};

struct integrator {
    struct body *body;
    struct loads loads;       ///< none at the start
    double time;              ///< s
    double step;              ///< h, s
    double mass_damping;      ///< Rayleigh's α, 1/s
    double stiffness_damping; ///< Rayleigh's β, s
    double tolerance;         ///< Newton's method stops once no node moves farther than this, m
    double (*x)[3];           ///< positions, m: the caller sets them at the start
    double (*v)[3];           ///< velocities, m/s: likewise
    long newton, gradients;   ///< iterations so far, of Newton's method and of conjugate gradients
    long calmed;              ///< steps so far that backward Euler took
    struct integrator_work *work;
};

/// A body at rest, undamped. The body must be ready and outlive it.
void integrator_create(struct integrator *integrator, struct body *body, double step);
void integrator_free(struct integrator *integrator);

/// Moves the body to where the loads of the start hold it, at rest. It must be pinned, or nothing stops its fall.
bool integrator_settle(struct integrator *integrator);

/// One step. False if a number is no longer finite, as after boundless forces.
bool integrator_step(struct integrator *integrator);

#endif

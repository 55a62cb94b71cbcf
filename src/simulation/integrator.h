/// Time steps of an elastic body by the generalised-α method (Chung and Hulbert 1993) with ρ∞ = 0.8.
///
/// Second order, one solve a step. Oscillations that the step resolves are nearly undamped: a swing of a fifth of the length at 50
/// steps a period loses 0.4 % of its energy in 100 periods. Unresolved ones lose a fifth per step. The midpoint rule damps nothing,
/// and in large deformations unresolved oscillations gain energy until it fails; BDF2 takes half the energy of the same swing
/// (table in README.md). No such scheme rules out a gain of energy in large deformations. So a step is repeated by backward Euler,
/// which loses energy, if it ends with more than it had plus the loads' work. With x as the unknown a step is
///
///   κ M (x − t) + r C (x − q) = f(x),    κ = (1 − α_m)/((1 − α_f) β h²),    r = γ/(β h)
///
/// with targets t and q from the state before. This is the gradient of a potential, so Newton's method with a definite matrix and a
/// line search descends it however far from rest. Damping is Rayleigh's, C = α M + β K, with the stiffness at the step's start.
#ifndef SIMULATION_INTEGRATOR_H
#define SIMULATION_INTEGRATOR_H

#include "simulation/drive.h"
#include "simulation/floor.h"
#include <stdbool.h>

/// External loads: gravity, a moving base, a floor. All zero: none.
///
/// The simulation runs in the base's frame. There a base that accelerates by a is a uniform force −m a on all nodes, the pinned
/// nodes stand still and the floor moves. This is exact.
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
    double (*x)[3];           ///< positions, m: set them before the first step
    double (*v)[3];           ///< velocities, m/s: likewise
    long newton, gradients;   ///< iterations so far, of Newton's method and of conjugate gradients
    long calmed;              ///< steps so far repeated by backward Euler
    struct integrator_work *work;
};

/// A body at rest, undamped. The body must be ready and outlive it.
void integrator_create(struct integrator *integrator, struct body *body, double step);
void integrator_free(struct integrator *integrator);

/// Moves the body to its equilibrium under the loads at the start, at rest. It must be pinned, or it falls for ever.
bool integrator_settle(struct integrator *integrator);

/// One step. False if a number is not finite any more, as under unbounded forces.
bool integrator_step(struct integrator *integrator);

#endif

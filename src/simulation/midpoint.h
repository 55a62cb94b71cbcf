/// Time steps of an elastic body by the implicit midpoint rule.
///
/// The rule keeps the linear and the angular momentum of a free body exactly and, being symplectic, its energy without
/// drift: it has no numerical damping at all, so a shake decays by the material's damping alone (README.md has figures).
/// With the midpoint y = (x₀ + x₁)/2 as the unknown, a step of length h is
///
///   4/h² M (y − x₀ − h/2 v₀) + C 2/h (y − x₀) = f(y),     x₁ = 2y − x₀,   v₁ = 4/h (y − x₀) − v₀
///
/// which is the gradient of a potential: Newton's method with a definite matrix and a line search always finds a
/// minimum, however far from rest. Damping is Rayleigh's, C = α M + β K(x₀), with the stiffness at the step's start.
#ifndef SIMULATION_MIDPOINT_H
#define SIMULATION_MIDPOINT_H

#include "simulation/body.h"
#include <stdbool.h>

struct midpoint {
    struct body *body;
    double step;            ///< h, s
    double alpha, beta;     ///< Rayleigh's coefficients, 1/s and s
    double tolerance;       ///< Newton stops once no node moves farther than this, m
    double (*x)[3];         ///< positions, m: the caller sets them at the start
    double (*v)[3];         ///< velocities, m/s
    long newton, gradients; ///< iterations so far, of Newton's method and of conjugate gradients
    struct midpoint_work *work;
};

/// A body at rest. False where memory is short. The body must outlive it.
bool midpoint_create(struct midpoint *midpoint, struct body *body, double step);
void midpoint_free(struct midpoint *midpoint);

/// One step. False where Newton's method did not converge or the state is not finite; x and v are then as before.
bool midpoint_step(struct midpoint *midpoint);

#endif

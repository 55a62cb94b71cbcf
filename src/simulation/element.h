/// One linear tetrahedron: its deformation gradient, its forces and its stiffness.
///
/// Positions are interpolated linearly, x(X) = Σ_a x_a N_a(X), so the deformation gradient is constant, F = Σ_a x_a ⊗ b_a
/// with b_a = ∇N_a. With F = U Σ Vᵀ and the diagonal stress P̂(Σ) the first Piola stress is P = U P̂ Vᵀ, and
/// the force on node a is f_a = −w P b_a (Irving, Teran, Fedkiw 2004, section 4), w being the rest volume of the material in it.
#ifndef SIMULATION_ELEMENT_H
#define SIMULATION_ELEMENT_H

#include "simulation/linear.h"
#include "simulation/material.h"
#include <stdbool.h>

struct element {
    int node[4];
    double gradient[4][3]; ///< b_a, 1/m
    double volume;         ///< m³ of material at rest: the whole tetrahedron's, or the part that the solid fills
    double stiffness;      ///< as a multiple of the material's
};

/// Sets the gradients and the volume of the tetrahedron with these nodes at rest, times `fraction`; stiffness 1. False if it
/// is flat.
bool element_init(struct element *element, const int node[4], const double (*rest)[3], double fraction);

/// The singular value decomposition of F at the positions x.
void element_decompose(const struct element *element, const double (*x)[3], struct svd *svd);

/// Adds the forces on the four nodes (N) to `force`, one row a node of the whole body; returns the energy (J).
double element_force(const struct element *element, const struct material *material, const struct svd *svd,
                     double (*force)[3]);

/// The 3×3 blocks −∂f_a/∂x_b (N/m), made semidefinite; block[a][b] row by row.
void element_stiffness(const struct element *element, const struct material *material, const struct svd *svd,
                       double block[4][4][9]);

#endif

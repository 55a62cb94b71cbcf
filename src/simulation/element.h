/// One linear tetrahedron: its deformation gradient, its forces and its stiffness.
///
/// Positions are interpolated linearly, x(X) = Σ_a x_a N_a(X), so the deformation gradient is constant, F = Σ_a x_a ⊗ b_a
/// with b_a = ∇N_a. With F = U Σ Vᵀ and the diagonal stress P̂(Σ) the first Piola stress is P = U P̂ Vᵀ, and
/// the force on node a is f_a = −w P b_a (Irving, Teran, Fedkiw 2004, section 4), w being the rest volume of the material in it.
#ifndef SIMULATION_ELEMENT_H
#define SIMULATION_ELEMENT_H

#include "simulation/linear.h"
#include <stdbool.h>

// A soft elastic solid, isotropic: compressible neo-Hookean with clamped principal stretches.
//
//   ψ(σ) = Σ [ μ/2 (σᵢ² − 1) − μ L(σᵢ) ] + λ/2 (Σ L(σᵢ))²        energy per rest volume, J/m³
//   L(σ) = ln σ for σ ≥ c,   ln c + (σ − c)/c below                c = MATERIAL_CLAMP
//
// Below c the logarithm continues as its tangent, so L'(σ) = 1/max(σ, c): the stress of Irving, Teran and Fedkiw (2004),
// which clamps the stretch where it would blow up, but derived from an energy, as a line search needs.
// It is finite for every stretch, negative ones included, and always pushes an inverted element back. At rest the
// material is the linear one of Young's modulus and Poisson's ratio.

#define MATERIAL_CLAMP 0.6

/// Lamé's constants, Pa.
struct material {
    double mu, lambda;
};

/// young > 0 in Pa, 0 ≤ poisson < 0.5.
struct material material_from(double young, double poisson);

/// ψ, J/m³.
double material_energy(const struct material *material, const double sigma[3]);

/// ∂ψ/∂σᵢ: the diagonal of the first Piola stress in principal axes, Pa.
void material_stress(const struct material *material, const double sigma[3], double stress[3]);

/// ∂P/∂F in principal axes, made positive semidefinite block by block (Teran, Sifakis, Irving, Fedkiw 2005): `stretch`
/// acts on the three diagonal entries; on each pair of entries (i, j) and (j, i) `straight` on the entry itself and
/// `across` on its mirror image. Pairs in the order 01, 02, 12. Pa.
struct principal_stiffness {
    double stretch[3][3];
    double straight[3], across[3];
};

void material_stiffness(const struct material *material, const double sigma[3],
                        struct principal_stiffness *stiffness);

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

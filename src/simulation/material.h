/// A soft elastic solid, isotropic: compressible neo-Hookean with clamped principal stretches.
///
///   ψ(σ) = Σ [ μ/2 (σᵢ² − 1) − μ L(σᵢ) ] + λ/2 (Σ L(σᵢ))²        energy per rest volume, J/m³
///   L(σ) = ln σ for σ ≥ c,   ln c + (σ − c)/c below                c = MATERIAL_CLAMP
///
/// Below c the logarithm continues as its tangent, so L'(σ) = 1/max(σ, c): the stress of Irving, Teran and Fedkiw (2004),
/// which clamps the stretch where it would blow up, but derived from an energy, as a line search needs.
/// It is finite for every stretch, negative ones included, and always pushes an inverted element back. At rest the
/// material is the linear one of Young's modulus and Poisson's ratio.
#ifndef SIMULATION_MATERIAL_H
#define SIMULATION_MATERIAL_H

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

#endif

/// An elastic body: nodes with masses, tetrahedra, its energy, forces and stiffness in any position, and its normal modes at rest.
///
/// Masses are lumped: a quarter of each element's at each of its nodes.
#ifndef SIMULATION_BODY_H
#define SIMULATION_BODY_H

#include "base/need.h"
#include <math.h>
#include <stdbool.h>

// Vectors of three doubles.

static inline double vec3_dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// out = a × b; out must be neither.
static inline void vec3_cross(const double a[3], const double b[3], double out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

/// The 3n numbers of n vectors.
static inline double *vec3_flat(double (*vectors)[3]) { return *vectors; }

static inline double vec3_length(const double a[3]) { return sqrt(vec3_dot(a, a)); }

// Singular values of 3×3 matrices.

/// F = U diag(σ) Vᵀ with rotations U and V and σ₀ ≥ σ₁ ≥ |σ₂|. If det F < 0, σ₂ is negative, so that an inverted tetrahedron turns
/// back along the direction of least effort (Irving, Teran and Fedkiw 2004, section 3).
struct svd {
    double u[3][3], sigma[3], v[3][3]; ///< u[row][column]
};

/// Any finite F, singular ones included.
void svd3(const double f[3][3], struct svd *svd);

// --- one linear tetrahedron
//
// Positions are interpolated linearly, x(X) = Σ_a x_a N_a(X), so the deformation gradient is constant, F = Σ_a x_a ⊗ b_a
// with b_a = ∇N_a. With F = U Σ Vᵀ and the diagonal stress P̂(Σ) the first Piola stress is P = U P̂ Vᵀ, and
// the force on node a is f_a = −w P b_a (Irving, Teran, Fedkiw 2004, section 4), w being the rest volume of the material in it.

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

struct element {
    int node[4];
    double gradient[4][3]; ///< b_a, 1/m
    double volume;         ///< m³ of material at rest: the whole tetrahedron's, or the part that the solid fills
    double stiffness;      ///< as a multiple of the material's
};

/// Sets the gradients and the volume of the tetrahedron with these nodes at rest, times `fraction`; stiffness 1. False if it
/// is flat.
bool element_init(struct element *element, const int node[4], const double (*rest)[3], double fraction);

// --- sparse symmetric matrices of 3×3 blocks
//
// One block row per node, both triangles stored; solved by conjugate gradients, preconditioned by the inverses of the diagonal blocks.
//
// No factorisation: in a time step the matrix is κM + K, and κM keeps the condition number low. Some twenty products with a
// matrix that fits the cache are faster than a factorisation with its fill-in (times in README.md), and need no library.

struct blocks {
    int rows;
    int *start;         ///< rows + 1
    int *column;        ///< ascending in each row
    double (*block)[9]; ///< row by row
    int *diagonal;      ///< per row: index of block (i, i)
};

/// y = A x, one vector of three per row.
void blocks_multiply(const struct blocks *blocks, const double (*x)[3], double (*y)[3]);

/// Scratch for any number of solves: four vectors and the preconditioner.
struct conjugate {
    double (*r)[3], (*z)[3], (*p)[3], (*q)[3];
    double (*inverse)[9]; ///< of the diagonal blocks
};

/// Solves A x = b for a definite A from the guess x, until the residual in the preconditioner's norm has fallen by
/// `tolerance` relative to that of x = 0. Returns the iterations taken, at most `limit`.
int conjugate_solve(struct conjugate *conjugate, const struct blocks *a, const double (*b)[3], double (*x)[3],
                    double tolerance, int limit);

// --- the body

struct body {
    struct pool pool; ///< has all below
    int node_count, element_count;
    double (*rest)[3];        ///< m
    double *mass;             ///< kg
    bool *pinned;             ///< never moves: the caller says so
    struct element *elements; ///< of positive volume
    struct material material;
    struct svd *svd;          ///< scratch: of each element's F at the last body_forces()
    int (*place)[16];         ///< of each element's blocks in the matrix, or −1 where a node is pinned
    struct blocks stiffness;  ///< what body_stiffness() fills
    struct conjugate scratch; ///< for systems of that size
};

/// Nodes at rest, and tetrahedra: tets[e] names four nodes.
struct body_mesh {
    const double (*rest)[3];
    int node_count;
    const int (*tets)[4];
    const double *fraction; ///< how much of each tetrahedron is filled; NULL: all
    int element_count;
};

/// Density in kg/m³. False where an element is flat.
bool body_create(struct body *body, const struct body_mesh *mesh, struct material material, double density);

/// Once nodes are pinned and elements have their stiffness, before anything below. Drops the elements between pinned nodes.
void body_ready(struct body *body);

/// The forces at the positions x (N; 0 at pinned nodes); returns the energy (J).
double body_forces(struct body *body, const double (*x)[3], double (*force)[3]);

/// K = −∂f/∂x at the last body_forces(), made semidefinite, into body->stiffness. Rows and columns of pinned nodes are
/// those of the identity.
void body_stiffness(struct body *body);

/// ½ Σ m v², J.
double body_kinetic(const struct body *body, const double (*v)[3]);

// Classical normal coordinates: K φ = ω² M φ at rest, by simultaneous diagonalisation of stiffness and mass (Goldstein).

/// The lowest normal modes. A free body's six rigid ones are skipped.
struct modes {
    struct pool pool; ///< has all below
    int count;
    double *frequency;  ///< Hz, ascending
    double (*shape)[3]; ///< count × node_count rows: mode k of node i at [k · node_count + i]; φᵀMφ = 1
};

/// The `count` lowest ones, or as many as there are.
void modes_create(struct modes *modes, struct body *body, int count);

#endif

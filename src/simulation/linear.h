/// Vectors of three doubles, eigenvalues of small dense symmetric matrices, and singular values of 3×3 ones.
#ifndef SIMULATION_LINEAR_H
#define SIMULATION_LINEAR_H

#include <math.h>

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

// Eigenvalues of small dense symmetric matrices, singular values of 3×3 ones.

/// Cyclic Jacobi. `a` (n × n, symmetric) is destroyed; values ascend; vectors[k·n …] is the k-th eigenvector, of length
/// 1. Meant for n up to a few hundred.
void eigen_symmetric(int n, double *a, double *values, double *vectors);

/// F = U diag(σ) Vᵀ with rotations U and V and σ₀ ≥ σ₁ ≥ |σ₂|. If det F < 0, σ₂ is negative, so that an inverted tetrahedron turns
/// back along the direction of least effort (Irving, Teran and Fedkiw 2004, section 3).
struct svd {
    double u[3][3], sigma[3], v[3][3]; ///< u[row][column]
};

/// Any finite F, singular ones included.
void svd3(const double f[3][3], struct svd *svd);

#endif

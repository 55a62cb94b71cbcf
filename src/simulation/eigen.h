/// Eigenvalues of small dense symmetric matrices, singular values of 3×3 ones.
#ifndef SIMULATION_EIGEN_H
#define SIMULATION_EIGEN_H

/// Cyclic Jacobi. `a` (n × n, symmetric) is destroyed; values ascend; vectors[k·n …] is the k-th eigenvector, of length
/// 1. Meant for n up to a few hundred.
void eigen_symmetric(int n, double *a, double *values, double *vectors);

/// By the sign convention of Irving, Teran and Fedkiw (2004), section 3: F = U diag(σ) Vᵀ with U and V rotations (determinant +1) and σ₀ ≥ σ₁ ≥ |σ₂|: where det F < 0 the smallest one is
/// negative, so that an inverted tetrahedron turns back along the direction of least effort.
struct svd {
    double u[3][3], sigma[3], v[3][3]; ///< u[row][column]
};

/// Any finite F, singular ones included.
void svd3(const double f[3][3], struct svd *svd);

#endif

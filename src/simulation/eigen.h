/// Eigenvalues of small dense symmetric matrices.
#ifndef SIMULATION_EIGEN_H
#define SIMULATION_EIGEN_H

/// Cyclic Jacobi. `a` (n × n, symmetric) is destroyed; values ascend; vectors[k·n …] is the k-th eigenvector, of length
/// 1. Meant for n up to a few hundred.
void eigen_symmetric(int n, double *a, double *values, double *vectors);

#endif

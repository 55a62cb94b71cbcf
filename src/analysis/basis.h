/// Sequences over the frames, and least squares on them.
#ifndef ANALYSIS_BASIS_H
#define ANALYSIS_BASIS_H

#include <stdbool.h>

double basis_dot(const double *a, const double *b, int count);

/// B: `count` sequences, each of `frames` numbers. B = L Q with orthonormal rows of Q and L lower triangular.
struct basis {
    int frames, count, capacity;
    double *q;     ///< capacity × frames
    double *lower; ///< capacity × capacity
};

/// Room for `capacity` sequences.
void basis_create(struct basis *basis, int frames, int capacity);
void basis_free(struct basis *basis);

/// Appends a sequence; if it is a combination of the others, it counts as zero.
void basis_append(struct basis *basis, const double *sequence);

/// How much of the power Σ S² the last `last` sequences explain beyond those before; `gram` is G = S Sᵀ.
double basis_gain(const struct basis *basis, int last, const double *gram);

/// W = (B Bᵀ)⁻¹ B, count × frames: S ≈ Bᵀ (W S) with the least sum of squares.
void basis_weights(const struct basis *basis, double *weights);

#endif

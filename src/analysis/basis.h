/// Sequences over the frames, least squares on them, and the position that vertices swing about.
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

// The position that each column swings about: w S, with weights w of the frames that add up to 1. Without it S′ = (1 − 1 wᵀ) S.

/// From a basis that begins with ones: w, of `first` frames that do not count and then the basis's. The caller frees it.
double *middle_create(const struct basis *basis, int first);

/// G becomes that of S′.
void middle_remove(const double *middle, int frames, double *gram);

/// Turns weights of S′ into the same weights of S: `rows` rows of `frames` numbers.
void middle_adapt(const double *middle, int frames, double *weights, int rows);

#endif

/// Sequences over the frames, least squares on them, and the drift that is found so.
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

// The steady drift of a motion: each vertex moves along a line at its own speed, and swings about it.

/// Removing it is a matrix on the frames: S′ = (1 − D) S, D = p₀ w₀ᵀ + p₁ w₁ᵀ, with p₀ = 1 and p₁ the frame number counted from
/// the middle.
struct drift {
    int frames;
    double *weights; ///< w₀ and w₁: w₁ S is each column's drift per frame
    double share;    ///< of the motion's power, 0 … 1
};

/// Appends p₀ and p₁ to a basis.
void drift_append(struct basis *basis);

/// From a basis that begins with p₀ and p₁; `gram` is G = S Sᵀ.
void drift_create(struct drift *drift, const struct basis *basis, const double *gram);
void drift_free(struct drift *drift);

/// Extends a drift of the frames from `first` on to all frames, whose G is `gram`.
void drift_extend(struct drift *drift, int first, const double *gram);

/// From now on the drift keeps each column's mean: D = p₁ w₁ᵀ.
void drift_keep_means(struct drift *drift);

/// No drift: D = 0.
void drift_keep_all(struct drift *drift);

/// G becomes (1 − D) G (1 − D)ᵀ.
void drift_remove(const struct drift *drift, double *gram);

/// Turns weights of S′ into the same weights of S: `rows` rows of `frames` numbers.
void drift_adapt(const struct drift *drift, double *weights, int rows);

#endif

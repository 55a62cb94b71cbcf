/// The Hilbert transform of all columns of a motion at once, as a matrix that acts on its frames.
#ifndef ANALYSIS_HILBERT_H
#define ANALYSIS_HILBERT_H

#include "base/lapack.h"
#include <stdbool.h>

enum { HILBERT_ORDER_MAX = 32 }; ///< of the prediction: sixteen modes

/// The coefficients a₀ = 1, a₁ … a_p of x_t ≈ −Σ a_i x_{t−i} that fit all columns of S best, in time and against it (Burg's
/// method with the sums over time pooled over the columns), from G = S Sᵀ (frames × frames, row after row, both halves).
/// Returns p ≤ HILBERT_ORDER_MAX and at most a third of the frames; less where nothing is left to predict.
int hilbert_predictor(const double *gram, int frames, double coefficients[HILBERT_ORDER_MAX + 1]);

/// Fills `transform` (frames × frames, row after row) with H, such that S + j H S is the analytic signal of the real S with
/// positive frequencies turning counter-clockwise. Beyond its ends S is continued by the predictor, faded out over half
/// its length each; H includes the continuation. False where memory is short.
bool hilbert_transform(const struct lapack *lapack, const double *coefficients, int order, int frames,
                       double *transform);

#endif

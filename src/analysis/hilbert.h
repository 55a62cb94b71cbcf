/// The Hilbert transform of all columns of a motion at once, as a matrix that acts on its frames.
#ifndef ANALYSIS_HILBERT_H
#define ANALYSIS_HILBERT_H

#include "base/lapack.h"
#include <stdbool.h>

enum { HILBERT_ORDER_MAX = 32 }; ///< of the prediction: sixteen modes

/// x_t ≈ −Σ_{i=1}^{order} a_i x_{t − i·stride}, and as well x_t ≈ −Σ a_i x_{t + i·stride}; a_0 = 1.
struct predictor {
    double a[HILBERT_ORDER_MAX + 1];
    int order, stride;
};

/// The predictor that fits all columns of S best, forwards and backwards in time: Burg's method with its sums pooled over
/// the columns, from G = S Sᵀ (frames × frames, row after row, both halves; its trace above 0). The stride is an eighth of the
/// mean period, so that the frame rate does not matter; the order ends where nothing is left to predict.
struct predictor hilbert_predictor(const double *gram, int frames);

/// Fills `transform` (frames × frames, row after row) with H, such that S + j H S is the analytic signal of the real S with
/// positive frequencies turning counter-clockwise. Beyond its ends S is continued by the predictor, faded out over half
/// its length each; H includes the continuation.
void hilbert_transform(const struct lapack *lapack, const struct predictor *predictor, int frames, double *transform);

#endif

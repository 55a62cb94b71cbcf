/// Complex principal components of a motion.
#ifndef ANALYSIS_SPECTRUM_H
#define ANALYSIS_SPECTRUM_H

#include "base/lapack.h"
#include <complex.h>
#include <stdbool.h>

// The Hilbert transform of all columns at once, as a matrix on the frames.

enum { HILBERT_ORDER_MAX = 32 }; ///< of the prediction: sixteen modes

/// x_t ≈ −Σ_{i=1}^{order} a_i x_{t − i·stride}, and likewise x_t ≈ −Σ a_i x_{t + i·stride}; a_0 = 1.
struct predictor {
    double a[HILBERT_ORDER_MAX + 1];
    int order, stride;
};

/// The predictor that fits all columns of S best, forwards and backwards in time: Burg's method with its sums pooled over the
/// columns, from G = S Sᵀ (frames × frames, row after row, both halves; its trace above 0). The stride is an eighth of the mean
/// period, so that the frame rate does not matter; the order stops growing once nothing is left to predict.
struct predictor hilbert_predictor(const double *gram, int frames);

/// Fills `transform` (frames × frames, row after row) with H, such that S + j H S is the analytic signal of the real S, in which
/// positive frequencies turn counter-clockwise. H includes the continuation of S by the predictor, which fades out over half of S's
/// length on either side.
void hilbert_transform(const struct lapack *lapack, const struct predictor *predictor, int frames, double *transform);

// The eigenproblems: complex principal components, and real ones for comparison, from G = S Sᵀ.

/// The complex covariance S̃ S̃ᴴ of the analytic signal S̃ = (1 + jH) S, decomposed.
struct spectrum {
    int frames;
    double *transform;       ///< H, frames × frames, row after row
    double complex *vectors; ///< eigenvectors u_k, one after the other
    double *values;          ///< descending
    double total;            ///< their sum
};

/// The shares of the real variance that the first, the first two … real principal components explain, 0 … 1: `count` of them, at
/// most one per frame. The trace of `gram` is above 0. False if LAPACK has no memory.
bool spectrum_real_shares(const struct lapack *lapack, const double *gram, int frames, int count, double *shares);

/// The trace of `gram` is above 0. False, with nothing to free, if LAPACK has no memory.
bool spectrum_create(struct spectrum *spectrum, const struct lapack *lapack, const double *gram, int frames);
void spectrum_free(struct spectrum *spectrum);

/// The weights w of the frames, Re w then Im w, with w S = u_kᴴ S̃, the k-th row of Vᴴ times its singular value.
void spectrum_weights(const struct spectrum *spectrum, int k, double *weights);

#endif

/// The eigenproblems of the analysis: complex principal components, and real ones beside them, from G = S Sᵀ.
#ifndef ANALYSIS_SPECTRUM_H
#define ANALYSIS_SPECTRUM_H

#include "base/lapack.h"
#include <complex.h>

/// The complex covariance S̃ S̃ᴴ of the analytic signal S̃ = (1 + jH) S, decomposed.
struct spectrum {
    int frames;
    double *transform;       ///< H, frames × frames, row after row
    double complex *vectors; ///< eigenvectors u_k, one after the other, of `values`
    double *values;          ///< descending
    double total;            ///< their sum
};

/// The shares of the real variance that real PCA's first component, its first two … explain, 0 … 1: `count` of them, at most one a
/// frame. `gram` is above 0. False where LAPACK has no memory.
bool spectrum_real_shares(const struct lapack *lapack, const double *gram, int frames, int count, double *shares);

/// Decomposes; the trace of `gram` is above 0. False, with nothing to free, where LAPACK has no memory.
bool spectrum_create(struct spectrum *spectrum, const struct lapack *lapack, const double *gram, int frames);
void spectrum_free(struct spectrum *spectrum);

/// The weights w of the frames, Re w then Im w, with w S = u_kᴴ S̃, the k-th row of Vᴴ times its singular value.
void spectrum_weights(const struct spectrum *spectrum, int k, double *weights);

#endif

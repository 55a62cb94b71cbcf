/// The eigenproblems of the analysis: complex principal components, and real ones beside them, from G = S Sᵀ.
#ifndef ANALYSIS_SPECTRUM_H
#define ANALYSIS_SPECTRUM_H

#include "base/error.h"
#include "base/lapack.h"
#include <complex.h>

/// The complex covariance S̃ S̃ᴴ of the analytic signal S̃ = (1 + jH) S, decomposed.
struct spectrum {
    int frames;
    double *transform;       ///< H, frames × frames, row after row
    double complex *vectors; ///< eigenvectors u_k, one after the other, of `values`
    double *values;          ///< descending
    double total;            ///< their sum
    double pca1, pca2;       ///< shares of the real variance that real PCA's first and first two explain
};

/// Decomposes; `name` begins error messages: nothing moves, memory is short. False leaves nothing to free.
bool spectrum_create(struct spectrum *spectrum, const struct lapack *lapack, const double *gram, int frames,
                     const char *name, struct error *error);
void spectrum_free(struct spectrum *spectrum);

/// The weights w of the frames, Re w then Im w, with w S = u_kᴴ S̃, the k-th row of Vᴴ times its singular value.
void spectrum_weights(const struct spectrum *spectrum, int k, double *weights);

#endif

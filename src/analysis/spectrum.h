/// Sequences over the frames of a motion: least squares on them, complex principal components, poles and their time series.
#ifndef ANALYSIS_SPECTRUM_H
#define ANALYSIS_SPECTRUM_H

#include "base/lapack.h"
#include "base/need.h"
#include <complex.h>
#include <stdbool.h>

/// B: `count` sequences, each of `frames` numbers. B = L Q with orthonormal rows of Q and L lower triangular.
struct basis {
    struct pool pool; ///< has all below
    int frames, count, capacity;
    double *q;     ///< capacity × frames
    double *lower; ///< capacity × capacity
};

/// Room for `capacity` sequences.
void basis_create(struct basis *basis, int frames, int capacity);

/// Appends a sequence; if it is a combination of the others, it counts as zero.
void basis_append(struct basis *basis, const double *sequence);

/// How much of the power Σ S² the last `last` sequences explain beyond those before; `gram` is G = S Sᵀ.
double basis_gain(const struct basis *basis, int last, const double *gram);

/// W = (B Bᵀ)⁻¹ B, count × frames: S ≈ Bᵀ (W S) with the least sum of squares.
void basis_weights(const struct basis *basis, double *weights);

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
    struct pool pool; ///< has all below
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

/// The weights w of the frames, Re w then Im w, with w S = u_kᴴ S̃, the k-th row of Vᴴ times its singular value.
void spectrum_weights(const struct spectrum *spectrum, int k, double *weights);

// The poles of a motion by a subspace method (ESPRIT) on G = S Sᵀ: they do not depend on the frame rate.

enum { SUBSPACE_ORDER_MAX = 24, SUBSPACE_POLES_MAX = SUBSPACE_ORDER_MAX / 2 };

/// One oscillation, z^t at frame t.
struct pole {
    double wander;    ///< how far it moves as the order grows, |Δs| / |s|: small for a true pole of the motion
    double complex z; ///< Im z > 0
};

/// Finds the oscillations that all columns of S share, from G (frames × frames, row after row, both halves), the steadiest first.
/// Constant and linear parts are removed first. Overdamped and growing oscillations are left out.
/// Returns their number, at most SUBSPACE_POLES_MAX; -1 if LAPACK has no memory.
int subspace_poles(const struct lapack *lapack, const double *gram, int frames, struct pole *poles);

// A motion as a sum of undisturbed damped oscillations: which poles matter.

/// Moves the poles that explain the motion best to the front, each judged beside those before it, and appends them to `basis`, which
/// has a sequence of ones and room for two per pole. Steady poles come before wandering ones. Chooses at most `most`,
/// and at least one if there is any; leaves out poles that explain less than `least` of the motion's power or only cancel each other.
/// Returns their number.
int exponentials_choose(struct pole *poles, int count, int most, double least, const double *gram,
                        struct basis *basis);

// One complex coordinate per pole: time series, and the weights of the frames that give the shapes.

enum { TIME_SERIES_MAX = 8 };

/// S ≈ Σ_k Re(R_k Ñ_k). Row 2k of `rows` holds Re R_k and row 2k + 1 −Im R_k, so that with Ñ_k = (w_2k + j w_2k+1) S for the
/// rows w of `weights` the sum is rowsᵀ weights S.
struct time_series {
    struct pool pool; ///< has the rows and the weights
    int frames, count;
    double complex pole[TIME_SERIES_MAX]; ///< z_k, R_k ~ z_k^t
    double *rows, *weights;               ///< 2 count × frames
    double part[TIME_SERIES_MAX];         ///< Σ_t |Re(R_k Ñ_k)|²: larger than the motion's if others cancel it
};

/// Fits time series to `count` poles. `gram` is G = S Sᵀ of a motion about its middle. A time series oscillates at its pole and deviates
/// only as the motion requires, for example under a force. The first shapes come from the undriven frames, those from `first` on.
struct time_series time_series_create(const struct lapack *lapack, const double *gram, int frames, int first,
                                      const double complex *poles, int count);

#endif

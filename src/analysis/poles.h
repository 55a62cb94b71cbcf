/// The poles of a motion: finding them, choosing those that matter, and their time series.
#ifndef ANALYSIS_POLES_H
#define ANALYSIS_POLES_H

#include "analysis/basis.h"
#include "base/lapack.h"
#include <complex.h>

// The poles of a motion by a subspace method (ESPRIT) on G = S Sᵀ: they do not depend on the frame rate.

enum { SUBSPACE_ORDER_MAX = 24, SUBSPACE_POLES_MAX = SUBSPACE_ORDER_MAX / 2 };

/// One oscillation, z^t at frame t.
struct pole {
    double complex z; ///< Im z > 0
    double wander;    ///< how far it moves as the order grows, |Δs| / |s|: small for a true pole of the motion
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
    int frames, count;
    double complex pole[TIME_SERIES_MAX]; ///< z_k, R_k ~ z_k^t
    double *rows, *weights;               ///< 2 count × frames
    double part[TIME_SERIES_MAX];         ///< Σ_t |Re(R_k Ñ_k)|²: larger than the motion's if others cancel it
};

/// Fits time series to `count` poles. `gram` is G = S Sᵀ of a motion about its middle. A time series oscillates at its pole and deviates
/// only as the motion requires, for example under a force. The first shapes come from the undriven frames, those from `first` on.
struct time_series time_series_create(const struct lapack *lapack, const double *gram, int frames, int first,
                                      const double complex *poles, int count);
void time_series_free(struct time_series *series);

#endif

/// One complex coordinate a pole: their time series, and the weights of the frames that give their shapes.
#ifndef ANALYSIS_TIME_SERIES_H
#define ANALYSIS_TIME_SERIES_H

#include "base/lapack.h"
#include <complex.h>

enum { TIME_SERIES_MAX = 8 };

/// S ≈ Σ_k Re(R_k Ñ_k). Row 2k of `rows` holds Re R_k and row 2k + 1 −Im R_k, so that with Ñ_k = (w_2k + j w_2k+1) S for the
/// rows w of `weights` the sum is rowsᵀ weights S.
struct time_series {
    int frames, count;
    double complex pole[TIME_SERIES_MAX]; ///< z_k, R_k ~ z_k^t
    double *rows, *weights;               ///< 2 count × frames
    double part[TIME_SERIES_MAX];         ///< Σ_t |Re(R_k Ñ_k)|²: above that of the motion where others cancel it
};

/// Fits the time series of `count` poles. `gram` is G = S Sᵀ of a motion without drift. A time series swings at its pole, and leaves that
/// as far as the motion asks for it, as where a force acts. The first shapes are those of the frames from `first` on, which nothing
/// drives.
void time_series_create(struct time_series *series, const struct lapack *lapack, const double *gram, int frames,
                        int first, const double complex *poles, int count);
void time_series_free(struct time_series *series);

#endif

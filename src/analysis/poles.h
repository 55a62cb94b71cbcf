/// The poles of a motion: by which oscillations it moves, which of them matter, and their time series.
#ifndef ANALYSIS_POLES_H
#define ANALYSIS_POLES_H

#include "analysis/basis.h"
#include "base/lapack.h"
#include <complex.h>

// The poles of a motion by a subspace method (ESPRIT) on G = S Sᵀ: they do not depend on the frame rate.

enum { SUBSPACE_ORDER_MAX = 24, SUBSPACE_POLES_MAX = SUBSPACE_ORDER_MAX / 2 };

/// One oscillation, z^t at frame t, and how sure it is.
struct pole {
    double complex z; ///< Im z > 0
    double
        wander; ///< how far it moves as the order grows, |Δs| / |s|: a pole of the motion stays, one of chance does not
};

/// Finds the oscillations of all columns of S together, from G (frames × frames, row after row, both halves), the steadiest
/// first. Whatever is constant or grows linearly with time takes no part. Overdamped and growing ones are left out.
/// Returns their number, at most SUBSPACE_POLES_MAX; -1 where LAPACK has no memory.
int subspace_poles(const struct lapack *lapack, const double *gram, int frames, struct pole *poles);

// A motion as a sum of damped oscillations that nothing disturbs: which poles matter.

/// Re z^t and −Im z^t over the frames, largest |z^t| = 1: two rows of `frames` numbers each.
void exponentials_fill(double complex z, int frames, double *rows);

/// Moves those of the poles to the front that explain the motion best, each beside those before it, and appends them to
/// `basis`, which has drift_append()'s two sequences and room for two a pole. Steady poles come before those that wander. At
/// most `most`, at least one where there is any; those that explain less than `least` of the motion's power, or only by cancelling
/// each other, stay behind. Returns their number.
int exponentials_choose(struct pole *poles, int count, int most, double least, const double *gram,
                        struct basis *basis);

// One complex coordinate a pole: their time series, and the weights of the frames that give their shapes.

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

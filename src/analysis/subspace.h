/// The poles of a motion by a subspace method (ESPRIT) on G = S Sᵀ: they do not depend on the frame rate.
#ifndef ANALYSIS_SUBSPACE_H
#define ANALYSIS_SUBSPACE_H

#include "base/lapack.h"
#include <complex.h>

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

#endif

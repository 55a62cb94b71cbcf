/// The rigid motion of a body's base, and passes over a motion from which it is removed.
#ifndef ANALYSIS_RIGID_H
#define ANALYSIS_RIGID_H

#include "base/lapack.h"
#include "base/need.h"
#include "model/motion.h"
#include "model/surface.h"
#include <complex.h>

/// In every frame the base's point that rests at r is at R r + p, with R and p of the least sum of squares (Horn 1987).
struct rigid {
    struct pool pool;     ///< has all below
    int frames;           ///< 0: the base rests, and the motion stays as it is
    double (*turn)[3][3]; ///< R of every frame
    double (*place)[3];   ///< p of every frame, metres
    bool whole;           ///< the base is the whole mesh
    bool base_unknown;    ///< the base is not known: a coordinate may have rigid motions of the mesh
    double travel, angle; ///< at most, from the first frame on: metres of the base's centre, degrees
};

/// Finds the motion of the vertices in `base`, one flag per vertex of `rest`. If it is NULL, resting vertices are the base, unless they lie
/// on a line. Without any, the base is the whole mesh, and only the slow part of its motion counts. Reads the motion once.
/// Errors: a number that is not finite, a file that shrinks.
bool rigid_find(struct rigid *rigid, const struct lapack *lapack, const struct motion *motion,
                const struct surface *rest, const bool *base, struct error *error);

/// The share of a shape that small rigid motions of the whole mesh explain, 0 … 1.
double rigid_share(const double complex (*shape)[3], const struct surface *rest);

// Passes over a motion, a slab of columns at a time: seen from the base, if that is not NULL, and without each column's mean over time:

/// G = S Sᵀ, frames × frames, row after row, both halves filled; and the means.
bool slabs_gram(const struct lapack *lapack, const struct motion *motion, const struct rigid *base, double *gram,
                double *means, struct error *error);

/// W S: `rows` weightings of the frames (rows × frames) give rows × columns.
bool slabs_combine(const struct lapack *lapack, const struct motion *motion, const struct rigid *base,
                   const double *weights, int rows, double *combined, struct error *error);

#endif

/// The passes over a motion, a slab of columns at a time.
#ifndef ANALYSIS_SLABS_H
#define ANALYSIS_SLABS_H

#include "analysis/rigid.h"

/// Some columns of S, those of whole vertices.
struct slab {
    const struct motion *motion;
    int columns, width, first, count; ///< columns in all; in a slab; the slab's first; in this slab
    double *numbers;                  ///< frames × count
};

/// A pass over all slabs: `for (slab = slab_start(m); slab_next(&slab, &error);)`, then slab_end().
struct slab slab_start(const struct motion *motion);
/// Reads the next slab; false after the last one or on an error.
bool slab_next(struct slab *slab, struct error *error);
/// Whether all slabs were read.
bool slab_end(const struct slab *slab);

// Seen from the base, if that is not NULL, and without each column's mean over time:

/// G = S Sᵀ, frames × frames, row after row, both halves filled; and the means.
bool slabs_gram(const struct lapack *lapack, const struct motion *motion, const struct rigid *base, double *gram,
                double *means, struct error *error);

/// W S: `rows` weightings of the frames (rows × frames) give rows × columns.
bool slabs_combine(const struct lapack *lapack, const struct motion *motion, const struct rigid *base,
                   const double *weights, int rows, double *combined, struct error *error);

#endif

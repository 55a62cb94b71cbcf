/// The two passes over a motion, a slab of columns at a time. Each column's mean over time is removed.
#ifndef ANALYSIS_SLABS_H
#define ANALYSIS_SLABS_H

#include "base/lapack.h"
#include "model/motion.h"

/// G = S Sᵀ, frames × frames, row after row, both halves filled; and the mean over time of every column.
bool slabs_gram(const struct lapack *lapack, const struct motion *motion, double *gram, double *means,
                struct error *error);

/// W S: `rows` weightings of the frames (rows × frames) give rows × columns.
bool slabs_combine(const struct lapack *lapack, const struct motion *motion, const double *weights, int rows,
                   double *combined, struct error *error);

#endif

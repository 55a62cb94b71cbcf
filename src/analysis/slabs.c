/// Two passes over a motion in slabs of columns: one forms G = S Sᵀ, the other weights frames.
#include "analysis/spectrum.h"
#include "base/need.h"
#include <stdlib.h>

enum { SLAB_NUMBERS = 1 << 20 }; ///< 8 MiB: a slab and its copies fit the cache

/// Subtracts each column's mean, and stores it in `means` unless that is NULL.
static void remove_means(double *slab, int frames, int count, double *means)
{
    for (int j = 0; j < count; j++) {
        double sum = 0;
        for (int i = 0; i < frames; i++) sum += slab[(size_t)i * (size_t)count + (size_t)j];
        double mean = sum / frames;
        if (means) means[j] = mean;
        for (int i = 0; i < frames; i++) slab[(size_t)i * (size_t)count + (size_t)j] -= mean;
    }
}

/// Some columns of S.
struct slab {
    const struct motion *motion;
    int columns, width, first, count; ///< columns in all; in a slab; the slab's first; in this slab
    double *numbers;
};

static struct slab before_first(const struct motion *motion)
{
    const int columns = 3 * motion->vertices, width = SLAB_NUMBERS / motion->frames + 1;
    struct slab slab = {.motion = motion, .columns = columns, .width = width < columns ? width : columns};
    slab.numbers = need((size_t)motion->frames * (size_t)slab.width, sizeof *slab.numbers);
    return slab;
}

/// Reads the next slab; false after the last one or on an error.
static bool read_next(struct slab *slab, double *means, struct error *error)
{
    const int left = slab->columns - slab->first - slab->count;
    if (left == 0) return false;
    slab->first += slab->count;
    slab->count = left < slab->width ? left : slab->width;
    if (!motion_columns(slab->motion, slab->first, slab->count, slab->numbers, error)) {
        slab->count = 0;
        return false;
    }
    remove_means(slab->numbers, slab->motion->frames, slab->count, means ? means + slab->first : NULL);
    return true;
}

/// Whether all slabs were read.
static bool end(const struct slab *slab)
{
    free(slab->numbers);
    return slab->first + slab->count == slab->columns;
}

bool slabs_gram(const struct lapack *lapack, const struct motion *motion, double *gram, double *means,
                struct error *error)
{
    size_t n = (size_t)motion->frames;
    struct slab slab = before_first(motion);
    for (size_t i = 0; i < n * n; i++) gram[i] = 0;
    while (read_next(&slab, means, error))
        lapack->dsyrk(LAPACK_ROWS_FIRST, BLAS_LOWER, BLAS_PLAIN, motion->frames, slab.count, 1, slab.numbers,
                      slab.count, 1, gram, motion->frames);
    if (!end(&slab)) return false;
    for (size_t i = 0; i < n; i++) {
        for (size_t j = i + 1; j < n; j++) gram[i * n + j] = gram[j * n + i];
    }
    return true;
}

bool slabs_combine(const struct lapack *lapack, const struct motion *motion, const double *weights, int rows,
                   double *combined, struct error *error)
{
    struct slab slab = before_first(motion);
    while (read_next(&slab, NULL, error))
        lapack->dgemm(LAPACK_ROWS_FIRST, BLAS_PLAIN, BLAS_PLAIN, rows, slab.count, motion->frames, 1, weights,
                      motion->frames, slab.numbers, slab.count, 0, combined + slab.first, slab.columns);
    return end(&slab);
}

/// Two passes over a motion in slabs of columns: one forms G = S Sᵀ, the other weights frames.
#include "analysis/slabs.h"
#include "base/need.h"
#include <stdlib.h>

enum { SLAB_NUMBERS = 1 << 20 }; ///< 8 MiB: a slab and its copies fit the cache

struct slab slab_start(const struct motion *motion)
{
    const int columns = 3 * motion->vertices, width = 3 * (SLAB_NUMBERS / motion->frames / 3 + 1);
    struct slab slab = {.motion = motion, .columns = columns, .width = width < columns ? width : columns};
    slab.numbers = need((size_t)motion->frames * (size_t)slab.width, sizeof *slab.numbers);
    return slab;
}

bool slab_next(struct slab *slab, struct error *error)
{
    const int left = slab->columns - slab->first - slab->count;
    if (left == 0) return false;
    slab->first += slab->count;
    slab->count = left < slab->width ? left : slab->width;
    if (motion_columns(slab->motion, slab->first, slab->count, slab->numbers, error)) return true;
    slab->count = 0;
    return false;
}

bool slab_end(const struct slab *slab)
{
    free(slab->numbers);
    return slab->first + slab->count == slab->columns;
}

/// Subtracts each column's mean, and stores it in `means` unless that is NULL.
static void remove_means(struct slab *slab, double *means)
{
    const int frames = slab->motion->frames, count = slab->count;
    for (int j = 0; j < count; j++) {
        double sum = 0, *column = slab->numbers + j;
        for (int i = 0; i < frames; i++) sum += column[(size_t)i * (size_t)count];
        double mean = sum / frames;
        if (means) means[slab->first + j] = mean;
        for (int i = 0; i < frames; i++) column[(size_t)i * (size_t)count] -= mean;
    }
}

/// The next slab as the analysis has it: seen from the base, without means.
static bool read_next(struct slab *slab, const struct rigid *base, double *means, struct error *error)
{
    if (!slab_next(slab, error)) return false;
    if (base && base->frames > 0) rigid_undo(base, slab->numbers, slab->count);
    remove_means(slab, means);
    return true;
}

bool slabs_gram(const struct lapack *lapack, const struct motion *motion, const struct rigid *base, double *gram,
                double *means, struct error *error)
{
    size_t n = (size_t)motion->frames;
    struct slab slab = slab_start(motion);
    for (size_t i = 0; i < n * n; i++) gram[i] = 0;
    while (read_next(&slab, base, means, error))
        lapack->dsyrk(LAPACK_ROWS_FIRST, BLAS_LOWER, BLAS_PLAIN, motion->frames, slab.count, 1, slab.numbers,
                      slab.count, 1, gram, motion->frames);
    if (!slab_end(&slab)) return false;
    for (size_t i = 0; i < n; i++) {
        for (size_t j = i + 1; j < n; j++) gram[i * n + j] = gram[j * n + i];
    }
    return true;
}

bool slabs_combine(const struct lapack *lapack, const struct motion *motion, const struct rigid *base,
                   const double *weights, int rows, double *combined, struct error *error)
{
    struct slab slab = slab_start(motion);
    while (read_next(&slab, base, NULL, error))
        lapack->dgemm(LAPACK_ROWS_FIRST, BLAS_PLAIN, BLAS_PLAIN, rows, slab.count, motion->frames, 1, weights,
                      motion->frames, slab.numbers, slab.count, 0, combined + slab.first, slab.columns);
    return slab_end(&slab);
}

/// Two passes over a motion in slabs of columns: one forms G = S Sᵀ, the other weights frames.
#include "analysis/spectrum.h"
#include "base/need.h"
#include <stdlib.h>

enum { SLAB_NUMBERS = 1 << 20 }; ///< 8 MiB: a slab and its copies fit the cache

/// Called with columns [first, first + count) of S.
typedef void visit(void *user, const double *slab, int first, int count);

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

static bool visit_slabs(const struct motion *motion, visit *each, void *user, double *means, struct error *error)
{
    int columns = 3 * motion->vertices, width = SLAB_NUMBERS / motion->frames + 1;
    if (width > columns) width = columns;
    double *slab = need((size_t)motion->frames * (size_t)width, sizeof *slab);
    bool done = true;
    for (int first = 0; done && first < columns; first += width) {
        int count = columns - first < width ? columns - first : width;
        done = motion_columns(motion, first, count, slab, error);
        if (!done) break;
        remove_means(slab, motion->frames, count, means ? means + first : NULL);
        each(user, slab, first, count);
    }
    free(slab);
    return done;
}

struct gram {
    const struct lapack *lapack;
    double *sum;
    int frames;
};

static void add_products(void *user, const double *slab, int first, int count)
{
    const struct gram *g = user;
    (void)first;
    g->lapack->dsyrk(LAPACK_ROWS_FIRST, BLAS_LOWER, BLAS_PLAIN, g->frames, count, 1, slab, count, 1, g->sum,
                     g->frames);
}

bool slabs_gram(const struct lapack *lapack, const struct motion *motion, double *gram, double *means,
                struct error *error)
{
    size_t n = (size_t)motion->frames;
    struct gram g = {lapack, gram, motion->frames};
    for (size_t i = 0; i < n * n; i++) gram[i] = 0;
    if (!visit_slabs(motion, add_products, &g, means, error)) return false;
    for (size_t i = 0; i < n; i++) {
        for (size_t j = i + 1; j < n; j++) gram[i * n + j] = gram[j * n + i];
    }
    return true;
}

struct combination {
    const struct lapack *lapack;
    const double *weights;
    double *combined;
    int rows, frames, columns;
};

static void combine(void *user, const double *slab, int first, int count)
{
    const struct combination *c = user;
    c->lapack->dgemm(LAPACK_ROWS_FIRST, BLAS_PLAIN, BLAS_PLAIN, c->rows, count, c->frames, 1, c->weights, c->frames,
                     slab, count, 0, c->combined + first, c->columns);
}

bool slabs_combine(const struct lapack *lapack, const struct motion *motion, const double *weights, int rows,
                   double *combined, struct error *error)
{
    struct combination c = {lapack, weights, combined, rows, motion->frames, 3 * motion->vertices};
    return visit_slabs(motion, combine, &c, NULL, error);
}

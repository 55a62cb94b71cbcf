/// Gram-Schmidt on sequences over the frames, each made orthogonal twice, so that close poles keep their digits.
#include "analysis/spectrum.h"
#include "base/need.h"
#include <math.h>
#include <string.h>

static const double dependent = 1e-12; ///< a sequence with less than this share left is a combination of the others

void basis_create(struct basis *b, int frames, int capacity)
{
    *b = (struct basis){.frames = frames, .capacity = capacity};
    b->q = pool_take(&b->pool, (size_t)capacity * (size_t)frames, sizeof *b->q);
    b->lower = pool_take(&b->pool, (size_t)capacity * (size_t)capacity, sizeof *b->lower);
}

double basis_dot(const double *a, const double *b, int count)
{
    double sum = 0;
    for (int i = 0; i < count; i++) sum += a[i] * b[i];
    return sum;
}

void basis_append(struct basis *b, const double *sequence)
{
    size_t n = (size_t)b->frames, row = (size_t)b->count;
    double *q = b->q + row * n, *lower = b->lower + row * (size_t)b->capacity;
    memcpy(q, sequence, n * sizeof *q);
    memset(lower, 0, (size_t)b->capacity * sizeof *lower);
    double whole = sqrt(basis_dot(q, q, b->frames));
    for (int pass = 0; pass < 2; pass++) {
        for (size_t k = 0; k < row; k++) {
            double along = basis_dot(q, b->q + k * n, b->frames);
            lower[k] += along;
            for (size_t t = 0; t < n; t++) q[t] -= along * b->q[k * n + t];
        }
    }
    double left = sqrt(basis_dot(q, q, b->frames));
    bool spanned = !(left > dependent * whole);
    for (size_t t = 0; t < n; t++) q[t] = spanned ? 0 : q[t] / left;
    lower[row] = spanned ? 0 : left;
    b->count++;
}

double basis_gain(const struct basis *b, int last, const double *gram)
{
    size_t n = (size_t)b->frames;
    double gain = 0;
    for (int k = b->count - last; k < b->count; k++) {
        const double *q = b->q + (size_t)k * n;
        for (size_t t = 0; t < n; t++) gain += q[t] * basis_dot(q, gram + t * n, b->frames);
    }
    return gain;
}

void basis_weights(const struct basis *b, double *weights)
{
    // W = L⁻ᵀ Q, from the last row upwards
    size_t n = (size_t)b->frames, capacity = (size_t)b->capacity;
    memcpy(weights, b->q, (size_t)b->count * n * sizeof *weights);
    for (size_t i = (size_t)b->count; i-- > 0;) {
        double pivot = b->lower[i * capacity + i];
        for (size_t k = i + 1; k < (size_t)b->count; k++) {
            for (size_t t = 0; t < n; t++) weights[i * n + t] -= b->lower[k * capacity + i] * weights[k * n + t];
        }
        for (size_t t = 0; t < n; t++) weights[i * n + t] = pivot > 0 ? weights[i * n + t] / pivot : 0;
    }
}

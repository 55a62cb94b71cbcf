/// Complex and real principal components from G, by LAPACKE.
#include "analysis/spectrum.h"
#include "base/need.h"
#include <stdlib.h>
#include <string.h>

/// S̃ S̃ᴴ = (1 + jH) G (1 − jHᵀ) = G + H G Hᵀ + j (H G − (H G)ᵀ)
static void covariance(const struct lapack *lapack, const double *h, const double *gram, int frames,
                       double complex *result)
{
    size_t n = (size_t)frames;
    double *hg = need(2 * n * n, sizeof *hg);
    double *hgh = hg + n * n;
    memcpy(hgh, gram, n * n * sizeof *hgh);
    lapack->dgemm(LAPACK_ROWS_FIRST, BLAS_PLAIN, BLAS_PLAIN, frames, frames, frames, 1, h, frames, gram, frames, 0,
                  hg, frames);
    lapack->dgemm(LAPACK_ROWS_FIRST, BLAS_PLAIN, BLAS_TRANSPOSED, frames, frames, frames, 1, hg, frames, h, frames, 1,
                  hgh, frames);
    for (size_t i = 0; i < n; i++) {
        for (size_t j = 0; j < n; j++) // column-major, as LAPACK needs it
            result[j * n + i] = hgh[i * n + j] + I * (hg[i * n + j] - hg[j * n + i]);
    }
    free(hg);
}

bool spectrum_real_shares(const struct lapack *lapack, const double *gram, int frames, int count, double *shares)
{
    size_t n = (size_t)frames;
    double total = 0, *copy = need(n * n + n, sizeof *copy);
    double *values = copy + n * n;
    memcpy(copy, gram, n * n * sizeof *copy);
    bool done = lapack->dsyevd(LAPACK_COLUMNS_FIRST, 'N', 'L', frames, copy, frames, values) == 0;
    for (size_t i = 0; done && i < n; i++) total += values[i] > 0 ? values[i] : 0;
    double sum = 0;
    for (int k = 0; done && k < count; k++) {
        sum += values[n - 1 - (size_t)k];
        shares[k] = sum / total;
    }
    free(copy);
    return done;
}

/// LAPACK sorts ascending.
static void turn_round(struct spectrum *s)
{
    size_t n = (size_t)s->frames;
    for (size_t i = 0, j = n - 1; i < j; i++, j--) {
        double value = s->values[i];
        s->values[i] = s->values[j];
        s->values[j] = value;
        for (size_t t = 0; t < n; t++) {
            double complex number = s->vectors[i * n + t];
            s->vectors[i * n + t] = s->vectors[j * n + t];
            s->vectors[j * n + t] = number;
        }
    }
    s->total = 0;
    for (size_t i = 0; i < n; i++) {
        if (s->values[i] < 0) s->values[i] = 0; // rounding
        s->total += s->values[i];
    }
}

bool spectrum_create(struct spectrum *s, const struct lapack *lapack, const double *gram, int frames)
{
    size_t n = (size_t)frames;
    struct predictor predictor = hilbert_predictor(gram, frames);
    *s = (struct spectrum){.frames = frames};
    s->transform = need(n * n, sizeof *s->transform);
    s->vectors = need(n * n, sizeof *s->vectors);
    s->values = need(n, sizeof *s->values);
    hilbert_transform(lapack, &predictor, frames, s->transform);
    covariance(lapack, s->transform, gram, frames, s->vectors);
    if (lapack->zheevd(LAPACK_COLUMNS_FIRST, 'V', 'L', frames, s->vectors, frames, s->values) == 0) {
        turn_round(s);
        return true;
    }
    spectrum_free(s);
    return false;
}

void spectrum_free(struct spectrum *s)
{
    free(s->transform);
    free(s->vectors);
    free(s->values);
    *s = (struct spectrum){0};
}

void spectrum_weights(const struct spectrum *s, int k, double *weights)
{
    // w = uᴴ (1 + jH): Re w = Re u + Im u H, Im w = −Im u + Re u H
    int n = s->frames;
    const double complex *u = s->vectors + (size_t)k * (size_t)n;
    double *re = weights, *im = weights + n;
    for (int t = 0; t < n; t++) {
        re[t] = im[t] = 0;
        for (int i = 0; i < n; i++) {
            double h = s->transform[(size_t)i * (size_t)n + (size_t)t];
            re[t] += cimag(u[i]) * h;
            im[t] += creal(u[i]) * h;
        }
        re[t] += creal(u[t]);
        im[t] -= cimag(u[t]);
    }
}

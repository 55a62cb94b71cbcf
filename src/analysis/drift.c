/// The drift of a motion, fitted together with its oscillations: half a swing alone would look like a drift.
#include "analysis/basis.h"
#include "base/need.h"
#include <stdlib.h>
#include <string.h>

enum { ROWS = 2 };

static double part(int frames, int row, int frame) { return row == 0 ? 1 : frame - (frames - 1) / 2.0; }

void drift_append(struct basis *basis)
{
    double *sequence = need_zeroed((size_t)basis->frames, sizeof *sequence);
    for (int row = 0; row < ROWS; row++) {
        for (int t = 0; t < basis->frames; t++) sequence[t] = part(basis->frames, row, t);
        basis_append(basis, sequence);
    }
    free(sequence);
}

static void measure(struct drift *d, const double *gram)
{
    size_t n = (size_t)d->frames;
    double speed = 0, size = 0, power = 0;
    for (size_t t = 0; t < n; t++) {
        double along = 0;
        for (size_t s = 0; s < n; s++) along += gram[t * n + s] * d->weights[n + s];
        speed += d->weights[n + t] * along;
        size += part(d->frames, 1, (int)t) * part(d->frames, 1, (int)t);
        power += gram[t * n + t];
    }
    d->share = power > 0 ? speed * size / power : 0;
}

void drift_create(struct drift *d, const struct basis *basis, const double *gram)
{
    *d = (struct drift){.frames = basis->frames};
    d->weights = need((size_t)basis->count * (size_t)d->frames, sizeof *d->weights);
    basis_weights(basis, d->weights);
    measure(d, gram);
}

void drift_extend(struct drift *d, int first, const double *gram)
{
    size_t from = (size_t)first, n = from + (size_t)d->frames;
    double *weights = need_zeroed(ROWS * n, sizeof *weights);
    for (size_t t = from; t < n; t++) {
        const double position = d->weights[t - from], speed = d->weights[n - from + t - from];
        weights[t] =
            position - first / 2.0 * speed; // the middle of all frames is first / 2 before that of the last ones
        weights[n + t] = speed;
    }
    free(d->weights);
    d->weights = weights;
    d->frames = (int)n;
    measure(d, gram);
}

void drift_free(struct drift *d)
{
    free(d->weights);
    *d = (struct drift){0};
}

void drift_keep_means(struct drift *d) { memset(d->weights, 0, (size_t)d->frames * sizeof *d->weights); }

void drift_keep_all(struct drift *d)
{
    memset(d->weights, 0, ROWS * (size_t)d->frames * sizeof *d->weights);
    d->share = 0;
}

void drift_remove(const struct drift *d, double *gram)
{
    size_t n = (size_t)d->frames;
    double *product = need(n, sizeof *product);
    for (int row = 0; row < ROWS; row++) {
        const double *w = d->weights + (size_t)row * n;
        double twice = 0;
        // With g = G w the result is G − p gᵀ − g pᵀ + (wᵀ g) p pᵀ, filled in both halves at once so that G stays symmetric. The two rows
        // do not mix, as w₀ᵀ p₁ = w₁ᵀ p₀ = 0.
        for (size_t t = 0; t < n; t++) {
            product[t] = 0;
            for (size_t s = 0; s < n; s++) product[t] += gram[t * n + s] * w[s];
        }
        for (size_t t = 0; t < n; t++) twice += w[t] * product[t];
        for (size_t t = 0; t < n; t++) {
            double p = part(d->frames, row, (int)t);
            for (size_t s = 0; s < n; s++) {
                double q = part(d->frames, row, (int)s);
                gram[t * n + s] += twice * p * q - p * product[s] - q * product[t];
            }
        }
    }
    free(product);
}

void drift_adapt(const struct drift *d, double *weights, int rows)
{
    size_t n = (size_t)d->frames;
    for (int row = 0; row < rows; row++) {
        double *w = weights + (size_t)row * n, along[ROWS] = {0};
        for (int r = 0; r < ROWS; r++) {
            for (size_t t = 0; t < n; t++) along[r] += w[t] * part(d->frames, r, (int)t);
        }
        for (int r = 0; r < ROWS; r++) {
            for (size_t t = 0; t < n; t++) w[t] -= along[r] * d->weights[(size_t)r * n + t];
        }
    }
}

/// Least squares on sequences over the frames, and complex and real principal components from G, by LAPACKE.
///
/// The Hilbert transform: x̂ = K x̄, where x̄ is x with a continuation on either side (together as long as x) and K is the Hilbert transform of a
/// periodic sequence of even length L:  K_ts = (2/L) cot(π (t − s)/L) for t − s odd, else 0.
///
///        ╭╮  ╭─╮         |  ╭─╮   ╭─╮   ╭─╮  |   ╭─╮  ╭╮        x̄ over L = 2n samples, n of them given
///     ──╯  ╰─╯   ╰╮   ╭─ |─╯   ╰─╯   ╰─╯   ╰─|─╯   ╰─╯  ╰──
///        before: n/2     |     frames: n     |  after: n − n/2
///
/// The continuation is linear prediction. The columns of a free motion are sums of the same few damped oscillations, and every such
/// sum obeys one recurrence x_t = −Σ a_i x_{t−iq}, whatever its amplitudes and phases. It is fitted to all columns together, from
/// G = S Sᵀ alone. Burg's reflection coefficients lie within the unit circle, so the continuation never grows.
#include "analysis/spectrum.h"
#include "base/need.h"
#include "maths/maths.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

// --- Gram-Schmidt on sequences over the frames, each made orthogonal twice, so that close poles keep their digits

static const double dependent = 1e-12; ///< a sequence with less than this share left is a combination of the others

void basis_create(struct basis *b, int frames, int capacity)
{
    *b = (struct basis){.frames = frames, .capacity = capacity};
    b->q = pool_take(&b->pool, (size_t)capacity * (size_t)frames, sizeof *b->q);
    b->lower = pool_take(&b->pool, (size_t)capacity * (size_t)capacity, sizeof *b->lower);
}

void basis_append(struct basis *b, const double *sequence)
{
    size_t n = (size_t)b->frames, row = (size_t)b->count;
    double *q = b->q + row * n, *lower = b->lower + row * (size_t)b->capacity;
    memcpy(q, sequence, n * sizeof *q);
    memset(lower, 0, (size_t)b->capacity * sizeof *lower);
    double whole = sqrt(maths_dot(q, q, b->frames));
    for (int pass = 0; pass < 2; pass++) {
        for (size_t k = 0; k < row; k++) {
            double along = maths_dot(q, b->q + k * n, b->frames);
            lower[k] += along;
            for (size_t t = 0; t < n; t++) q[t] -= along * b->q[k * n + t];
        }
    }
    double left = sqrt(maths_dot(q, q, b->frames));
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
        for (size_t t = 0; t < n; t++) gain += q[t] * maths_dot(q, gram + t * n, b->frames);
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

// --- the Hilbert transform and the components

/// Another coefficient needs this share of the power left to predict; less is the rounding of float data.
static const double least_power = 1e-9;

enum { TERMS = HILBERT_ORDER_MAX + 1 };

struct predictor hilbert_predictor(const double *gram, int frames)
{
    size_t n = (size_t)frames;
    struct predictor p = {.a = {1}};
    double lags[TERMS][TERMS] = {{0}}, neighbours = 0, power = 0, trace = 0;

    // The stride is an eighth of the mean period, from the pooled correlation of neighbouring frames:
    // cos ω = Σ ⟨x_t, x_{t−1}⟩ / Σ |x_t|². In much shorter steps every oscillation looks like a straight line, and Burg's damping
    // is wrong.
    int longest = frames / 8 > 1 ? frames / 8 : 1;
    for (size_t t = 1; t < n; t++) {
        neighbours += gram[t * n + t - 1];
        power += (gram[t * n + t] + gram[(t - 1) * n + t - 1]) / 2;
    }
    double omega = acos(fmax(fmin(neighbours / power, 1), -1)); // radians a frame
    double stride = M_PI / (4 * omega);
    p.stride = stride < 1 ? 1 : stride < longest ? (int)stride : longest;

    for (size_t t = 0; t < n; t++) trace += gram[t * n + t];
    lags[0][0] = trace;
    for (int m = 1; m <= HILBERT_ORDER_MAX && m * p.stride <= 2 * frames / 3; m++) {
        double before[TERMS];

        // C_ij = Σ_{t=mq}^{n−1} ⟨x_{t−iq}, x_{t−jq}⟩ for i, j ≤ m from order m − 1; q is the stride.
        const int q = p.stride;
        for (int i = 0; i < m; i++) {
            for (int j = 0; j < m; j++) {
                for (int t = (m - 1) * q; t < m * q; t++)
                    lags[i][j] -= gram[(size_t)(t - i * q) * n + (size_t)(t - j * q)];
            }
        }
        for (int j = 0; j <= m; j++) {
            double sum = 0;
            for (int t = m * q; t < frames; t++) sum += gram[(size_t)(t - m * q) * n + (size_t)(t - j * q)];
            lags[m][j] = lags[j][m] = sum;
        }

        // Burg's step, with f_t = Σ a_i x_{t−iq} and b_{t−q} = Σ a_i x_{t−(m−i)q}: k = −2 Σ ⟨f_t, b_{t−q}⟩ / Σ (|f_t|² + |b_{t−q}|²)
        double product = 0, left = 0;
        for (int i = 0; i < m; i++) {
            for (int j = 0; j < m; j++) {
                product += p.a[i] * p.a[j] * lags[i][m - j];
                left += p.a[i] * p.a[j] * (lags[i][j] + lags[m - i][m - j]);
            }
        }
        if (!(left > 2 * least_power * trace)) break;
        const double k = -2 * product / left;
        memcpy(before, p.a, sizeof before);
        for (int i = 1; i <= m; i++) p.a[i] = before[i] + k * before[m - i]; // Levinson
        p.order = m;
    }
    return p;
}

/// Adds −Σ a_i x_{at − i·step} to the row of a continued sample. Each x is a row of `rows` or, for a given sample, a unit row.
static void predict(const struct predictor *p, int frames, int at, int step, double *rows)
{
    size_t n = (size_t)frames;
    int before = frames / 2;
    double *row = rows + (size_t)(at < 0 ? at + before : at - frames + before) * n;
    for (int i = 1; i <= p->order; i++) {
        int from = at - i * step;
        if (from >= 0 && from < frames) {
            row[from] -= p->a[i];
            continue;
        }
        const double *other = rows + (size_t)(from < 0 ? from + before : from - frames + before) * n;
        for (size_t t = 0; t < n; t++) row[t] -= p->a[i] * other[t];
    }
}

/// Half a cosine from 1 beside the given samples to 0 at the end: sample i of `count`, counted from the inside.
static double fade(int i, int count) { return 0.5 + 0.5 * cos(M_PI * (i + 0.5) / count); }

static double kernel(int difference, int length)
{
    return difference % 2 == 0 ? 0 : 2.0 / length / tan(M_PI * difference / length);
}

void hilbert_transform(const struct lapack *lapack, const struct predictor *predictor, int frames, double *transform)
{
    size_t n = (size_t)frames;
    int before = frames / 2, after = frames - before, length = 2 * frames;
    double *rows = need(2 * n * n, sizeof *rows), *outside = rows + n * n; // K's columns of the continuation

    // The continuation in terms of the given samples: rows for the samples before, in order, then for those after.
    memset(rows, 0, n * n * sizeof *rows);
    for (int i = 0; i < before; i++) predict(predictor, frames, -1 - i, -predictor->stride, rows);
    for (int i = 0; i < after; i++) predict(predictor, frames, frames + i, predictor->stride, rows);
    for (int r = 0; r < frames; r++) {
        double weight = r < before ? fade(before - 1 - r, before) : fade(r - before, after);
        for (size_t t = 0; t < n; t++) rows[(size_t)r * n + t] *= weight;
    }

    for (int t = 0; t < frames; t++) {
        for (int s = 0; s < frames; s++) {
            transform[(size_t)t * n + (size_t)s] = kernel(t - s, length);
            outside[(size_t)t * n + (size_t)s] = kernel(t - (s < before ? s - before : s - before + frames), length);
        }
    }
    lapack->dgemm(LAPACK_ROWS_FIRST, BLAS_PLAIN, BLAS_PLAIN, frames, frames, frames, 1, outside, frames, rows, frames,
                  1, transform, frames);
    free(rows);
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

bool spectrum_create(struct spectrum *s, const struct lapack *lapack, const double *gram, int frames)
{
    size_t n = (size_t)frames;
    struct predictor predictor = hilbert_predictor(gram, frames);
    *s = (struct spectrum){.frames = frames};
    s->transform = pool_take(&s->pool, n * n, sizeof *s->transform);
    s->vectors = pool_take(&s->pool, n * n, sizeof *s->vectors);
    s->values = pool_take(&s->pool, n, sizeof *s->values);
    hilbert_transform(lapack, &predictor, frames, s->transform);

    // S̃ S̃ᴴ = (1 + jH) G (1 − jHᵀ) = G + H G Hᵀ + j (H G − (H G)ᵀ)
    double *hg = need(2 * n * n, sizeof *hg), *hgh = hg + n * n;
    memcpy(hgh, gram, n * n * sizeof *hgh);
    lapack->dgemm(LAPACK_ROWS_FIRST, BLAS_PLAIN, BLAS_PLAIN, frames, frames, frames, 1, s->transform, frames, gram,
                  frames, 0, hg, frames);
    lapack->dgemm(LAPACK_ROWS_FIRST, BLAS_PLAIN, BLAS_TRANSPOSED, frames, frames, frames, 1, hg, frames, s->transform,
                  frames, 1, hgh, frames);
    for (size_t i = 0; i < n; i++) {
        for (size_t j = 0; j < n; j++) // column-major, as LAPACK needs it, and the opposite: it sorts ascending
            s->vectors[j * n + i] = -hgh[i * n + j] - I * (hg[i * n + j] - hg[j * n + i]);
    }
    free(hg);
    if (lapack->zheevd(LAPACK_COLUMNS_FIRST, 'V', 'L', frames, s->vectors, frames, s->values) != 0) {
        pool_free(&s->pool);
        return false;
    }

    for (size_t i = 0; i < n; i++) {
        s->values[i] = fmax(-s->values[i], 0); // below 0 by rounding
        s->total += s->values[i];
    }
    return true;
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

/// The time series R_k and the shapes Ñ_k of given poles z_k minimise
///
///     Σ_t |s_t − Σ_k Re(R_k,t Ñ_k)|²  +  Σ_k μ_k Σ_t |R_k,t+1 − z_k R_k,t|²        μ_k = |Ñ_k|² / 2 (β |ln z_k|)²
///
/// The first sum is the part of the motion s_t left unexplained, the second the push, as in a wiggly spline but with one pole each.
/// Undisturbed motion needs no push, so R is z^t and the fit is one of exponentials. A force changes R at rates up to about β of the
/// pole's frequency; faster changes belong to other poles or are noise. While something drives the motion, μ is 3 % of that.
///
/// Finding R for given Ñ and Ñ for given R are both linear least squares, and alternate. Ñ = W S with weights W of the frames, so
/// they need nothing of the motion but G = S Sᵀ: Ñᵢ·s_t = (W G)_it and Ñᵢ·Ñⱼ = (W G Wᵀ)_ij. The system for R is block tridiagonal
/// over the frames, with 2 × 2 blocks per pole.
#include "analysis/basis.h"
#include "analysis/poles.h"
#include "base/need.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double freedom = 0.4;  ///< β
static const double driven = 0.03;  ///< of μ, while something drives the motion: R changes six times as fast
static const double settled = 1e-4; ///< stop when the unexplained power changes by less than this share of the total
static const double least_push = 1e-12; ///< keeps the equations definite if a shape is zero

enum { TURNS_MAX = 30, ROWS_MAX = 2 * TIME_SERIES_MAX, BLOCK = ROWS_MAX * ROWS_MAX };

struct fit {
    struct time_series *series;
    const struct lapack *lapack;
    const double *gram;
    struct basis basis;
    double *pull;         ///< W G, 2 count × frames
    double metric[BLOCK]; ///< W G Wᵀ
    int first;            ///< the first undriven frame
    double *band;         ///< the system of all frames, 2 d × d n; then its right side
};

/// The share of μ that counts between frame t and the next.
static double firmness(const struct fit *f, int t) { return t < f->first ? driven : 1; }

/// μ_k of every pole, and z_k limited so that it does not grow.
static void weigh_pushes(const struct fit *f, double *push, double complex *z)
{
    int d = 2 * f->series->count;
    double trace = 0;
    for (int i = 0; i < d; i++) trace += f->metric[i * d + i];
    for (int k = 0; k < f->series->count; k++) {
        double shape = f->metric[2 * k * d + 2 * k] + f->metric[(2 * k + 1) * d + 2 * k + 1];
        z[k] = f->series->pole[k] / fmax(1, cabs(f->series->pole[k]));
        push[k] = (shape + least_push * trace) / 2 / pow(freedom * cabs(clog(z[k])), 2);
    }
}

/// Adds to an entry of the lower band, column after column; blocks of two neighbouring frames fit in it.
static void put(double *band, int d, int row, int column, double value)
{
    band[column * 2 * d + row - column] += value;
}

/// The push on a pole between frame t and the next: μ |R_t+1 − z R_t|² in a = Re R, b = −Im R, as
/// Re(conj(R_t+1) z R_t) = (a a' + b b') Re z + (a' b − b' a) Im z.
static void put_push(double *band, int d, int t, int k, double push, double complex z)
{
    const int a = t * d + 2 * k, next = a + d;
    for (int i = 0; i < 2; i++) {
        put(band, d, a + i, a + i, push * creal(z * conj(z)));
        put(band, d, next + i, next + i, push);
        put(band, d, next + i, a + i, -push * creal(z));
    }
    put(band, d, next, a + 1, -push * cimag(z));
    put(band, d, next + 1, a, push * cimag(z));
}

/// Finds R for given Ñ.
static void solve_series(struct fit *f)
{
    const int n = f->series->frames, d = 2 * f->series->count;
    double push[TIME_SERIES_MAX], *band = f->band, *x = band + 2 * d * d * n;
    double complex z[TIME_SERIES_MAX];
    weigh_pushes(f, push, z);
    memset(band, 0, 2 * (size_t)(d * d) * (size_t)n * sizeof *band);
    for (int t = 0; t < n; t++) {
        for (int i = 0; i < d; i++) {
            for (int k = 0; k <= i; k++) put(band, d, t * d + i, t * d + k, f->metric[i * d + k]);
            x[t * d + i] = f->pull[i * n + t];
        }
        for (int k = 0; k < d / 2 && t + 1 < n; k++) put_push(band, d, t, k, firmness(f, t) * push[k], z[k]);
    }
    if (f->lapack->dpbsv(LAPACK_COLUMNS_FIRST, 'L', n * d, 2 * d - 1, 1, band, 2 * d, x, n * d) != 0) return;
    for (int t = 0; t < n; t++) {
        for (int i = 0; i < d; i++) f->series->rows[i * n + t] = x[t * d + i];
    }
}

/// Scales each R to a largest modulus of 1, so that the push's weight is the same in every iteration.
static void scale_series(struct time_series *c)
{
    for (int k = 0; k < c->count; k++) {
        double *re = c->rows + 2 * k * c->frames, *im = re + c->frames, largest = 0;
        for (int t = 0; t < c->frames; t++) largest = fmax(largest, hypot(re[t], im[t]));
        for (int t = 0; largest > 0 && t < c->frames; t++) {
            re[t] /= largest;
            im[t] /= largest;
        }
    }
}

/// Finds Ñ for given R; returns how much both explain of Σ |s_t|².
static double solve_shapes(struct fit *f)
{
    int n = f->series->frames, d = 2 * f->series->count;
    double explained = 0;
    scale_series(f->series);
    f->basis.count = 0;
    for (int i = 0; i < d; i++) basis_append(&f->basis, f->series->rows + i * n);
    basis_weights(&f->basis, f->series->weights);
    f->lapack->dgemm(LAPACK_ROWS_FIRST, BLAS_PLAIN, BLAS_PLAIN, d, n, n, 1, f->series->weights, n, f->gram, n, 0,
                     f->pull, n);
    f->lapack->dgemm(LAPACK_ROWS_FIRST, BLAS_PLAIN, BLAS_TRANSPOSED, d, d, n, 1, f->pull, n, f->series->weights, n, 0,
                     f->metric, d);
    for (int i = 0; i < d * n; i++) explained += f->series->rows[i] * f->pull[i];
    return explained;
}

static void measure_parts(const struct fit *f)
{
    struct time_series *c = f->series;
    for (int k = 0; k < c->count; k++) {
        const double *re = c->rows + 2 * k * c->frames, *im = re + c->frames;
        const double *m = f->metric + (size_t)(2 * k) * (size_t)(2 * c->count + 1), *below = m + 2 * c->count;
        for (int t = 0; t < c->frames; t++)
            c->part[k] += re[t] * re[t] * m[0] + 2 * re[t] * im[t] * m[1] + im[t] * im[t] * below[1];
    }
}

static void take_turns(struct fit *f)
{
    int n = f->series->frames;
    double power = 0, before, explained = solve_shapes(f);
    for (int t = 0; t < n; t++) power += f->gram[(size_t)t * (size_t)(n + 1)];
    for (int turn = 0; turn < TURNS_MAX; turn++) {
        before = explained;
        solve_series(f);
        explained = solve_shapes(f);
        if (fabs(explained - before) < settled * power) break;
    }
}

void time_series_create(struct time_series *c, const struct lapack *lapack, const double *gram, int frames, int first,
                        const double complex *poles, int count)
{
    size_t n = (size_t)frames, d = 2 * (size_t)count;
    struct fit fit = {.series = c, .lapack = lapack, .gram = gram, .first = first};
    *c = (struct time_series){.frames = frames, .count = count};
    memcpy(c->pole, poles, (size_t)count * sizeof *poles);
    c->rows = need(d * n, sizeof *c->rows);
    c->weights = need(d * n, sizeof *c->weights);
    fit.pull = need(d * n, sizeof *fit.pull);
    fit.band = need((2 * d + 1) * d * n, sizeof *fit.band);
    basis_create(&fit.basis, frames, (int)d);
    for (int k = 0; k < count; k++) {
        double *re = c->rows + 2 * (size_t)k * n, *im = re + n;
        exponentials_fill(poles[k], frames, re);
        for (int t = 0; t < first; t++) re[t] = im[t] = 0;
    }
    take_turns(&fit);
    measure_parts(&fit);
    basis_free(&fit.basis);
    free(fit.pull);
    free(fit.band);
}

void time_series_free(struct time_series *c)
{
    free(c->rows);
    free(c->weights);
    *c = (struct time_series){0};
}

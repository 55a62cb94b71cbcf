/// Finds poles, chooses those that matter, and fits their time series.
#include "analysis/spectrum.h"
#include "base/need.h"
#include "maths/maths.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

// --- finding poles
//
// ESPRIT. Windows of L = n/2 frames start at each of J = n − L + 1 frames. In a sum of oscillations every window of every column
// lies in the span of the sequences z_k^i, i < L. That span without its first frame and without its last differ by Z = diag(z_k):
//
//     C = Σ_j  G[j … j+L−1, j … j+L−1]        all windows of all columns, L × L: running sums along G's diagonals
//     C = U Λ Uᵀ,  U_r the r largest           U_r = V T,  V_ik = z_k^i
//     Φ = U_top⁺ U_bottom = T⁻¹ Z T            so the eigenvalues of Φ are the poles
//
// U_topᵀ U_top = 1 − u uᵀ with u the last row of U_r, so (Sherman, Morrison) Φ = A + u (uᵀA)/(1 − uᵀu), A = U_topᵀ U_bottom.
// A of a smaller order is a corner of A. White noise adds a multiple of 1 to C and does not change U.
//
// A constant and a drift t = j + i would be a double pole at 1, which pulls slow poles towards itself. So the parts that are
// constant or linear in j are removed from every row of windows first.
//
// Large displacements or a force make a motion need more poles than it has. Spurious poles move as the order grows; those of the
// body stay, to at least three digits.

/// Smaller eigenvalues of C, as a share of the largest, are rounding of float data or too weak to matter.
static const double least_share = 1e-6;
/// Noise gives eigenvalues of about equal size; those this many times above their median are motion.
static const double above_noise = 1.6;
/// Of all power: what is left of a constant and a linear motion is the rounding of float data.
static const double least_swing = 1e-9;
static const double growth_most = 0.02; ///< negative damping ratio that noise or a growing force may cause

enum { ORDER_STEP = 2, ORDER_STEPS = 3, ORDER_LARGEST = SUBSPACE_ORDER_MAX + ORDER_STEP * ORDER_STEPS };

/// A constant and a linear sequence over the windows' starts j, both of length 1.
static double trend(int windows, bool linear, int j)
{
    double middle = (windows - 1) / 2.0;
    return linear ? (j - middle) / sqrt(windows * (windows * (double)windows - 1) / 12) : 1 / sqrt(windows);
}

/// Entry (i, k) of U_r. LAPACK stores columns first, eigenvalues ascending.
static double entry(const double *vectors, int length, int i, int k)
{
    return vectors[(size_t)(length - 1 - k) * (size_t)length + (size_t)i];
}

/// All eigenvalues of Φ of one order; returns 0 or LAPACK's error.
static int eigenvalues(const struct lapack *lapack, const double *vectors, int length, int order,
                       double a[ORDER_LARGEST][ORDER_LARGEST], double complex *z)
{
    double phi[ORDER_LARGEST * ORDER_LARGEST], re[ORDER_LARGEST], im[ORDER_LARGEST], last[ORDER_LARGEST], left = 1;
    for (int k = 0; k < order; k++) {
        last[k] = entry(vectors, length, length - 1, k);
        left -= last[k] * last[k];
    }
    left = fmax(left, 1e-12);
    for (int l = 0; l < order; l++) {
        double along = 0;
        for (int k = 0; k < order; k++) along += last[k] * a[k][l];
        for (int k = 0; k < order; k++) phi[l * order + k] = a[k][l] + last[k] * along / left;
    }
    int status = lapack->dgeev(LAPACK_COLUMNS_FIRST, 'N', 'N', order, phi, order, re, im, NULL, 1, NULL, 1);
    for (int k = 0; status == 0 && k < order; k++) z[k] = re[k] + I * im[k];
    return status;
}

/// The poles of the motion's order, and how far each wanders at larger orders.
static int esprit(const struct lapack *lapack, const double *vectors, const double *values, int length,
                  struct pole *poles)
{
    double a[ORDER_LARGEST][ORDER_LARGEST];
    double complex z[ORDER_LARGEST];

    // The eigenvalues (ascending) that are motion, not noise or rounding.
    const double least = fmax(above_noise * fmax(values[length / 2], 0), least_share * values[length - 1]);
    int order = 0, count = 0;
    while (order < length - 1 && order < SUBSPACE_ORDER_MAX && values[length - 1 - order] > least) order++;
    if (order < 2) order = 2;

    int most = order + ORDER_STEP * ORDER_STEPS < length ? order + ORDER_STEP * ORDER_STEPS : length - 1;
    for (int k = 0; k < most; k++) { // A = U_topᵀ U_bottom
        for (int l = 0; l < most; l++) {
            a[k][l] = 0;
            for (int i = 0; i + 1 < length; i++)
                a[k][l] += entry(vectors, length, i, k) * entry(vectors, length, i + 1, l);
        }
    }
    if (eigenvalues(lapack, vectors, length, order, a, z) != 0) return -1;
    for (int k = 0; k < order && count < SUBSPACE_POLES_MAX; k++) {
        const double complex s = clog(z[k]);
        const bool swings = cabs(z[k]) > 1e-6 && cimag(s) > 1e-6 && cimag(s) < M_PI - 1e-6;
        if (swings && creal(s) < growth_most * cabs(s)) poles[count++] = (struct pole){.z = z[k]};
    }
    for (int larger = order + ORDER_STEP; larger <= most; larger += ORDER_STEP) {
        if (eigenvalues(lapack, vectors, length, larger, a, z) != 0) return -1;
        for (int k = 0; k < count; k++) {
            const double complex s = clog(poles[k].z);
            double nearest = HUGE_VAL;
            for (int l = 0; l < larger; l++) {
                if (cabs(z[l]) > 0) nearest = fmin(nearest, cabs(clog(z[l]) - s) / cabs(s));
            }
            poles[k].wander = fmax(poles[k].wander, nearest);
        }
    }
    qsort(poles, (size_t)count, sizeof *poles, maths_compare);
    return count;
}

int subspace_poles(const struct lapack *lapack, const double *gram, int frames, struct pole *poles)
{
    int length = frames / 2, count = -1;
    size_t n = (size_t)frames, size = n / 2 * (n / 2);
    double *c = need(size + n * n + n, sizeof *c);
    double *room = c + size, *values = room + n * n;
    double whole = 0;
    const int windows = frames - length + 1;
    for (int k = 0; k < length; k++) { // C_ij over all windows, both halves
        double sum = 0;
        for (int j = 0; j < windows; j++) sum += gram[j * frames + j + k];
        for (int i = 0; i + k < length; i++) {
            c[i * length + i + k] = c[(i + k) * length + i] = sum;
            if (i + k + 1 < length) sum += gram[(i + windows) * frames + i + k + windows] - gram[i * frames + i + k];
        }
    }
    for (int i = 0; i < length; i++) whole += c[i * length + i];

    // Removes what is constant, then what is linear in the window's start j: C −= B G Bᵀ, where row i of B is the trend over j, delayed
    // by i frames.
    double *b = room, *bg = room + (size_t)length * n;
    for (int linear = 0; linear < 2; linear++) {
        memset(b, 0, (size_t)length * n * sizeof *b);
        for (int i = 0; i < length; i++) {
            for (int j = 0; j < windows; j++) b[(size_t)i * n + (size_t)(i + j)] = trend(windows, linear, j);
        }
        lapack->dgemm(LAPACK_ROWS_FIRST, BLAS_PLAIN, BLAS_PLAIN, length, frames, frames, 1, b, frames, gram, frames,
                      0, bg, frames);
        lapack->dgemm(LAPACK_ROWS_FIRST, BLAS_PLAIN, BLAS_TRANSPOSED, length, length, frames, -1, bg, frames, b,
                      frames, 1, c, length);
    }
    memcpy(room, c, size * sizeof *c);
    bool good = lapack->dsyevd(LAPACK_COLUMNS_FIRST, 'N', 'L', length, room, length, values) == 0;
    if (good && values[length - 1] <= least_swing * whole) {
        count = 0;
    } else if (good) {
        // Restores what that removed of white noise of this power per window and frame, so that it is white again.
        const double noise = fmax(values[length / 2], 0);
        for (int d = 0; d < length; d++) {
            double removed = 0;
            for (int j = 0; j + d < windows; j++) {
                removed += trend(windows, false, j) * trend(windows, false, j + d);
                removed += trend(windows, true, j) * trend(windows, true, j + d);
            }
            for (int i = 0; i + d < length; i++) {
                c[i * length + i + d] += noise / windows * removed;
                if (d > 0) c[(i + d) * length + i] += noise / windows * removed;
            }
        }
        if (lapack->dsyevd(LAPACK_COLUMNS_FIRST, 'V', 'L', length, c, length, values) == 0)
            count = esprit(lapack, c, values, length, poles);
    }
    free(c);
    return count;
}

// --- choosing poles: forward selection on G = S Sᵀ alone

enum { MIDDLE = 1 }; ///< sequences at the start of the basis that no pole has

static const double steady = 0.05;        ///< how far a steady pole may wander
static const double wanderer_gain = 0.01; ///< share of the motion's power that a wandering pole must explain
static const double part_most = 4;        ///< times the motion's power: a larger part only cancels another

/// Re z^t and −Im z^t over the frames, largest |z^t| = 1: two rows of `frames` numbers each.
static void exponentials_fill(double complex z, int frames, double *rows)
{
    double complex s = clog(z);
    int largest = creal(s) > 0 ? frames - 1 : 0;
    for (int t = 0; t < frames; t++) {
        double complex value = cexp(s * (t - largest));
        rows[t] = creal(value);
        rows[frames + t] = -cimag(value);
    }
}

static void append_pole(struct basis *basis, double complex z, double *room)
{
    exponentials_fill(z, basis->frames, room);
    basis_append(basis, room);
    basis_append(basis, room + basis->frames);
}

int exponentials_choose(struct pole *poles, int count, int most, double least, const double *gram,
                        struct basis *basis)
{
    const size_t n = (size_t)basis->frames;
    double *room = need((size_t)basis->capacity * n, sizeof *room);
    double power = -basis_gain(basis, MIDDLE, gram);
    int steady_count = 0, chosen = 0;
    for (size_t t = 0; t < n; t++) power += gram[t * n + t];
    while (steady_count < count && poles[steady_count].wander < steady) steady_count++;
    for (int wandering = 0; wandering < 2; wandering++) {
        int end = steady_count; // of the candidates, which begin at `chosen`
        if (wandering) {
            const int left_out = steady_count - chosen;
            for (int k = chosen; k + left_out < count; k++) poles[k] = poles[k + left_out];
            end = count - left_out;
            least = wanderer_gain;
        }
        while (chosen < end && chosen < most) {
            int best = chosen; // the one that explains most beside those of the basis
            double gain = -1;
            for (int k = chosen; k < end; k++) {
                append_pole(basis, poles[k].z, room);
                double more = basis_gain(basis, 2, gram);
                basis->count -= 2;
                if (more > gain) {
                    best = k;
                    gain = more;
                }
            }
            const struct pole pole = poles[best];
            if ((!wandering || chosen > 0) && gain < least * power) break;
            append_pole(basis, pole.z, room);

            // The largest power of one pole's part on its own, Σ (Bᵀ W S)² over its two sequences: tr(B Bᵀ W G Wᵀ) with B Bᵀ = L Lᵀ.
            double largest = 0;
            if (chosen > 0) basis_weights(basis, room);
            for (int k = MIDDLE; chosen > 0 && k < basis->count; k += 2) {
                double part = 0;
                for (int i = 0; i < 4; i++) {
                    const double *a = room + (size_t)(k + i / 2) * n, *b = room + (size_t)(k + i % 2) * n;
                    const double *above = basis->lower + (k + i / 2) * basis->capacity,
                                 *below = basis->lower + (k + i % 2) * basis->capacity;
                    double share = 0, product = 0;
                    for (size_t t = 0; t < n; t++) share += a[t] * maths_dot(gram + t * n, b, basis->frames);
                    for (int j = 0; j < basis->capacity; j++) product += above[j] * below[j];
                    part += share * product;
                }
                largest = fmax(largest, part);
            }
            if (largest > part_most * power) {
                basis->count -= 2;
                poles[best] = poles[--end];
                continue;
            }
            poles[best] = poles[chosen];
            poles[chosen++] = pole;
        }
    }
    free(room);
    return chosen;
}

// --- time series
//
// The time series R_k and the shapes Ñ_k of given poles z_k minimise
//
//     Σ_t |s_t − Σ_k Re(R_k,t Ñ_k)|²  +  Σ_k μ_k Σ_t |R_k,t+1 − z_k R_k,t|²        μ_k = |Ñ_k|² / 2 (β |ln z_k|)²
//
// The first sum is the part of the motion s_t left unexplained, the second the push, as in a wiggly spline but with one pole each.
// Undisturbed motion needs no push, so R is z^t and the fit is one of exponentials. A force changes R at rates up to about β of the
// pole's frequency; faster changes belong to other poles or are noise. While something drives the motion, μ is 3 % of that.
//
// Finding R for given Ñ and Ñ for given R are both linear least squares, and alternate. Ñ = W S with weights W of the frames, so
// they need nothing of the motion but G = S Sᵀ: Ñᵢ·s_t = (W G)_it and Ñᵢ·Ñⱼ = (W G Wᵀ)_ij. The system for R is block tridiagonal
// over the frames, with 2 × 2 blocks per pole.

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

/// Adds to an entry of the lower band, column after column; blocks of two neighbouring frames fit in it.
static void put_in_band(double *band, int d, int row, int column, double value)
{
    band[column * 2 * d + row - column] += value;
}

/// Finds R for given Ñ.
static void solve_series(struct fit *f)
{
    const int n = f->series->frames, d = 2 * f->series->count;
    double push[TIME_SERIES_MAX], *band = f->band, *x = band + 2 * d * d * n;
    double complex z[TIME_SERIES_MAX];
    double trace = 0; // μ_k of every pole, and z_k limited so that it does not grow
    for (int i = 0; i < d; i++) trace += f->metric[i * d + i];
    for (int k = 0; k < d / 2; k++) {
        double shape = f->metric[2 * k * d + 2 * k] + f->metric[(2 * k + 1) * d + 2 * k + 1];
        z[k] = f->series->pole[k] / fmax(1, cabs(f->series->pole[k]));
        push[k] = (shape + least_push * trace) / 2 / pow(freedom * cabs(clog(z[k])), 2);
    }
    memset(band, 0, 2 * (size_t)(d * d) * (size_t)n * sizeof *band);
    for (int t = 0; t < n; t++) {
        for (int i = 0; i < d; i++) {
            for (int k = 0; k <= i; k++) put_in_band(band, d, t * d + i, t * d + k, f->metric[i * d + k]);
            x[t * d + i] = f->pull[i * n + t];
        }
        const double share = t < f->first ? driven : 1; // of μ that counts between frame t and the next
        for (int k = 0; k < d / 2 && t + 1 < n; k++) {
            // The push between the frames: μ |R_t+1 − z R_t|² in a = Re R, b = −Im R, as
            // Re(conj(R_t+1) z R_t) = (a a' + b b') Re z + (a' b − b' a) Im z.
            const int at = t * d + 2 * k, next = at + d;
            const double mu = share * push[k];
            for (int i = 0; i < 2; i++) {
                put_in_band(band, d, at + i, at + i, mu * creal(z[k] * conj(z[k])));
                put_in_band(band, d, next + i, next + i, mu);
                put_in_band(band, d, next + i, at + i, -mu * creal(z[k]));
            }
            put_in_band(band, d, next, at + 1, -mu * cimag(z[k]));
            put_in_band(band, d, next + 1, at, mu * cimag(z[k]));
        }
    }
    if (f->lapack->dpbsv(LAPACK_COLUMNS_FIRST, 'L', n * d, 2 * d - 1, 1, band, 2 * d, x, n * d) != 0) return;
    for (int t = 0; t < n; t++) {
        for (int i = 0; i < d; i++) f->series->rows[i * n + t] = x[t * d + i];
    }
}

/// Finds Ñ for given R; returns how much both explain of Σ |s_t|².
static double solve_shapes(struct fit *f)
{
    int n = f->series->frames, d = 2 * f->series->count;
    double explained = 0;
    // Each R gets a largest modulus of 1, so that the push's weight is the same in every iteration.
    for (int k = 0; k < d / 2; k++) {
        double *re = f->series->rows + 2 * k * n, *im = re + n, largest = 0;
        for (int t = 0; t < n; t++) largest = fmax(largest, hypot(re[t], im[t]));
        for (int t = 0; largest > 0 && t < n; t++) {
            re[t] /= largest;
            im[t] /= largest;
        }
    }
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

struct time_series time_series_create(const struct lapack *lapack, const double *gram, int frames, int first,
                                      const double complex *poles, int count)
{
    size_t n = (size_t)frames, d = 2 * (size_t)count;
    struct time_series c = {.frames = frames, .count = count};
    struct pool work = {0};
    struct fit fit = {.series = &c, .lapack = lapack, .gram = gram, .first = first};
    memcpy(c.pole, poles, (size_t)count * sizeof *poles);
    c.rows = pool_take(&c.pool, d * n, sizeof *c.rows);
    c.weights = pool_take(&c.pool, d * n, sizeof *c.weights);
    fit.pull = pool_take(&work, d * n, sizeof *fit.pull);
    fit.band = pool_take(&work, (2 * d + 1) * d * n, sizeof *fit.band);
    basis_create(&fit.basis, frames, (int)d);
    for (int k = 0; k < count; k++) {
        double *re = c.rows + 2 * (size_t)k * n, *im = re + n;
        exponentials_fill(poles[k], frames, re);
        for (int t = 0; t < first; t++) re[t] = im[t] = 0;
    }

    double power = 0, before, explained = solve_shapes(&fit);
    for (size_t i = 0; i < n; i++) power += gram[i * (n + 1)];
    for (int turn = 0; turn < TURNS_MAX; turn++) {
        before = explained;
        solve_series(&fit);
        explained = solve_shapes(&fit);
        if (fabs(explained - before) < settled * power) break;
    }
    for (size_t k = 0; k < (size_t)count; k++) {
        const double *re = c.rows + 2 * k * n, *im = re + n, *m = fit.metric + 2 * k * (d + 1), *below = m + d;
        for (size_t i = 0; i < n; i++)
            c.part[k] += re[i] * re[i] * m[0] + 2 * re[i] * im[i] * m[1] + im[i] * im[i] * below[1];
    }
    pool_free(&fit.basis.pool);
    pool_free(&work);
    return c;
}

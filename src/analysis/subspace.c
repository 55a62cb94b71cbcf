/// ESPRIT. Windows of L = n/2 frames start at each of J = n − L + 1 frames. In a sum of oscillations every window of every column
/// lies in the span of the sequences z_k^i, i < L. That span without its first frame and without its last differ by Z = diag(z_k):
///
///     C = Σ_j  G[j … j+L−1, j … j+L−1]        all windows of all columns, L × L: running sums along G's diagonals
///     C = U Λ Uᵀ,  U_r the r largest           U_r = V T,  V_ik = z_k^i
///     Φ = U_top⁺ U_bottom = T⁻¹ Z T            so the eigenvalues of Φ are the poles
///
/// U_topᵀ U_top = 1 − u uᵀ with u the last row of U_r, so (Sherman, Morrison) Φ = A + u (uᵀA)/(1 − uᵀu), A = U_topᵀ U_bottom.
/// A of a smaller order is a corner of A. White noise adds a multiple of 1 to C and does not change U.
///
/// A constant and a drift t = j + i would be a double pole at 1, which pulls slow poles towards itself. So the parts that are
/// constant or linear in j are removed from every row of windows first.
///
/// Large displacements or a force make a motion need more poles than it has. Spurious poles move as the order grows; those of the
/// body stay, to at least three digits.
#include "analysis/poles.h"
#include "base/need.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/// Smaller eigenvalues of C, as a share of the largest, are rounding of float data or too weak to matter.
static const double least_share = 1e-6;
/// Noise gives eigenvalues of about equal size; those this many times above their median are motion.
static const double above_noise = 1.6;
/// Of all power: what is left of a constant and a linear motion is the rounding of float data.
static const double least_swing = 1e-9;
static const double growth_most = 0.02; ///< negative damping ratio that noise or a growing force may cause

enum { ORDER_STEP = 2, ORDER_STEPS = 3, ORDER_LARGEST = SUBSPACE_ORDER_MAX + ORDER_STEP * ORDER_STEPS };

/// Sums C_ij over all windows; fills both halves.
static void sum_windows(const double *gram, size_t n, size_t length, double *c)
{
    size_t windows = n - length + 1;
    for (size_t k = 0; k < length; k++) {
        double sum = 0;
        for (size_t j = 0; j < windows; j++) sum += gram[j * n + j + k];
        for (size_t i = 0; i + k < length; i++) {
            c[i * length + i + k] = c[(i + k) * length + i] = sum;
            if (i + k + 1 < length) sum += gram[(i + windows) * n + i + k + windows] - gram[i * n + i + k];
        }
    }
}

/// A constant and a linear sequence over the windows' starts j, both of length 1.
static double trend(int windows, bool linear, int j)
{
    double middle = (windows - 1) / 2.0;
    return linear ? (j - middle) / sqrt(windows * (windows * (double)windows - 1) / 12) : 1 / sqrt(windows);
}

/// Removes what is constant or linear in the window's start j: C −= B G Bᵀ, where row i of B is the trend over j, delayed by i
/// frames. `room` holds 2 L n numbers.
static void project(const struct lapack *lapack, const double *gram, int n, int length, bool linear, double *room,
                    double *c)
{
    int windows = n - length + 1;
    double *b = room, *bg = room + (size_t)length * (size_t)n;
    memset(b, 0, (size_t)length * (size_t)n * sizeof *b);
    for (int i = 0; i < length; i++) {
        for (int j = 0; j < windows; j++) b[(size_t)i * (size_t)n + (size_t)(i + j)] = trend(windows, linear, j);
    }
    lapack->dgemm(LAPACK_ROWS_FIRST, BLAS_PLAIN, BLAS_PLAIN, length, n, n, 1, b, n, gram, n, 0, bg, n);
    lapack->dgemm(LAPACK_ROWS_FIRST, BLAS_PLAIN, BLAS_TRANSPOSED, length, length, n, -1, bg, n, b, n, 1, c, length);
}

/// Restores what project() removed of white noise with a power of `noise` per window and frame, so that it is white again.
static void whiten(double noise, int windows, int length, double *c)
{
    for (int d = 0; d < length; d++) {
        double lost = 0;
        for (int j = 0; j + d < windows; j++) {
            lost += trend(windows, false, j) * trend(windows, false, j + d);
            lost += trend(windows, true, j) * trend(windows, true, j + d);
        }
        for (int i = 0; i + d < length; i++) {
            c[i * length + i + d] += noise / windows * lost;
            if (d > 0) c[(i + d) * length + i] += noise / windows * lost;
        }
    }
}

/// How many eigenvalues (ascending) are motion, not noise or rounding.
static int find_order(const double *values, int length)
{
    double least = fmax(above_noise * fmax(values[length / 2], 0), least_share * values[length - 1]);
    int order = 0;
    while (order < length - 1 && order < SUBSPACE_ORDER_MAX && values[length - 1 - order] > least) order++;
    return order < 2 ? 2 : order;
}

/// Entry (i, k) of U_r. LAPACK stores columns first, eigenvalues ascending.
static double entry(const double *vectors, int length, int i, int k)
{
    return vectors[(size_t)(length - 1 - k) * (size_t)length + (size_t)i];
}

/// A = U_topᵀ U_bottom of the order `most`.
static void shift_products(const double *vectors, int length, int most, double a[ORDER_LARGEST][ORDER_LARGEST])
{
    for (int k = 0; k < most; k++) {
        for (int l = 0; l < most; l++) {
            a[k][l] = 0;
            for (int i = 0; i + 1 < length; i++)
                a[k][l] += entry(vectors, length, i, k) * entry(vectors, length, i + 1, l);
        }
    }
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

static bool oscillates(double complex z)
{
    double complex s = clog(z);
    return cabs(z) > 1e-6 && cimag(s) > 1e-6 && cimag(s) < M_PI - 1e-6 && creal(s) < growth_most * cabs(s);
}

static int compare_poles(const void *a, const void *b)
{
    const struct pole *p = a, *q = b;
    return (p->wander > q->wander) - (p->wander < q->wander);
}

static double distance_to_nearest(double complex z, const double complex *others, int count)
{
    double complex s = clog(z);
    double nearest = HUGE_VAL;
    for (int k = 0; k < count; k++) {
        if (cabs(others[k]) > 0) nearest = fmin(nearest, cabs(clog(others[k]) - s) / cabs(s));
    }
    return nearest;
}

/// The poles of the motion's order, and how far each wanders at larger orders.
static int find_poles(const struct lapack *lapack, const double *vectors, const double *values, int length,
                      struct pole *poles)
{
    double a[ORDER_LARGEST][ORDER_LARGEST];
    double complex z[ORDER_LARGEST];
    int order = find_order(values, length), count = 0;
    int most = order + ORDER_STEP * ORDER_STEPS < length ? order + ORDER_STEP * ORDER_STEPS : length - 1;
    shift_products(vectors, length, most, a);
    if (eigenvalues(lapack, vectors, length, order, a, z) != 0) return -1;
    for (int k = 0; k < order && count < SUBSPACE_POLES_MAX; k++) {
        if (oscillates(z[k])) poles[count++] = (struct pole){z[k], 0};
    }
    for (int larger = order + ORDER_STEP; larger <= most; larger += ORDER_STEP) {
        if (eigenvalues(lapack, vectors, length, larger, a, z) != 0) return -1;
        for (int k = 0; k < count; k++)
            poles[k].wander = fmax(poles[k].wander, distance_to_nearest(poles[k].z, z, larger));
    }
    qsort(poles, (size_t)count, sizeof *poles, compare_poles);
    return count;
}

int subspace_poles(const struct lapack *lapack, const double *gram, int frames, struct pole *poles)
{
    int length = frames / 2, count = -1;
    size_t n = (size_t)frames, size = n / 2 * (n / 2);
    double *c = need(size + n * n + n, sizeof *c);
    double *room = c + size, *values = room + n * n;
    double whole = 0;
    sum_windows(gram, n, n / 2, c);
    for (int i = 0; i < length; i++) whole += c[i * length + i];
    project(lapack, gram, frames, length, false, room, c);
    project(lapack, gram, frames, length, true, room, c);
    memcpy(room, c, size * sizeof *c);
    bool good = lapack->dsyevd(LAPACK_COLUMNS_FIRST, 'N', 'L', length, room, length, values) == 0;
    if (good && values[length - 1] <= least_swing * whole) {
        count = 0;
    } else if (good) {
        whiten(fmax(values[length / 2], 0), frames - length + 1, length, c);
        if (lapack->dsyevd(LAPACK_COLUMNS_FIRST, 'V', 'L', length, c, length, values) == 0)
            count = find_poles(lapack, c, values, length, poles);
    }
    free(c);
    return count;
}

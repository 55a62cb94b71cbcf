/// Eigenvectors by cyclic Jacobi rotations, and Cholesky's factor.
#include "spline/symmetric.h"
#include "spline/wide.h"
#include <float.h>
#include <math.h>

enum { MAX_SWEEPS = 40 };

/// A pivot below this share of its diagonal entry has no digit left.
static const double lost = 64 * DBL_EPSILON;

/// Rotates rows and columns p and q so that a_pq becomes 0.
static void rotate(int n, double *a, double *vectors, int p, int q)
{
    if (a[n * p + q] == 0) return;
    double theta = 0.5 * (a[n * q + q] - a[n * p + p]) / a[n * p + q];
    double t = copysign(1 / (fabs(theta) + sqrt(theta * theta + 1)), theta), c = 1 / sqrt(t * t + 1), s = t * c;
    for (int k = 0; k < n; k++) {
        double kp = a[n * k + p], kq = a[n * k + q];
        a[n * k + p] = c * kp - s * kq, a[n * k + q] = s * kp + c * kq;
    }
    for (int k = 0; k < n; k++) {
        double pk = a[n * p + k], qk = a[n * q + k], vp = vectors[n * k + p], vq = vectors[n * k + q];
        a[n * p + k] = c * pk - s * qk, a[n * q + k] = s * pk + c * qk;
        vectors[n * k + p] = c * vp - s * vq, vectors[n * k + q] = s * vp + c * vq;
    }
}

void symmetric_eigen(int n, double *a, double *values, double *vectors)
{
    double trace = 0;
    for (int i = 0; i < n; i++) {
        trace += a[n * i + i];
        for (int j = 0; j < n; j++) vectors[n * i + j] = i == j;
    }
    const double enough = trace * trace * DBL_EPSILON * DBL_EPSILON;
    for (int sweep = 0; sweep < MAX_SWEEPS; sweep++) {
        double apart = 0; // from a diagonal
        for (int i = 0; i < n; i++) {
            for (int j = 0; j < i; j++) apart += a[n * i + j] * a[n * i + j];
        }
        if (!(apart > enough)) break;
        for (int p = 0; p < n; p++) {
            for (int q = p + 1; q < n; q++) rotate(n, a, vectors, p, q);
        }
    }
    for (int i = 0; i < n; i++) values[i] = a[n * i + i];
}

/// Σ a_k b_k, in lanes of eight.
WIDEST static double dot(const double *restrict a, const double *restrict b, int n)
{
    double part[8] = {0}, sum = 0;
    int k = 0;
    for (; k + 8 <= n; k += 8) {
        for (int i = 0; i < 8; i++) part[i] += a[k + i] * b[k + i];
    }
    for (; k < n; k++) sum += a[k] * b[k];
    for (int i = 0; i < 8; i++) sum += part[i];
    return sum;
}

void symmetric_reduce(int n, int count, double *a)
{
    for (int i = 0; i < n; i++) {
        double *row = a + n * i, entry = row[i];
        for (int j = 0; j < i && j < count; j++) row[j] = (row[j] - dot(row, a + n * j, j)) / a[n * j + j];
        for (int j = count; j < i; j++) row[j] -= dot(row, a + n * j, count);
        row[i] -= dot(row, row, i < count ? i : count);
        if (i < count) row[i] = row[i] > lost * entry ? sqrt(row[i]) : INFINITY;
    }
}

double symmetric_solve(int n, const double *a, double *b)
{
    double energy = 0;
    for (int i = 0; i < n; i++) {
        const double *row = a + n * i, rest = b[i] - dot(row, b, i);
        const double pivot =
            row[i] < INFINITY ? row[i] : sqrt(lost * dot(row, row, i)); // a left-out row's is at most that
        energy += rest == 0 ? 0 : rest / pivot * (rest / pivot);
        b[i] = rest / row[i];
    }
    for (int i = n - 1; i >= 0; i--) {
        b[i] /= a[n * i + i];
        for (int j = 0; j < i; j++) b[j] -= a[n * i + j] * b[i];
    }
    return energy;
}

void symmetric_multiply(int n, int stride, const double *a, const double *x, double *y)
{
    for (int i = 0; i < n; i++) {
        y[i] = dot(a + stride * i, x, i + 1);
        for (int j = 0; j < i; j++) y[j] += a[stride * i + j] * x[i];
    }
}

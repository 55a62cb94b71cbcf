/// Eigenvalues by Jacobi rotations.
#include "simulation/eigen.h"
#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

enum { SWEEPS_MAX = 60 };

/// The rotation that makes entry (p, q) zero, from both sides; rows of `vectors` turn along. False if it is zero already.
static bool rotate(int n, double *a, double *vectors, int p, int q)
{
    double pq = a[p * n + q], pp = a[p * n + p], qq = a[q * n + q];
    if (fabs(pq) <= DBL_EPSILON * sqrt(fabs(pp)) * sqrt(fabs(qq)) || fabs(pq) < DBL_MIN) return false;
    double theta = (qq - pp) / (2 * pq);
    double t = copysign(1, theta) / (fabs(theta) + sqrt(1 + theta * theta));
    double c = 1 / sqrt(1 + t * t), s = c * t;
    for (int k = 0; k < n; k++) {
        double x = a[k * n + p], y = a[k * n + q];
        a[k * n + p] = c * x - s * y;
        a[k * n + q] = s * x + c * y;
    }
    for (int k = 0; k < n; k++) {
        double x = a[p * n + k], y = a[q * n + k];
        a[p * n + k] = c * x - s * y;
        a[q * n + k] = s * x + c * y;
        x = vectors[p * n + k];
        y = vectors[q * n + k];
        vectors[p * n + k] = c * x - s * y;
        vectors[q * n + k] = s * x + c * y;
    }
    a[p * n + q] = a[q * n + p] = 0;
    return true;
}

static void exchange_rows(int n, double *vectors, int p, int q)
{
    for (int k = 0; k < n; k++) {
        double x = vectors[p * n + k];
        vectors[p * n + k] = vectors[q * n + k];
        vectors[q * n + k] = x;
    }
}

static void sort(int n, double *values, double *vectors)
{
    for (int i = 0; i < n - 1; i++) {
        int least = i;
        for (int j = i + 1; j < n; j++) {
            if (values[j] < values[least]) least = j;
        }
        if (least == i) continue;
        double value = values[i];
        values[i] = values[least];
        values[least] = value;
        exchange_rows(n, vectors, i, least);
    }
}

void eigen_symmetric(int n, double *a, double *values, double *vectors)
{
    memset(vectors, 0, (size_t)n * (size_t)n * sizeof *vectors);
    for (int i = 0; i < n; i++) vectors[i * n + i] = 1;
    bool moved = true;
    for (int sweep = 0; moved && sweep < SWEEPS_MAX; sweep++) {
        moved = false;
        for (int p = 0; p < n; p++) {
            for (int q = p + 1; q < n; q++) moved |= rotate(n, a, vectors, p, q);
        }
    }
    for (int i = 0; i < n; i++) values[i] = a[i * n + i];
    sort(n, values, vectors);
}

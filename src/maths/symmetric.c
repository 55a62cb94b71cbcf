/// Eigenvalues by cyclic Jacobi rotations, and Cholesky's factor.
#include "maths/symmetric.h"
#include "maths/maths.h"
#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

enum { MAX_SWEEPS = 60 };

/// A pivot below this share of its diagonal entry has no digit left.
static const double lost = 64 * DBL_EPSILON;

void symmetric_eigen(int n, double *a, double *values, double *vectors)
{
    memset(vectors, 0, (size_t)n * (size_t)n * sizeof *vectors);
    for (int i = 0; i < n; i++) vectors[i * n + i] = 1;
    bool moved = true;
    for (int sweep = 0; moved && sweep < MAX_SWEEPS; sweep++) {
        moved = false;
        for (int p = 0; p < n; p++) {
            for (int q = p + 1; q < n; q++) {
                // Rotates rows and columns p and q so that entry (p, q) becomes zero, and the same rows of `vectors`.
                double pq = a[p * n + q], pp = a[p * n + p], qq = a[q * n + q];
                if (fabs(pq) <= DBL_EPSILON * sqrt(fabs(pp)) * sqrt(fabs(qq)) || fabs(pq) < DBL_MIN) continue;
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
                moved = true;
            }
        }
    }
    for (int i = 0; i < n; i++) values[i] = a[i * n + i];

    for (int i = 0; i < n - 1; i++) {
        int least = i;
        for (int j = i + 1; j < n; j++) {
            if (values[j] < values[least]) least = j;
        }
        if (least == i) continue;
        double value = values[i];
        values[i] = values[least];
        values[least] = value;
        for (int k = 0; k < n; k++) {
            value = vectors[i * n + k];
            vectors[i * n + k] = vectors[least * n + k];
            vectors[least * n + k] = value;
        }
    }
}

void symmetric_reduce(int n, int count, double *a)
{
    for (int i = 0; i < n; i++) {
        double *row = a + n * i, entry = row[i];
        for (int j = 0; j < i && j < count; j++) row[j] = (row[j] - maths_dot(row, a + n * j, j)) / a[n * j + j];
        for (int j = count; j < i; j++) row[j] -= maths_dot(row, a + n * j, count);
        row[i] -= maths_dot(row, row, i < count ? i : count);
        if (i < count) row[i] = row[i] > lost * entry ? sqrt(row[i]) : INFINITY;
    }
}

double symmetric_solve(int n, const double *a, double *b)
{
    double energy = 0;
    for (int i = 0; i < n; i++) {
        const double *row = a + n * i, rest = b[i] - maths_dot(row, b, i);
        const double pivot =
            row[i] < INFINITY ? row[i] : sqrt(lost * maths_dot(row, row, i)); // a left-out row's is at most that
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
        y[i] = maths_dot(a + stride * i, x, i + 1);
        for (int j = 0; j < i; j++) y[j] += a[stride * i + j] * x[i];
    }
}

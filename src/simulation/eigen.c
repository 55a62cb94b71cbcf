/// Eigenvalues and singular values by Jacobi rotations.
#include "simulation/linear.h"
#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

enum { SWEEPS_MAX = 60 };

/// Rotates rows and columns p and q so that entry (p, q) becomes zero, and the same rows of `vectors`. False if it is zero already.
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
        for (int k = 0; k < n; k++) {
            value = vectors[i * n + k];
            vectors[i * n + k] = vectors[least * n + k];
            vectors[least * n + k] = value;
        }
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

// --- singular values

// One-sided Jacobi (Hestenes): rotations from the right make the columns of A = F V orthogonal; their lengths are the
// singular values, the columns themselves σ_k u_k. It works on F and not on FᵀF, so small singular values keep their
// digits. The remaining signs follow from u₂ = u₀ × u₁ and σ₂ = u₂ · a₂.
enum { SVD_SWEEPS_MAX = 16 }; // three or four are enough in practice

/// Columns p and q of m become c·p − s·q and s·p + c·q.
static void rotate_columns(double m[3][3], int p, int q, double c, double s)
{
    for (int i = 0; i < 3; i++) {
        double x = m[i][p], y = m[i][q];
        m[i][p] = c * x - s * y;
        m[i][q] = s * x + c * y;
    }
}

static double column_dot(const double m[3][3], int p, int q)
{
    return m[0][p] * m[0][q] + m[1][p] * m[1][q] + m[2][p] * m[2][q];
}

/// Makes columns p and q of A orthogonal; false where they are already.
static bool orthogonalise(double a[3][3], double v[3][3], int p, int q)
{
    double pp = column_dot(a, p, p), qq = column_dot(a, q, q), pq = column_dot(a, p, q);
    if (fabs(pq) <= DBL_EPSILON * sqrt(pp) * sqrt(qq)) return false;
    double zeta = (qq - pp) / (2 * pq);
    double t = copysign(1, zeta) / (fabs(zeta) + sqrt(1 + zeta * zeta)); // the smaller angle
    double c = 1 / sqrt(1 + t * t);
    rotate_columns(a, p, q, c, c * t);
    rotate_columns(v, p, q, c, c * t);
    return true;
}

/// Exchanges two columns by a quarter turn, so that V stays a rotation.
static void order_columns(double a[3][3], double v[3][3], int p, int q)
{
    if (column_dot(a, p, p) >= column_dot(a, q, q)) return;
    rotate_columns(a, p, q, 0, -1);
    rotate_columns(v, p, q, 0, -1);
}

/// The unit vector along `a` minus its part along the unit vector `first`; if that is zero, any unit vector orthogonal to `first`.
static void unit_across(const double first[3], const double a[3], double smallest, double out[3])
{
    double along = vec3_dot(first, a);
    for (int i = 0; i < 3; i++) out[i] = a[i] - along * first[i];
    double length = vec3_length(out);
    if (length <= smallest) {
        int axis = fabs(first[0]) < 0.6 ? 0 : 1; // far from parallel to `first`
        double other[3] = {0};
        other[axis] = 1;
        vec3_cross(first, other, out);
        length = vec3_length(out);
    }
    for (int i = 0; i < 3; i++) out[i] /= length;
}

void svd3(const double f[3][3], struct svd *svd)
{
    double a[3][3];
    memcpy(a, f, sizeof a);
    memcpy(svd->v, (const double[3][3]){{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, sizeof svd->v);
    bool moved = true;
    for (int sweep = 0; moved && sweep < SVD_SWEEPS_MAX; sweep++) {
        moved = orthogonalise(a, svd->v, 0, 1);
        moved |= orthogonalise(a, svd->v, 0, 2);
        moved |= orthogonalise(a, svd->v, 1, 2);
    }
    order_columns(a, svd->v, 0, 1);
    order_columns(a, svd->v, 0, 2);
    order_columns(a, svd->v, 1, 2);

    double column[3][3], u[3][3];
    for (int i = 0; i < 9; i++) column[i % 3][i / 3] = a[i / 3][i % 3];
    svd->sigma[0] = vec3_length(column[0]);
    for (int i = 0; i < 3; i++) u[0][i] = svd->sigma[0] > 0 ? column[0][i] / svd->sigma[0] : i == 0;
    unit_across(u[0], column[1], DBL_EPSILON * svd->sigma[0], u[1]);
    vec3_cross(u[0], u[1], u[2]);
    svd->sigma[1] = vec3_dot(u[1], column[1]);
    svd->sigma[2] = vec3_dot(u[2], column[2]);
    for (int i = 0; i < 9; i++) svd->u[i / 3][i % 3] = u[i % 3][i / 3];
}

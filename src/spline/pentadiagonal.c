/// Block L D Lᵀ of the pentadiagonal matrix.
//
// The system's matrix A = Rᵀ W R couples a sample with two neighbours on each side, one block row a sample:
//
//     | D0 E0' F0'           |        D_k symmetric w×w, E_k = A_{k+1,k}, F_k = A_{k+2,k}; w = 1, or 2 for (Re x, Im x),
//     | E0 D1  E1' F1'       |        because a knot fixes Re x alone and so breaks complex linearity.
//     | F0 E1  D2  E2' F2'   |
//     |    F1  E2  D3  E3'   |        A = L S Lᵀ:   S_k  = D_k − L1_{k−1} U_{k−1}ᵀ − L2_{k−2} F_{k−2}ᵀ
//     |        F2  E3  D4    |                      U_k  = E_k − L2_{k−1} U_{k−1}ᵀ
//                                                   L1_k = U_k S_k⁻¹,  L2_k = F_k S_k⁻¹
//
// No fill outside the band and no pivoting: A is positive definite. A loop wraps the band around; there the last two samples
// are taken out as a border B with corner C, the rest is factored as above, and the border is solved through its Schur
// complement C − Bᵀ A⁻¹ B. (Periodic tridiagonal solvers do the same with Sherman–Morrison.)
#include "spline/pentadiagonal.h"
#include "spline/wide.h"
#include <float.h>
#include <math.h>
#include <string.h>

/// A pivot below this part of its diagonal entry is rounding; those of a knot-free stretch of G samples are about G⁻³ of it.
static const double rounding = 8 * DBL_EPSILON;

typedef struct block {
    double a, b, c, d; ///< [a b; c d]
} block;

static inline block load(const double *p) { return (block){p[0], p[1], p[2], p[3]}; }

static inline void store(double *p, block m) { p[0] = m.a, p[1] = m.b, p[2] = m.c, p[3] = m.d; }

/// X − Y Zᵀ
static inline block minus_product(block x, block y, block z)
{
    return (block){x.a - (y.a * z.a + y.b * z.b), x.b - (y.a * z.c + y.b * z.d), x.c - (y.c * z.a + y.d * z.b),
                   x.d - (y.c * z.c + y.d * z.d)};
}

/// X S for symmetric S = (s0 s1; s1 s2)
static inline block times_symmetric(block x, const double *s)
{
    return (block){x.a * s[0] + x.b * s[1], x.a * s[1] + x.b * s[2], x.c * s[0] + x.d * s[1],
                   x.c * s[1] + x.d * s[2]};
}

/// X S Xᵀ
static inline block squared(block x, const double *s)
{
    block xs = times_symmetric(x, s);
    double off = xs.a * x.c + xs.b * x.d;
    return (block){xs.a * x.a + xs.b * x.b, off, off, xs.c * x.c + xs.d * x.d};
}

/// Each row waits for the one before: what is left to do once 1 / det of that is known, U S⁻¹ Uᵀ of it, is a product and a difference.
WIDEST static pentadiagonal_rank factor_blocks(pentadiagonal *m, int rows)
{
    double lost = 1, inverse = 0;
    const block zero = {0, 0, 0, 0};
    block square = zero, u = zero, l2 = zero, f = zero; // of row k−1; square: U S⁻¹ Uᵀ times det
    block l2_before = zero, f_before = zero;            // of row k−2
    for (int k = 0; k < rows; k++) {
        double *d = m->diagonal + 3 * k, *below = m->below + 4 * k, *below2 = m->below2 + 4 * k;
        block s = {d[0], d[1], d[1], d[2]};
        s = minus_product(s, l2_before, f_before);
        s.a -= square.a * inverse, s.b -= square.b * inverse, s.d -= square.d * inverse; // S_k
        const double adjugate[3] = {s.d, -s.b, s.a};
        double det = s.a * s.d - s.b * s.b;
        if (!(s.a > 0 && det > 0 && det < INFINITY)) return RANK_BROKEN;
        inverse = 1 / det;
        double of_second = d[2] * s.a * inverse;
        if (d[0] > lost * s.a) lost = d[0] / s.a;
        lost = of_second > lost ? of_second : lost;
        for (int i = 0; i < 3; i++) d[i] = adjugate[i] * inverse;
        block next_u = minus_product(load(below), l2, u); // U_k
        l2_before = l2, f_before = f;
        u = next_u, f = load(below2);
        square = squared(u, adjugate);
        l2 = times_symmetric(f, d);
        store(below, times_symmetric(u, d));
        store(below2, l2);
    }
    m->lost = lost;
    return lost * rounding > 1 ? RANK_WEAK : RANK_FULL;
}

static pentadiagonal_rank factor_scalars(pentadiagonal *m, int rows)
{
    double lost = 1, inverse = 0, u = 0, l2 = 0, f = 0, l2_before = 0, f_before = 0;
    for (int k = 0; k < rows; k++) {
        double s = (m->diagonal[k] - l2_before * f_before) - u * u * inverse;
        if (!(s > 0 && s < INFINITY)) return RANK_BROKEN;
        inverse = 1 / s;
        double next_u = m->below[k] - l2 * u, of_pivot = m->diagonal[k] * inverse;
        lost = of_pivot > lost ? of_pivot : lost;
        l2_before = l2, f_before = f;
        u = next_u, f = m->below2[k];
        l2 = f * inverse;
        m->diagonal[k] = inverse, m->below[k] = u * inverse, m->below2[k] = l2;
    }
    m->lost = lost;
    return lost * rounding > 1 ? RANK_WEAK : RANK_FULL;
}

static void solve_blocks(const pentadiagonal *m, int rows, double *x)
{
    double p0 = 0, p1 = 0, q0 = 0, q1 = 0; // forward: z_{k−1}, z_{k−2}
    for (int k = 0; k < rows; k++) {
        double z0 = x[2 * k], z1 = x[2 * k + 1];
        if (k > 1) {
            const double *l = m->below2 + 4 * (k - 2);
            z0 -= l[0] * q0 + l[1] * q1, z1 -= l[2] * q0 + l[3] * q1;
        }
        if (k > 0) { // last, because it is what waits
            const double *l = m->below + 4 * (k - 1);
            z0 -= l[0] * p0 + l[1] * p1, z1 -= l[2] * p0 + l[3] * p1;
        }
        q0 = p0, q1 = p1, p0 = z0, p1 = z1;
        x[2 * k] = z0, x[2 * k + 1] = z1;
    }
    p0 = p1 = q0 = q1 = 0; // backward: x_{k+1}, x_{k+2}
    for (int k = rows - 1; k >= 0; k--) {
        const double *s = m->diagonal + 3 * k, *l = m->below + 4 * k, *l2 = m->below2 + 4 * k;
        double z0 = x[2 * k], z1 = x[2 * k + 1];
        double y0 = s[0] * z0 + s[1] * z1 - (l2[0] * q0 + l2[2] * q1) - (l[0] * p0 + l[2] * p1);
        double y1 = s[1] * z0 + s[2] * z1 - (l2[1] * q0 + l2[3] * q1) - (l[1] * p0 + l[3] * p1);
        q0 = p0, q1 = p1, p0 = y0, p1 = y1;
        x[2 * k] = y0, x[2 * k + 1] = y1;
    }
}

static void solve_scalars(const pentadiagonal *m, int rows, double *x)
{
    double p = 0, q = 0;
    for (int k = 0; k < rows; k++) {
        double z = x[k];
        if (k > 1) z -= m->below2[k - 2] * q;
        if (k > 0) z -= m->below[k - 1] * p;
        q = p, p = z, x[k] = z;
    }
    p = q = 0;
    for (int k = rows - 1; k >= 0; k--) {
        double y = m->diagonal[k] * x[k] - m->below2[k] * q - m->below[k] * p;
        q = p, p = y, x[k] = y;
    }
}

static pentadiagonal_rank factor_rows(pentadiagonal *m, int rows)
{
    return m->width == 2 ? factor_blocks(m, rows) : factor_scalars(m, rows);
}

static void solve_rows(const pentadiagonal *m, int rows, double *x)
{
    if (m->width == 2) {
        solve_blocks(m, rows, x);
    } else {
        solve_scalars(m, rows, x);
    }
}

/// The column of the border that belongs to an interior row, as a list: only the rows next to the seam are not 0.
static double *edge_entry(pentadiagonal *m, int row, int within, int column)
{
    int e = 0;
    while (e < m->edge_count && m->edge_row[e] != row) e++;
    if (e == m->edge_count) {
        m->edge_row[m->edge_count++] = row;
        memset(m->edge[e], 0, sizeof m->edge[e]);
    }
    return &m->edge[e][within][column];
}

/// Moves the coupling block A_{row,column} (at `from`, which becomes 0) out of the band into border or corner.
static void move_to_border(pentadiagonal *m, int row, int column, double *from)
{
    int w = m->width, interior = m->count - 2;
    for (int i = 0; i < w; i++) {
        for (int j = 0; j < w; j++) {
            double value = from[w * i + j];
            if (row < interior) {
                *edge_entry(m, row, i, w * (column - interior) + j) += value;
            } else if (column < interior) {
                *edge_entry(m, column, j, w * (row - interior) + i) += value;
            } else {
                int r = w * (row - interior) + i, c = w * (column - interior) + j;
                m->corner[r][c] += value;
                m->corner[c][r] += value;
            }
            from[w * i + j] = 0;
        }
    }
}

static void split_border(pentadiagonal *m)
{
    int w = m->width, interior = m->count - 2;
    m->edge_count = 0;
    memset(m->corner, 0, sizeof m->corner);
    for (int s = 0; s < 2; s++) {
        const double *d = m->diagonal + (w == 2 ? 3 : 1) * (interior + s);
        double(*c)[BORDER_MAX] = m->corner;
        int o = w * s;
        c[o][o] = d[0];
        if (w == 2) c[o][o + 1] = c[o + 1][o] = d[1], c[o + 1][o + 1] = d[2];
    }
    for (int k = interior > 2 ? interior - 2 : 0; k < m->count; k++) {
        int next = (k + 1) % m->count, second = (k + 2) % m->count;
        if (k >= interior || next >= interior) move_to_border(m, next, k, m->below + w * w * k);
        if (k >= interior || second >= interior) move_to_border(m, second, k, m->below2 + w * w * k);
    }
}

/// corner ← its Cholesky factor; `entry` are the diagonal entries before the border was taken off.
static pentadiagonal_rank factor_corner(pentadiagonal *m, const double *entry)
{
    pentadiagonal_rank rank = RANK_FULL;
    int size = 2 * m->width;
    for (int c = 0; c < size; c++) {
        for (int r = c; r < size; r++) {
            double sum = m->corner[r][c];
            for (int k = 0; k < c; k++) sum -= m->corner[r][k] * m->corner[c][k];
            if (r == c && !(sum > 0 && sum < INFINITY)) return RANK_BROKEN;
            if (r == c && entry[c] > m->lost * sum) m->lost = entry[c] / sum;
            if (r == c && sum < rounding * entry[c]) rank = RANK_WEAK;
            m->corner[r][c] = r == c ? sqrt(sum) : sum / m->corner[c][c];
        }
    }
    return rank;
}

/// Border columns ← interior⁻¹ B; corner ← Cholesky factor of C − Bᵀ interior⁻¹ B.
static pentadiagonal_rank factor_border(pentadiagonal *m)
{
    int w = m->width, size = 2 * w, interior = m->count - 2;
    double entry[BORDER_MAX];
    for (int c = 0; c < size; c++) entry[c] = m->corner[c][c];
    for (int c = 0; c < size; c++) {
        double *column = m->border + (size_t)c * (size_t)(w * m->count);
        memset(column, 0, sizeof *column * (size_t)(w * interior));
        for (int e = 0; e < m->edge_count; e++) {
            for (int i = 0; i < w; i++) column[w * m->edge_row[e] + i] = m->edge[e][i][c];
        }
        solve_rows(m, interior, column);
        for (int r = 0; r < size; r++) {
            for (int e = 0; e < m->edge_count; e++) {
                for (int i = 0; i < w; i++) m->corner[r][c] -= m->edge[e][i][r] * column[w * m->edge_row[e] + i];
            }
        }
    }
    return factor_corner(m, entry);
}

pentadiagonal_rank pentadiagonal_factor(pentadiagonal *m)
{
    if (!m->cyclic) return factor_rows(m, m->count);
    split_border(m);
    pentadiagonal_rank inner = factor_rows(m, m->count - 2);
    if (inner == RANK_BROKEN) return inner;
    pentadiagonal_rank border = factor_border(m);
    return border < inner ? border : inner;
}

void pentadiagonal_solve(const pentadiagonal *m, double *b)
{
    if (!m->cyclic) {
        solve_rows(m, m->count, b);
        return;
    }
    int w = m->width, size = 2 * w, interior = m->count - 2;
    double *t = b + w * interior;
    solve_rows(m, interior, b);
    for (int c = 0; c < size; c++) {
        for (int e = 0; e < m->edge_count; e++) {
            for (int i = 0; i < w; i++) t[c] -= m->edge[e][i][c] * b[w * m->edge_row[e] + i];
        }
    }
    for (int r = 0; r < size; r++) {
        for (int k = 0; k < r; k++) t[r] -= m->corner[r][k] * t[k];
        t[r] /= m->corner[r][r];
    }
    for (int r = size - 1; r >= 0; r--) {
        for (int k = r + 1; k < size; k++) t[r] -= m->corner[k][r] * t[k];
        t[r] /= m->corner[r][r];
    }
    for (int c = 0; c < size; c++) {
        const double *column = m->border + (size_t)c * (size_t)(w * m->count);
        for (int i = 0; i < w * interior; i++) b[i] -= column[i] * t[c];
    }
}

/// Block L D Lᵀ of the pentadiagonal matrix.
//
// The system's matrix A = Rᵀ W R couples a sample with two neighbours on each side, one block row a sample:
//
//     | D0 E0' F0'           |        D_k symmetric 2×2 for (Re x, Im x), E_k = A_{k+1,k}, F_k = A_{k+2,k},
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

// Each step is written once, for a mode that is known where it is compiled: outside complex mode a block is its first number.

static inline block load(bool is_complex, const double *p)
{
    return is_complex ? (block){p[0], p[1], p[2], p[3]} : (block){.a = p[0]};
}

static inline void store(bool is_complex, double *p, block m)
{
    p[0] = m.a;
    if (is_complex) p[1] = m.b, p[2] = m.c, p[3] = m.d;
}

/// X − Y Zᵀ
static inline block minus_product(bool is_complex, block x, block y, block z)
{
    if (!is_complex) return (block){.a = x.a - y.a * z.a};
    return (block){x.a - (y.a * z.a + y.b * z.b), x.b - (y.a * z.c + y.b * z.d), x.c - (y.c * z.a + y.d * z.b),
                   x.d - (y.c * z.c + y.d * z.d)};
}

/// X S for symmetric S = (s0 s1; s1 s2)
static inline block times_symmetric(bool is_complex, block x, const double *s)
{
    if (!is_complex) return (block){.a = x.a * s[0]};
    return (block){x.a * s[0] + x.b * s[1], x.a * s[1] + x.b * s[2], x.c * s[0] + x.d * s[1],
                   x.c * s[1] + x.d * s[2]};
}

/// X S Xᵀ
static inline block squared(bool is_complex, block x, const double *s)
{
    block xs = times_symmetric(is_complex, x, s);
    if (!is_complex) return (block){.a = xs.a * x.a};
    double off = xs.a * x.c + xs.b * x.d;
    return (block){xs.a * x.a + xs.b * x.b, off, off, xs.c * x.c + xs.d * x.d};
}

/// Each row waits for the one before: what is left to do once 1 / det of that is known, U S⁻¹ Uᵀ of it, is a product and a difference.
static inline pentadiagonal_rank factor(pentadiagonal *m, int rows, const bool is_complex)
{
    double lost = 1, inverse = 0;
    const block zero = {0, 0, 0, 0};
    block square = zero, u = zero, l2 = zero, f = zero; // of row k−1; square: U S⁻¹ Uᵀ times det
    block l2_before = zero, f_before = zero;            // of row k−2
    for (int k = 0; k < rows; k++) {
        double *d = m->diagonal + 3 * k, *below = m->below + 4 * k, *below2 = m->below2 + 4 * k;
        block s = is_complex ? (block){d[0], d[1], d[1], d[2]} : (block){.a = d[0], .d = 1};
        s = minus_product(is_complex, s, l2_before, f_before);
        s.a -= square.a * inverse, s.b -= square.b * inverse, s.d -= square.d * inverse; // S_k
        const double adjugate[3] = {is_complex ? s.d : 1, -s.b, s.a};
        double det = is_complex ? s.a * s.d - s.b * s.b : s.a;
        if (!(s.a > 0 && det > 0 && det < INFINITY)) return RANK_BROKEN;
        inverse = 1 / det;
        double of_second = is_complex ? d[2] * s.a * inverse : 1;
        if (d[0] > lost * s.a) lost = d[0] / s.a;
        lost = of_second > lost ? of_second : lost;
        for (int i = 0; i < (is_complex ? 3 : 1); i++) d[i] = adjugate[i] * inverse;
        block next_u = minus_product(is_complex, load(is_complex, below), l2, u); // U_k
        l2_before = l2, f_before = f;
        u = next_u, f = load(is_complex, below2);
        square = squared(is_complex, u, adjugate);
        l2 = times_symmetric(is_complex, f, d);
        store(is_complex, below, times_symmetric(is_complex, u, d));
        store(is_complex, below2, l2);
    }
    m->lost = lost;
    return lost * rounding > 1 ? RANK_WEAK : RANK_FULL;
}

static inline void solve(const pentadiagonal *m, int rows, double *x, const bool is_complex)
{
    double p0 = 0, p1 = 0, q0 = 0, q1 = 0; // forward: z_{k−1}, z_{k−2}
    for (int k = 0; k < rows; k++) {
        double z0 = x[2 * k], z1 = x[2 * k + 1];
        if (k > 1) {
            const double *l = m->below2 + 4 * (k - 2);
            z0 -= is_complex ? l[0] * q0 + l[1] * q1 : l[0] * q0;
            if (is_complex) z1 -= l[2] * q0 + l[3] * q1;
        }
        if (k > 0) { // last, because it is what waits
            const double *l = m->below + 4 * (k - 1);
            z0 -= is_complex ? l[0] * p0 + l[1] * p1 : l[0] * p0;
            if (is_complex) z1 -= l[2] * p0 + l[3] * p1;
        }
        q0 = p0, q1 = p1, p0 = z0, p1 = z1;
        x[2 * k] = z0, x[2 * k + 1] = z1;
    }
    p0 = p1 = q0 = q1 = 0; // backward: x_{k+1}, x_{k+2}
    for (int k = rows - 1; k >= 0; k--) {
        const double *s = m->diagonal + 3 * k, *l = m->below + 4 * k, *l2 = m->below2 + 4 * k;
        double z0 = x[2 * k], z1 = x[2 * k + 1];
        double y0 = s[0] * z0 - l2[0] * q0 - l[0] * p0, y1 = 0;
        if (is_complex) {
            y0 = s[0] * z0 + s[1] * z1 - (l2[0] * q0 + l2[2] * q1) - (l[0] * p0 + l[2] * p1);
            y1 = s[1] * z0 + s[2] * z1 - (l2[1] * q0 + l2[3] * q1) - (l[1] * p0 + l[3] * p1);
        }
        q0 = p0, q1 = p1, p0 = y0, p1 = y1;
        x[2 * k] = y0, x[2 * k + 1] = y1;
    }
}

WIDEST static pentadiagonal_rank factor_rows(pentadiagonal *m, int rows)
{
    return m->is_complex ? factor(m, rows, true) : factor(m, rows, false);
}

static void solve_rows(const pentadiagonal *m, int rows, double *x)
{
    if (m->is_complex) {
        solve(m, rows, x, true);
    } else {
        solve(m, rows, x, false);
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

/// The border's unknowns: outside complex mode only every other one is there.
static int stride_of(const pentadiagonal *m) { return m->is_complex ? 1 : 2; }

/// Moves the coupling block A_{row,column} (at `from`, which becomes 0) out of the band into border or corner.
static void move_to_border(pentadiagonal *m, int row, int column, double *from)
{
    const int stride = stride_of(m), interior = m->count - 2;
    for (int i = 0; i < 2; i += stride) {
        for (int j = 0; j < 2; j += stride) {
            double value = from[2 * i + j];
            if (row < interior) {
                *edge_entry(m, row, i, 2 * (column - interior) + j) += value;
            } else if (column < interior) {
                *edge_entry(m, column, j, 2 * (row - interior) + i) += value;
            } else {
                int r = 2 * (row - interior) + i, c = 2 * (column - interior) + j;
                m->corner[r][c] += value;
                m->corner[c][r] += value;
            }
            from[2 * i + j] = 0;
        }
    }
}

static void split_border(pentadiagonal *m)
{
    const int interior = m->count - 2;
    m->edge_count = 0;
    memset(m->corner, 0, sizeof m->corner);
    for (int s = 0; s < 2; s++) {
        const double *d = m->diagonal + 3 * (interior + s);
        double(*c)[BORDER_MAX] = m->corner;
        int o = 2 * s;
        c[o][o] = d[0];
        if (m->is_complex) c[o][o + 1] = c[o + 1][o] = d[1], c[o + 1][o + 1] = d[2];
    }
    for (int k = interior > 2 ? interior - 2 : 0; k < m->count; k++) {
        int next = (k + 1) % m->count, second = (k + 2) % m->count;
        if (k >= interior || next >= interior) move_to_border(m, next, k, m->below + 4 * k);
        if (k >= interior || second >= interior) move_to_border(m, second, k, m->below2 + 4 * k);
    }
}

/// corner ← its Cholesky factor; `entry` are the diagonal entries before the border was taken off.
static pentadiagonal_rank factor_corner(pentadiagonal *m, const double *entry)
{
    pentadiagonal_rank rank = RANK_FULL;
    const int stride = stride_of(m);
    for (int c = 0; c < BORDER_MAX; c += stride) {
        for (int r = c; r < BORDER_MAX; r += stride) {
            double sum = m->corner[r][c];
            for (int k = 0; k < c; k += stride) sum -= m->corner[r][k] * m->corner[c][k];
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
    const int stride = stride_of(m), interior = m->count - 2;
    double entry[BORDER_MAX];
    for (int c = 0; c < BORDER_MAX; c++) entry[c] = m->corner[c][c];
    for (int c = 0; c < BORDER_MAX; c += stride) {
        double *column = m->border + (size_t)c * (size_t)(2 * m->count);
        memset(column, 0, sizeof *column * (size_t)(2 * interior));
        for (int e = 0; e < m->edge_count; e++) {
            for (int i = 0; i < 2; i += stride) column[2 * m->edge_row[e] + i] = m->edge[e][i][c];
        }
        solve_rows(m, interior, column);
        for (int r = 0; r < BORDER_MAX; r += stride) {
            for (int e = 0; e < m->edge_count; e++) {
                for (int i = 0; i < 2; i += stride)
                    m->corner[r][c] -= m->edge[e][i][r] * column[2 * m->edge_row[e] + i];
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
    const int stride = stride_of(m), interior = m->count - 2;
    double *t = b + 2 * interior;
    solve_rows(m, interior, b);
    for (int c = 0; c < BORDER_MAX; c += stride) {
        for (int e = 0; e < m->edge_count; e++) {
            for (int i = 0; i < 2; i += stride) t[c] -= m->edge[e][i][c] * b[2 * m->edge_row[e] + i];
        }
    }
    for (int r = 0; r < BORDER_MAX; r += stride) {
        for (int k = 0; k < r; k += stride) t[r] -= m->corner[r][k] * t[k];
        t[r] /= m->corner[r][r];
    }
    for (int r = BORDER_MAX - stride; r >= 0; r -= stride) {
        for (int k = r + stride; k < BORDER_MAX; k += stride) t[r] -= m->corner[k][r] * t[k];
        t[r] /= m->corner[r][r];
    }
    for (int c = 0; c < BORDER_MAX; c += stride) {
        const double *column = m->border + (size_t)c * (size_t)(2 * m->count);
        for (int i = 0; i < 2 * interior; i++) b[i] -= column[i] * t[c];
    }
}

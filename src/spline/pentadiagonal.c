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
// There is no fill outside the band, and no pivoting, because A is positive definite. A loop wraps the band around. Its last two samples
// are then the border: their rows of L are full, and their corner of A, after elimination, is factored separately.
#include "spline/pentadiagonal.h"
#include "spline/wide.h"
#include <float.h>
#include <math.h>
#include <string.h>

/// A pivot below this share of its diagonal entry is rounding. Those of a knot-free stretch of G samples are about G⁻³ of it.
static const double rounding = 8 * DBL_EPSILON;

/// The step between the border's unknowns: outside complex mode every other one is unused.
static int stride_of(const pentadiagonal *m) { return m->is_complex ? 1 : 2; }

/// Rows before the border.
static int interior_of(const pentadiagonal *m) { return m->cyclic ? m->count - 2 : m->count; }

typedef struct block {
    double a, b, c, d; ///< [a b; c d]
} block;

static const block zero = {0, 0, 0, 0};

// Each step is written once, with the mode known at compile time. Outside complex mode a block is its first number.

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

static void add_to_corner(pentadiagonal *m, int r, int c, block x)
{
    m->corner[r][c] += x.a, m->corner[r][c + 1] += x.b;
    m->corner[r + 1][c] += x.c, m->corner[r + 1][c + 1] += x.d;
}

/// Border ← the border's rows of L for a sample; corner ← the rest.
static inline void eliminate_border(pentadiagonal *m, int of_sample, const bool is_complex)
{
    block before = zero, second = zero, own = zero, beside = zero; // L S of row k−1 and k−2; L S L'
    for (int k = 0; k < interior_of(m); k++) {
        double *border = m->border + BORDER_ROW * k;
        block now = load(is_complex, border + 4 * of_sample);
        if (k > 1) now = minus_product(is_complex, now, second, load(is_complex, m->below2 + 4 * (k - 2)));
        if (k > 0) now = minus_product(is_complex, now, before, load(is_complex, m->below + 4 * (k - 1)));
        const block l = times_symmetric(is_complex, now, m->diagonal + 3 * k);
        store(is_complex, border + 4 * of_sample, l);
        own = minus_product(is_complex, own, now, l);
        beside = minus_product(is_complex, beside, now, load(is_complex, border));
        second = before, before = now;
    }
    add_to_corner(m, 2 * of_sample, 2 * of_sample, own);
    if (of_sample > 0) add_to_corner(m, 2, 0, beside);
}

/// Each row waits for the one before. So U S⁻¹ Uᵀ is kept times det: once 1 / det is known, a product and a difference remain.
static inline pentadiagonal_rank factor(pentadiagonal *m, const bool is_complex)
{
    const int rows = interior_of(m);
    double lost = 1, inverse = 0;
    m->is_rooted = false;
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
    for (int s = 0; s < 2 && m->cyclic; s++) eliminate_border(m, s, is_complex);
    return lost * rounding > 1 ? RANK_WEAK : RANK_FULL;
}

static void solve_corner(const pentadiagonal *m, double *t)
{
    const int stride = stride_of(m);
    for (int r = 0; r < BORDER_MAX; r += stride) {
        for (int k = 0; k < r; k += stride) t[r] -= m->corner[r][k] * t[k];
        t[r] /= m->corner[r][r];
    }
    for (int r = BORDER_MAX - stride; r >= 0; r -= stride) {
        for (int k = r + stride; k < BORDER_MAX; k += stride) t[r] -= m->corner[k][r] * t[k];
        t[r] /= m->corner[r][r];
    }
}

static inline void solve(const pentadiagonal *m, double *x, const bool is_complex)
{
    const int rows = interior_of(m), stride = is_complex ? 1 : 2;
    double t[BORDER_MAX] = {0}; // of the border
    for (int c = 0; m->cyclic && c < BORDER_MAX; c++) t[c] = x[2 * rows + c];
    double p0 = 0, p1 = 0, q0 = 0, q1 = 0; // forward: z_{k−1}, z_{k−2}
    for (int k = 0; k < rows; k++) {
        const double *s = m->diagonal + 3 * k, *b = m->border + BORDER_ROW * k;
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
        if (m->is_rooted) z1 = is_complex ? s[1] * z0 + s[2] * z1 : 0, z0 *= s[0];
        for (int c = 0; m->cyclic && c < BORDER_MAX; c += stride)
            t[c] -= is_complex ? b[2 * c] * z0 + b[2 * c + 1] * z1 : b[2 * c] * z0;
        q0 = p0, q1 = p1, p0 = z0, p1 = z1;
        x[2 * k] = z0, x[2 * k + 1] = z1;
    }
    if (m->cyclic) solve_corner(m, t);
    for (int c = 0; m->cyclic && c < BORDER_MAX; c++) x[2 * rows + c] = t[c];
    p0 = p1 = q0 = q1 = 0; // backward: x_{k+1}, x_{k+2}
    for (int k = rows - 1; k >= 0; k--) {
        const double *s = m->diagonal + 3 * k, *l = m->below + 4 * k, *l2 = m->below2 + 4 * k;
        const double *b = m->border + BORDER_ROW * k;
        double y0 = x[2 * k], y1 = is_complex ? x[2 * k + 1] : 0;
        if (!m->is_rooted) {
            const double z0 = y0;
            y0 = is_complex ? s[0] * z0 + s[1] * y1 : s[0] * z0;
            if (is_complex) y1 = s[1] * z0 + s[2] * y1;
        }
        for (int c = 0; m->cyclic && c < BORDER_MAX; c += stride) {
            y0 -= b[2 * c] * t[c];
            if (is_complex) y1 -= b[2 * c + 1] * t[c];
        }
        y0 -= is_complex ? l2[0] * q0 + l2[2] * q1 : l2[0] * q0;
        y0 -= is_complex ? l[0] * p0 + l[2] * p1 : l[0] * p0;
        if (is_complex) y1 = y1 - (l2[1] * q0 + l2[3] * q1) - (l[1] * p0 + l[3] * p1);
        if (m->is_rooted) y0 = is_complex ? s[0] * y0 + s[1] * y1 : s[0] * y0, y1 *= s[2];
        q0 = p0, q1 = p1, p0 = y0, p1 = y1;
        x[2 * k] = y0, x[2 * k + 1] = y1;
    }
}

WIDEST static pentadiagonal_rank factor_rows(pentadiagonal *m)
{
    return m->is_complex ? factor(m, true) : factor(m, false);
}

/// Moves the coupling block A_{row,column} from the band (at `from`, set to 0) to the border or corner.
static void move_to_border(pentadiagonal *m, int row, int column, double *from)
{
    const int stride = stride_of(m), interior = interior_of(m), r = 2 * (row - interior), c = 2 * (column - interior);
    for (int i = 0; i < 2; i += stride) {
        for (int j = 0; j < 2; j += stride) {
            double value = from[2 * i + j];
            if (row < interior) {
                m->border[BORDER_ROW * row + 2 * (c + j) + i] += value;
            } else if (column < interior) {
                m->border[BORDER_ROW * column + 2 * (r + i) + j] += value;
            } else {
                m->corner[r + i][c + j] += value;
                m->corner[c + j][r + i] += value;
            }
            from[2 * i + j] = 0;
        }
    }
}

static void split_border(pentadiagonal *m)
{
    const int interior = interior_of(m);
    memset(m->border, 0, sizeof *m->border * BORDER_ROW * (size_t)interior);
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

/// corner ← its Cholesky factor; `entry` are the diagonal entries before elimination.
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

pentadiagonal_rank pentadiagonal_factor(pentadiagonal *m)
{
    if (!m->cyclic) return factor_rows(m);
    split_border(m);
    double entry[BORDER_MAX];
    for (int c = 0; c < BORDER_MAX; c++) entry[c] = m->corner[c][c];
    const pentadiagonal_rank inner = factor_rows(m);
    if (inner == RANK_BROKEN) return inner;
    const pentadiagonal_rank border = factor_corner(m, entry);
    return border < inner ? border : inner;
}

void pentadiagonal_solve(const pentadiagonal *m, double *b)
{
    if (m->is_complex) {
        solve(m, b, true);
    } else {
        solve(m, b, false);
    }
}

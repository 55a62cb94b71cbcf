/// Squares the rows into the banded matrix.
//
// Rᵀ W R from the rows, block by block. With A_i = 2 + m_i and B_i = 1 + m_i + p_i the jet row i is
// (B_i, −A_i, 1) on x_{i−1}, x_i, x_{i+1}, so that
//
//     D_k = |A_k|² + |B_{k+1}|² + 1        E_k = −A_k − A_{k+1}* B_{k+1}        F_k = B_{k+1}
//
// minus what rows outside the domain would add. A complex number u + jv is the block (u −v; v u); in the other modes v is 0.
#include "spline/system.h"

static void add_complex(double *at, cplx z) { at[0] += z.re, at[1] -= z.im, at[2] += z.im, at[3] += z.re; }

static inline void put_complex(bool is_complex, double *at, cplx z)
{
    at[0] = z.re;
    if (is_complex) at[1] = -z.im, at[2] = z.im, at[3] = z.re;
}

/// A jet row's weight, and its coefficients −a and b on its sample and the one before; the last sample's includes the tail.
static double jet_row(const system_rows *rows, int i, cplx *a, cplx *b)
{
    const coefficients *at = &rows->at[i];
    *a = coefficients_a(at);
    *b = coefficients_b(at);
    if (!rows->loop && i == rows->count - 1) *a = (cplx){a->re - 1 - rows->tail.re, a->im - rows->tail.im};
    return i >= rows->jet_from && i <= rows->jet_to ? rows->jet_weight[i] : 0;
}

/// The jets' blocks, each written once when the next row is known; in a loop the row after the last is the first.
static inline void jet_rows(const system_rows *rows, pentadiagonal *m, const bool is_complex)
{
    const int n = rows->count, end = rows->loop ? n : n - 1;
    cplx a, b, left = {0, 0}; // w a of the row before
    double before = rows->loop ? rows->jet_weight[n - 1] : 0, own = 0;
    for (int i = 0; i <= end; i++) {
        const double w = jet_row(rows, i < n ? i : 0, &a, &b);
        if (i > 0) {
            double *d = m->diagonal + 3 * (i - 1);
            d[0] = own + w * cplx_norm(b);
            if (is_complex) d[1] = 0, d[2] = d[0];
            put_complex(is_complex, m->below + 4 * (i - 1),
                        cplx_scale(-1, cplx_add(left, cplx_scale(w, cplx_mul(cplx_conj(a), b)))));
            const bool apart = rows->fixed[i < n ? i : 0] & FIXED_STILL || (!rows->loop && i == n - 1);
            put_complex(is_complex, m->below2 + 4 * (i - 1), cplx_scale(apart ? 0 : w, b));
        }
        own = before + w * cplx_norm(a);
        left = cplx_scale(w, a);
        before = w;
    }
    if (rows->loop) return;
    double *d = m->diagonal + 3 * (n - 1);
    d[0] = d[2] = own, d[1] = 0;
    put_complex(is_complex, m->below + 4 * (n - 1), (cplx){0, 0});
    put_complex(is_complex, m->below2 + 4 * (n - 1), (cplx){0, 0});
}

stencil system_slope_stencil(const system_rows *rows, const slope_row *slope)
{
    int n = rows->count, k = slope->sample;
    stencil s = {.before = k > 0        ? k - 1
                           : rows->loop ? n - 1
                                        : -1,
                 .at = k,
                 .after = k < n - 1    ? k + 1
                          : rows->loop ? 0
                                       : -1,
                 .c = {cplx_scale(-1, slope->behind), cplx_add(slope->here, cplx_sub(slope->behind, slope->ahead)),
                       slope->ahead}};
    if (s.after < 0) s.c[1] = cplx_add(s.c[1], cplx_mul(slope->ahead, (cplx){1 + rows->tail.re, rows->tail.im}));
    return s;
}

/// Adds w (Re c z)² of a complex number z: c as the row (c.re, −c.im) of its parts.
static void add_square(double *diagonal, double w, cplx c)
{
    diagonal[0] += w * (c.re * c.re), diagonal[1] -= w * (c.re * c.im), diagonal[2] += w * (c.im * c.im);
}

/// The block of w (Re to·z')(Re from·z), rows z', columns z.
static void add_product(double *block, double w, cplx to, cplx from)
{
    block[0] += w * (to.re * from.re), block[1] -= w * (to.re * from.im);
    block[2] -= w * (to.im * from.re), block[3] += w * (to.im * from.im);
}

static void slope_rows(const system_rows *rows, pentadiagonal *m)
{
    for (int r = 0; r < rows->slope_count; r++) {
        const stencil s = system_slope_stencil(rows, &rows->slopes[r]);
        const double w = rows->slopes[r].weight;
        const int at[3] = {s.before, s.at, s.after};
        for (int i = 0; i < 3; i++) {
            for (int j = 0; at[i] >= 0 && j <= i; j++) {
                if (at[j] < 0) continue;
                double *coupling = i - j == 2 ? m->below2 : m->below;
                if (i == j) {
                    add_square(m->diagonal + 3 * at[i], w, s.c[i]);
                } else {
                    add_product(coupling + 4 * at[j], w, s.c[i], s.c[j]);
                }
            }
        }
    }
}

static void start_rows(const system_rows *rows, pentadiagonal *m)
{
    for (int i = 0; i < 2; i++) {
        const struct start_row *row = &rows->start.row[i];
        if (!(row->weight > 0)) continue;
        cplx on_x1 = row->on_e, on_x0 = cplx_sub(row->on_x, row->on_e);
        bool alone = rows->count == 1;
        if (alone) on_x0 = cplx_add(row->on_x, cplx_mul(row->on_e, rows->tail));
        double w = row->weight, first = w * cplx_norm(on_x0), second = w * cplx_norm(on_x1);
        cplx both = cplx_scale(w, cplx_mul(cplx_conj(on_x1), on_x0));
        m->diagonal[0] += first, m->diagonal[2] += first;
        if (alone) continue;
        m->diagonal[3] += second, m->diagonal[5] += second;
        add_complex(m->below, both);
    }
}

/// Clears row or column `part` (0 re, 1 im) of a 2×2 block.
static void clear_row(double *at, int part) { at[2 * part] = at[2 * part + 1] = 0; }
static void clear_column(double *at, int part) { at[part] = at[2 + part] = 0; }

static void fix(const system_rows *rows, pentadiagonal *m, int k, int part)
{
    int n = rows->count, before = k > 0 ? k - 1 : n - 1, second = before > 0 ? before - 1 : n - 1;
    double *d = m->diagonal + 3 * k;
    d[1] = 0;
    d[2 * part] = 1;
    clear_column(m->below + 4 * k, part);
    clear_column(m->below2 + 4 * k, part);
    if (rows->loop || k > 0) clear_row(m->below + 4 * before, part);
    if (rows->loop || k > 1) clear_row(m->below2 + 4 * second, part);
}

void system_matrix(const system_rows *rows, pentadiagonal *m)
{
    m->count = rows->count;
    m->is_complex = rows->is_complex;
    m->cyclic = rows->loop;
    if (rows->is_complex) {
        jet_rows(rows, m, true);
    } else {
        jet_rows(rows, m, false);
    }
    slope_rows(rows, m);
    start_rows(rows, m);
    for (int k = 0; k < rows->count && rows->is_complex; k++) m->diagonal[3 * k + 2] += rows->im_weight[k];
    for (int k = 0; k < rows->count; k++) {
        if (rows->fixed[k] & FIXED_RE) fix(rows, m, k, 0);
        if (rows->is_complex && rows->fixed[k] & FIXED_IM) fix(rows, m, k, 1);
    }
}

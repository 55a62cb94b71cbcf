/// Squares the rows into the banded matrix.
//
// Rᵀ W R from the rows, block by block. With A_i = 2 + m_i and B_i = 1 + m_i + p_i the jet row i is
// (B_i, −A_i, 1) on x_{i−1}, x_i, x_{i+1}, so that
//
//     D_k = |A_k|² + |B_{k+1}|² + 1        E_k = −A_k − A_{k+1}* B_{k+1}        F_k = B_{k+1}
//
// less what rows outside the domain would have added. A complex number u + jv is the block (u −v; v u).
#include "spline/system.h"
#include <string.h>

static void add_complex(double *at, cplx z) { at[0] += z.re, at[1] -= z.im, at[2] += z.im, at[3] += z.re; }

/// Adds w c* c of a complex row's coefficients to the blocks of its neighbours before … at … after.
static void jet_rows_complex(const system_rows *rows, pentadiagonal *m)
{
    int n = rows->count;
    for (int i = rows->jet_from; i <= rows->jet_to; i++) {
        double w = rows->jet_weight[i];
        cplx a = {2 + rows->at[i].m.re, rows->at[i].m.im};
        cplx b = {a.re - 1 + rows->at[i].p.re, a.im + rows->at[i].p.im};
        bool has_after = rows->loop || i < n - 1, has_before = rows->loop || i > 0;
        if (!has_after) a = (cplx){a.re - 1 - rows->tail.re, a.im - rows->tail.im};
        double aa = w * cplx_norm(a), bb = w * cplx_norm(b);
        cplx ab = cplx_mul(cplx_conj(a), b);
        m->diagonal[3 * i] += aa, m->diagonal[3 * i + 2] += aa;
        if (has_before) {
            int before = i > 0 ? i - 1 : n - 1;
            m->diagonal[3 * before] += bb, m->diagonal[3 * before + 2] += bb;
            add_complex(m->below + 4 * before, cplx_scale(-w, ab));
            if (has_after) add_complex(m->below2 + 4 * before, cplx_scale(w, b));
        }
        if (has_after) {
            int after = i < n - 1 ? i + 1 : 0;
            m->diagonal[3 * after] += w, m->diagonal[3 * after + 2] += w;
            add_complex(m->below + 4 * i, cplx_scale(-w, a));
        }
    }
}

static void jet_rows_real(const system_rows *rows, pentadiagonal *m)
{
    int n = rows->count;
    for (int i = rows->jet_from; i <= rows->jet_to; i++) {
        double w = rows->jet_weight[i], a = 2 + rows->at[i].m.re, b = a - 1 + rows->at[i].p.re;
        bool has_after = rows->loop || i < n - 1, has_before = rows->loop || i > 0;
        if (!has_after) a -= 1 + rows->tail.re;
        m->diagonal[i] += w * (a * a);
        if (has_before) {
            int before = i > 0 ? i - 1 : n - 1;
            m->diagonal[before] += w * (b * b);
            m->below[before] -= w * (a * b);
            if (has_after) m->below2[before] += w * b;
        }
        if (has_after) {
            m->diagonal[i < n - 1 ? i + 1 : 0] += w;
            m->below[i] -= w * a;
        }
    }
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
                if (i == j && rows->is_complex) {
                    add_square(m->diagonal + 3 * at[i], w, s.c[i]);
                } else if (i == j) {
                    m->diagonal[at[i]] += w * (s.c[i].re * s.c[i].re);
                } else if (rows->is_complex) {
                    add_product(coupling + 4 * at[j], w, s.c[i], s.c[j]);
                } else {
                    coupling[at[j]] += w * (s.c[i].re * s.c[j].re);
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
        m->diagonal[0] += first;
        if (rows->is_complex) m->diagonal[2] += first;
        if (alone) continue;
        m->diagonal[rows->is_complex ? 3 : 1] += second;
        if (rows->is_complex) {
            m->diagonal[5] += second;
            add_complex(m->below, both);
        } else {
            m->below[0] += both.re;
        }
    }
}

static void other_rows(const system_rows *rows, pentadiagonal *m)
{
    slope_rows(rows, m);
    start_rows(rows, m);
    for (int k = 0; k < rows->count && rows->is_complex; k++) m->diagonal[3 * k + 2] += rows->im_weight[k];
}

/// Clears row or column `part` (0 re, 1 im) of a 2×2 block.
static void clear_row(double *at, int part) { at[2 * part] = at[2 * part + 1] = 0; }
static void clear_column(double *at, int part) { at[part] = at[2 + part] = 0; }

static void fix_complex(const system_rows *rows, pentadiagonal *m, int k, int part)
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

static void fix_real(const system_rows *rows, pentadiagonal *m, int k)
{
    int n = rows->count, before = k > 0 ? k - 1 : n - 1, second = before > 0 ? before - 1 : n - 1;
    m->diagonal[k] = 1;
    m->below[k] = m->below2[k] = 0;
    if (rows->loop || k > 0) m->below[before] = 0;
    if (rows->loop || k > 1) m->below2[second] = 0;
}

void system_matrix(const system_rows *rows, pentadiagonal *m)
{
    size_t n = (size_t)rows->count;
    m->count = rows->count;
    m->width = rows->is_complex ? 2 : 1;
    m->cyclic = rows->loop;
    memset(m->diagonal, 0, n * sizeof(double) * (rows->is_complex ? 3 : 1));
    memset(m->below, 0, n * sizeof(double) * (rows->is_complex ? 4 : 1));
    memset(m->below2, 0, n * sizeof(double) * (rows->is_complex ? 4 : 1));
    if (rows->is_complex) {
        jet_rows_complex(rows, m);
    } else {
        jet_rows_real(rows, m);
    }
    other_rows(rows, m);
    for (int k = 0; k < rows->count; k++) {
        if (!rows->is_complex && rows->fixed[k] & FIXED_RE) fix_real(rows, m, k);
        if (rows->is_complex && rows->fixed[k] & FIXED_RE) fix_complex(rows, m, k, 0);
        if (rows->is_complex && rows->fixed[k] & FIXED_IM) fix_complex(rows, m, k, 1);
    }
}

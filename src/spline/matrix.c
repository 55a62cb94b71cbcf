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

static void jet_rows_complex(const system_rows *rows, pentadiagonal *m, int from, int to)
{
    int n = rows->count;
    for (int i = from; i <= to; i++) {
        int before = i > 0 ? i - 1 : n - 1, after = i < n - 1 ? i + 1 : 0;
        cplx a = {2 + rows->at[i].m.re, rows->at[i].m.im};
        cplx b = {a.re - 1 + rows->at[i].p.re, a.im + rows->at[i].p.im};
        double aa = cplx_norm(a), bb = cplx_norm(b);
        m->diagonal[3 * before] += bb, m->diagonal[3 * before + 2] += bb;
        m->diagonal[3 * i] += aa, m->diagonal[3 * i + 2] += aa;
        m->diagonal[3 * after] += 1, m->diagonal[3 * after + 2] += 1;
        cplx ab = cplx_mul(cplx_conj(a), b);
        add_complex(m->below + 4 * before, (cplx){-ab.re, -ab.im});
        add_complex(m->below + 4 * i, (cplx){-a.re, -a.im});
        add_complex(m->below2 + 4 * before, b);
    }
}

static void jet_rows_real(const system_rows *rows, pentadiagonal *m, int from, int to)
{
    int n = rows->count;
    for (int i = from; i <= to; i++) {
        int before = i > 0 ? i - 1 : n - 1, after = i < n - 1 ? i + 1 : 0;
        double a = 2 + rows->at[i].m.re, b = a - 1 + rows->at[i].p.re;
        m->diagonal[before] += b * b;
        m->diagonal[i] += a * a;
        m->diagonal[after] += 1;
        m->below[before] -= a * b;
        m->below[i] -= a;
        m->below2[before] += b;
    }
}

static void other_rows(const system_rows *rows, pentadiagonal *m)
{
    int diagonal = rows->is_complex ? 3 : 1, block = rows->is_complex ? 4 : 1;
    for (int s = 0; s < rows->slope_count; s++) {
        const slope_row *row = &rows->slopes[s];
        m->diagonal[diagonal * row->p] += row->weight;
        m->diagonal[diagonal * row->q] += row->weight;
        m->below[block * row->p] -= row->weight;
    }
    if (rows->start.h00 > 0) {
        cplx l = {rows->start.e.re - 1, rows->start.e.im}; // h00 |x0 + l x1|² + d |x1|²
        double h00 = rows->start.h00, h11 = h00 * cplx_norm(l) + rows->start.d;
        m->diagonal[0] += h00;
        m->diagonal[diagonal] += h11;
        if (rows->is_complex) {
            m->diagonal[2] += h00;
            m->diagonal[diagonal + 2] += h11;
            add_complex(m->below, (cplx){h00 * l.re, -h00 * l.im});
        } else {
            m->below[0] += h00 * l.re;
        }
    }
    if (rows->is_complex) {
        for (int k = 0; k < rows->count; k++) m->diagonal[3 * k + 2] += rows->im_weight[k];
    }
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
    int from = rows->loop ? 0 : 1, to = rows->loop ? rows->count - 1 : rows->count - 2;
    if (rows->is_complex) {
        jet_rows_complex(rows, m, from, to);
    } else {
        jet_rows_real(rows, m, from, to);
    }
    other_rows(rows, m);
    for (int k = 0; k < rows->count; k++) {
        if (!rows->is_complex && rows->fixed[k] & FIXED_RE) fix_real(rows, m, k);
        if (rows->is_complex && rows->fixed[k] & FIXED_RE) fix_complex(rows, m, k, 0);
        if (rows->is_complex && rows->fixed[k] & FIXED_IM) fix_complex(rows, m, k, 1);
    }
}

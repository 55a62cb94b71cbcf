/// Squares the rows into the band (the normal equations of eq. 6, 9 and 25).
//
// Rᵀ W R from the rows, block by block. With A_i = 2 + m_i and B_i = 1 + m_i + p_i the jet row i is
// (B_i, −A_i, 1) on x_{i−1}, x_i, x_{i+1}, so that
//
//     D_k = |A_k|² + |B_{k+1}|² + 1        E_k = −A_k − A_{k+1}* B_{k+1}        F_k = B_{k+1}
//
// of weighted rows. With constant poles all samples share one block; only those beside an end, a slope or a still knot have their own.
#include "maths/wide.h"
#include "spline/system.h"
#include <string.h>

jet_row system_jet(const system_rows *rows, int i)
{
    const coefficients at = system_coefficients(rows, i);
    const cplx a = coefficients_a(&at);
    jet_row row = {.own = {-a.re, -a.im}, .before = coefficients_b(&at)};
    if (rows->fixed[i] & FIXED_STILL) {
        row.own.re += 1;
    } else if (!rows->loop && i == rows->count - 1) {
        row.own = cplx_add(row.own, (cplx){1 + rows->tail.re, rows->tail.im});
    }
    if (i < rows->jet_from || i > rows->jet_to) return row;
    row.weight = rows->is_constant ? 1 : rows->jet_weight[i];
    if (rows->fixed[i] & JET_TWICE) row.weight *= 2;
    return row;
}

static void put_complex(double *at, cplx z) { at[0] += z.re, at[1] -= z.im, at[2] += z.im, at[3] += z.re; }

/// The jets' part of the blocks of a sample and those beside it, from the rows around each.
static void set_own_around(const system_rows *rows, band_matrix *m, int i)
{
    for (int by = -1; by <= 1; by++) {
        const int k = system_beside(rows, i, by);
        if (k < 0 || m->marks[k] & BAND_OWN) continue;
        band_block *block = band_own(m, k);
        const int next = system_beside(rows, k, 1), before = system_beside(rows, k, -1);
        const jet_row own = system_jet(rows, k);
        double d = own.weight * cplx_norm(own.own);
        *block = (band_block){.d = {0}};
        if (before >= 0) d += system_jet(rows, before).weight;
        if (next >= 0) {
            const jet_row after = system_jet(rows, next);
            const bool ends = !rows->loop && next == rows->count - 1, still = rows->fixed[k] & FIXED_STILL;
            d += after.weight * cplx_norm(after.before);
            put_complex(block->e, cplx_scale(after.weight, cplx_mul(cplx_conj(after.own), after.before)));
            put_complex(block->e, cplx_scale(own.weight, still ? (cplx){-1, 0} : own.own));
            if (!ends && !(rows->fixed[next] & FIXED_STILL))
                put_complex(block->f, cplx_scale(after.weight, after.before));
        }
        block->d[0] = block->d[2] = d;
        if (rows->is_complex) block->d[2] += rows->is_constant ? rows->own_im : rows->im_weight[k];
    }
}

stencil system_slope_stencil(const system_rows *rows, const slope_row *slope)
{
    const int k = slope->sample;
    stencil s = {.at = {system_beside(rows, k, -1), k, system_beside(rows, k, 1)},
                 .c = {cplx_scale(-1, slope->behind), cplx_add(slope->here, cplx_sub(slope->behind, slope->ahead)),
                       slope->ahead}};
    if (s.at[2] < 0) s.c[1] = cplx_add(s.c[1], cplx_mul(slope->ahead, (cplx){1 + rows->tail.re, rows->tail.im}));
    return s;
}

/// Adds w (Re c z)² of a complex number z: c as the row (c.re, −c.im) of its parts.
static void add_square(double *diagonal, double w, cplx c)
{
    diagonal[0] += w * (c.re * c.re), diagonal[1] -= w * (c.re * c.im), diagonal[2] += w * (c.im * c.im);
}

/// The blocks of varying rows, as if all around them were jets of the usual kind.
WIDEST static void square(int count, const double *restrict mr, const double *restrict mi, const double *restrict pr,
                          const double *restrict pi, const double *restrict w, double *restrict d,
                          double *restrict e_re, double *restrict e_im, double *restrict f_re, double *restrict f_im)
{
    for (int k = 0; k < count; k++) {
        const double a = 2 + mr[k], ai = mi[k];
        const double c = 2 + mr[k + 1], ci = mi[k + 1], b = (c - 1) + pr[k + 1], bi = ci + pi[k + 1];
        const double own = w[k], next = w[k + 1];
        d[k] = own * (a * a + ai * ai) + next * (b * b + bi * bi) + (k > 0 ? w[k - 1] : 0);
        f_re[k] = next * b, f_im[k] = next * bi;
        e_re[k] = -(own * a + next * (c * b + ci * bi));
        e_im[k] = -(own * ai + next * (c * bi - ci * b));
    }
}

void system_matrix(const system_rows *rows, band_matrix *m)
{
    const int n = rows->count;
    m->count = n;
    m->is_complex = rows->is_complex;
    m->cyclic = rows->loop;
    m->is_alike = rows->is_constant;
    m->is_kept = false;
    m->marks = rows->fixed;
    m->im_weight = rows->is_complex && !rows->is_constant ? rows->im_weight : NULL;
    m->stiffness = NULL;
    for (int k = 0; k < n; k++) rows->fixed[k] &= (unsigned char)~(BAND_OWN | BAND_BESIDE);
    if (rows->is_constant) {
        const cplx a = coefficients_a(&rows->own), b = coefficients_b(&rows->own);
        m->alike = (band_block){.d = {0}};
        m->alike.d[0] = m->alike.d[2] = cplx_norm(a) + cplx_norm(b) + 1;
        put_complex(m->alike.e, cplx_scale(-1, cplx_add(a, cplx_mul(cplx_conj(a), b))));
        put_complex(m->alike.f, b);
        if (rows->is_complex) m->alike.d[2] += rows->own_im;
    } else if (n > 1) {
        square(n - 1, rows->m_re, rows->m_im, rows->p_re, rows->p_im, rows->jet_weight, m->d, m->e_re, m->e_im,
               m->f_re, m->f_im);
    }
    for (int k = 0; k < n && !rows->loop; k++) { // the rows beside an end
        if (k <= rows->jet_from || k >= rows->jet_to) set_own_around(rows, m, k);
        if (k == rows->jet_from && k < rows->jet_to) k = rows->jet_to - 1;
    }
    const bool each = rows->fast && !rows->is_constant;
    for (int k = 0; k < n; k++) {
        if (each || rows->fixed[k] & (FIXED_STILL | JET_TWICE)) set_own_around(rows, m, k);
    }
    if (rows->loop && !rows->is_constant) set_own_around(rows, m, 0), set_own_around(rows, m, n - 1);
    for (int r = 0; r < rows->slope_count; r++) { // the slopes (eq. 9)
        const stencil s = system_slope_stencil(rows, &rows->slopes[r]);
        const double w = rows->slopes[r].weight;
        for (int pair = 0; pair < 9; pair++) {
            const int i = pair / 3, j = pair % 3;
            if (j > i || s.at[i] < 0 || s.at[j] < 0) continue;
            band_block *block = band_own(m, s.at[j]);
            if (i == j) {
                add_square(block->d, w, s.c[i]);
            } else {
                double *c = i - j == 2 ? block->f : block->e; // w (Re to·z')(Re from·z), rows z', columns z
                const cplx to = s.c[i], from = s.c[j];
                c[0] += w * (to.re * from.re), c[1] -= w * (to.re * from.im);
                c[2] -= w * (to.im * from.re), c[3] += w * (to.im * from.im);
            }
        }
    }
    for (int i = 0; i < 2; i++) { // the start's rows
        const struct start_row *row = &rows->start.row[i];
        if (!(row->weight > 0)) continue;
        const cplx on_x0 = system_start_on_x(rows, row);
        band_block *block = band_own(m, 0);
        const double first = row->weight * cplx_norm(on_x0), second = row->weight * cplx_norm(row->on_e);
        block->d[0] += first, block->d[2] += first;
        if (n == 1) continue;
        put_complex(block->e, cplx_scale(row->weight, cplx_mul(cplx_conj(row->on_e), on_x0)));
        block = band_own(m, 1);
        block->d[0] += second, block->d[2] += second;
    }
}

/// How hard the energy pulls at one sample: the multiplier of what holds it there.
#include "spline/system.h"

typedef struct view {
    const system_rows *rows;
    const double *re, *im;
} view;

/// x of a sample and beyond the ends: a loop wraps, before is nothing, behind what moves by itself.
static cplx x_at(const view *v, int k)
{
    const system_rows *rows = v->rows;
    if (rows->loop) k = (k + rows->count) % rows->count;
    if (k < 0) return (cplx){0, 0};
    int at = k < rows->count ? k : rows->count - 1;
    cplx x = {v->re[at], v->im ? v->im[at] : 0};
    return k < rows->count ? x : cplx_add(x, cplx_mul(rows->tail, x));
}

/// Re(conj(c) z).
static double along(cplx c, cplx z) { return c.re * z.re + c.im * z.im; }

static cplx jet_at(const view *v, int row)
{
    const coefficients *at = &v->rows->at[row];
    cplx before = x_at(v, row - 1), here = x_at(v, row), after = x_at(v, row + 1), step = cplx_sub(here, before);
    return cplx_add(cplx_add(cplx_sub(cplx_sub(after, here), step), v->rows->drive[row]),
                    cplx_sub(cplx_mul(at->p, before), cplx_mul(at->m, step)));
}

static double jet_pull(const view *v, int i, int k)
{
    const system_rows *rows = v->rows;
    int row = rows->loop ? (i + rows->count) % rows->count : i;
    if (row < rows->jet_from || row > rows->jet_to) return 0;
    const coefficients *at = &rows->at[row];
    cplx r = jet_at(v, row);
    cplx by = {1, 0};
    if (k == i) by = (cplx){-2 - at->m.re, -at->m.im};
    if (k == i && !rows->loop && i == rows->count - 1) by = cplx_add(by, (cplx){1 + rows->tail.re, rows->tail.im});
    if (k == i + 1) by = (cplx){1, 0};
    if (k == i - 1) by = (cplx){1 + at->m.re + at->p.re, at->m.im + at->p.im};
    return rows->jet_weight[row] * along(by, r);
}

/// What a slope misses its target by; `by` is how much of that comes from Re x of sample k.
static double slope_miss(const view *v, const slope_row *slope, int k, double *by)
{
    const stencil s = system_slope_stencil(v->rows, slope);
    const int at[3] = {s.before, s.at, s.after};
    double seen = 0;
    *by = 0;
    for (int i = 0; i < 3; i++) {
        if (at[i] < 0) continue;
        seen += along(cplx_conj(s.c[i]), x_at(v, at[i]));
        if (at[i] == k) *by += s.c[i].re;
    }
    return seen - slope->target;
}

static double slope_pull(const view *v, const slope_row *slope, int k)
{
    double by, miss = slope_miss(v, slope, k, &by);
    return slope->weight * by * miss;
}

static cplx start_at(const view *v, const struct start_row *row)
{
    cplx x = x_at(v, 0), e = cplx_sub(x_at(v, 1), x);
    return cplx_add(cplx_mul(row->on_x, x), cplx_mul(row->on_e, e));
}

static double start_pull(const view *v, int k)
{
    double sum = 0;
    for (int i = 0; i < 2 && k < 2; i++) {
        const struct start_row *row = &v->rows->start.row[i];
        cplx by = k == 1 ? row->on_e : cplx_sub(row->on_x, row->on_e);
        sum += row->weight * along(by, start_at(v, row));
    }
    return sum;
}

double system_pull(const system_rows *rows, const double *re, const double *im, int k)
{
    view v = {rows, re, im};
    double sum = rows->loop ? 0 : start_pull(&v, k);
    for (int i = k - 1; i <= k + 1; i++) sum += jet_pull(&v, i, k);
    for (int s = 0; s < rows->slope_count; s++) {
        int apart = rows->slopes[s].sample - k;
        bool beside = apart >= -1 && apart <= 1,
             wraps = rows->loop && (apart == rows->count - 1 || apart == 1 - rows->count);
        if (beside || wraps) sum += slope_pull(&v, &rows->slopes[s], k);
    }
    return -sum;
}

/// The gradient through the un-squared rows, in double-double.
//
// The gradient −½ ∇(E·h³) = −Rᵀ W (R x − d) at a given x, where the rows R are never squared.
//
//     r_i = [(x_{i+1} − x_i) − (x_i − x_{i−1})] − m_i (x_i − x_{i−1}) + p_i x_{i−1} + f_i
//     g_k = −[r_{k−1} − 2r_k + r_{k+1}] + m_k* r_k − (m_{k+1} + p_{k+1})* r_{k+1}
//
// Both are sums of nearly equal numbers: over a gap of G samples r is G² times smaller than x, and g again than r. In
// double-double the cancellation leaves full double precision for any G that a double can count.
#include "spline/dd.h"
#include "spline/system.h"

typedef struct ddc {
    dd re, im;
} ddc;

/// z·w for a double z.
static inline ddc ddc_scale(cplx z, ddc w)
{
    return (ddc){dd_subtract(dd_scale(z.re, w.re), dd_scale(z.im, w.im)),
                 dd_add(dd_scale(z.re, w.im), dd_scale(z.im, w.re))};
}

static inline ddc ddc_add(ddc a, ddc b) { return (ddc){dd_add(a.re, b.re), dd_add(a.im, b.im)}; }
static inline ddc ddc_subtract(ddc a, ddc b) { return (ddc){dd_subtract(a.re, b.re), dd_subtract(a.im, b.im)}; }

static inline ddc complex_jet(const system_rows *rows, int before, int i, int after)
{
    const double *x = rows->x;
    ddc step = {dd_difference(x[2 * i], x[2 * before]), dd_difference(x[2 * i + 1], x[2 * before + 1])};
    ddc next = {dd_difference(x[2 * after], x[2 * i]), dd_difference(x[2 * after + 1], x[2 * i + 1])};
    ddc base = {dd_from(x[2 * before]), dd_from(x[2 * before + 1])};
    ddc spring = ddc_subtract(ddc_scale(rows->at[i].p, base), ddc_scale(rows->at[i].m, step));
    ddc drive = {dd_from(rows->drive[i].re), dd_from(rows->drive[i].im)};
    return ddc_add(ddc_subtract(next, step), ddc_add(spring, drive));
}

static inline dd real_jet(const system_rows *rows, int before, int i, int after)
{
    const double *x = rows->x;
    dd step = dd_difference(x[i], x[before]), next = dd_difference(x[after], x[i]);
    dd spring = dd_subtract(dd_product(rows->at[i].p.re, x[before]), dd_scale(rows->at[i].m.re, step));
    return dd_add(dd_subtract(next, step), dd_add(spring, dd_from(rows->drive[i].re)));
}

static const ddc no_jet = {{0, 0}, {0, 0}};

static inline ddc complex_jet_at(const system_rows *rows, int i)
{
    const double *j = rows->jet + 4 * i;
    return (ddc){{j[0], j[1]}, {j[2], j[3]}};
}

static inline dd real_jet_at(const system_rows *rows, int i) { return (dd){rows->jet[2 * i], rows->jet[2 * i + 1]}; }

static void complex_jets(const system_rows *rows, int from, int to)
{
    int last = rows->count - 1;
    for (int i = from; i <= to; i++) {
        ddc r = complex_jet(rows, i > 0 ? i - 1 : last, i, i < last ? i + 1 : 0);
        double *j = rows->jet + 4 * i;
        j[0] = r.re.hi, j[1] = r.re.lo, j[2] = r.im.hi, j[3] = r.im.lo;
    }
}

static void real_jets(const system_rows *rows, int from, int to)
{
    int last = rows->count - 1;
    for (int i = from; i <= to; i++) {
        dd r = real_jet(rows, i > 0 ? i - 1 : last, i, i < last ? i + 1 : 0);
        rows->jet[2 * i] = r.hi;
        rows->jet[2 * i + 1] = r.lo;
    }
}

/// g = −(before − 2·here + after) + m* here − (m+p)* after, where the neighbours' rows exist.
static void complex_adjoint(const system_rows *rows, int from, int to)
{
    int last = rows->count - 1;
    for (int k = 0; k <= last; k++) {
        int b = k > 0 ? k - 1 : last, a = k < last ? k + 1 : 0;
        bool has_b = rows->loop || (k > 0 && b >= from && b <= to),
             has_a = rows->loop || (k < last && a >= from && a <= to);
        ddc before = has_b ? complex_jet_at(rows, b) : no_jet, after = has_a ? complex_jet_at(rows, a) : no_jet;
        ddc here = k >= from && k <= to ? complex_jet_at(rows, k) : no_jet;
        ddc second = ddc_subtract(ddc_subtract(before, here), ddc_subtract(here, after));
        ddc g = ddc_subtract(ddc_scale(cplx_conj(rows->at[k].m), here), second);
        if (has_a) {
            g = ddc_subtract(
                g, ddc_add(ddc_scale(cplx_conj(rows->at[a].m), after), ddc_scale(cplx_conj(rows->at[a].p), after)));
        }
        rows->gradient[2 * k] = g.re.hi + g.re.lo;
        rows->gradient[2 * k + 1] = g.im.hi + g.im.lo;
    }
}

static void real_adjoint(const system_rows *rows, int from, int to)
{
    int last = rows->count - 1;
    for (int k = 0; k <= last; k++) {
        int b = k > 0 ? k - 1 : last, a = k < last ? k + 1 : 0;
        bool has_b = rows->loop || (k > 0 && b >= from && b <= to),
             has_a = rows->loop || (k < last && a >= from && a <= to);
        dd before = has_b ? real_jet_at(rows, b) : no_jet.re, after = has_a ? real_jet_at(rows, a) : no_jet.re;
        dd here = k >= from && k <= to ? real_jet_at(rows, k) : no_jet.re;
        dd second = dd_subtract(dd_subtract(before, here), dd_subtract(here, after));
        dd g = dd_subtract(dd_scale(rows->at[k].m.re, here), second);
        if (has_a) g = dd_subtract(g, dd_add(dd_scale(rows->at[a].m.re, after), dd_scale(rows->at[a].p.re, after)));
        rows->gradient[k] = g.hi + g.lo;
    }
}

/// Slope, start and imaginary rows: a handful of terms without cancellation between samples.
static void add_other_rows(const system_rows *rows)
{
    int width = rows->is_complex ? 2 : 1;
    double *g = rows->gradient, *x = rows->x;
    for (int s = 0; s < rows->slope_count; s++) {
        const slope_row *row = &rows->slopes[s];
        double miss = row->weight * (x[width * row->q] - x[width * row->p] - row->target);
        g[width * row->q] -= miss;
        g[width * row->p] += miss;
    }
    if (rows->start.h00 > 0) {
        cplx x0 = {x[0], rows->is_complex ? x[1] : 0}, x1 = {x[width], rows->is_complex ? x[3] : 0};
        cplx ex = cplx_mul(rows->start.e, x1);
        cplx cost = {rows->start.h00 * (x0.re - x1.re + ex.re), rows->start.h00 * (x0.im - x1.im + ex.im)};
        cplx back = cplx_mul(cplx_conj(rows->start.e), cost);
        g[0] -= cost.re;
        g[width] += cost.re - back.re - rows->start.d * x1.re;
        if (rows->is_complex) {
            g[1] -= cost.im;
            g[3] += cost.im - back.im - rows->start.d * x1.im;
        }
    }
    if (rows->is_complex) {
        for (int k = 0; k < rows->count; k++) g[2 * k + 1] -= rows->im_weight[k] * x[2 * k + 1];
    }
}

void system_gradient(const system_rows *rows)
{
    int from = rows->loop ? 0 : 1, to = rows->loop ? rows->count - 1 : rows->count - 2;
    if (rows->is_complex) {
        complex_jets(rows, from, to);
        complex_adjoint(rows, from, to);
    } else {
        real_jets(rows, from, to);
        real_adjoint(rows, from, to);
    }
    add_other_rows(rows);
    for (int k = 0; k < rows->count; k++) {
        if (rows->is_complex) {
            if (rows->fixed[k] & FIXED_RE) rows->gradient[2 * k] = 0;
            if (rows->fixed[k] & FIXED_IM) rows->gradient[2 * k + 1] = 0;
        } else if (rows->fixed[k] & FIXED_RE) {
            rows->gradient[k] = 0;
        }
    }
}

/// The gradient through the un-squared rows, in double-double.
//
// The gradient −½ ∇(E·h³) = −Rᵀ W (R x − d) at a given x, where the rows R are never squared.
//
//     r_i = [(x_{i+1} − x_i) − (x_i − x_{i−1})] − m_i (x_i − x_{i−1}) + p_i x_{i−1} + f_i
//     g_k = −[j_{k−1} − 2j_k + j_{k+1}] + m_k* j_k − (m_{k+1} + p_{k+1})* j_{k+1},   j = w r
//
// Both are sums of nearly equal numbers: over a gap of G samples r is G² times smaller than x, and g again than r. In
// double-double the cancellation leaves full double precision for any G that a double can count.
#include "spline/dd.h"
#include "spline/system.h"
#include <string.h>

typedef struct ddc {
    dd re, im;
} ddc;

static inline ddc ddc_from(cplx z) { return (ddc){dd_from(z.re), dd_from(z.im)}; }

/// z·w for a double z.
static inline ddc ddc_scale(cplx z, ddc w)
{
    return (ddc){dd_subtract(dd_scale(z.re, w.re), dd_scale(z.im, w.im)),
                 dd_add(dd_scale(z.re, w.im), dd_scale(z.im, w.re))};
}

static inline ddc ddc_weigh(double w, ddc z) { return (ddc){dd_scale(w, z.re), dd_scale(w, z.im)}; }

static inline ddc ddc_add(ddc a, ddc b) { return (ddc){dd_add(a.re, b.re), dd_add(a.im, b.im)}; }
static inline ddc ddc_subtract(ddc a, ddc b) { return (ddc){dd_subtract(a.re, b.re), dd_subtract(a.im, b.im)}; }

/// A sample of x; 0 before the first, the tail after the last.
static inline cplx sample_of(const system_rows *rows, int k)
{
    int last = rows->count - 1;
    if (rows->loop) k = k < 0 ? last : k > last ? 0 : k;
    if (k < 0) return (cplx){0, 0};
    if (k > last) k = last;
    return (cplx){rows->x[2 * k], rows->x[2 * k + 1]};
}

/// f_i. In a slow loop the sum of all is almost 0, so not even their rounding may remain.
static inline ddc drive_of(const system_rows *rows, int i)
{
    const int last = rows->count - 1;
    const cplx plain = rows->drive[i];
    if (!rows->driven || (!rows->loop && (i == 0 || i == last))) return ddc_from(plain);
    const double *y = rows->driven, here = y[i];
    const dd ahead = dd_difference(y[i < last ? i + 1 : 0], here),
             behind = dd_difference(here, y[i > 0 ? i - 1 : last]);
    const dd bend = dd_subtract(ahead, behind);
    return (ddc){dd_scale(rows->at[i].g.re, bend), dd_scale(rows->at[i].g.im, bend)};
}

static inline ddc jet_of(const system_rows *rows, int i)
{
    cplx before = sample_of(rows, i - 1), here = sample_of(rows, i), after = sample_of(rows, i + 1);
    if (rows->fixed[i] & FIXED_STILL) after = here;
    ddc step = {dd_difference(here.re, before.re), dd_difference(here.im, before.im)};
    ddc next = {dd_difference(after.re, here.re), dd_difference(after.im, here.im)};
    if (!rows->loop && i == rows->count - 1) next = ddc_scale(rows->tail, ddc_from(here));
    ddc base = {dd_from(before.re), dd_from(before.im)};
    ddc spring = ddc_subtract(ddc_scale(rows->at[i].p, base), ddc_scale(rows->at[i].m, step));
    if (rows->fast) {
        ddc own = ddc_scale(rows->at[i].a_rest, ddc_from(here));
        spring = ddc_add(spring, ddc_subtract(ddc_scale(rows->at[i].b_rest, base), own));
    }
    return ddc_add(ddc_subtract(next, step), ddc_add(spring, drive_of(rows, i)));
}

static const ddc no_jet = {{0, 0}, {0, 0}};

static inline ddc jet_at(const system_rows *rows, int i)
{
    const double *j = rows->jet + 4 * i;
    return (ddc){{j[0], j[1]}, {j[2], j[3]}};
}

static void set_jets(const system_rows *rows)
{
    for (int i = rows->jet_from; i <= rows->jet_to; i++) {
        const ddc r = ddc_weigh(rows->jet_weight[i], jet_of(rows, i));
        double *j = rows->jet + 4 * i;
        j[0] = r.re.hi, j[1] = r.re.lo, j[2] = r.im.hi, j[3] = r.im.lo;
    }
}

/// The jet that starts from rest at the still sample before k.
static inline ddc jet_from_rest(const system_rows *rows, int k)
{
    const cplx from = sample_of(rows, k - 1), to = sample_of(rows, k);
    const double weight = rows->jet_weight[k > 0 ? k - 1 : rows->count - 1];
    return ddc_weigh(weight, (ddc){dd_difference(to.re, from.re), dd_difference(to.im, from.im)});
}

/// The index of the jet at k, or -1.
static inline int jet_beside(const system_rows *rows, int i)
{
    if (rows->loop) return i < 0 ? rows->count - 1 : i >= rows->count ? 0 : i;
    return i >= rows->jet_from && i <= rows->jet_to ? i : -1;
}

/// g = −(before − 2·here + after) + m* here − (m+p)* after, with 0 for missing rows; the tail's row has a smaller coefficient on the last
/// sample.
static void set_adjoint(const system_rows *rows)
{
    for (int k = 0; k < rows->count; k++) {
        int b = jet_beside(rows, k - 1), a = jet_beside(rows, k + 1), h = jet_beside(rows, k);
        ddc before = b >= 0 ? jet_at(rows, b) : no_jet, after = a >= 0 ? jet_at(rows, a) : no_jet;
        if (b >= 0 && rows->fixed[b] & FIXED_STILL) before = jet_from_rest(rows, k);
        ddc here = h >= 0 ? jet_at(rows, h) : no_jet;
        ddc second = ddc_subtract(ddc_subtract(before, here), ddc_subtract(here, after));
        ddc g = ddc_subtract(ddc_scale(cplx_conj(rows->at[k].m), here), second);
        if (a >= 0) {
            g = ddc_subtract(
                g, ddc_add(ddc_scale(cplx_conj(rows->at[a].m), after), ddc_scale(cplx_conj(rows->at[a].p), after)));
        }
        if (rows->fast) {
            g = ddc_add(g, ddc_scale(cplx_conj(rows->at[k].a_rest), here));
            if (a >= 0) g = ddc_subtract(g, ddc_scale(cplx_conj(rows->at[a].b_rest), after));
        }
        if (!rows->loop && k == rows->count - 1)
            g = ddc_subtract(g, ddc_add(here, ddc_scale(cplx_conj(rows->tail), here)));
        rows->gradient[2 * k] = g.re.hi + g.re.lo;
        rows->gradient[2 * k + 1] = g.im.hi + g.im.lo;
    }
}

/// Re(c x_j).
static double part_of(const system_rows *rows, cplx c, int j)
{
    if (j < 0) return 0;
    return c.re * rows->x[2 * j] - c.im * rows->x[2 * j + 1];
}

/// Subtracts w Re(c* …) from the gradient at a sample.
static void pull_back(const system_rows *rows, cplx c, int j, double miss)
{
    if (j < 0) return;
    rows->gradient[2 * j] -= c.re * miss;
    rows->gradient[2 * j + 1] += c.im * miss;
}

static void add_slopes(const system_rows *rows)
{
    for (int r = 0; r < rows->slope_count; r++) {
        const slope_row *slope = &rows->slopes[r];
        const stencil s = system_slope_stencil(rows, slope);
        double seen = part_of(rows, s.c[0], s.before) + part_of(rows, s.c[1], s.at) + part_of(rows, s.c[2], s.after);
        double miss = slope->weight * (seen - slope->target);
        pull_back(rows, s.c[0], s.before, miss);
        pull_back(rows, s.c[1], s.at, miss);
        pull_back(rows, s.c[2], s.after, miss);
    }
}

static void add_start(const system_rows *rows)
{
    bool alone = rows->count == 1;
    const double *x = rows->x;
    double *g = rows->gradient;
    cplx x0 = {x[0], x[1]}, e0 = cplx_mul(rows->tail, x0);
    if (!alone) e0 = cplx_sub((cplx){x[2], x[3]}, x0);
    for (int i = 0; i < 2; i++) {
        const struct start_row *row = &rows->start.row[i];
        if (!(row->weight > 0)) continue;
        cplx cost = cplx_scale(row->weight, cplx_add(cplx_mul(row->on_x, x0), cplx_mul(row->on_e, e0)));
        cplx on_x = cplx_mul(cplx_conj(row->on_x), cost), on_e = cplx_mul(cplx_conj(row->on_e), cost);
        cplx back = alone ? cplx_mul(cplx_conj(rows->tail), on_e) : cplx_scale(-1, on_e);
        g[0] -= on_x.re + back.re, g[1] -= on_x.im + back.im;
        if (!alone) g[2] -= on_e.re, g[3] -= on_e.im;
    }
}

static void add_pulls(const system_rows *rows)
{
    for (int i = 0; rows->pulls && i < rows->pulls->count; i++) {
        int k = rows->pulls->sample[i] - rows->first;
        rows->gradient[2 * k] += rows->pulls->pull[i].re;
        rows->gradient[2 * k + 1] += rows->pulls->pull[i].im;
    }
}

/// Slope, start and imaginary rows, and pulls: few terms, without cancellation between samples.
static void add_other_rows(const system_rows *rows)
{
    add_pulls(rows);
    add_slopes(rows);
    add_start(rows);
    for (int k = 0; k < rows->count; k++) rows->gradient[2 * k + 1] -= rows->im_weight[k] * rows->x[2 * k + 1];
}

/// Fixed unknowns have no gradient.
static void hold_fixed(const system_rows *rows)
{
    for (int k = 0; k < rows->count; k++) {
        if (rows->fixed[k] & FIXED_RE) rows->gradient[2 * k] = 0;
        if (rows->fixed[k] & FIXED_IM) rows->gradient[2 * k + 1] = 0;
    }
}

/// Subtracts w c* r from the gradient at a sample.
static inline void pull_jet(const system_rows *rows, int k, cplx c, cplx r)
{
    cplx pulled = cplx_mul(cplx_conj(c), r);
    rows->gradient[2 * k] -= pulled.re, rows->gradient[2 * k + 1] -= pulled.im;
}

static cplx before_of(const coefficients *at)
{
    return (cplx){1 + at->m.re + at->p.re + at->b_rest.re, at->m.im + at->p.im + at->b_rest.im};
}

static bool is_zero(cplx z) { return z.re == 0 && z.im == 0; }

/// The jets at x in plain double; far from known values and drives they are 0.
static void pull_plainly(const system_rows *rows)
{
    const int last = rows->count - 1;
    cplx before, here = sample_of(rows, rows->jet_from - 1), after = sample_of(rows, rows->jet_from);
    for (int i = rows->jet_from; i <= rows->jet_to; i++) {
        const coefficients *at = &rows->at[i];
        before = here, here = after, after = sample_of(rows, i + 1);
        if (is_zero(before) && is_zero(here) && is_zero(after) && is_zero(rows->drive[i])) continue;
        const bool is_tail = !rows->loop && i == last, is_still = rows->fixed[i] & FIXED_STILL;
        const cplx step = cplx_sub(here, before), ahead = cplx_sub(after, here);
        const cplx next = is_still ? (cplx){0, 0} : is_tail ? cplx_mul(rows->tail, here) : ahead;
        cplx r = cplx_add(cplx_add(cplx_sub(next, step), rows->drive[i]),
                          cplx_sub(cplx_mul(at->p, before), cplx_mul(at->m, step)));
        if (rows->fast) r = cplx_add(r, cplx_sub(cplx_mul(at->b_rest, before), cplx_mul(at->a_rest, here)));
        r = cplx_scale(rows->jet_weight[i], r);
        cplx middle = cplx_scale(-1, coefficients_a(at));
        if (is_tail) middle = cplx_add(middle, (cplx){1 + rows->tail.re, rows->tail.im});
        pull_jet(rows, i, middle, r);
        if (i > 0 || rows->loop) pull_jet(rows, i > 0 ? i - 1 : last, before_of(at), r);
        if (is_still) r = cplx_scale(rows->jet_weight[i], ahead);
        if (i < last || rows->loop) pull_jet(rows, i < last ? i + 1 : 0, (cplx){1, 0}, r);
    }
}

void system_forget_known(system_rows *rows)
{
    rows->driven = NULL;
    memset(rows->x, 0, sizeof *rows->x * 2 * (size_t)rows->count);
    memset(rows->drive, 0, sizeof *rows->drive * (size_t)rows->count);
    for (int i = 0; i < rows->slope_count; i++) rows->slopes[i].target = 0;
}

void system_forces(const system_rows *rows)
{
    memset(rows->gradient, 0, sizeof *rows->gradient * 2 * (size_t)rows->count);
    pull_plainly(rows);
    add_other_rows(rows);
}

void system_right_side(const system_rows *rows)
{
    system_forces(rows);
    hold_fixed(rows);
}

void system_gradient(const system_rows *rows)
{
    set_jets(rows);
    set_adjoint(rows);
    add_other_rows(rows);
    hold_fixed(rows);
}

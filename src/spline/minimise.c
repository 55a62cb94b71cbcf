/// Minimises E with the band, and bounds what rounding has done to the answer.
//
// The squared matrix is factored in double, and its solution corrected once by the gradient through the unsquared rows. With
// D = diag A⁻¹ every x_k is within
//
//     √D_k ( ‖δ‖ ρ / (1 − ρ)  +  ‖W^½ (ΔR x − Δd)‖  +  Σ_j √D_j (|ΔR|ᵀ W |r|)_j ),        ‖δ‖² = g A⁻¹ g of the last correction,
//
// of the minimum, by Cauchy and Schwarz in the norm of the energy. The first term is what the factor's own rounding leaves of a correction;
// ρ = 80 ε Σ D_k A_kk bounds it, in the trace. The others are what the rounding of the rows' coefficients, of the targets and of the known
// values may be, and does to x. No number here is fitted. (A factor of the rows themselves, for which ρ has a root
// inside the sum, is used where ρ would be too large; and where it still is, nothing is known.)
//
// An error e of the response u moves the targets of w, and adds itself to the total. But what of e is a free motion, w takes back: the error of
// u + w is the x that is 0 at the knots and minimises ‖W^½ R (x − e)‖, so it is within √D ‖W^½ R e‖ (forced_response.c), and outside the system
// within twice e more. The smaller of the two counts.
#include "maths/wide.h"
#include "spline/solver.h"
#include <float.h>
#include <math.h>
#include <string.h>

// --- the gradient through the un-squared rows
//
// The gradient −½ ∇(E·h³) = −Rᵀ W (R x − d) at a given x, where the rows R are never squared.
//
//     r_i = [(x_{i+1} − x_i) − (x_i − x_{i−1})] − m_i (x_i − x_{i−1}) + p_i x_{i−1} + f_i                       (eq. 25)
//     g_k = −[j_{k−1} − 2j_k + j_{k+1}] + m_k* j_k − (m_{k+1} + p_{k+1})* j_{k+1},   j = w r
//
// The differences are those of near numbers, so they are exact or almost. Beside it are sums of what the rows' own rounding may be
// (the bound is below).

static inline cplx as_cplx(twin z) { return (cplx){z[0], z[1]}; }
static inline twin as_twin(cplx z) { return (twin){z.re, z.im}; }

/// A complex number c as factors of z and of z with its parts exchanged: c z.
typedef struct factors {
    twin same, turned;
} factors;

ALWAYS_INLINE factors factors_of(double re, double im) { return (factors){{re, re}, {-im, im}}; }
ALWAYS_INLINE twin turned(twin z) { return (twin){z[1], z[0]}; }
ALWAYS_INLINE twin times(const factors *c, twin z) { return c->same * z + c->turned * turned(z); }
ALWAYS_INLINE twin times_conjugate(const factors *c, twin z) { return c->same * z - c->turned * turned(z); }
ALWAYS_INLINE void store(double *x, int k, twin z) { *(twin *)(void *)(x + 2 * k) = z; }
ALWAYS_INLINE twin sample_at(const double *x, int k) { return *(const twin *)(const void *)(x + 2 * k); }
ALWAYS_INLINE double norm(twin z) { return z[0] * z[0] + z[1] * z[1]; }

/// A sample of x; 0 before the first, the tail after the last.
static twin sample_of(const system_rows *rows, int k)
{
    const int last = rows->count - 1;
    if (rows->loop) k = k < 0 ? last : k > last ? 0 : k;
    if (k < 0) return (twin){0, 0};
    if (k <= last) return sample_at(rows->x, k);
    const cplx end = as_cplx(sample_at(rows->x, last));
    return as_twin(cplx_add(end, cplx_mul(rows->tail, end)));
}

/// What a pass over the jets sums: w |x_i − x_{i−1}|² and w |x_{i−1}|², times the rounding of m and p if that varies, and w |r|².
typedef struct sums {
    twin by_step, by_x, energy;
} sums;

/// The weighted jet at i, of the samples before, at and after it.
ALWAYS_INLINE twin jet_at(const system_rows *rows, const bool is_constant, const bool is_complex, int i,
                          const factors *m, const factors *p, twin before, twin here, twin ahead, sums *s)
{
    const twin step = here - before;
    double w = is_constant ? 1 : rows->jet_weight[i];
    twin r = ahead - step;
    if (rows->fixed[i] & (FIXED_STILL | JET_TWICE)) {
        if (rows->fixed[i] & JET_TWICE) w *= 2;
        if (rows->fixed[i] & FIXED_STILL) r = -step;
    }
    if (is_complex) {
        r += times(p, before) - times(m, step);
    } else {
        r += p->same * before - m->same * step;
    }
    if (rows->driven) r += as_twin(rows->drive[i]);
    const twin weight = both(w), j = weight * r;
    s->energy += r * j;
    if (is_constant) {
        s->by_step += weight * (step * step), s->by_x += weight * (before * before);
    } else {
        const double of_m = rows->loss_m[i], of_p = rows->loss_p[i];
        s->by_step += both(of_m * of_m) * (weight * (step * step)),
            s->by_x += both(of_p * of_p) * (weight * (before * before));
    }
    return j;
}

/// The jets at x, weighted, to rows->jet, 0 where there is none, and their adjoint to the gradient. Returns Σ w (rounding of the row at x)²,
/// and to `energy` Σ w |r|².
ALWAYS_INLINE double pull_jets(const system_rows *rows, const bool is_constant, const bool is_complex, double *energy)
{
    const int n = rows->count, last = n - 1, from = rows->jet_from, to = rows->jet_to;
    const cplx m = rows->own.m, p = rows->own.p;
    factors of_m = factors_of(m.re, m.im), of_p = factors_of(p.re, p.im), of_b = factors_of(m.re + p.re, m.im + p.im),
            own = of_m;
    double *jet = rows->jet, *g = rows->gradient;
    const double *x = rows->x;
    sums s = {.by_step = {0, 0}};
    twin j[3] = {{0}}; // of the last three rows
    twin before = sample_of(rows, from - 1), here = sample_of(rows, from);
    for (int i = 0; i < from; i++) store(jet, i, j[2]);
    for (int i = to + 1; i < n; i++) store(jet, i, j[2]);
    for (int i = from; i <= to + 1; i++) {
        own = of_m;
        j[0] = j[1], j[1] = j[2], j[2] = both(0);
        if (i <= to) {
            if (!is_constant) {
                of_m = factors_of(rows->m_re[i], rows->m_im[i]), of_p = factors_of(rows->p_re[i], rows->p_im[i]);
                of_b = factors_of(rows->m_re[i] + rows->p_re[i], rows->m_im[i] + rows->p_im[i]);
            }
            const bool inside = i < last;
            const twin after = inside ? sample_at(x, i + 1) : sample_of(rows, i + 1);
            twin ahead = after - here;
            if (!inside && !rows->loop) ahead = as_twin(cplx_mul(rows->tail, as_cplx(here)));
            j[2] = jet_at(rows, is_constant, is_complex, i, &of_m, &of_p, before, here, ahead, &s);
            store(jet, i, j[2]);
            before = here, here = after;
        }
        if (i == 0) continue;
        const twin bend = (j[1] - j[0]) - (j[2] - j[1]);
        if (is_complex) {
            store(g, i - 1, bend + (times_conjugate(&own, j[1]) - times_conjugate(&of_b, j[2])));
        } else {
            store(g, i - 1, bend + (own.same * j[1] - of_b.same * j[2]));
        }
    }
    for (int k = 0; k < from - 1; k++) store(g, k, both(0));
    if (to + 1 < n) store(g, to + 1, -j[1]);
    for (int k = to + 2; k < n; k++) store(g, k, both(0));
    // In a loop the first row and the last are neighbours. A jet may be far larger than its change.
    for (int k = 0; rows->loop && k < n; k += last) {
        const int next = system_beside(rows, k, 1);
        const coefficients at = system_coefficients(rows, k), after = system_coefficients(rows, next);
        const factors m_here = factors_of(at.m.re, at.m.im),
                      b_after = factors_of(after.m.re + after.p.re, after.m.im + after.p.im);
        const twin here_j = sample_at(jet, k), next_j = sample_at(jet, next);
        const twin bend = (here_j - sample_at(jet, system_beside(rows, k, -1))) - (next_j - here_j);
        store(g, k, bend + (times_conjugate(&m_here, here_j) - times_conjugate(&b_after, next_j)));
    }
    *energy = s.energy[0] + s.energy[1];
    const double by_m = is_constant ? rows->own_loss.m : 1, by_p = is_constant ? rows->own_loss.p : 1;
    const double root = by_m * sqrt(s.by_step[0] + s.by_step[1]) + by_p * sqrt(s.by_x[0] + s.by_x[1]); // Minkowski
    return root * root;
}

static coefficient_loss loss_at(const system_rows *rows, int i)
{
    return rows->is_constant ? rows->own_loss : (coefficient_loss){rows->loss_m[i], rows->loss_p[i]};
}

static inline void load(const system_rows *rows, int k, cplx by)
{
    if (k >= 0) rows->gradient[2 * k] += by.re, rows->gradient[2 * k + 1] += by.im;
}

/// Subtracts a row's coefficient times what it costs.
static inline void pull(const system_rows *rows, int k, cplx c, cplx j)
{
    load(rows, k, cplx_scale(-1, cplx_mul(cplx_conj(c), j)));
}

/// The jets' gradient if poles fade within a sample: a and b themselves are small then, and differences would cost their digits.
static double pull_each(const system_rows *rows, double *energy)
{
    const int n = rows->count;
    double misses = 0;
    memset(rows->gradient, 0, sizeof *rows->gradient * 2 * (size_t)n);
    *energy = 0;
    for (int i = rows->jet_from; i <= rows->jet_to; i++) {
        const jet_row row = system_jet(rows, i);
        const int before = system_beside(rows, i, -1), after = system_beside(rows, i, 1);
        const bool still = rows->fixed[i] & FIXED_STILL;
        const cplx x = as_cplx(sample_of(rows, i)), back = as_cplx(sample_of(rows, i - 1));
        cplx r = cplx_add(cplx_mul(row.own, x), cplx_mul(row.before, back)), ahead = {0, 0};
        if (rows->driven) r = cplx_add(r, rows->drive[i]);
        if (after >= 0) ahead = as_cplx(sample_at(rows->x, after));
        if (!still) r = cplx_add(r, ahead);
        const cplx j = cplx_scale(row.weight, r);
        pull(rows, i, row.own, j);
        pull(rows, before, row.before, j);
        pull(rows, after, (cplx){1, 0}, still ? cplx_scale(row.weight, cplx_sub(ahead, x)) : j);
        const coefficient_loss loss = loss_at(rows, i);
        const double off = loss.m * cplx_size(cplx_sub(x, back)) + loss.p * cplx_size(back);
        misses += row.weight * (off * off);
        *energy += row.weight * cplx_norm(r);
    }
    return misses;
}

/// The least that a row's miss costs: its own weight, or that of moving one of its samples alone.
static double least_cost(const system_rows *rows, const band_matrix *m, double weight, const stencil *s)
{
    double least = weight;
    for (int i = 0; i < 3; i++) {
        const double on[2] = {s->c[i].re, s->c[i].im};
        for (int part = 0; part < 2; part++) {
            if (s->at[i] < 0 || on[part] == 0 || rows->fixed[s->at[i]] & (part ? FIXED_IM : FIXED_RE)) continue;
            const double square = on[part] * on[part],
                         others = band_block_at(m, s->at[i]).d[2 * part] - weight * square;
            if (others > 0) least = fmin(least, others / square);
        }
    }
    return least;
}

static void add_slopes(const system_rows *rows, const band_matrix *m, row_errors *errors)
{
    for (int r = 0; r < rows->slope_count; r++) {
        const slope_row *slope = &rows->slopes[r];
        const stencil s = system_slope_stencil(rows, slope);
        double seen = 0, apart = 0, off = 0, pulled = 0;
        for (int i = 0; i < 3; i++) { // Re(c x)
            if (s.at[i] < 0) continue;
            const twin x = sample_at(rows->x, s.at[i]);
            seen += s.c[i].re * x[0] - s.c[i].im * x[1];
        }
        const double miss = seen - slope->target, force = slope->weight * miss;
        for (int i = 0; i < 3; i++) pull(rows, s.at[i], s.c[i], (cplx){force, 0});
        if (!errors) continue;
        const twin here = sample_at(rows->x, s.at[1]);
        if (s.at[0] >= 0 && (slope->behind.re != 0 || slope->behind.im != 0))
            apart += sqrt(norm(here - sample_at(rows->x, s.at[0])));
        if (s.at[2] >= 0 && (slope->ahead.re != 0 || slope->ahead.im != 0))
            apart += sqrt(norm(sample_at(rows->x, s.at[2]) - here));
        off = slope->loss.x * sqrt(norm(here)) + slope->loss.e * apart + slope->target_error;
        if (slope->loss.cut) off += fabs(miss) + fabs(slope->target);
        // as a row that misses its target, or as a pull
        const double miss_by = off * sqrt(least_cost(rows, m, slope->weight, &s));
        for (int i = 0; i < 3; i++) {
            if (s.at[i] < 0) continue;
            const double loss = i == 1 ? slope->loss.x + 2 * slope->loss.e : slope->loss.e,
                         spread = sqrt(m->spread[2 * s.at[i]]);
            errors->pulls += loss * fabs(force) * spread;
            pulled += slope->weight * off * cplx_size(s.c[i]) * spread;
        }
        if (pulled < miss_by) {
            errors->pulls += pulled;
        } else {
            errors->misses += miss_by * miss_by;
        }
    }
}

static void add_start(const system_rows *rows, const band_matrix *m, row_errors *errors)
{
    bool alone = rows->count == 1;
    const double *x = rows->x;
    double *g = rows->gradient;
    cplx x0 = {x[0], x[1]}, e0 = cplx_mul(rows->tail, x0);
    if (!alone) e0 = cplx_sub((cplx){x[2], x[3]}, x0);
    for (int i = 0; i < 2; i++) {
        const struct start_row *row = &rows->start.row[i];
        if (!(row->weight > 0)) continue;
        const cplx seen = cplx_add(cplx_mul(row->on_x, x0), cplx_mul(row->on_e, e0)),
                   cost = cplx_scale(row->weight, seen);
        cplx on_x = cplx_mul(cplx_conj(row->on_x), cost), on_e = cplx_mul(cplx_conj(row->on_e), cost);
        cplx back = alone ? cplx_mul(cplx_conj(rows->tail), on_e) : cplx_scale(-1, on_e);
        g[0] -= on_x.re + back.re, g[1] -= on_x.im + back.im;
        if (!alone) g[2] -= on_e.re, g[3] -= on_e.im;
        if (!errors) continue;
        const double off =
            row->loss.x * cplx_size(x0) + row->loss.e * cplx_size(e0) + (row->loss.cut ? cplx_size(seen) : 0);
        const double part = 32 * DBL_EPSILON * cplx_size(seen); // of the weight
        errors->misses += row->weight * (off * off + part * part);
        const double first = sqrt(m->spread[0]);
        errors->pulls +=
            cplx_size(cost) * ((row->loss.x + row->loss.e) * first + (alone ? 0 : row->loss.e * sqrt(m->spread[2])));
    }
}

static void add_pulls(const system_rows *rows)
{
    for (int i = 0; rows->pulls && i < rows->pulls->count; i++)
        load(rows, rows->pulls->sample[i] - rows->first, rows->pulls->pull[i]);
}

/// Known values are rounded, and so is each as far as it moves the rows that see it.
static void add_known(const system_rows *rows, const band_matrix *m, row_errors *errors)
{
    for (int k = 0; k < rows->count; k++) {
        if (!(rows->fixed[k] & FIXED_RE)) continue;
        const double x = fabs(rows->x[2 * k]), off = rows->noise + DBL_EPSILON * x;
        double a = 0;
        for (int i = k - 1; i <= k + 1; i++) {
            const int at = system_beside(rows, k, i - k);
            if (at < rows->jet_from || at > rows->jet_to) continue;
            const jet_row row = system_jet(rows, at);
            a += row.weight * (i < k ? 1 : cplx_norm(i > k ? row.before : row.own));
        }
        for (int i = 0; i < 2 && k < 2; i++)
            a += rows->start.row[i].weight *
                 cplx_norm(k ? rows->start.row[i].on_e : cplx_sub(rows->start.row[i].on_x, rows->start.row[i].on_e));
        errors->misses += off * off * a;
        errors->known += rows->response * rows->response * a;
    }
    for (int r = 0; r < rows->slope_count && rows->noise > 0; r++) {
        const stencil s = system_slope_stencil(rows, &rows->slopes[r]);
        const double size = cplx_size(s.c[0]) + cplx_size(s.c[1]) + cplx_size(s.c[2]);
        const double cost = size * size * least_cost(rows, m, rows->slopes[r].weight, &s);
        errors->misses += rows->noise * rows->noise * cost;
        errors->known += rows->response * rows->response * cost;
    }
}

void system_gradient(const system_rows *rows, const band_matrix *m, row_errors *errors)
{
    const int last = rows->count - 1;
    double energy, misses;
    if (rows->fast) {
        misses = pull_each(rows, &energy);
    } else {
        misses = rows->is_constant
                     ? rows->is_complex ? pull_jets(rows, true, true, &energy) : pull_jets(rows, true, false, &energy)
                 : rows->is_complex ? pull_jets(rows, false, true, &energy)
                                    : pull_jets(rows, false, false, &energy);
        // What the usual adjoint leaves out: the second row of still knots, whose own sample is known, and the tail's row.
        for (int i = rows->jet_from; i <= rows->jet_to; i++) {
            if (!(rows->fixed[i] & FIXED_STILL) || (i == last && !rows->loop)) continue;
            const int after = i < last ? i + 1 : 0;
            const double weight = system_jet(rows, i).weight;
            const cplx from = as_cplx(sample_at(rows->x, i)), to = as_cplx(sample_at(rows->x, after));
            const cplx jet = cplx_scale(weight, cplx_sub(to, from));
            pull(rows, after, (cplx){1, 0}, cplx_sub(jet, as_cplx(sample_at(rows->jet, i))));
        }
        if (!rows->loop && rows->jet_to == last && !(rows->fixed[last] & FIXED_STILL))
            pull(rows, last, (cplx){1 + rows->tail.re, rows->tail.im}, as_cplx(sample_at(rows->jet, last)));
    }
    if (errors) {
        const double of_weight = 16 * DBL_EPSILON;
        double pulled = 0; // Σ w (Δm √D of the difference + Δp √D of the sample before)², at most
        for (int i = rows->jet_from; i <= rows->jet_to; i++) {
            const coefficient_loss loss = loss_at(rows, i);
            const double *d = m->spread + 2 * i, before = i > 0 ? d[-2] : rows->loop ? m->spread[2 * last] : 0;
            const double weight =
                (rows->is_constant ? 1 : rows->jet_weight[i]) * (rows->fixed[i] & JET_TWICE ? 2 : 1);
            pulled += 2 * weight * (loss.m * loss.m * d[1] + loss.p * loss.p * before);
        }
        *errors = (row_errors){.misses = misses + rows->drive_error + of_weight * of_weight * energy,
                               .pulls = sqrt(energy * pulled)};
        if (!rows->loop && rows->jet_to == last) {
            const double off = rows->tail_loss;
            errors->misses += system_jet(rows, last).weight * (off * off) * norm(sample_at(rows->x, last));
        }
        add_known(rows, m, errors);
    }
    add_pulls(rows);
    add_slopes(rows, m, errors);
    add_start(rows, m, errors);
    for (int k = 0; k <= last && rows->is_complex; k++)
        rows->gradient[2 * k + 1] -= (rows->is_constant ? rows->own_im : rows->im_weight[k]) * rows->x[2 * k + 1];
}

/// The gradient where all unknowns are 0, by the squared matrix; what it leaves at fixed ones means nothing.
static void set_right_side(const system_rows *rows, const band_matrix *m)
{
    const int n = rows->count;
    memset(rows->gradient, 0, sizeof *rows->gradient * 2 * (size_t)n);
    add_pulls(rows);
    for (int r = 0; r < rows->slope_count; r++) {
        const stencil s = system_slope_stencil(rows, &rows->slopes[r]);
        const double force = rows->slopes[r].weight * rows->slopes[r].target;
        for (int i = 0; i < 3; i++) load(rows, s.at[i], cplx_scale(force, cplx_conj(s.c[i])));
    }
    for (int i = rows->jet_from; i <= rows->jet_to && rows->driven; i++) {
        const jet_row row = system_jet(rows, i);
        const cplx j = cplx_scale(-row.weight, rows->drive[i]);
        load(rows, system_beside(rows, i, -1), cplx_mul(cplx_conj(row.before), j));
        load(rows, i, cplx_mul(cplx_conj(row.own), j));
        load(rows, system_beside(rows, i, 1), j);
    }
    for (int k = 0; k < n; k++) {
        if (!(rows->fixed[k] & FIXED_RE)) continue; // Im x is known of poses alone, or 0
        const double re = rows->x[2 * k], im = rows->fixed[k] & FIXED_IM ? rows->x[2 * k + 1] : 0;
        const band_block own = band_block_at(m, k);
        rows->gradient[2 * k] -= own.d[1] * im, rows->gradient[2 * k + 1] -= own.d[1] * re;
        for (int by = 1; by <= 2; by++) {
            const int after = system_beside(rows, k, by), before = system_beside(rows, k, -by);
            const double *c = by == 1 ? own.e : own.f;
            load(rows, after, (cplx){-(c[0] * re + c[1] * im), -(c[2] * re + c[3] * im)});
            if (before < 0) continue;
            const band_block block = band_block_at(m, before);
            c = by == 1 ? block.e : block.f;
            load(rows, before, (cplx){-(c[0] * re + c[2] * im), -(c[1] * re + c[3] * im)});
        }
    }
}

void system_forget_known(system_rows *rows)
{
    rows->driven = false;
    rows->drive_error = rows->noise = rows->response = rows->slip = 0;
    memset(rows->x, 0, sizeof *rows->x * 2 * (size_t)rows->count);
    for (int i = 0; i < rows->slope_count; i++) rows->slopes[i].target = rows->slopes[i].target_error = 0;
}

// --- the minimum

enum { CORRECTIONS = 4 };
/// ρ from which on the rows are factored, and from which on no bound is left.
static const double most_squared = 0.02, most = 0.5;
/// A correction this small, as a share of x, leaves the other terms as they are.
static const double settled = 1e-3;
/// Share of x at which a bound's first term asks for another correction.
static const double enough = 1e-10;

/// x + by; returns the largest magnitude of a part, NaN if there is one.
WIDEST static double add_change(double *restrict x, const double *restrict by, int count)
{
    enum { LANES = 8 };
    double sizes[LANES] = {0}, largest = 0;
    int i = 0;
    for (; i + LANES <= count; i += LANES) {
        for (int n = 0; n < LANES; n++) {
            const double sum = x[i + n] + by[i + n], size = fabs(sum);
            x[i + n] = sum;
            sizes[n] = size > sizes[n] || size != size ? size : sizes[n];
        }
    }
    for (; i < count; i++) {
        x[i] += by[i];
        if (!(fabs(x[i]) <= largest)) largest = fabs(x[i]);
    }
    for (int n = 0; n < LANES; n++) largest = sizes[n] <= largest ? largest : sizes[n];
    return largest;
}

/// Puts a solution that the gradient's memory holds into x.
static void put_solution(const system_rows *rows)
{
    for (int k = 0; k < rows->count; k++) {
        if (!(rows->fixed[k] & FIXED_RE)) rows->x[2 * k] = rows->gradient[2 * k];
        if (rows->is_complex && !(rows->fixed[k] & FIXED_IM)) rows->x[2 * k + 1] = rows->gradient[2 * k + 1];
    }
}

/// x from the known values alone.
static void solve_first(wiggly_solver *solver)
{
    const system_rows *rows = &solver->rows;
    band_matrix *m = &solver->band;
    if (m->by_rows) {
        memset(rows->gradient, 0, sizeof *rows->gradient * 2 * (size_t)rows->count);
        put_solution(rows);
        system_gradient(rows, NULL, NULL);
    } else {
        set_right_side(rows, m);
    }
    band_solve(m, rows->gradient, !m->has_spread);
    put_solution(rows);
}

/// Corrects x and bounds its error.
static minimum finish(wiggly_solver *solver)
{
    const system_rows *rows = &solver->rows;
    band_matrix *m = &solver->band;
    minimum result = {0};
    if (!m->by_rows && !(m->rounding < most_squared)) {
        m->is_kept = false;
        if (!orthogonal_factor(rows, m)) return result;
        solve_first(solver);
    }
    for (int n = 0; n < CORRECTIONS; n++) {
        row_errors errors;
        system_gradient(rows, m, &errors);
        const double change = sqrt(fmax(band_solve(m, rows->gradient, false), 0)); // in the norm of the energy
        const double left = change * m->rounding / (1 - m->rounding);
        result.largest = add_change(rows->x, rows->gradient, 2 * rows->count);
        result.sweeps = n + 1;
        result.error = m->largest * (left + sqrt(errors.misses) + errors.pulls) +
                       fmin(m->largest * sqrt(errors.known) + rows->response,
                            m->largest * rows->slip + (rows->loop ? rows->noise : 2 * rows->response));
        // pins and bounds compare what splines do under pulls to the last digit
        const double small = rows->pulls ? DBL_EPSILON : settled;
        if (m->largest * change <= small * result.largest && m->largest * left <= enough * result.largest) break;
    }
    result.solved = result.largest < INFINITY;
    result.lost = !rows->fast && !(m->rounding < most); // jets of different weights cost digits, too
    if (!(m->rounding < most) || rows->unknown || !(result.error >= 0)) result.error = INFINITY;
    return result;
}

minimum solver_find(wiggly_solver *solver)
{
    if (!solver->band.is_factor) return (minimum){0};
    solve_first(solver);
    return finish(solver);
}

minimum solver_minimise(wiggly_solver *solver)
{
    const system_rows *rows = &solver->rows;
    band_matrix *m = &solver->band;
    const bool is_kept = m->is_kept;
    system_matrix(rows, m);
    if (rows->count <= solver->longest_squared) {
        m->is_kept = is_kept && band_is_kept(m);
        if (m->is_kept) return solver_find(solver);
        set_right_side(rows, m);
        if (band_factor_solve(m, rows->gradient)) {
            put_solution(rows);
            band_keep(m);
            return finish(solver);
        }
    }
    if (!orthogonal_factor(rows, m)) return (minimum){0};
    return solver_find(solver);
}

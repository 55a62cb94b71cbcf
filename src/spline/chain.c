/// The chain: solves a spline of constant parameters using only the states at its knots.
//
// With λ = a/2, the mean of the two poles, and the state s_k = (x_k, d_k), d_k = x_{k+1} − λ x_k (the envelope's step), a jet
// row is one step of a linear system driven by the jet, whose eigenvalues λ ± δ are the poles:
//
//     s_{k+1} = F s_k + B r_{k+1},     F = | λ   1 |,   B = | 0 |,   δ² = (λ₀ − λ₁)²/4
//                                          | δ²  λ |        | 1 |
//
// The least Σ|r|² that brings s_p to s_q in L steps is (s_q − F^L s_p)* W_L⁻¹ (s_q − F^L s_p), with the Gramian
// W_L = Σ_{i<L} F^i B B* F^i*. So a knot-free stretch is a 2×2 Hermitian form in its end states, exact at any length, because W is a sum
// of positive terms. Unknown are only the states at the knots, where Re x is given (below). Inside a stretch
//
//     x_{p+i} = [F^i s_p + W_i F*^{L−i} ν]_x,     ν = W_L⁻¹ (s_q − F^L s_p),
//
// two columns of one table read forwards, and two backwards. After the last knot x is free, r = 0. If it settles there, d_L is a multiple of
// x_L and the last jet counts twice: the last input's share of W is then a half, W_L − ½ B B*.
//
// Outside complex mode all imaginary parts are zeros.
#include "maths/maths.h"
#include "maths/wide.h"
#include "spline/problem.h"
#include <float.h>
#include <math.h>
#include <string.h>

enum { BLOCK = 8 }; ///< powers are computed so many at a time

/// The powers of step k, and W's increment: p' = λ p + δ² q, q' = p + λ q, W' = W + (q p)* (q p).
typedef struct power {
    cplx p, q, w01;
    double w00, w11;
} power;

static power power_at(const chain_powers *t, int k)
{
    return (power){
        {t->p_re[k], t->p_im[k]}, {t->q_re[k], t->q_im[k]}, {t->w01_re[k], t->w01_im[k]}, t->w00[k], t->w11[k]};
}

static power power_after(const chain *c, power at)
{
    return (power){.p = cplx_add(cplx_mul(c->lambda, at.p), cplx_mul(c->delta2, at.q)),
                   .q = cplx_add(at.p, cplx_mul(c->lambda, at.q)),
                   .w01 = cplx_add(at.w01, cplx_mul(at.q, cplx_conj(at.p))),
                   .w00 = at.w00 + cplx_norm(at.q),
                   .w11 = at.w11 + cplx_norm(at.p)};
}

/// Extends the table to `longest`, in blocks: F^{k+i} = F^k F^i with F^i of the first one, and W's sums.
WIDEST static void extend_powers(chain *c, int longest)
{
    chain_powers *t = &c->powers;
    double *restrict pr = t->p_re, *restrict pi = t->p_im, *restrict qr = t->q_re, *restrict qi = t->q_im;
    double *restrict w00 = t->w00, *restrict w11 = t->w11, *restrict w01r = t->w01_re, *restrict w01i = t->w01_im;
    int k = t->count;
    if (k == 0) {
        for (power at = {.p = {1, 0}}; k < BLOCK; k++, at = power_after(c, at)) {
            pr[k] = at.p.re, pi[k] = at.p.im, qr[k] = at.q.re, qi[k] = at.q.im;
            w00[k] = at.w00, w11[k] = at.w11, w01r[k] = at.w01.re, w01i[k] = at.w01.im;
        }
    }
    double ar[BLOCK], ai[BLOCK], br[BLOCK], bi[BLOCK];
    for (int i = 0; i < BLOCK; i++) ar[i] = pr[i], ai[i] = pi[i], br[i] = qr[i], bi[i] = qi[i];
    const power block = power_after(c, power_at(t, BLOCK - 1));
    const cplx block_dq = cplx_mul(c->delta2, block.q);
    power sum = power_after(c, power_at(t, k - 1));
    for (; k <= longest; k += BLOCK) {
        const cplx p = {pr[k - BLOCK], pi[k - BLOCK]}, q = {qr[k - BLOCK], qi[k - BLOCK]};
        const cplx f = cplx_add(cplx_mul(block.p, p), cplx_mul(block_dq, q));
        const cplx g = cplx_add(cplx_mul(block.p, q), cplx_mul(block.q, p)), dg = cplx_mul(c->delta2, g);
        double n00[BLOCK], n11[BLOCK], n01r[BLOCK], n01i[BLOCK];
        for (int i = 0; i < BLOCK; i++) {
            double xr = (f.re * ar[i] - f.im * ai[i]) + (dg.re * br[i] - dg.im * bi[i]);
            double xi = (f.re * ai[i] + f.im * ar[i]) + (dg.re * bi[i] + dg.im * br[i]);
            double yr = (f.re * br[i] - f.im * bi[i]) + (g.re * ar[i] - g.im * ai[i]);
            double yi = (f.re * bi[i] + f.im * br[i]) + (g.re * ai[i] + g.im * ar[i]);
            pr[k + i] = xr, pi[k + i] = xi, qr[k + i] = yr, qi[k + i] = yi;
            n00[i] = yr * yr + yi * yi, n11[i] = xr * xr + xi * xi;
            n01r[i] = yr * xr + yi * xi, n01i[i] = yi * xr - yr * xi;
        }
        for (int i = 0; i < BLOCK; i++) {
            w00[k + i] = sum.w00, w11[k + i] = sum.w11, w01r[k + i] = sum.w01.re, w01i[k + i] = sum.w01.im;
            sum.w00 += n00[i], sum.w11 += n11[i], sum.w01.re += n01r[i], sum.w01.im += n01i[i];
        }
    }
    t->count = k;
}

/// At least |z|.
static double size_of(cplx z) { return fabs(z.re) + fabs(z.im); }

/// At least |q| of F^k for k up to a length, as |λ ± δ| ≤ 1; |p| is at most 1.
static double chain_reach(const chain *c, double length)
{
    const double delta2 = cplx_norm(c->delta2); // |δ|⁴
    return length * length * (length * length) * delta2 < 1 ? length : 1 / sqrt(sqrt(delta2));
}

/// V = W⁻¹, C = V F, P = F* V F for the stretch's length; if it settles, the last input counts half.
static void set_form(const chain *c, chain_stretch *s)
{
    const power at = power_at(&c->powers, s->length);
    const cplx p = at.p, q = at.q, r = cplx_mul(c->delta2, q);
    const double w11 = at.w11 - (s->settles ? 0.5 : 0), inverse = 1 / (at.w00 * w11 - cplx_norm(at.w01));
    const double v00 = w11 * inverse, v11 = at.w00 * inverse;
    const cplx v01 = cplx_scale(-inverse, at.w01), v10 = cplx_conj(v01);
    s->p = p, s->q = q, s->r = r;
    s->v00 = v00, s->v01 = v01, s->v11 = v11;
    s->c00 = cplx_add(cplx_scale(v00, p), cplx_mul(v01, r)), s->c01 = cplx_add(cplx_scale(v00, q), cplx_mul(v01, p));
    s->c10 = cplx_add(cplx_mul(v10, p), cplx_scale(v11, r)), s->c11 = cplx_add(cplx_mul(v10, q), cplx_scale(v11, p));
    s->p00 = cplx_mul(cplx_conj(p), s->c00).re + cplx_mul(cplx_conj(r), s->c10).re;
    s->p11 = cplx_mul(cplx_conj(q), s->c01).re + cplx_mul(cplx_conj(p), s->c11).re;
    s->p01 = cplx_add(cplx_mul(cplx_conj(p), s->c01), cplx_mul(cplx_conj(r), s->c11));
    s->loss = c->loss * (s->length + 16);
    s->reach = chain_reach(c, s->length);
    s->turn = cplx_size(c->delta2) * s->reach;
    s->weight0 = sqrt(2 * v00), s->weight1 = sqrt(2 * v11), s->open = sqrt(at.w00);
    const int half = (s->length + 1) / 2;
    const double decay = 2 * c->fade * (half + 1);
    s->half_reach = chain_reach(c, half), s->half_open = sqrt(c->powers.w00[half + 1]);
    s->growth = decay < 1 ? 1 + 2 * decay : INFINITY; // at least e^decay
    s->ratio = v00 * at.w00;
    s->w00 = at.w00, s->w01 = size_of(at.w01), s->w11 = w11;
}

void chain_forget(chain *c)
{
    c->powers.count = 0;
    c->kept = false;
    for (int j = 0; j < c->stretch_count; j++) c->stretches[j].length = 0;
    c->stretch_count = 0;
}

/// The form of every stretch, of the one before if that is as long, and the powers of what is free after the last node.
static void make_tables(chain *c)
{
    const int last = c->node_count - 1, after = c->count - c->nodes[last].at.sample;
    int longest = after - 1;
    for (int j = 0; j < last; j++) {
        const int length = c->nodes[j + 1].at.sample - c->nodes[j].at.sample;
        longest = length > longest ? length : longest;
    }
    if (longest >= c->powers.count) extend_powers(c, longest);
    const chain_stretch *before = NULL;
    for (int j = 0; j < last; j++) {
        const int length = c->nodes[j + 1].at.sample - c->nodes[j].at.sample;
        const bool settles = c->nodes[j + 1].at.free[1] == 0;
        if (!before || before->length != length || before->settles != settles) {
            chain_stretch *s = &c->stretches[j];
            if (s->length != length || s->settles != settles) {
                s->length = length, s->settles = settles;
                set_form(c, s);
            }
            before = s;
        }
        c->rows[j].stretch = before;
    }
    if (c->stretch_count < last) c->stretch_count = last;
}

// --- the block-tridiagonal system of the nodes, and the bound of its error
//
// An unknown is Im x, Re d or Im d of a node; Re x is known, and so may others be. Known ones are removed by 0 instead of 1 in `free`. A
// stretch adds its form to the blocks of its ends, the start its two rows to the first one's. The gradient goes by the costates, so through
// the rows before they are squared.
//
// A slope at s_q acts on h times a speed, φ = Re(on_x x_q + on_d d_q − on_r r_q), where r_q is the last jet of the stretch before. Given both
// ends, that jet is ν_d = B* ν ± √(1 − V₁₁). So with s = weight / (1 + weight |on_r|² (1 − V₁₁)) the slope costs
// s (Re(on_x x_q + on_d d_q − on_r ν_d) − target)², a row of the two nodes alone. In the stretch it moves r_q from B* ν by
// η = s (φ − target) on_r*, and the samples follow the costate ν − V B η.
//
// The bound is that of the band (minimise.c), with the stretches for rows and D the diagonal of the inverse. At a sample between nodes √D is at
// most |p| √D_x + |q| √D_d + √W₀₀ from the node before, because the jets cost no more than everything does; from the node after it is the same
// with the powers of F⁻¹, so half the stretch is enough. The rows of a stretch are W^{−½} (s_q − F^L s_p). Their powers and Gramian are known to
// u, some ε for every sample. Let R(s) = (√2V₀₀ + √2V₁₁) (|s_q| + |F^L| |s_p|), by components, of sizes or of √D. Rounding
//
//     moves the rows by  u R(s)  and, by W, by  u (8 W₀₀V₀₀ ν* diag(W) ν)^½;
//     pulls with  u |F^L|* |ν|  on s_p and, as the gradient is summed, with  8 ε R(s) R(√D);
//     and adds  8 ε R(√D)²  to  ρ = 80 ε Σ D_k A_kk,  as the forms are.
//
// The imaginary rows are left out: they pull with ω |Im x_j| at every sample.

/// Rounding of an L D Lᵀ and its solve, as the band's; of sums of the gradient and of the forms; and of a coefficient.
static const double of_factor = 80 * DBL_EPSILON, of_sums = 8 * DBL_EPSILON, of_coefficient = 32 * DBL_EPSILON;
static const double most = 0.5; ///< ρ from which on no bound is left

static inline double square(double x) { return x * x; }
static inline double larger(double a, double b) { return a >= b ? a : b; }

/// Re(a x + b d).
ALWAYS_INLINE double seen(cplx a, cplx b, const chain_node *node)
{
    return (a.re * node->x.re - a.im * node->x.im) + (b.re * node->d.re - b.im * node->d.im);
}

/// d += [h00 h01; h01* h11] of a state: 00 01 02 11 12 22 of the unknowns.
ALWAYS_INLINE void add_form(double *d, double h00, cplx h01, double h11)
{
    d[0] += h00, d[1] += h01.im, d[2] += h01.re, d[3] += h11, d[5] += h11;
}

/// A row Re(a x + b d) by unknowns.
typedef struct real_row {
    double on[3];
} real_row;

ALWAYS_INLINE real_row row_of(cplx a, cplx b) { return (real_row){{-a.im, b.re, -b.im}}; }

/// d += w g gᵀ.
ALWAYS_INLINE void add_square(double *d, double w, real_row g)
{
    for (int r = 0, i = 0; r < 3; r++) {
        for (int v = r; v < 3; v++, i++) d[i] += w * g.on[r] * g.on[v];
    }
}

/// The start's rows on the first state: on_x x + on_e e with e = x_1 − x_0 = d + (λ − 1) x.
static cplx start_on_x(const chain *c, const struct start_row *row)
{
    return cplx_add(row->on_x, cplx_mul(row->on_e, (cplx){c->lambda.re - 1, c->lambda.im}));
}

static cplx start_at(cplx on_x, const struct start_row *row, const chain_node *first)
{
    return cplx_add(cplx_mul(on_x, first->x), cplx_mul(row->on_e, first->d));
}

/// The weight of a slope at a stretch's end, where the jet there is free but for V₁₁; without a stretch for 1.
static double slope_weight(const chain_place *at, double v11)
{
    return at->slope_weight / (1 + at->slope_weight * cplx_norm(at->on_r) * (1 - v11));
}

/// How hard the first node's slope pulls.
static double first_pull(const chain_node *node)
{
    return slope_weight(&node->at, 1) * (seen(node->at.on_x, node->at.on_d, node) - node->slope);
}

/// Adds a stretch, and the slope at its end, to the blocks of its nodes; n is the coupling, row-major, of the later to the earlier.
ALWAYS_INLINE void add_stretch(const chain_stretch *s, const chain_place *end, double *d, double *n, double *entering)
{
    add_form(d, s->p00, s->p01, s->p11);
    add_form(entering, s->v00, s->v01, s->v11);
    n[0] = -s->c00.re, n[1] = -s->c01.im, n[2] = -s->c01.re;
    n[3] = s->c10.im, n[4] = -s->c11.re, n[5] = s->c11.im;
    n[6] = -s->c10.re, n[7] = -s->c11.im, n[8] = -s->c11.re;
    if (!(end->slope_weight > 0)) return;
    const double weight = slope_weight(end, s->v11);
    const real_row before = row_of(cplx_mul(end->on_r, s->c10), cplx_mul(end->on_r, s->c11));
    const real_row at = row_of(cplx_sub(end->on_x, cplx_mul(end->on_r, cplx_conj(s->v01))),
                               cplx_sub(end->on_d, cplx_scale(s->v11, end->on_r)));
    add_square(d, weight, before);
    add_square(entering, weight, at);
    for (int r = 0; r < 3; r++) {
        for (int v = 0; v < 3; v++) n[3 * r + v] += weight * at.on[r] * before.on[v];
    }
}

/// Moves a tied d to Im x, and puts 1 on the diagonal for what is known.
ALWAYS_INLINE void hold(double *d, const chain_place *at)
{
    const double fx = at->free[0], fd = at->free[1], fi = at->free[2], t = at->tie.re, s = at->tie.im;
    const double d1 = d[1] + t * d[3] + s * d[4], d2 = d[2] + t * d[4] + s * d[5];
    d[0] = (d[0] + (t * (d[1] + d1) + s * (d[2] + d2))) * fx + (1 - fx);
    d[1] = d1 * (fx * fd), d[2] = d2 * (fx * fi);
    d[3] = d[3] * fd + (1 - fd);
    d[4] = d[4] * (fd * fi);
    d[5] = d[5] * fi + (1 - fi);
}

ALWAYS_INLINE void hold_coupling(double *n, const chain_place *before, const chain_place *at)
{
    for (int v = 0; v < 3; v++) {
        n[v] = (n[v] + (at->tie.re * n[3 + v] + at->tie.im * n[6 + v])) * (before->free[v] * at->free[0]);
        n[3 + v] *= before->free[v] * at->free[1];
        n[6 + v] *= before->free[v] * at->free[2];
    }
}

/// Factors one block, d, and the coupling n to the next row: n ← n l⁻ᵀ. False if a pivot is not positive.
ALWAYS_INLINE bool factor_row(chain_row *row, double *d, double *n)
{
    const double i0 = 1 / d[0], l10 = d[1] * i0, l20 = d[2] * i0;
    const double p1 = d[3] - l10 * d[1], i1 = 1 / p1, below = d[4] - l10 * d[2], l21 = below * i1;
    const double p2 = (d[5] - l20 * d[2]) - l21 * below, i2 = 1 / p2;
    row->lower[0] = l10, row->lower[1] = l20, row->lower[2] = l21;
    row->inverse[0] = i0, row->inverse[1] = i1, row->inverse[2] = i2;
    for (int v = 0; v < 9; v += 3) {
        n[v + 1] -= l10 * n[v];
        n[v + 2] -= l20 * n[v] + l21 * n[v + 1];
        row->below[v] = n[v] * i0, row->below[v + 1] = n[v + 1] * i1, row->below[v + 2] = n[v + 2] * i2;
    }
    return d[0] > 0 && p1 > 0 && p2 > 0 && d[0] + d[3] + d[5] < INFINITY;
}

static bool factor(chain *c)
{
    bool sound = true;
    double d[6] = {0}, less[6] = {0};
    for (int i = 0; i < 2; i++) { // the first node's rows: the start's, and its slope's
        const struct start_row *row = &c->start.row[i];
        const cplx on_x = start_on_x(c, row), on_d = row->on_e;
        add_form(d, row->weight * cplx_norm(on_x), cplx_scale(row->weight, cplx_mul(cplx_conj(on_x), on_d)),
                 row->weight * cplx_norm(on_d));
    }
    const chain_place *first = &c->nodes[0].at;
    if (first->slope_weight > 0) add_square(d, slope_weight(first, 1), row_of(first->on_x, first->on_d));
    for (int j = 0; j < c->node_count; j++) {
        chain_row *row = &c->rows[j];
        const chain_place *at = &c->nodes[j].at;
        double n[9] = {0}, next[6] = {0};
        if (j + 1 < c->node_count) {
            add_stretch(row->stretch, &c->nodes[j + 1].at, d, n, next);
            hold_coupling(n, at, &c->nodes[j + 1].at);
        }
        hold(d, at);
        row->entry[0] = d[0], row->entry[1] = d[3], row->entry[2] = d[5];
        for (int i = 0; i < 6; i++) d[i] -= less[i];
        sound = factor_row(row, d, n) && sound;
        const double *k = row->below;
        for (int r = 0, i = 0; r < 3; r++) {
            for (int v = r; v < 3; v++, i++)
                less[i] = n[3 * r] * k[3 * v] + n[3 * r + 1] * k[3 * v + 1] + n[3 * r + 2] * k[3 * v + 2];
        }
        for (int i = 0; i < 6; i++) d[i] = next[i];
    }
    return sound;
}

/// z, the inverse's block of a row, from that of the next: P + Hᵀ z H, with P the inverse of the row's own pivots.
ALWAYS_INLINE void invert_row(const chain_row *row, double *z)
{
    const double *i = row->inverse, *l = row->lower;
    const double t10 = -l[0], t21 = -l[2], t20 = l[0] * l[2] - l[1];
    const double full[9] = {z[0], z[1], z[2], z[1], z[3], z[4], z[2], z[4], z[5]};
    const double own[6] = {i[0] + t10 * t10 * i[1] + t20 * t20 * i[2],
                           t10 * i[1] + t20 * t21 * i[2],
                           t20 * i[2],
                           i[1] + t21 * t21 * i[2],
                           t21 * i[2],
                           i[2]};
    double h[9], zh[9];
    for (int v = 0; v < 9; v += 3) {
        const double a = row->below[v], b = row->below[v + 1], c = row->below[v + 2];
        h[v] = a + b * t10 + c * t20, h[v + 1] = b + c * t21, h[v + 2] = c;
    }
    for (int r = 0; r < 3; r++) {
        for (int v = 0; v < 3; v++)
            zh[3 * r + v] = full[3 * r] * h[v] + full[3 * r + 1] * h[3 + v] + full[3 * r + 2] * h[6 + v];
    }
    for (int r = 0, n = 0; r < 3; r++) {
        for (int v = r; v < 3; v++, n++) z[n] = own[n] + h[r] * zh[v] + h[3 + r] * zh[3 + v] + h[6 + r] * zh[6 + v];
    }
}

/// R of sizes at both ends.
ALWAYS_INLINE double rows_of(const chain_stretch *s, double xp, double dp, double xq, double dq)
{
    return s->weight0 * (xq + xp + s->reach * dp) + s->weight1 * (dq + s->turn * xp + dp);
}

/// How far the energy lets x stray at the nodes and between them; and ρ.
static void find_spread(chain *c)
{
    double z[6] = {0};
    const int last = c->node_count - 1;
    c->rounding = c->spread = 0;
    for (int j = last; j >= 0; j--) {
        chain_row *row = &c->rows[j];
        const chain_place *at = &c->nodes[j].at;
        invert_row(row, z);
        const double x = at->free[0] * z[0], d = at->free[1] * z[3], i = at->free[2] * z[5], of_x = sqrt(x);
        c->rounding += of_factor * (x * row->entry[0] + d * row->entry[1] + i * row->entry[2]);
        row->spread[0] = of_x;
        row->spread[1] = sqrt(d + i) + size_of(at->tie) * of_x;
        double between = of_x + chain_reach(c, c->count - 1 - at->sample) * row->spread[1];
        if (j < last) {
            const chain_stretch *s = row->stretch;
            row->reach = rows_of(s, row->spread[0], row->spread[1], row[1].spread[0], row[1].spread[1]);
            c->rounding += of_sums * square(row->reach);
            const double ahead = of_x + s->reach * row->spread[1] + s->open,
                         half = of_x + s->half_reach * row->spread[1] + s->half_open,
                         behind = s->growth * (row[1].spread[0] + s->half_reach * row[1].spread[1] + s->half_open);
            between = larger(half, ahead < behind ? ahead : behind);
        }
        c->spread = larger(between, c->spread);
    }
}

/// At the nodes' present state, the costate ν at the end of the stretch after node j, and F*^L ν at its start; and how hard the slope at its
/// end pulls.
typedef struct chain_costates {
    cplx end[2], start[2];
    double pull;
} chain_costates;

static chain_costates costates_of(const chain *c, int j)
{
    const chain_node *p = &c->nodes[j], *q = p + 1;
    const chain_stretch *s = c->rows[j].stretch;
    const cplx x = cplx_sub(q->x, cplx_add(cplx_mul(s->p, p->x), cplx_mul(s->q, p->d)));
    const cplx d = cplx_sub(q->d, cplx_add(cplx_mul(s->r, p->x), cplx_mul(s->p, p->d)));
    chain_costates nu = {.end = {cplx_add(cplx_scale(s->v00, x), cplx_mul(s->v01, d)),
                                 cplx_add(cplx_mul(cplx_conj(s->v01), x), cplx_scale(s->v11, d))}};
    if (q->at.slope_weight > 0) {
        const cplx on_r = q->at.on_r;
        const double jet = on_r.re * nu.end[1].re - on_r.im * nu.end[1].im;
        nu.pull = slope_weight(&q->at, s->v11) * (seen(q->at.on_x, q->at.on_d, q) - jet - q->slope);
        const cplx eta = cplx_scale(nu.pull, cplx_conj(on_r));
        nu.end[0] = cplx_sub(nu.end[0], cplx_mul(s->v01, eta));
        nu.end[1] = cplx_sub(nu.end[1], cplx_scale(s->v11, eta));
    }
    const cplx p_conj = cplx_conj(s->p);
    nu.start[0] = cplx_add(cplx_mul(p_conj, nu.end[0]), cplx_mul(cplx_conj(s->r), nu.end[1]));
    nu.start[1] = cplx_add(cplx_mul(cplx_conj(s->q), nu.end[0]), cplx_mul(p_conj, nu.end[1]));
    return nu;
}

/// Corrects the nodes' unknowns by the gradient at their present state; returns the norm of the correction, that of the energy. Sets `size`.
static double correct(chain *c)
{
    double energy = 0, y[3] = {0}, u[3] = {0};
    cplx g[2] = {{0, 0}, {0, 0}};
    chain_row *const last = &c->rows[c->node_count - 1], *row = c->rows;
    chain_node *node = c->nodes;
    for (int i = 0; i < 2; i++) { // −½ of the gradient at the first node, of its own rows
        const struct start_row *start = &c->start.row[i];
        const cplx on_x = start_on_x(c, start), at = start_at(on_x, start, node);
        g[0] = cplx_sub(g[0], cplx_scale(start->weight, cplx_mul(cplx_conj(on_x), at)));
        g[1] = cplx_sub(g[1], cplx_scale(start->weight, cplx_mul(cplx_conj(start->on_e), at)));
    }
    if (node->at.slope_weight > 0) {
        const double pull = first_pull(node);
        g[0] = cplx_sub(g[0], cplx_scale(pull, cplx_conj(node->at.on_x)));
        g[1] = cplx_sub(g[1], cplx_scale(pull, cplx_conj(node->at.on_d)));
    }
    for (;; row++, node++) {
        cplx ahead[2] = {{0, 0}, {0, 0}};
        if (row < last) {
            const chain_costates nu = costates_of(c, (int)(row - c->rows));
            const chain_place *end = &node[1].at;
            g[0] = cplx_add(g[0], nu.start[0]), g[1] = cplx_add(g[1], nu.start[1]);
            ahead[0] = (cplx){-nu.end[0].re - nu.pull * end->on_x.re, nu.pull * end->on_x.im - nu.end[0].im};
            ahead[1] = (cplx){-nu.end[1].re - nu.pull * end->on_d.re, nu.pull * end->on_d.im - nu.end[1].im};
        }
        const chain_place *at = &node->at;
        const double *l = row->lower, *i = row->inverse, *f = at->free;
        u[0] = f[0] * (g[0].im + (at->tie.re * g[1].re + at->tie.im * g[1].im)) - u[0];
        u[1] = f[1] * g[1].re - u[1];
        u[2] = f[2] * g[1].im - u[2];
        y[0] = u[0], y[1] = u[1] - l[0] * y[0], y[2] = u[2] - (l[1] * y[0] + l[2] * y[1]);
        energy += i[0] * square(y[0]) + i[1] * square(y[1]) + i[2] * square(y[2]);
        for (int v = 0; v < 3; v++) {
            const double *k = row->below + 3 * v;
            row->right[v] = y[v];
            u[v] = k[0] * y[0] + k[1] * y[1] + k[2] * y[2];
        }
        if (row == last) break;
        g[0] = ahead[0], g[1] = ahead[1];
    }
    c->size = 0;
    for (u[0] = u[1] = u[2] = 0; row >= c->rows; row--, node--) {
        const double *l = row->lower, *i = row->inverse, *k = row->below;
        for (int v = 0; v < 3; v++) y[v] = i[v] * row->right[v] - (k[v] * u[0] + k[3 + v] * u[1] + k[6 + v] * u[2]);
        u[2] = y[2];
        u[1] = y[1] - l[2] * u[2];
        u[0] = y[0] - (l[0] * u[1] + l[1] * u[2]);
        node->x.im += u[0];
        node->d.re += u[1] + node->at.tie.re * u[0];
        node->d.im += u[2] + node->at.tie.im * u[0];
        c->size = larger(larger(size_of(node->x), size_of(node->d)), c->size);
    }
    return sqrt(energy);
}

/// What is summed over the rows: the squares that rounding moves them by, and how it pulls on the unknowns, times √D.
typedef struct row_sums {
    double misses, pulls;
} row_sums;

/// The slope at node j, of coefficients that are known to a share. The jet before it, where there is one, has that size and √D. However stiff the
/// slope is, it moves x no farther than its pull.
static void add_slope(const chain *c, int j, double share, double jet, double jet_reach, double pull, row_sums *sums)
{
    const chain_node *node = &c->nodes[j];
    const double *spread = c->rows[j].spread, on_x = size_of(node->at.on_x), on_d = size_of(node->at.on_d),
                 on_r = size_of(node->at.on_r);
    const double off_x = share * on_x + node->loss_x, off_d = share * on_d + node->loss_d, off_r = share * on_r;
    const double off = off_x * size_of(node->x) + off_d * size_of(node->d) + off_r * jet + share * fabs(node->slope) +
                       node->slope_error + c->noise * (1 + on_x);
    const double root = sqrt(node->at.slope_weight),
                 moved = root * (on_x * spread[0] + on_d * spread[1] + on_r * jet_reach);
    sums->misses += square(root * off * (moved < 1 ? moved : 1));
    sums->pulls += fabs(pull) * (off_x * spread[0] + off_d * spread[1] + off_r * jet_reach);
}

static void add_stretch_errors(const chain *c, int j, double *steps, row_sums *sums)
{
    const chain_row *row = &c->rows[j];
    const chain_node *p = &c->nodes[j], *q = p + 1;
    const chain_stretch *s = row->stretch;
    const double x = size_of(p->x), d = size_of(p->d), to = size_of(q->x), rows = rows_of(s, x, d, to, size_of(q->d));
    const double n0 = row->end[0], n1 = row->end[1], *spread = row->spread;
    sums->misses += square(s->loss * rows + c->noise * (2 * s->weight0 + s->turn * s->weight1));
    sums->misses += 8 * s->ratio * square(s->loss) * (s->w00 * n0 * n0 + s->w11 * n1 * n1);
    sums->pulls += s->loss * (n0 * (spread[0] + s->reach * spread[1]) + n1 * (s->turn * spread[0] + spread[1]));
    sums->pulls += of_sums * rows * row->reach;
    *steps =
        larger(s->loss * (x + s->reach * d + s->w00 * (n0 + s->turn * n1) + s->w01 * (s->reach * n0 + n1)), *steps);
    if (s->settles) {
        sums->misses += square(s->weight1 * c->tail_loss * to);
        sums->pulls += n1 * c->tail_loss * row[1].spread[0];
    }
    if (q->at.slope_weight > 0)
        add_slope(c, j + 1, s->loss, s->weight1 * rows, s->weight1 * row->reach, row->pull, sums);
}

// --- a solve

/// x of `count` samples of a stretch of `length`, from its first on, for the state s there and the costate ν at its end.
WIDEST static void fill(const chain *c, int length, int count, const cplx s[2], const cplx nu[2], double *restrict re,
                        double *restrict im)
{
    const chain_powers *t = &c->powers;
    const double *restrict pr = t->p_re, *restrict pi = t->p_im, *restrict qr = t->q_re, *restrict qi = t->q_im;
    const double *restrict w00 = t->w00, *restrict w01r = t->w01_re, *restrict w01i = t->w01_im;
    const cplx x = s[0], d = s[1], a = nu[0], b = nu[1], e = cplx_mul(cplx_conj(c->delta2), b);
    for (int i = 0; i < count; i++) {
        const int k = length - i; // F*^k ν
        const double mr = (pr[k] * a.re + pi[k] * a.im) + (qr[k] * e.re + qi[k] * e.im);
        const double mi = (pr[k] * a.im - pi[k] * a.re) + (qr[k] * e.im - qi[k] * e.re);
        const double nr = (qr[k] * a.re + qi[k] * a.im) + (pr[k] * b.re + pi[k] * b.im);
        const double ni = (qr[k] * a.im - qi[k] * a.re) + (pr[k] * b.im - pi[k] * b.re);
        re[i] = ((pr[i] * x.re - pi[i] * x.im) + (qr[i] * d.re - qi[i] * d.im)) +
                (w00[i] * mr + (w01r[i] * nr - w01i[i] * ni));
        im[i] = ((pr[i] * x.im + pi[i] * x.re) + (qr[i] * d.im + qi[i] * d.re)) +
                (w00[i] * mi + (w01r[i] * ni + w01i[i] * nr));
    }
}

/// Share of x at which what the factor may have lost asks for another correction.
static const double enough = 1e-9;
enum { CORRECTIONS = 3 };

/// Solves for the nodes and writes x of every sample of the system; outside complex mode x_im receives zeros. If `kept` is set, only values
/// have changed since the last solve, and its factor is reused. false if the nodes' system has no factor, or that leaves no bound.
static bool solve(chain *c, double *x_re, double *x_im)
{
    if (!c->kept) {
        make_tables(c);
        c->sound = factor(c);
        if (c->sound) find_spread(c);
        c->sound = c->sound && c->rounding < most;
        c->kept = true;
    }
    if (!c->sound) return false;
    double left;
    for (int n = 0; n < CORRECTIONS; n++) {
        left = c->rounding / (1 - c->rounding) * correct(c);
        if (c->spread * left <= enough * c->size) break;
    }
    const int last = c->node_count - 1;
    const chain_node *node = c->nodes;
    for (int j = 0; j < last; j++, node++) {
        const chain_costates nu = costates_of(c, j);
        const int length = c->rows[j].stretch->length, at = node->at.sample;
        c->rows[j].pull = nu.pull, c->rows[j].end[0] = size_of(nu.end[0]), c->rows[j].end[1] = size_of(nu.end[1]);
        fill(c, length, length, (cplx[]){node->x, node->d}, nu.end, x_re + at, x_im + at);
    }
    const int at = node->at.sample, after = c->count - at;
    fill(c, after - 1, after, (cplx[]){node->x, node->d}, (cplx[2]){{0, 0}}, x_re + at, x_im + at);

    // What rounding may be: of the first node's rows, of each stretch, and of what Im x costs.
    row_sums sums = {0, 0};
    double steps = c->loss * (after + 16) * (size_of(node->x) + chain_reach(c, after) * size_of(node->d));
    const chain_node *first = &c->nodes[0];
    const double *spread = c->rows[0].spread, growth = size_of((cplx){c->lambda.re - 1, c->lambda.im});
    const double x0 = size_of(first->x), e = size_of(first->d) + growth * x0;
    for (int i = 0; i < 2; i++) {
        const struct start_row *row = &c->start.row[i];
        const double on_x = size_of(row->on_x), on_e = size_of(row->on_e),
                     off_x = row->loss.x + of_coefficient * on_x, off_e = row->loss.e + of_coefficient * on_e;
        sums.misses += row->weight * square(off_x * x0 + off_e * e + c->noise * (on_x + growth * on_e));
        sums.pulls += row->weight * size_of(start_at(start_on_x(c, row), row, first)) *
                      (off_x * spread[0] + off_e * (spread[1] + growth * spread[0]));
    }
    if (first->at.slope_weight > 0) add_slope(c, 0, of_coefficient, 0, 0, first_pull(first), &sums);
    for (int j = 0; j < last; j++) add_stretch_errors(c, j, &steps, &sums);
    if (c->im_weight > 0) { // as rows that miss, or as pulls
        const double root = sqrt(c->im_weight), moved = root * c->spread * sqrt(c->count);
        sums.pulls += root * sqrt(maths_dot(x_im, x_im, c->count)) * (moved < 1 ? moved : 1);
    }
    c->error = c->spread * (left + sqrt(sums.misses) + sums.pulls) + steps;
    return true;
}

// --- from a problem to the chain

/// If a row's b almost vanishes, the jet at a sample and the motion after it are unrelated: the chain cannot handle speeds seen from there.
static const double least_b = 1e-3;

/// The n-th knot in order of samples.
static const wiggly_knot *knot_at(const wiggly_solver *solver, const problem *p, int n)
{
    return &p->desc->knots[solver->order[n]];
}

/// Whether the chain may solve it: constant parameters, for the paper's filter a constant equilibrium; no loop, no still knots, none side by
/// side.
static bool fits_chain(wiggly_solver *solver, const problem *p)
{
    const wiggly_desc *desc = p->desc;
    if (solver->method == WIGGLY_BAND || p->pulls || p->level_slope || p->still >= 0 || desc->knot_count == 0)
        return false;
    if (p->start == WIGGLY_LOOP || !poles_are_constant(desc)) return false;
    const bool oscillates = problem_oscillates(p);
    const constant_filter *f = problem_filter(solver, p);
    if (oscillates ? f->cut : p->about != NULL) return false; // only the band knows what a cut changes
    if (p->start == WIGGLY_REST && knot_at(solver, p, 0)->sample < 2)
        return false; // held at a limit: too close to the node at rest
    const bool faint = maths_exp(2 * desc->step * (f->at.s[0].re + f->at.s[1].re)) < least_b;
    int before = -2;
    for (int n = 0; n < desc->knot_count; n++) {
        const wiggly_knot *knot = knot_at(solver, p, n);
        if (knot->sample == before + 1) return false;
        if (knot->has_slope && (oscillates ? faint : knot->sample == desc->samples - 1)) return false;
        before = knot->sample;
    }
    return true;
}

/// The slope of a knot. An oscillator's speed seen from behind differs from that seen ahead by the jet between.
static void put_slope(const problem *p, const wiggly_knot *knot, const constant_filter *f, chain_node *node)
{
    const slope_row slope = problem_slope(p, knot->sample, knot->slope, knot_stiffness(knot));
    const bool ahead = knot->sample + 1 < p->first + p->count, behind = knot->sample > p->first;
    chain_place *at = &node->at;
    node->slope = slope.target;
    node->slope_error = slope.target_error;
    at->slope_weight = slope.weight;
    if (p->settles && knot->sample == p->latest) {
        at->on_x = f->passive;
        return;
    }
    const bool oscillates = problem_oscillates(p);
    const speed_form form = oscillates ? f->ahead : (speed_form){.on_e = {1, 0}};
    const cplx growth = {f->lambda.re - 1, f->lambda.im}; // e = d + growth x
    at->on_x = cplx_add(form.on_x, cplx_mul(form.on_e, growth));
    at->on_d = form.on_e;
    node->loss_x = form.loss.x + cplx_size(growth) * form.loss.e;
    node->loss_d = form.loss.e;
    if (oscillates) at->on_r = cplx_scale(!behind ? 0 : ahead ? 0.5 : 1, form.on_e);
}

/// Writes the nodes; true if only values differ from those before.
static bool make_nodes(wiggly_solver *solver, const problem *p, const constant_filter *f)
{
    chain *c = &solver->chain;
    chain_node *node = c->nodes;
    const bool is_complex = p->desc->mode == WIGGLY_COMPLEX, rests = p->start == WIGGLY_REST;
    const int count = p->desc->knot_count + rests;
    bool same = count == c->node_count;
    for (int n = 0; n < count; n++, node++) {
        const chain_place before = node->at;
        memset(node, 0, sizeof *node); // places are compared as bytes
        node->at.free[0] = node->at.free[2] = is_complex ? 1 : 0;
        node->at.free[1] = 1;
        if (rests && n == 0) { // x is 0 there; the filter's next one, too
            node->at.free[0] = 0;
            if (!problem_oscillates(p)) {
                node->at.free[1] = node->at.free[2] = 0;
                node->d.re = p->y && !p->about ? p->y[1] - p->level : 0;
            }
        } else {
            const wiggly_knot *knot = knot_at(solver, p, n - rests);
            node->at.sample = knot->sample - p->first;
            node->x.re = problem_knot_re(p, knot);
            if (problem_is_whole(p, knot)) node->x.im = problem_knot_im(p, knot), node->at.free[0] = 0;
            if (p->settles && n == count - 1) {
                const cplx tail = is_complex ? cplx_sub((cplx){1 + f->tail.re, f->tail.im}, f->lambda) : (cplx){0, 0};
                node->at.free[1] = node->at.free[2] = 0;
                node->at.tie = (cplx){-tail.im, tail.re};
                node->d = cplx_mul(tail, node->x);
            }
            if (knot->has_slope) put_slope(p, knot, f, node);
        }
        same = memcmp(&before, &node->at, sizeof before) == 0 && same;
    }
    c->node_count = count;
    return same;
}

bool problem_solve_chain(wiggly_solver *solver, const problem *p, double *x_re, double *x_im)
{
    if (!fits_chain(solver, p)) return false;
    solver->band.is_kept = false; // its memory is that of the chain's tables
    chain *c = &solver->chain;
    const constant_filter *f = problem_filter(solver, p);
    start_cost start = p->cost;
    if (p->start == WIGGLY_REST && problem_oscillates(p)) // d is the jet there, and counts twice
        start.row[0] = (struct start_row){.weight = 2, .on_e = {1, 0}};
    if (memcmp(&f->lambda, &c->lambda, sizeof c->lambda) != 0 ||
        memcmp(&f->delta2, &c->delta2, sizeof c->delta2) != 0)
        chain_forget(c);
    if (memcmp(&start, &c->start, sizeof start) != 0 || c->count != problem_rows(p)) c->kept = false;
    c->count = problem_rows(p);
    c->start = start;
    c->lambda = f->lambda;
    c->delta2 = f->delta2;
    const double reach = fmax(cplx_size(f->at.s[0]), cplx_size(f->at.s[1])) * p->desc->step;
    c->loss = 4 * DBL_EPSILON * (1 + reach);
    c->fade = p->desc->step * fmax(fabs(f->at.s[0].re), fabs(f->at.s[1].re));
    const double passive = cplx_size(f->passive),
                 on_e = cplx_norm(f->ahead.on_e); // the tail is h (p − s₀) / on_e + e^{h s₀} − 1
    c->tail_loss = 8 * DBL_EPSILON * (2 + reach) + (on_e > 0 ? f->ahead.loss.e * (passive + reach) / on_e : 0);
    c->noise = p->about ? problem_noise(p) + problem_response_error(p) : 0;
    c->im_weight = p->desc->mode == WIGGLY_COMPLEX ? p->unit * problem_im_weight(p, f->at.natural) : 0;
    if (!make_nodes(solver, p, f)) c->kept = false;

    double *const im = p->desc->mode == WIGGLY_COMPLEX ? x_im : solver->rows.x; // for a real curve it may be x_re
    if (!solve(c, x_re, im)) return false;
    problem_settle(solver, p, x_re - p->first, x_im - p->first);
    return true;
}

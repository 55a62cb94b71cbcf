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
// of positive terms. Unknown are only the states at the knots, where Re x is given (chain_nodes.c). Inside a stretch
//
//     x_{p+i} = [F^i s_p + W_i F*^{L−i} ν]_x,     ν = W_L⁻¹ (s_q − F^L s_p),
//
// two columns of one table read forwards, and two backwards. After the last knot x is free, r = 0. If it settles there, d_L is a multiple of
// x_L and the last jet counts twice: the last input's share of W is then a half, W_L − ½ B B*.
//
// Outside complex mode all imaginary parts are zeros.
#include "spline/chain.h"
#include "maths/wide.h"
#include <float.h>
#include <math.h>

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

static double size_of(cplx z) { return fabs(z.re) + fabs(z.im); }

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

bool chain_solve(chain *c, double *x_re, double *x_im)
{
    if (!c->kept) {
        make_tables(c);
        c->sound = chain_factor(c);
        c->kept = true;
    }
    if (!c->sound) return false;
    double left;
    for (int n = 0; n < CORRECTIONS; n++) {
        left = c->rounding / (1 - c->rounding) * chain_correct(c);
        if (c->spread * left <= enough * c->size) break;
    }
    const int last = c->node_count - 1;
    const chain_node *node = c->nodes;
    for (int j = 0; j < last; j++, node++) {
        const chain_costates nu = chain_costates_of(c, j);
        const int length = c->rows[j].stretch->length, at = node->at.sample;
        c->rows[j].pull = nu.pull, c->rows[j].end[0] = size_of(nu.end[0]), c->rows[j].end[1] = size_of(nu.end[1]);
        fill(c, length, length, (cplx[]){node->x, node->d}, nu.end, x_re + at, x_im + at);
    }
    const int at = node->at.sample, after = c->count - at;
    fill(c, after - 1, after, (cplx[]){node->x, node->d}, (cplx[2]){{0, 0}}, x_re + at, x_im + at);
    c->error = chain_bound(c, left, x_im);
    return true;
}

/// Powers of the filter, and the forms of stretches (chain.c has the mathematics).
#include "spline/chain.h"
#include "spline/wide.h"

/// The powers of step k, and W's increment: p' = λ p + δ² q, q' = p + λ q, W' = W + (q p)* (q p).
typedef struct power {
    cplx p, q, w01;
    double w00, w11;
} power;

static power power_at(const chain *c, int k)
{
    const chain_powers *t = &c->powers;
    return (power){chain_power(c, &t->p, k), chain_power(c, &t->q, k), chain_power(c, &t->w01, k), t->w00[k],
                   t->w11[k]};
}

static power power_after(const chain *c, power at)
{
    return (power){.p = cplx_add(cplx_mul(c->lambda, at.p), cplx_mul(c->delta2, at.q)),
                   .q = cplx_add(at.p, cplx_mul(c->lambda, at.q)),
                   .w01 = cplx_add(at.w01, cplx_mul(at.q, cplx_conj(at.p))),
                   .w00 = at.w00 + cplx_norm(at.q),
                   .w11 = at.w11 + cplx_norm(at.p)};
}

/// The first block, one sample at a time.
static void begin_powers(chain *c)
{
    const chain_powers *t = &c->powers;
    power at = {.p = {1, 0}};
    for (int k = 0; k < CHAIN_BLOCK; k++, at = power_after(c, at)) {
        t->p.re[k] = at.p.re, t->p.im[k] = at.p.im, t->q.re[k] = at.q.re, t->q.im[k] = at.q.im;
        t->w00[k] = at.w00, t->w01.re[k] = at.w01.re, t->w01.im[k] = at.w01.im, t->w11[k] = at.w11;
    }
    c->powers_count = CHAIN_BLOCK;
}

/// Extends the blocks to `longest`: F^{k+i} = F^k F^i with F^i of the first block, and W's sums.
WIDEST static void extend_complex(chain *c, int longest)
{
    const chain_powers *t = &c->powers;
    double *restrict pr = t->p.re, *restrict pi = t->p.im, *restrict qr = t->q.re, *restrict qi = t->q.im;
    double ar[CHAIN_BLOCK], ai[CHAIN_BLOCK], br[CHAIN_BLOCK], bi[CHAIN_BLOCK];
    for (int i = 0; i < CHAIN_BLOCK; i++) ar[i] = pr[i], ai[i] = pi[i], br[i] = qr[i], bi[i] = qi[i];
    const power block = power_after(c, power_at(c, CHAIN_BLOCK - 1));
    const cplx block_dq = cplx_mul(c->delta2, block.q);
    int k = c->powers_count;
    power sum = power_after(c, power_at(c, k - 1));
    for (; k <= longest; k += CHAIN_BLOCK) {
        const cplx p = {pr[k - CHAIN_BLOCK], pi[k - CHAIN_BLOCK]}, q = {qr[k - CHAIN_BLOCK], qi[k - CHAIN_BLOCK]};
        const cplx f = cplx_add(cplx_mul(block.p, p), cplx_mul(block_dq, q));
        const cplx g = cplx_add(cplx_mul(block.p, q), cplx_mul(block.q, p)), dg = cplx_mul(c->delta2, g);
        double n00[CHAIN_BLOCK], n11[CHAIN_BLOCK], n01r[CHAIN_BLOCK], n01i[CHAIN_BLOCK];
        for (int i = 0; i < CHAIN_BLOCK; i++) {
            double xr = (f.re * ar[i] - f.im * ai[i]) + (dg.re * br[i] - dg.im * bi[i]);
            double xi = (f.re * ai[i] + f.im * ar[i]) + (dg.re * bi[i] + dg.im * br[i]);
            double yr = (f.re * br[i] - f.im * bi[i]) + (g.re * ar[i] - g.im * ai[i]);
            double yi = (f.re * bi[i] + f.im * br[i]) + (g.re * ai[i] + g.im * ar[i]);
            pr[k + i] = xr, pi[k + i] = xi, qr[k + i] = yr, qi[k + i] = yi;
            n00[i] = yr * yr + yi * yi, n11[i] = xr * xr + xi * xi;
            n01r[i] = yr * xr + yi * xi, n01i[i] = yi * xr - yr * xi;
        }
        for (int i = 0; i < CHAIN_BLOCK; i++) {
            t->w00[k + i] = sum.w00, t->w11[k + i] = sum.w11;
            t->w01.re[k + i] = sum.w01.re, t->w01.im[k + i] = sum.w01.im;
            sum.w00 += n00[i], sum.w11 += n11[i], sum.w01.re += n01r[i], sum.w01.im += n01i[i];
        }
    }
    c->powers_count = k;
}

static void extend_real(chain *c, int longest)
{
    const chain_powers *t = &c->powers;
    const double l = c->lambda.re, d = c->delta2.re;
    int k = c->powers_count - 1, end = longest + CHAIN_BLOCK - longest % CHAIN_BLOCK;
    double p = t->p.re[k], q = t->q.re[k], w00 = t->w00[k], w01 = t->w01.re[k], w11 = t->w11[k];
    while (++k < end) {
        w00 += q * q, w01 += q * p, w11 += p * p;
        double next = l * p + d * q;
        q = p + l * q;
        p = next;
        t->p.re[k] = p, t->q.re[k] = q;
        t->w00[k] = w00, t->w01.re[k] = w01, t->w11[k] = w11;
    }
    c->powers_count = end;
}

/// The columns of a costate, first row of W_i F*^{−i}: (w00 p* − w01 q*, w01 p* − w00 (δ² q)*) / (det F)*^i.
/// The destinations are parameters so that the compiler can assume that they do not overlap.
WIDEST static void set_pulled_complex(const chain *c, int from, int end, double *restrict g0r, double *restrict g0i,
                                      double *restrict g1r, double *restrict g1i)
{
    const chain_powers *t = &c->powers;
    const double *restrict pr = t->p.re, *restrict pi = t->p.im, *restrict qr = t->q.re, *restrict qi = t->q.im;
    const double *restrict w = t->w00, *restrict vr = t->w01.re, *restrict vi = t->w01.im;
    const double *restrict er = c->back.re, *restrict ei = c->back.im;
    const cplx d = c->delta2;
    for (int i = from; i < end; i++) {
        double rr = d.re * qr[i] - d.im * qi[i], ri = d.re * qi[i] + d.im * qr[i];
        double ar = w[i] * pr[i] - (vr[i] * qr[i] + vi[i] * qi[i]),
               ai = (vr[i] * qi[i] - vi[i] * qr[i]) - w[i] * pi[i];
        double br = (vr[i] * pr[i] + vi[i] * pi[i]) - w[i] * rr, bi = (vi[i] * pr[i] - vr[i] * pi[i]) + w[i] * ri;
        g0r[i] = ar * er[i] - ai * ei[i], g0i[i] = ar * ei[i] + ai * er[i];
        g1r[i] = br * er[i] - bi * ei[i], g1i[i] = br * ei[i] + bi * er[i];
    }
}

static void set_pulled_real(const chain *c, int from, int end)
{
    const chain_powers *t = &c->powers;
    for (int i = from; i < end; i++) {
        double p = t->p.re[i], q = t->q.re[i], w = t->w00[i], v = t->w01.re[i], e = c->back.re[i];
        c->pulled[0].re[i] = (w * p - v * q) * e;
        c->pulled[1].re[i] = (v * p - w * (c->delta2.re * q)) * e;
    }
}

/// Whole blocks, each a multiple of the one before.
static void set_pulled(const chain *c, int from, int end)
{
    const cplx det = cplx_conj(cplx_sub(cplx_mul(c->lambda, c->lambda), c->delta2));
    const double size = cplx_norm(det);
    const cplx inverse = {det.re / size, -det.im / size};
    cplx e = {1, 0};
    for (int i = 0; i < CHAIN_BLOCK; i++, e = cplx_mul(e, inverse)) c->back.re[i] = e.re, c->back.im[i] = e.im;
    for (int i = from > 0 ? from : CHAIN_BLOCK; i < end; i++) {
        cplx next = cplx_mul(e, (cplx){c->back.re[i - CHAIN_BLOCK], c->back.im[i - CHAIN_BLOCK]});
        c->back.re[i] = next.re, c->back.im[i] = next.im;
    }
    if (c->is_complex) {
        set_pulled_complex(c, from, end, c->pulled[0].re, c->pulled[0].im, c->pulled[1].re, c->pulled[1].im);
    } else {
        set_pulled_real(c, from, end);
    }
}

static void extend_powers(chain *c, int longest)
{
    int from = c->powers_count;
    if (from > longest) return;
    if (from == 0) begin_powers(c);
    if (c->powers_count <= longest) {
        if (c->is_complex) {
            extend_complex(c, longest);
        } else {
            extend_real(c, longest);
        }
    }
    int end = c->powers_count < CHAIN_RUN ? c->powers_count : CHAIN_RUN;
    if (from < end) set_pulled(c, from, end);
}

static void put_entry(chain_stretch *s, int at, cplx value) { s->form[at] = value.re, s->form[at + 1] = value.im; }

/// V = W⁻¹, C = V F, P = F* V F for the stretch's length; if it settles, the last input counts half.
static void set_form(const chain *c, chain_stretch *s)
{
    const chain_powers *t = &c->powers;
    int n = s->length;
    cplx p = chain_power(c, &t->p, n), q = chain_power(c, &t->q, n), r = cplx_mul(c->delta2, q);
    cplx w01 = chain_power(c, &t->w01, n);
    double w11 = t->w11[n] - (s->settles ? 0.5 : 0), det = t->w00[n] * w11 - cplx_norm(w01);
    double v00 = w11 / det, v11 = t->w00[n] / det;
    cplx v01 = cplx_scale(-1 / det, w01), v10 = cplx_conj(v01);
    cplx c00 = cplx_add(cplx_scale(v00, p), cplx_mul(v01, r)), c01 = cplx_add(cplx_scale(v00, q), cplx_mul(v01, p));
    cplx c10 = cplx_add(cplx_mul(v10, p), cplx_scale(v11, r)), c11 = cplx_add(cplx_mul(v10, q), cplx_scale(v11, p));
    s->form[FORM_V00] = v00, s->form[FORM_V11] = v11;
    s->form[FORM_P00] = cplx_mul(cplx_conj(p), c00).re + cplx_mul(cplx_conj(r), c10).re;
    s->form[FORM_P11] = cplx_mul(cplx_conj(q), c01).re + cplx_mul(cplx_conj(p), c11).re;
    put_entry(s, FORM_V01, v01);
    put_entry(s, FORM_P01, cplx_add(cplx_mul(cplx_conj(p), c01), cplx_mul(cplx_conj(r), c11)));
    put_entry(s, FORM_C00, c00), put_entry(s, FORM_C01, c01);
    put_entry(s, FORM_C10, c10), put_entry(s, FORM_C11, c11);
}

static void forget_stretches(chain *c)
{
    for (int s = 0; s < c->stretch_count; s++) c->stretch_of[c->stretches[s].settles][c->stretches[s].length] = 0;
    c->stretch_count = 0;
}

void chain_forget(chain *c)
{
    forget_stretches(c);
    c->powers_count = 0;
    c->kept = false;
}

/// The stretch of a length, created if need be; -1 if there is no room.
static int find_stretch(chain *c, int length, bool settles)
{
    int *at = &c->stretch_of[settles][length];
    if (*at > 0) return *at - 1;
    if (c->stretch_count == c->stretch_capacity) return -1;
    extend_powers(c, length);
    chain_stretch *s = &c->stretches[c->stretch_count++];
    s->length = length;
    s->settles = settles;
    set_form(c, s);
    chain_measure(c, s);
    *at = c->stretch_count;
    return c->stretch_count - 1;
}

/// Samples of the stretch after node j.
static int length_after(const chain *c, int j)
{
    int ahead = j + 1 < c->node_count ? c->nodes[j + 1].sample : c->count;
    return ahead - c->nodes[j].sample;
}

void chain_make_tables(chain *c)
{
    int after = c->cyclic ? 0 : c->count - 1 - c->nodes[c->node_count - 1].sample;
    extend_powers(c, after < CHAIN_RUN ? after : CHAIN_RUN);
    for (int j = 0; j < chain_stretches(c); j++) {
        bool settles = c->nodes[chain_next(c, j)].fixed & (NODE_SETTLED | NODE_STILL);
        int stretch = find_stretch(c, length_after(c, j), settles);
        if (stretch < 0) { // full of earlier solves' lengths; this solve's fit, as there are no more than nodes
            forget_stretches(c);
            j = -1;
        } else {
            c->nodes[j].stretch = stretch;
        }
    }
}

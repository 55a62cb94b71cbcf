/// Powers of the filter and the condensed stretches (see chain.c for the mathematics).
#include "spline/chain.h"
#include "spline/wide.h"

/// Tables p, q and W up to `longest`, from where they end now: p' = λ p + δ² q, q' = p + λ q, W' = W + (q p)* (q p).
static void extend_complex(chain *c, int longest)
{
    const chain_powers *t = &c->powers;
    const cplx l = c->lambda, d = c->delta2;
    int k = c->powers_count - 1;
    cplx p = {t->p.re[k], t->p.im[k]}, q = {t->q.re[k], t->q.im[k]}, w01 = {t->w01.re[k], t->w01.im[k]};
    double w00 = t->w00[k], w11 = t->w11[k];
    while (k++ < longest) {
        w00 += cplx_norm(q), w11 += cplx_norm(p);
        w01 = cplx_add(w01, cplx_mul(q, cplx_conj(p)));
        cplx next = cplx_add(cplx_mul(l, p), cplx_mul(d, q));
        q = cplx_add(p, cplx_mul(l, q));
        p = next;
        t->p.re[k] = p.re, t->p.im[k] = p.im, t->q.re[k] = q.re, t->q.im[k] = q.im;
        t->w00[k] = w00, t->w01.re[k] = w01.re, t->w01.im[k] = w01.im, t->w11[k] = w11;
    }
}

static void extend_real(chain *c, int longest)
{
    const chain_powers *t = &c->powers;
    const double l = c->lambda.re, d = c->delta2.re;
    int k = c->powers_count - 1;
    double p = t->p.re[k], q = t->q.re[k], w00 = t->w00[k], w01 = t->w01.re[k], w11 = t->w11[k];
    while (k++ < longest) {
        w00 += q * q, w01 += q * p, w11 += p * p;
        double next = l * p + d * q;
        q = p + l * q;
        p = next;
        t->p.re[k] = p, t->q.re[k] = q;
        t->w00[k] = w00, t->w01.re[k] = w01, t->w11[k] = w11;
    }
}

static void extend_powers(chain *c, int longest)
{
    const chain_powers *t = &c->powers;
    if (c->powers_count > longest) return;
    if (c->powers_count == 0) {
        t->p.re[0] = 1;
        t->p.im[0] = t->q.re[0] = t->q.im[0] = t->w00[0] = t->w01.re[0] = t->w01.im[0] = t->w11[0] = 0;
        c->powers_count = 1;
    }
    if (c->is_complex) {
        extend_complex(c, longest);
    } else {
        extend_real(c, longest);
    }
    c->powers_count = longest + 1;
}

static void put_entry(chain_stretch *s, int at, cplx value) { s->form[at] = value.re, s->form[at + 1] = value.im; }

/// V = W⁻¹, C = V F, P = F* V F at the stretch's length; the last input counts half where it settles.
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

/// The table of forced columns, the first row of W_i F*^{L−i}: (w00 p* + w01 q*, w00 (δ² q)* + w01 p*).
WIDEST static void set_forced_complex(const chain *c, const chain_stretch *s)
{
    const chain_powers *t = &c->powers;
    const double *restrict pr = t->p.re, *restrict pi = t->p.im, *restrict qr = t->q.re, *restrict qi = t->q.im;
    const double *restrict w = t->w00, *restrict vr = t->w01.re, *restrict vi = t->w01.im;
    double *restrict g0r = c->forced[0].re + s->first, *restrict g0i = c->forced[0].im + s->first;
    double *restrict g1r = c->forced[1].re + s->first, *restrict g1i = c->forced[1].im + s->first;
    const cplx d = c->delta2;
    const int n = s->length;
    for (int i = 0; i < n; i++) {
        const int k = n - i;
        double rr = d.re * qr[k] - d.im * qi[k], ri = d.re * qi[k] + d.im * qr[k];
        g0r[i] = w[i] * pr[k] + (vr[i] * qr[k] + vi[i] * qi[k]);
        g0i[i] = (vi[i] * qr[k] - vr[i] * qi[k]) - w[i] * pi[k];
        g1r[i] = w[i] * rr + (vr[i] * pr[k] + vi[i] * pi[k]);
        g1i[i] = (vi[i] * pr[k] - vr[i] * pi[k]) - w[i] * ri;
    }
}

WIDEST static void set_forced_real(const chain *c, const chain_stretch *s)
{
    const double *restrict p = c->powers.p.re, *restrict q = c->powers.q.re;
    const double *restrict w = c->powers.w00, *restrict v = c->powers.w01.re;
    double *restrict g0 = c->forced[0].re + s->first, *restrict g1 = c->forced[1].re + s->first;
    const double d = c->delta2.re;
    const int n = s->length;
    for (int i = 0; i < n; i++) {
        g0[i] = w[i] * p[n - i] + v[i] * q[n - i];
        g1[i] = w[i] * (d * q[n - i]) + v[i] * p[n - i];
    }
}

static void forget_stretches(chain *c)
{
    for (int s = 0; s < c->stretch_count; s++) c->stretch_of[c->stretches[s].settles][c->stretches[s].length] = 0;
    c->stretch_count = c->forced_count = 0;
    c->forgotten++;
}

void chain_forget(chain *c)
{
    forget_stretches(c);
    c->powers_count = 0;
    c->kept = false;
}

/// The stretch of a length, made where it is not there yet; -1 where there is no room for it.
static int find_stretch(chain *c, int length, bool settles)
{
    int *at = &c->stretch_of[settles][length], twin = c->stretch_of[!settles][length];
    if (*at > 0) return *at - 1;
    int columns = twin > 0 ? 0 : length; // the samples inside are the same
    if (c->stretch_count == c->stretch_capacity || c->forced_count + columns > c->forced_capacity) return -1;
    extend_powers(c, length);
    chain_stretch *s = &c->stretches[c->stretch_count++];
    *s = (chain_stretch){.length = length, .settles = settles, .first = c->forced_count};
    c->forced_count += columns;
    set_form(c, s);
    if (twin > 0) {
        s->first = c->stretches[twin - 1].first;
    } else if (c->is_complex) {
        set_forced_complex(c, s);
    } else {
        set_forced_real(c, s);
    }
    *at = c->stretch_count;
    return c->stretch_count - 1;
}

void chain_make_tables(chain *c)
{
    int after = c->cyclic ? 0 : c->count - 1 - c->nodes[c->node_count - 1].sample;
    extend_powers(c, after < CHAIN_RUN ? after : CHAIN_RUN);
    for (int j = 0; j < chain_stretches(c); j++) {
        bool settles = c->nodes[chain_next(c, j)].fixed & NODE_SETTLED;
        int stretch = find_stretch(c, chain_length_after(c, j), settles);
        if (stretch <
            0) { // full of lengths of earlier solves; those of this one fit, their sum is at most the domain
            forget_stretches(c);
            j = -1;
        } else {
            c->nodes[j].stretch = stretch;
        }
    }
}

// Powers of the filter and the condensed stretches (see chain.c for the mathematics).
#include "spline/chain.h"

static cplx entry(const cplx_array *a, int k, bool is_complex) { return (cplx){a->re[k], is_complex ? a->im[k] : 0}; }

static void set_entry(const cplx_array *a, int k, bool is_complex, cplx value)
{
    a->re[k] = value.re;
    if (is_complex) a->im[k] = value.im;
}

/// Tables F^k and W_k up to `longest`: F^{k+1} = F F^k, W_{k+1} = F W_k F* + B B*.
static void make_powers(const chain *c, int longest)
{
    const chain_powers *t = &c->powers;
    bool z = c->is_complex;
    const cplx l = c->lambda, d = c->delta2, ls = cplx_conj(l), ds = cplx_conj(d);
    cplx f00 = {1, 0}, f01 = {0, 0}, f10 = {0, 0}, f11 = {1, 0}, w01 = {0, 0};
    double w00 = 0, w11 = 0;
    for (int k = 0; k <= longest; k++) {
        set_entry(&t->f00, k, z, f00), set_entry(&t->f01, k, z, f01);
        set_entry(&t->f10, k, z, f10), set_entry(&t->f11, k, z, f11);
        set_entry(&t->w01, k, z, w01);
        t->w00[k] = w00, t->w11[k] = w11;
        cplx g00 = cplx_add(cplx_mul(l, f00), f10), g01 = cplx_add(cplx_mul(l, f01), f11);
        f10 = cplx_add(cplx_mul(d, f00), cplx_mul(l, f10));
        f11 = cplx_add(cplx_mul(d, f01), cplx_mul(l, f11));
        f00 = g00, f01 = g01;
        cplx w10 = cplx_conj(w01); // rows of F W, then times F*
        cplx a0 = cplx_add(cplx_scale(w00, l), w10), a1 = cplx_add(cplx_mul(l, w01), (cplx){w11, 0});
        cplx b0 = cplx_add(cplx_scale(w00, d), cplx_mul(l, w10)), b1 = cplx_add(cplx_mul(d, w01), cplx_scale(w11, l));
        w00 = cplx_mul(a0, ls).re + a1.re;
        w01 = cplx_add(cplx_mul(a0, ds), cplx_mul(a1, ls));
        w11 = cplx_mul(b0, ds).re + cplx_mul(b1, ls).re + 1;
    }
}

/// V = W⁻¹, C = V F, P = F* V F at the stretch's length, and its table of forced columns.
static void make_stretch(const chain *c, chain_stretch *s)
{
    const chain_powers *t = &c->powers;
    bool z = c->is_complex;
    int n = s->length;
    cplx f00 = entry(&t->f00, n, z), f01 = entry(&t->f01, n, z), f10 = entry(&t->f10, n, z),
         f11 = entry(&t->f11, n, z);
    cplx w01 = entry(&t->w01, n, z);
    double det = t->w00[n] * t->w11[n] - cplx_norm(w01);
    s->v00 = t->w11[n] / det, s->v11 = t->w00[n] / det;
    s->v01 = cplx_scale(-1 / det, w01);
    cplx v10 = cplx_conj(s->v01);
    s->c00 = cplx_add(cplx_scale(s->v00, f00), cplx_mul(s->v01, f10));
    s->c01 = cplx_add(cplx_scale(s->v00, f01), cplx_mul(s->v01, f11));
    s->c10 = cplx_add(cplx_mul(v10, f00), cplx_scale(s->v11, f10));
    s->c11 = cplx_add(cplx_mul(v10, f01), cplx_scale(s->v11, f11));
    s->p00 = cplx_mul(cplx_conj(f00), s->c00).re + cplx_mul(cplx_conj(f10), s->c10).re;
    s->p01 = cplx_add(cplx_mul(cplx_conj(f00), s->c01), cplx_mul(cplx_conj(f10), s->c11));
    s->p11 = cplx_mul(cplx_conj(f01), s->c01).re + cplx_mul(cplx_conj(f11), s->c11).re;
    for (int i = 0; i < n; i++) {
        cplx g00 = cplx_conj(entry(&t->f00, n - i, z)), g01 = cplx_conj(entry(&t->f01, n - i, z));
        cplx g10 = cplx_conj(entry(&t->f10, n - i, z)), g11 = cplx_conj(entry(&t->f11, n - i, z));
        cplx w = entry(&t->w01, i, z); // F* has the conjugates transposed
        set_entry(&c->forced[0], s->first + i, z, cplx_add(cplx_scale(t->w00[i], g00), cplx_mul(w, g01)));
        set_entry(&c->forced[1], s->first + i, z, cplx_add(cplx_scale(t->w00[i], g10), cplx_mul(w, g11)));
    }
}

void chain_make_tables(chain *c)
{
    int longest = 0, used = 0;
    c->stretch_count = 0;
    for (int j = 0; j + 1 < c->node_count; j++) {
        int length = c->nodes[j + 1].sample - c->nodes[j].sample;
        longest = length > longest ? length : longest;
    }
    for (int k = 0; k <= longest; k++) c->stretch_of[k] = -1;
    make_powers(c, longest);
    for (int j = 0; j + 1 < c->node_count; j++) {
        int length = c->nodes[j + 1].sample - c->nodes[j].sample;
        if (c->stretch_of[length] < 0) {
            c->stretch_of[length] = c->stretch_count;
            chain_stretch *s = &c->stretches[c->stretch_count++];
            *s = (chain_stretch){.length = length, .first = used};
            used += length;
            make_stretch(c, s);
        }
        c->nodes[j].stretch = c->stretch_of[length];
    }
}

// Powers of the filter and the condensed stretches (see chain.c for the mathematics).
#include "spline/chain.h"

static cplx entry(const cplx_array *a, int k, bool is_complex) { return (cplx){a->re[k], is_complex ? a->im[k] : 0}; }

static void set_entry(const cplx_array *a, int k, bool is_complex, cplx value)
{
    a->re[k] = value.re;
    if (is_complex) a->im[k] = value.im;
}

/// Tables F^k and W_k up to `longest`, from where they end now: F^{k+1} = F F^k, W_{k+1} = F W_k F* + B B*.
static void extend_powers(chain *c, int longest)
{
    const chain_powers *t = &c->powers;
    bool z = c->is_complex;
    const cplx l = c->lambda, d = c->delta2, ls = cplx_conj(l), ds = cplx_conj(d);
    for (int k = c->powers_count; k <= longest; k++) {
        cplx f00 = {1, 0}, f01 = {0, 0}, f10 = {0, 0}, f11 = {1, 0}, w01 = {0, 0};
        double w00 = 0, w11 = 0;
        if (k > 0) {
            cplx g00 = entry(&t->f00, k - 1, z), g01 = entry(&t->f01, k - 1, z);
            cplx g10 = entry(&t->f10, k - 1, z), g11 = entry(&t->f11, k - 1, z);
            f00 = cplx_add(cplx_mul(l, g00), g10), f01 = cplx_add(cplx_mul(l, g01), g11);
            f10 = cplx_add(cplx_mul(d, g00), cplx_mul(l, g10)), f11 = cplx_add(cplx_mul(d, g01), cplx_mul(l, g11));
            cplx v01 = entry(&t->w01, k - 1, z), v10 = cplx_conj(v01); // rows of F W, then times F*
            double v00 = t->w00[k - 1], v11 = t->w11[k - 1];
            cplx a0 = cplx_add(cplx_scale(v00, l), v10), a1 = cplx_add(cplx_mul(l, v01), (cplx){v11, 0});
            cplx b0 = cplx_add(cplx_scale(v00, d), cplx_mul(l, v10));
            cplx b1 = cplx_add(cplx_mul(d, v01), cplx_scale(v11, l));
            w00 = cplx_mul(a0, ls).re + a1.re;
            w01 = cplx_add(cplx_mul(a0, ds), cplx_mul(a1, ls));
            w11 = cplx_mul(b0, ds).re + cplx_mul(b1, ls).re + 1;
        }
        set_entry(&t->f00, k, z, f00), set_entry(&t->f01, k, z, f01);
        set_entry(&t->f10, k, z, f10), set_entry(&t->f11, k, z, f11);
        set_entry(&t->w01, k, z, w01);
        t->w00[k] = w00, t->w11[k] = w11;
    }
    if (c->powers_count <= longest) c->powers_count = longest + 1;
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

static void forget_stretches(chain *c)
{
    for (int s = 0; s < c->stretch_count; s++) c->stretch_of[c->stretches[s].length] = 0;
    c->stretch_count = c->forced_count = 0;
}

void chain_forget(chain *c)
{
    forget_stretches(c);
    c->powers_count = 0;
    c->kept = false;
}

/// The stretch of a length, made where it is not there yet; -1 where there is no room for it.
static int find_stretch(chain *c, int length)
{
    if (c->stretch_of[length] > 0) return c->stretch_of[length] - 1;
    if (c->stretch_count == c->stretch_capacity || c->forced_count + length > c->powers_capacity) return -1;
    extend_powers(c, length);
    chain_stretch *s = &c->stretches[c->stretch_count++];
    *s = (chain_stretch){.length = length, .first = c->forced_count};
    c->forced_count += length;
    make_stretch(c, s);
    c->stretch_of[length] = c->stretch_count;
    return c->stretch_count - 1;
}

void chain_make_tables(chain *c)
{
    for (int j = 0; j + 1 < c->node_count; j++) {
        int stretch = find_stretch(c, c->nodes[j + 1].sample - c->nodes[j].sample);
        if (stretch <
            0) { // full of lengths of earlier solves; those of this one fit, their sum is at most the domain
            forget_stretches(c);
            j = -1;
        } else {
            c->nodes[j].stretch = stretch;
        }
    }
}

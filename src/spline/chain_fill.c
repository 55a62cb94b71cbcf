// The samples inside a stretch: most of the arithmetic. In vectors of eight, as wide as the processor has them; the last one of a
// stretch reaches back over samples that are there already, and gives them the same bits.
#include "spline/chain.h"
#include "spline/wide.h"

enum { WIDTH = 8 };
typedef double wide __attribute__((vector_size(8 * WIDTH), aligned(8), may_alias));

#define AT(column) (*(const wide *)((column) + i))

/// Where the vector after the one at i begins; at `count` or beyond where that was the last.
static inline int after(int i, int count)
{
    return i + 2 * WIDTH <= count || i + WIDTH == count ? i + WIDTH : count - WIDTH;
}

/// Parts of f a + g b.
static inline double sum_re(const cplx_array *f, const cplx_array *g, int i, cplx a, cplx b)
{
    return (f->re[i] * a.re - f->im[i] * a.im) + (g->re[i] * b.re - g->im[i] * b.im);
}

static inline double sum_im(const cplx_array *f, const cplx_array *g, int i, cplx a, cplx b)
{
    return (f->re[i] * a.im + f->im[i] * a.re) + (g->re[i] * b.im + g->im[i] * b.re);
}

WIDEST void chain_fill_complex(const chain *c, const chain_stretch *s, const cplx weight[4], double *restrict re,
                               double *restrict im)
{
    const cplx_array f0 = c->powers.p, f1 = c->powers.q;
    const cplx_array g0 = {c->forced[0].re + s->first, c->forced[0].im + s->first};
    const cplx_array g1 = {c->forced[1].re + s->first, c->forced[1].im + s->first};
    const cplx a = weight[0], b = weight[1], d = weight[2], e = weight[3];
    const int n = s->length;
    for (int i = 0; i < n && n < WIDTH; i++) {
        re[i] = sum_re(&f0, &f1, i, a, b) + sum_re(&g0, &g1, i, d, e);
        im[i] = sum_im(&f0, &f1, i, a, b) + sum_im(&g0, &g1, i, d, e);
    }
    for (int i = 0; i < n && n >= WIDTH; i = after(i, n)) {
        wide f0r = AT(f0.re), f0i = AT(f0.im), f1r = AT(f1.re), f1i = AT(f1.im);
        wide g0r = AT(g0.re), g0i = AT(g0.im), g1r = AT(g1.re), g1i = AT(g1.im);
        *(wide *)(re + i) = ((f0r * a.re - f0i * a.im) + (f1r * b.re - f1i * b.im)) +
                            ((g0r * d.re - g0i * d.im) + (g1r * e.re - g1i * e.im));
        *(wide *)(im + i) = ((f0r * a.im + f0i * a.re) + (f1r * b.im + f1i * b.re)) +
                            ((g0r * d.im + g0i * d.re) + (g1r * e.im + g1i * e.re));
    }
}

WIDEST void chain_fill_real(const chain *c, const chain_stretch *s, const double weight[4], double *restrict re)
{
    const double *f0 = c->powers.p.re, *f1 = c->powers.q.re;
    const double *g0 = c->forced[0].re + s->first, *g1 = c->forced[1].re + s->first;
    const double a = weight[0], b = weight[1], d = weight[2], e = weight[3];
    const int n = s->length;
    for (int i = 0; i < n && n < WIDTH; i++) re[i] = (f0[i] * a + f1[i] * b) + (g0[i] * d + g1[i] * e);
    for (int i = 0; i < n && n >= WIDTH; i = after(i, n)) {
        *(wide *)(re + i) = (AT(f0) * a + AT(f1) * b) + (AT(g0) * d + AT(g1) * e);
    }
}

WIDEST void chain_fill_free_complex(const chain *c, int count, cplx x, cplx d, double *restrict re,
                                    double *restrict im)
{
    const cplx_array p = c->powers.p, q = c->powers.q;
    for (int i = 0; i < count; i++) {
        re[i] = sum_re(&p, &q, i, x, d);
        im[i] = sum_im(&p, &q, i, x, d);
    }
}

WIDEST void chain_fill_free_real(const chain *c, int count, double x, double d, double *restrict re)
{
    const double *restrict p = c->powers.p.re, *restrict q = c->powers.q.re;
    for (int i = 0; i < count; i++) re[i] = p[i] * x + q[i] * d;
}

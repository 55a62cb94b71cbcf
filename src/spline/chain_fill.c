/// The samples inside a stretch: most of the arithmetic.
#include "spline/chain.h"
#include "spline/wide.h"

WIDEST void chain_fill_complex(const chain *c, const cplx weight[4], int from, int count, double *restrict re,
                               double *restrict im)
{
    const double *restrict f0r = c->powers.p.re + from, *restrict f0i = c->powers.p.im + from;
    const double *restrict f1r = c->powers.q.re + from, *restrict f1i = c->powers.q.im + from;
    const double *restrict g0r = c->pulled[0].re + from, *restrict g0i = c->pulled[0].im + from;
    const double *restrict g1r = c->pulled[1].re + from, *restrict g1i = c->pulled[1].im + from;
    const cplx a = weight[0], b = weight[1], d = weight[2], e = weight[3];
    for (int i = 0; i < count; i++) {
        re[i] = ((f0r[i] * a.re - f0i[i] * a.im) + (f1r[i] * b.re - f1i[i] * b.im)) +
                ((g0r[i] * d.re - g0i[i] * d.im) + (g1r[i] * e.re - g1i[i] * e.im));
        im[i] = ((f0r[i] * a.im + f0i[i] * a.re) + (f1r[i] * b.im + f1i[i] * b.re)) +
                ((g0r[i] * d.im + g0i[i] * d.re) + (g1r[i] * e.im + g1i[i] * e.re));
    }
}

WIDEST void chain_fill_real(const chain *c, const cplx weight[4], int from, int count, double *restrict re)
{
    const double *restrict f0 = c->powers.p.re + from, *restrict f1 = c->powers.q.re + from;
    const double *restrict g0 = c->pulled[0].re + from, *restrict g1 = c->pulled[1].re + from;
    const double a = weight[0].re, b = weight[1].re, d = weight[2].re, e = weight[3].re;
    for (int i = 0; i < count; i++) re[i] = (f0[i] * a + f1[i] * b) + (g0[i] * d + g1[i] * e);
}

WIDEST void chain_fill_free_complex(const chain *c, int count, cplx x, cplx d, double *restrict re,
                                    double *restrict im)
{
    const double *restrict pr = c->powers.p.re, *restrict pi = c->powers.p.im;
    const double *restrict qr = c->powers.q.re, *restrict qi = c->powers.q.im;
    for (int i = 0; i < count; i++) {
        re[i] = (pr[i] * x.re - pi[i] * x.im) + (qr[i] * d.re - qi[i] * d.im);
        im[i] = (pr[i] * x.im + pi[i] * x.re) + (qr[i] * d.im + qi[i] * d.re);
    }
}

WIDEST void chain_fill_free_real(const chain *c, int count, double x, double d, double *restrict re)
{
    const double *restrict p = c->powers.p.re, *restrict q = c->powers.q.re;
    for (int i = 0; i < count; i++) re[i] = p[i] * x + q[i] * d;
}

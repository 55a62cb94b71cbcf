// The samples inside a stretch: most of the arithmetic, and the only loop that is worth compiling for wider vectors. Each sample is
// computed by the same operations in the same order whatever the width (no sums across lanes, no fused multiply-add), so the
// result is the same to the last bit.
#include "spline/chain.h"

#if defined(__x86_64__) && defined(__gnu_linux__) && !defined(__SANITIZE_ADDRESS__) && !defined(__clang__)
#define WIDEST __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define WIDEST
#endif

WIDEST void chain_fill_complex(const chain *c, const chain_stretch *s, const cplx weight[4], double *restrict re,
                               double *restrict im)
{
    const double *restrict f0r = c->powers.f00.re, *restrict f0i = c->powers.f00.im;
    const double *restrict f1r = c->powers.f01.re, *restrict f1i = c->powers.f01.im;
    const double *restrict g0r = c->forced[0].re + s->first, *restrict g0i = c->forced[0].im + s->first;
    const double *restrict g1r = c->forced[1].re + s->first, *restrict g1i = c->forced[1].im + s->first;
    const cplx a = weight[0], b = weight[1], d = weight[2], e = weight[3];
    for (int i = 0; i < s->length; i++) {
        re[i] = (f0r[i] * a.re - f0i[i] * a.im) + (f1r[i] * b.re - f1i[i] * b.im) + (g0r[i] * d.re - g0i[i] * d.im) +
                (g1r[i] * e.re - g1i[i] * e.im);
        im[i] = (f0r[i] * a.im + f0i[i] * a.re) + (f1r[i] * b.im + f1i[i] * b.re) + (g0r[i] * d.im + g0i[i] * d.re) +
                (g1r[i] * e.im + g1i[i] * e.re);
    }
}

WIDEST void chain_fill_real(const chain *c, const chain_stretch *s, const cplx weight[4], double *restrict re)
{
    const double *restrict f0 = c->powers.f00.re, *restrict f1 = c->powers.f01.re;
    const double *restrict g0 = c->forced[0].re + s->first, *restrict g1 = c->forced[1].re + s->first;
    const double a = weight[0].re, b = weight[1].re, d = weight[2].re, e = weight[3].re;
    for (int i = 0; i < s->length; i++) re[i] = (f0[i] * a + f1[i] * b) + (g0[i] * d + g1[i] * e);
}

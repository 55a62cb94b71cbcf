/// The free motion after the last knot: w_{i+1} = e^{ph} w_i, p = −ζω_n + jω_n√(1−ζ²); a cubic holds its total.
#include "spline/problem.h"
#include "spline/wide.h"

enum { RUN = 64 }; ///< samples filled from one power

WIDEST static void scale_powers(const double *restrict power_re, const double *restrict power_im, cplx w, int count,
                                double *restrict re, double *restrict im)
{
    for (int i = 0; i < count; i++) {
        re[i] = power_re[i] * w.re - power_im[i] * w.im;
        im[i] = power_re[i] * w.im + power_im[i] * w.re;
    }
}

/// Fills each run of samples on its own, counted from the knot, so that the result does not depend on `from`.
static void fill_constant(cplx exponent, cplx w, int from, int count, double *re, double *im)
{
    double power_re[RUN], power_im[RUN];
    const int end = from % RUN + count, needed = end < RUN ? end : RUN;
    cplx turn = cplx_exp(exponent), power = {1, 0};
    for (int i = 0; i < needed; i++) {
        power_re[i] = power.re, power_im[i] = power.im;
        power = cplx_mul(power, turn);
    }
    for (int i = 0; i < count;) {
        int run = (from + i) / RUN, begin = (from + i) % RUN, rest = RUN - begin;
        int n = rest < count - i ? rest : count - i;
        cplx base = run > 0 ? cplx_mul(cplx_exp(cplx_scale(run * (double)RUN, exponent)), w) : w;
        scale_powers(power_re + begin, power_im + begin, base, n, re + i, im + i);
        i += n;
    }
}

static void fill_varying(const problem *p, cplx w, int from, int count, double *re, double *im)
{
    poles here = poles_at(p->desc, p->latest, 0);
    for (int k = 1; k < from + count; k++) { // p of an interval is the mean at its ends
        poles next = poles_at(p->desc, p->latest + k, 0);
        cplx both = cplx_add(poles_passive(&here), poles_passive(&next));
        w = cplx_mul(cplx_exp(cplx_scale(0.5 * p->desc->step, both)), w);
        here = next;
        if (k >= from) re[k - from] = w.re, im[k - from] = w.im;
    }
}

void problem_fill_tail(wiggly_solver *solver, const problem *p, cplx w, int from, int count, double *re, double *im)
{
    if (p->desc->mode != WIGGLY_COMPLEX) {
        for (int i = 0; i < count; i++) re[i] = w.re;
    } else if (poles_are_constant(p->desc)) {
        fill_constant(problem_filter(solver, p)->passive, w, from, count, re, im);
    } else {
        fill_varying(p, w, from, count, re, im);
    }
}

void problem_settle(wiggly_solver *solver, const problem *p, double *re, double *im)
{
    int after = p->latest + 1, count = p->desc->samples - after;
    if (!p->settles || count < 1) return;
    problem_fill_tail(solver, p, (cplx){re[p->latest], im[p->latest]}, 1, count, re + after, im + after);
}

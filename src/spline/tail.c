/// The free motion after the last knot: w_{i+1} = e^{ph} w_i, p = −ζω_n + jω_n√(1−ζ²); a cubic holds its total.
#include "spline/problem.h"
#include "spline/wide.h"

WIDEST static void scale_powers(const double *restrict power_re, const double *restrict power_im, cplx w, int count,
                                double *restrict re, double *restrict im)
{
    for (int i = 0; i < count; i++) {
        re[i] = power_re[i] * w.re - power_im[i] * w.im;
        im[i] = power_re[i] * w.im + power_im[i] * w.re;
    }
}

/// The first powers of a free motion's step; those of the motion before are kept.
static const free_powers *powers_of(wiggly_solver *solver, cplx exponent, int needed)
{
    free_powers *p = &solver->powers;
    if (p->count >= needed && p->exponent.re == exponent.re && p->exponent.im == exponent.im) return p;
    const cplx turn = cplx_exp(exponent);
    cplx power = {1, 0};
    *p = (free_powers){.exponent = exponent, .count = needed};
    for (int i = 0; i < needed; i++) {
        p->re[i] = power.re, p->im[i] = power.im;
        power = cplx_mul(power, turn);
    }
    return p;
}

/// Fills each run of samples on its own, counted from the knot, so that the result does not depend on `from`.
static void fill_constant(wiggly_solver *solver, cplx exponent, cplx w, int from, int count, double *re, double *im)
{
    const int end = from % FREE_RUN + count;
    const free_powers *power = powers_of(solver, exponent, end < FREE_RUN ? end : FREE_RUN);
    for (int i = 0; i < count;) {
        const int run = (from + i) / FREE_RUN, begin = (from + i) % FREE_RUN, rest = FREE_RUN - begin;
        const int n = rest < count - i ? rest : count - i;
        cplx base = w;
        if (run > 0) base = cplx_mul(cplx_exp(cplx_scale(run * (double)FREE_RUN, exponent)), w);
        scale_powers(power->re + begin, power->im + begin, base, n, re + i, im + i);
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
        fill_constant(solver, problem_filter(solver, p)->passive, w, from, count, re, im);
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

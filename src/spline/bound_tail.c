/// After the last knot w is free, w = e^{p…} w_L, until bounds push it: w = e^{p…} w_L + e. Re e is the real oscillator's spline from rest
/// at L; Im e turns with it.
//
// e = G r is the filter run forward over the jets r, each of which costs weight |r|²/(h³|g|²). So a push f causes e = G W⁻¹ Gᵀ f: run the
// filter backwards over f, scale, and run it forward.
#include "spline/bound_tail.h"
#include "maths/maths.h"
#include "spline/oscillator.h"
#include <math.h>

bound_tail bound_tail_of(const problem *p, double weight)
{
    const wiggly_desc *desc = p->desc;
    bound_tail tail = {.desc = *desc, .is_complex = desc->mode == WIGGLY_COMPLEX, .weight = weight};
    const bool alone = !problem_is_asked(p) && p->start != WIGGLY_LOOP;
    tail.begin = alone ? 0 : p->latest;
    tail.end = alone || p->settles ? desc->samples : 0;
    tail.desc.mode = WIGGLY_REAL;
    return tail;
}

tail_row bound_tail_row(const bound_tail *tail, int sample, const double c[2])
{
    tail_row row = {.sample = sample, .on = {0, c[0], 0}};
    if (!tail->is_complex || c[1] == 0) return row;
    const poles at = poles_at(&tail->desc, sample, 0);
    const double h = tail->desc.step;
    const oscillator o = {at.decay, at.natural * at.natural};
    const double turn = -c[1] * oscillator_turn(o, (tail->desc.samples - 1) * h);
    const speed_form back = poles_speed(&at, h, true), ahead = poles_speed(&at, h, false);
    const bool both = sample + 1 < tail->end;
    const double share = turn / h * (both ? 0.5 : 1);
    row.on[1] += turn * o.d + share * (back.on_x.re + back.on_e.re);
    row.on[0] -= share * back.on_e.re;
    if (!both) return row;
    row.on[1] += share * (ahead.on_x.re - ahead.on_e.re);
    row.on[2] += share * ahead.on_e.re;
    return row;
}

double bound_tail_see(const bound_tail *tail, const tail_row *row, const double *e)
{
    double sum = 0;
    for (int k = 0; k < 3; k++) {
        const int sample = row->sample + k - 1;
        if (bound_tail_moves(tail, sample)) sum += row->on[k] * e[sample];
    }
    return sum;
}

/// The filter at a sample: x_{i+1} = a x_i + b x_{i−1} + r_i.
typedef struct step {
    double a, b, ease; ///< ease: h³|g|²/weight
} step;

static step step_at(const bound_tail *tail, int sample)
{
    const poles at = poles_at(&tail->desc, sample, 0);
    const double h = tail->desc.step;
    const coefficients c = poles_coefficients(&at, h);
    const double g2 = tail->desc.passive == WIGGLY_FILTER ? 1 : maths_exp(-poles_weight_exponent(&at, h));
    return (step){2 + c.m.re, -(1 + c.m.re + c.p.re), h * h * h * g2 / tail->weight};
}

void bound_tail_press(const bound_tail *tail, const tail_row *row, double push, double *pressed, double *e)
{
    const bool constant = poles_are_constant(&tail->desc);
    const step first = step_at(tail, tail->begin);
    double after = 0, last = 0; // pressure at the samples two and one ahead
    const int end = row->sample + 2 < tail->end ? row->sample + 2 : tail->end;
    step ahead = first, at = constant ? first : step_at(tail, end - 1);
    for (int i = end - 1; i > tail->begin; i--) {
        const int k = i - row->sample + 1;
        double now = (k >= 0 && k < 3 ? row->on[k] * push : 0) + at.a * last + ahead.b * after;
        after = last, last = now;
        pressed[i] = now;
        ahead = at;
        if (!constant) at = step_at(tail, i - 1);
    }
    double before = 0, x = 0;
    for (int i = tail->begin; i + 1 < tail->end; i++) {
        const step s = constant ? first : step_at(tail, i);
        const double next = s.a * x + s.b * before + (i + 1 < end ? s.ease * pressed[i + 1] : 0);
        before = x, x = next;
        e[i + 1] += next;
    }
}

void bound_tail_add(const bound_tail *tail, const double *e, wiggly_curve *curve)
{
    static const double im[2] = {0, 1};
    for (int i = tail->begin + 1; i < tail->end; i++) {
        curve->re[i] += e[i];
        if (!tail->is_complex) continue;
        const tail_row row = bound_tail_row(tail, i, im);
        curve->im[i] -= bound_tail_see(tail, &row, e);
    }
}

/// u: q″ + 2d q′ + k q = −y″ in closed form from sample to sample, y linear between them.
#include "textbook_parts.h"

real textbook_y_before(const struct textbook *b, int i)
{
    if (b->loop) return b->y[(i + b->samples - 2) % (b->samples - 1)];
    return i > 0 ? b->y[i - 1] : b->y[0];
}

real textbook_y_after(const struct textbook *b, int i)
{
    if (b->loop) return b->y[(i + 1) % (b->samples - 1)];
    if (i + 1 < b->samples) return b->y[i + 1];
    return i > 0 ? 2 * b->y[i] - b->y[i - 1] : b->y[i];
}

/// Where the oscillator is, and how fast.
struct state {
    real q, v;
};

/// Over a time h with d and k that stay.
static struct state step(struct state from, real d, real k, real h)
{
    real square = d * d - k, r = sqrtq(fabsq(square)), c, s;
    c = square > 0 ? coshq(r * h) : cosq(r * h);
    s = r == 0 ? h : (square > 0 ? sinhq(r * h) : sinq(r * h)) / r;
    real e = expq(-d * h);
    return (struct state){e * ((c + d * s) * from.q + s * from.v), e * (-k * s * from.q + (c - d * s) * from.v)};
}

/// From a state just before sample 0 to that just before the last sample; `at` (or NULL) receives the samples' own, q′ in the middle of
/// its jump. `drive` scales y.
static struct state run(const struct textbook *b, struct state now, real drive, struct state *at)
{
    real d = -1, k = -1, h = b->h;
    struct state of_q = {0}, of_v = {0};
    for (int i = 0;; i++) {
        real kick = -drive * (textbook_y_after(b, i) - 2 * b->y[i] + textbook_y_before(b, i)) / b->h;
        if (at) at[i] = (struct state){now.q, now.v + kick / 2};
        if (i == b->samples - 1) return now;
        now.v += kick;
        const struct textbook_poles *p = &b->swing[i], *next = &b->swing[i + 1];
        if (d != (p->d + next->d) / 2 || k != (p->k + next->k) / 2) {
            d = (p->d + next->d) / 2, k = (p->k + next->k) / 2;
            of_q = step((struct state){1, 0}, d, k, h), of_v = step((struct state){0, 1}, d, k, h);
        }
        now = (struct state){of_q.q * now.q + of_v.q * now.v, of_q.v * now.q + of_v.v * now.v};
    }
}

/// Nothing pulls it back: of the family of periodic swings, the one of mean 0.
static struct state periodic_without_spring(const struct textbook *b)
{
    int period = b->samples - 1;
    struct state driven = run(b, (struct state){0}, 1, NULL);
    static struct state at[TEXTBOOK_MAX];
    struct state start = {0, -driven.q / (period * b->h)};
    run(b, start, 1, at);
    real sum = 0;
    for (int i = 0; i < period; i++) sum += at[i].q;
    start.q = -sum / period;
    return start;
}

/// The state before sample 0 that comes back before the last one. false where there is none.
static bool find_periodic(struct textbook *b, struct state *start)
{
    bool pulls = false;
    for (int i = 0; i < b->samples - 1; i++) pulls = pulls || b->swing[i].k > 0;
    if (!pulls) {
        *start = periodic_without_spring(b);
        return true;
    }
    struct state driven = run(b, (struct state){0}, 1, NULL), q = run(b, (struct state){1, 0}, 0, NULL),
                 v = run(b, (struct state){0, 1}, 0, NULL);
    real determinant = (1 - q.q) * (1 - v.v) - v.q * q.v;
    b->pivot = (double)fminq(b->pivot, fabsq(determinant));
    *start = (struct state){((1 - v.v) * driven.q + v.q * driven.v) / determinant,
                            ((1 - q.q) * driven.v + q.v * driven.q) / determinant};
    return fabsq(determinant) > 1e-28Q;
}

static real range_of_y(const struct textbook *b)
{
    real low = b->y[0], high = b->y[0];
    for (int i = 1; i < b->samples; i++) low = fminq(low, b->y[i]), high = fmaxq(high, b->y[i]);
    return high - low;
}

/// Im u: the one-sided form, faded out where it would diverge.
static real imaginary(const struct textbook *b, int sample, struct state at)
{
    const struct textbook_poles *p = &b->swing[sample];
    if (!(p->turn > 0)) return 0;
    real tau = powq(p->turn * (b->samples - 1) * b->h, 8), rho = powq(p->turn / p->natural, 8);
    if (b->settles) at.v += b->offset_speed[sample];
    return -(at.v + p->d * at.q) / p->turn * tau / (1 + tau) * rho / (rho + 1e-8Q);
}

static bool swing_at_calm(const wiggly_desc *desc, struct textbook *b, real calm)
{
    static struct state at[TEXTBOOK_MAX];
    struct state start = {0};
    textbook_fill_poles(desc, b->loop ? calm / 20 : 0, b->loop, b->swing);
    if (b->loop && !find_periodic(b, &start)) return false;
    run(b, start, 1, at);
    real largest = 0;
    for (int i = 0; i < b->samples; i++) {
        largest = fmaxq(largest, fabsq(at[i].q));
        b->u[i] = at[i].q + (b->is_complex ? 1.0Qi * imaginary(b, i, at[i]) : 0);
        // y + q has no jump in its speed: y comes from rest at sample 0, as q does.
        b->speed[i] = at[i].v + (textbook_y_after(b, i) - textbook_y_before(b, i)) / (2 * b->h);
    }
    return !b->loop || largest <= 10000 * range_of_y(b);
}

void textbook_forced_response(const wiggly_desc *desc, struct textbook *b)
{
    for (int i = 0; i < b->samples; i++) {
        real before = i == 0 && !b->loop && b->samples > 1 ? 2 * b->y[0] - b->y[1] : textbook_y_before(b, i);
        b->u[i] = 0;
        b->speed[i] = (textbook_y_after(b, i) - before) / (2 * b->h);
    }
    if (b->filter || desc->mode == WIGGLY_CUBIC || range_of_y(b) == 0) return;
    b->swing_calmed = !swing_at_calm(desc, b, b->calm) && b->loop && b->calm == 0;
    if (b->swing_calmed) swing_at_calm(desc, b, 0.05Q);
}

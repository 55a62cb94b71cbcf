/// Variations: noise through the filter, sample by sample, with spread 1, times amount and size.
#include "spline/problem.h"
#include <math.h>
#include <stdint.h>

/// The force is constant over cells of this share of a period, whatever the sample rate.
enum { CELLS = 8 };

/// The state of the noise: n and its step to the next sample.
typedef struct walk {
    cplx m, p; ///< of the filter (coefficients)
    cplx n, e;
    cplx gain; ///< of the force: in phase with the filter
} walk;

/// The source of the force.
typedef struct source {
    uint64_t key; ///< from the seed
    double cell;  ///< samples
    double rate;  ///< cells per sample
    int64_t wrap; ///< cells in a loop; 0: no loop
    bool is_complex;
    int64_t at; ///< the cell of `now`
    cplx now, before;
} source;

/// SplitMix64's step.
static const uint64_t GOLDEN = 0x9E3779B97F4A7C15u;

/// SplitMix64's output for the state `x`.
static uint64_t mixed(uint64_t x)
{
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
    return x ^ (x >> 31);
}

/// Variance 1 and nearly normal: the sum of four uniform numbers, so that all machines give the same.
static double chance(uint64_t key)
{
    const uint64_t bits = mixed(key);
    int sum = 0;
    for (int k = 0; k < 4; k++) sum += (int)(bits >> 16 * k & 0xFFFF);
    return (sum - 2 * 0xFFFF) * (1.7320508075688772 / 0x10000);
}

static cplx chances(const source *s, int64_t place)
{
    if (s->wrap > 0) place %= s->wrap;
    const uint64_t key = s->key + 2 * GOLDEN * (uint64_t)place;
    return (cplx){chance(key), s->is_complex ? chance(key + GOLDEN) : 0};
}

/// The mean force over the sample's interval.
static inline cplx force(source *s, int sample)
{
    const double from = (sample - 0.5) * s->rate, to = (sample + 0.5) * s->rate;
    const int64_t place = (int64_t)to, cell = place + s->wrap;
    const double edge = (double)place;
    if (cell != s->at) {
        s->before = cell == s->at + 1 ? s->now : chances(s, cell - 1);
        s->now = chances(s, cell);
        s->at = cell;
    }
    if (from >= edge) return s->now;
    const double after = (to - edge) * s->cell;
    return cplx_add(cplx_scale(1 - after, s->before), cplx_scale(after, s->now));
}

/// Advances by one sample.
static inline void advance(walk *w, cplx force)
{
    const cplx bent = cplx_sub(cplx_mul(w->m, w->e), cplx_mul(w->p, w->n));
    w->n = cplx_add(w->n, w->e);
    w->e = cplx_add(cplx_add(w->e, bent), cplx_mul(w->gain, force));
}

bool variation_is_set(const wiggly_desc *desc)
{
    return desc->variation > 0 && desc->mode != WIGGLY_CUBIC && desc->passive == WIGGLY_OSCILLATOR &&
           poles_are_constant(desc) && poles_at(desc, 0, 0).natural > 0;
}

double variation_farthest(const wiggly_desc *desc)
{
    const wiggly_param *y = &desc->equilibrium;
    double farthest = 0;
    for (int k = 0; k < desc->knot_count; k++) {
        const wiggly_knot *knot = &desc->knots[k];
        const double about = y->track ? y->track[knot->sample] : y->value;
        if (!knot->still) farthest = fmax(farthest, fabs(knot->value - about));
    }
    return farthest;
}

static cplx determinant(cplx a, cplx b, cplx c, cplx d) { return cplx_sub(cplx_mul(a, d), cplx_mul(b, c)); }

/// n and e that return to themselves after `count` samples.
static void close_loop(walk *w, source *s, int count)
{
    walk forced = *w, one = *w, other = *w;
    one.n = other.e = (cplx){1, 0};
    for (int i = 0; i < count; i++) {
        advance(&forced, force(s, i + 1 < count ? i + 1 : 0));
        advance(&one, (cplx){0, 0});
        advance(&other, (cplx){0, 0});
    }
    const cplx unit = {1, 0}, a = cplx_sub(unit, one.n), b = cplx_scale(-1, other.n), c = cplx_scale(-1, one.e),
               d = cplx_sub(unit, other.e), det = determinant(a, b, c, d);
    if (!(cplx_norm(det) > 0)) return;
    const cplx inverse = cplx_scale(1 / cplx_norm(det), cplx_conj(det));
    w->n = cplx_mul(inverse, determinant(forced.n, b, forced.e, d));
    w->e = cplx_mul(inverse, determinant(a, forced.n, c, forced.e));
}

void variation_add(problem *p)
{
    const wiggly_desc *desc = p->desc;
    const forced_response *u = &p->response;
    const bool loops = p->start == WIGGLY_LOOP;
    const poles at = poles_at(desc, 0, LEAST_DAMPING);
    const coefficients c = poles_coefficients(&at, desc->step);
    const start_cost cost = poles_start_cost(&at, desc->step);
    source s = {.key = mixed((uint64_t)desc->variation_seed + GOLDEN),
                .cell = fmax(1, 2 * 3.14159265358979323846 / (CELLS * at.natural * desc->step)),
                .is_complex = desc->mode == WIGGLY_COMPLEX,
                .at = INT64_MIN / 2};
    if (loops) {
        s.wrap = llround(fmax(1, p->count / s.cell));
        s.cell = (double)p->count / (double)s.wrap;
    }
    s.rate = 1 / s.cell;
    const double farthest = variation_farthest(desc), half_rate = 0.5 / desc->step;
    const double size = desc->variation * (farthest > 0 ? farthest : 1);
    if (!(cost.row[0].weight > 0 && cost.row[1].weight > 0)) return;
    walk w = {.m = c.m, .p = c.p, .gain = cplx_scale(size * sqrt(cost.row[1].weight / s.cell), c.g)};
    if (loops) close_loop(&w, &s, p->count);
    if (p->start == WIGGLY_FREE) {
        // The stationary process, by the start's cost reversed in time: |x₀|² and |x₁ + on_e* x₀|² have variance 1 over the weights.
        const struct start_row *row = cost.row;
        const cplx apart = cplx_scale(size * sqrt(row[1].weight / row[0].weight), chances(&s, s.wrap - 101));
        w.n = cplx_scale(size, chances(&s, s.wrap - 100));
        w.e = cplx_sub(cplx_sub(apart, cplx_mul(cplx_conj(row[0].on_e), w.n)), w.n);
    }
    if (p->start == WIGGLY_REST) w.e = cplx_mul(w.gain, force(&s, 0));
    p->held = w.n;
    for (int i = 0; i < p->first; i++) u->total[i] += w.n.re, u->im[i] += w.n.im;
    double before = w.e.re;
    for (int i = p->first; i < p->first + p->count; i++) {
        u->total[i] += w.n.re, u->im[i] += w.n.im;
        u->speed[i] += half_rate * (before + w.e.re);
        before = w.e.re;
        if (!loops && p->latest >= 0 && i + 1 >= p->latest && i <= p->latest) { // the oscillator moves both parts
            poles own = poles_at(desc, 0, 0);
            if (desc->mode == WIGGLY_COMPLEX) {
                own.s[0] = poles_passive(&own);
                own.s[1] = cplx_conj(own.s[0]);
                for (int k = 0; k < 2; k++) own.angle[k] = own.s[k].im * desc->step;
            }
            const coefficients alone = poles_coefficients(&own, desc->step);
            w.m = alone.m, w.p = alone.p, w.gain = (cplx){0, 0};
        }
        advance(&w, force(&s, loops && i + 1 == p->count ? 0 : i + 1));
    }
    if (!loops) return;
    u->speed[0] += half_rate * (before - w.e.re); // w is back where it began
    u->total[p->count] = u->total[0], u->im[p->count] = u->im[0], u->speed[p->count] = u->speed[0];
}

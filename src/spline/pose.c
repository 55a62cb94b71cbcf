/// Sets up the problem from a description (docs/mathematics.md, Constraints): checks it, brings its values to a safe size, and finds where the
/// domain starts and ends, the level that knots are measured from, and the cost of the start.
#include "maths/maths.h"
#include "maths/wide.h"
#include "spline/problem.h"
#include <float.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

// --- checks ----------------------------------------------------------------------------------------------------------

/// Periods.
static const double longest_wind_up = 100;

/// Whether all magnitudes are within a limit; false for NaN.
WIDEST static bool are_within(const double *x, int count, double limit)
{
    int64_t beyond = 0; // same width as the comparison
    for (int i = 0; i < count; i++) beyond |= fabs(x[i]) <= limit ? 0 : 1;
    return beyond == 0;
}

static bool param_is_within(wiggly_param param, int samples, double limit)
{
    return param.track ? are_within(param.track, samples, limit) : fabs(param.value) <= limit;
}

static wiggly_status check_knot(const wiggly_desc *desc, const wiggly_knot *knot)
{
    const int end = desc->samples - (desc->start == WIGGLY_LOOP ? 1 : 0);
    if (knot->sample < 0 || knot->sample >= end) return WIGGLY_ERROR_KNOT_OUTSIDE;
    if (knot->still) return knot->has_slope || knot->has_phase || knot->settles ? WIGGLY_ERROR_KNOT_STILL : WIGGLY_OK;
    if (!(fabs(knot->value) <= LARGEST_VALUE) || (knot->has_phase && !(fabs(knot->phase) <= LARGEST_VALUE)) ||
        (knot->has_slope && !(isfinite(knot->slope) && knot->stiffness >= 0 && knot->stiffness < INFINITY)))
        return WIGGLY_ERROR_KNOT_NUMBER;
    return knot->value < desc->low || knot->value > desc->high ? WIGGLY_ERROR_KNOT_LIMIT : WIGGLY_OK;
}

wiggly_status desc_check(const wiggly_desc *desc, int *knot, bool *y_is_safe)
{
    *knot = -1;
    if (desc->samples < 0 || desc->knot_count < 0 || (desc->knot_count > 0 && !desc->knots))
        return WIGGLY_ERROR_ARGUMENT;
    if (desc->start == WIGGLY_LOOP && desc->samples < 2) return WIGGLY_ERROR_LOOP;
    if (!(desc->step > 0 && desc->step < INFINITY) || !(desc->calm >= 0 && desc->calm <= 1) ||
        !(desc->variation >= 0 && desc->variation < INFINITY) ||
        !(desc->wind_up >= 0 && desc->wind_up <= longest_wind_up))
        return WIGGLY_ERROR_NUMBER;
    if ((unsigned)desc->mode > WIGGLY_CUBIC || (unsigned)desc->start > WIGGLY_LOOP ||
        (unsigned)desc->passive > WIGGLY_FILTER)
        return WIGGLY_ERROR_NUMBER;
    for (const desc_member *m = desc_members; m->name; m++) {
        if (m->kind != DESC_PARAM) continue;
        const wiggly_param *param = (const wiggly_param *)(const void *)((const char *)desc + m->offset);
        const bool is_y = param == &desc->equilibrium;
        if (!param_is_within(*param, desc->samples, is_y ? LARGEST_VALUE : DBL_MAX)) return WIGGLY_ERROR_NUMBER;
        if (is_y) *y_is_safe = param_is_within(*param, desc->samples, SAFE_VALUE);
    }
    if (!(desc->low < desc->high)) return WIGGLY_ERROR_LIMITS;
    for (int k = 0; k < desc->knot_count; k++) {
        const wiggly_status status = check_knot(desc, &desc->knots[k]);
        if (status == WIGGLY_OK) continue;
        *knot = k;
        return status;
    }
    return WIGGLY_OK;
}

wiggly_status problem_check(wiggly_solver *solver, const wiggly_desc *desc, int *knot)
{
    const wiggly_status status = desc_check(desc, knot, &solver->y_is_safe);
    if (status != WIGGLY_OK) return status;
    if (desc->samples > solver->samples || desc->knot_count > solver->knots) return WIGGLY_ERROR_CAPACITY;
    bool ordered = true; // knots already in order, like a document's, are visited once
    for (int k = 0; k < desc->knot_count; k++) {
        ordered = ordered && (k == 0 || desc->knots[k].sample > desc->knots[k - 1].sample);
        solver->order[k] = k;
    }
    if (ordered) return WIGGLY_OK;
    for (int i = 0; i < desc->samples; i++) solver->knot_at[i] = -1;
    for (int k = 0; k < desc->knot_count; k++) {
        int *const at = &solver->knot_at[desc->knots[k].sample];
        if (*at >= 0) {
            *knot = k;
            return WIGGLY_ERROR_KNOT_TWICE;
        }
        *at = k;
    }
    for (int i = 0, n = 0; i < desc->samples; i++) {
        if (solver->knot_at[i] >= 0) solver->order[n++] = solver->knot_at[i];
    }
    return WIGGLY_OK;
}

// --- variations: noise through the filter, sample by sample, with spread 1, times amount and size -------------------------

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

/// Whether a description has noise that its knots are solved over: some amount, an oscillator of constant poles that has a frequency.
static bool variation_is_set(const wiggly_desc *desc)
{
    return desc->variation > 0 && desc->mode != WIGGLY_CUBIC && desc->passive == WIGGLY_OSCILLATOR &&
           poles_are_constant(desc) && poles_at(desc, 0, 0).natural > 0;
}

/// The height of the farthest knot above the equilibrium. The noise is the variation times that, or times 1 if it is 0.
static double variation_farthest(const wiggly_desc *desc)
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

/// Adds every sample's noise to u, once the domain is known, and the value before `first` to the held value.
static void variation_add(problem *p)
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

// --- values whose squares a double cannot hold, in units of a power of two -------------------------------------------
//
// Everything that is solved for is linear in them, so only the power differs.

/// The largest power of two that is a double, either way.
enum { MOST = 1000 };

double scale_size(const wiggly_solver *solver, const wiggly_desc *desc)
{
    const wiggly_param *y = &desc->equilibrium;
    const double n = desc->samples, n4 = n * n * n * n, seconds = n * desc->step;
    double size = 0;
    for (int k = 0; k < desc->knot_count; k++) {
        const wiggly_knot *knot = &desc->knots[k];
        if (knot->still) continue;
        size = fmax(fabs(knot->value), size);
        if (knot->has_phase && desc->mode == WIGGLY_COMPLEX) size = fmax(fabs(knot->phase), size);
        // What a slope moves at most: its line, if it is stiff beside the jets, which bend by less than n⁴.
        if (knot->has_slope)
            size = fmax(seconds * fabs(knot->slope) * fmin(1, knot_stiffness(knot) * desc->step * n4), size);
    }
    if (variation_is_set(desc)) {
        const double farthest = variation_farthest(desc);
        size = fmax(desc->variation * (farthest > 0 ? farthest : 1), size);
    }
    if (!y->track || (solver->y_is_safe && size * SAFE_VALUE >= 1)) return fmax(y->track ? 0 : fabs(y->value), size);
    return fmax(extent_size(extent_of(y->track, desc->samples)), size);
}

double scale_for(double size)
{
    int exponent;
    if (!(size > 0) || (size <= SAFE_VALUE && size * SAFE_VALUE >= 1)) return 1;
    frexp(fmin(size, DBL_MAX), &exponent);
    return ldexp(1, exponent > MOST ? -MOST : exponent < -MOST ? MOST : -exponent);
}

void scale_values(wiggly_solver *solver, double scale, wiggly_desc *desc)
{
    solver->scale = scale;
    if (scale == 1) return;
    for (int k = 0; k < desc->knot_count; k++) {
        wiggly_knot *knot = &solver->scaled[k];
        *knot = desc->knots[k];
        knot->value *= scale, knot->slope *= scale, knot->phase *= scale;
    }
    if (variation_is_set(desc) && variation_farthest(desc) == 0) desc->variation *= scale;
    desc->knots = solver->scaled;
    desc->low *= scale, desc->high *= scale;
    desc->equilibrium.value *= scale;
    if (!desc->equilibrium.track) return;
    for (int i = 0; i < desc->samples; i++) solver->y[i] = scale * desc->equilibrium.track[i];
    desc->equilibrium.track = solver->y;
}

// --- the rules of start and end ---------------------------------------------------------------------------------------

const constant_filter *problem_filter(wiggly_solver *solver, const problem *p)
{
    const wiggly_desc *desc = p->desc;
    const double floor = problem_least_damping(p);
    constant_filter *f = &solver->filter;
    if (f->known && f->floor == floor && desc_same_filter(&f->desc, desc)) return f;
    const poles own = poles_at(desc, 0, floor);
    *f = (constant_filter){.known = true, .desc = desc_settings(desc), .floor = floor, .at = own};
    poles_mean(&f->at, desc->step, &f->lambda, &f->delta2);
    poles damped = poles_at(desc, 0, fmax(floor, LEAST_DAMPING));
    f->start = poles_start_cost(&damped, desc->step);
    if (desc->passive != WIGGLY_OSCILLATOR) return f;
    f->unit = maths_exp(-poles_weight_exponent(&f->at, desc->step));
    f->ahead = poles_speed(&f->at, desc->step, false);
    f->passive = cplx_scale(desc->step, poles_passive(&own));
    f->tail = poles_tail(poles_passive(&own), &f->ahead, desc->step);
    f->cut = f->ahead.loss.cut;
    if (damped.decay == f->at.decay) return f;
    f->start = poles_start_seen_from(f->start, &damped, &f->at, desc->step);
    f->cut = f->cut || poles_speed(&damped, desc->step, false).loss.cut;
    double weight = maths_exp(poles_weight_exponent(&damped, desc->step) - poles_weight_exponent(&f->at, desc->step));
    for (int i = 0; i < 2; i++) f->start.row[i].weight *= weight;
    return f;
}

/// At a lower share of ω_n the jets, and not the free motion, meet a last knot's slope.
static const double slowest_settling = 0.3;

/// Sets the level that knots are measured from.
static void set_about(wiggly_solver *solver, problem *p)
{
    const wiggly_desc *desc = p->desc;
    if (!p->y) return;
    if (desc->mode == WIGGLY_CUBIC) {
        p->level = p->y[0];
    } else if (!problem_oscillates(p)) {
        p->about = p->y;
    } else {
        p->response = solver->response;
        p->response.offset = p->settled ? solver->offset : NULL;
        p->about = p->response.total;
        if (desc->equilibrium.track || p->settled) {
            p->status = forced_response_find(desc, p->y, p->calm, &p->response);
        } else {
            forced_response_rest(desc, p->y, &p->response);
        }
        if (variation_is_set(desc)) variation_add(p);
    }
}

/// c·H of the start, for the problem's present calm. The filter's cost is that of the first sample, the oscillator's that of the fastest sample
/// up to the first still knot.
static void set_start(wiggly_solver *solver, problem *p)
{
    const wiggly_desc *desc = p->desc;
    const bool oscillates = problem_oscillates(p), is_constant = poles_are_constant(desc);
    p->cost = (start_cost){0};
    p->unit = 1;
    if (oscillates && is_constant) {
        p->unit = problem_filter(solver, p)->unit;
    } else if (oscillates) {
        const poles at = poles_at(desc, p->first, problem_least_damping(p));
        p->unit = maths_exp(-poles_weight_exponent(&at, desc->step));
    }
    p->free_end = p->start == WIGGLY_FREE && !(p->still >= 0 && p->still == p->first); // a still knot: at rest before
    if (!p->free_end || p->latest < 0) return;
    if (is_constant) {
        p->cost = problem_filter(solver, p)->start;
    } else {
        const int end = p->still >= 0 && p->still < p->latest ? p->still : p->latest;
        const int at = oscillates ? poles_fastest(desc, p->first, end, NULL) : p->first;
        const poles damped = poles_at(desc, at, LEAST_DAMPING);
        p->cost = poles_start_cost(&damped, desc->step);
        if (oscillates) {
            const poles here = poles_at(desc, p->first, 0);
            const double h = desc->step,
                         weight = maths_exp(poles_weight_exponent(&damped, h) - poles_weight_exponent(&here, h));
            for (int i = 0; i < 2; i++) p->cost.row[i].weight *= weight;
            p->cost = poles_start_seen_from(p->cost, &damped, &here, h);
        }
    }
    for (int i = 0; i < 2; i++) p->cost.row[i].weight *= p->calm;
    p->free_end = !(p->cost.row[0].weight > 0);
}

void problem_set_calm(wiggly_solver *solver, problem *p, double calm)
{
    p->calm = calm;
    if (p->start == WIGGLY_LOOP && p->about) set_about(solver, p);
    set_start(solver, p);
}

/// Moves the equilibrium to the values of settling knots: each takes it there over the gap before it, or the wind-up's part of that. A constant
/// equilibrium leaves `y` unused.
static void settle(wiggly_solver *solver, problem *p, double *y)
{
    const wiggly_desc *desc = p->desc;
    const int knots = desc->knot_count, samples = desc->samples, period = samples - 1;
    const bool loops = p->start == WIGGLY_LOOP;
    double *const o = solver->offset;
    int from = 0;
    while (from < knots && !desc->knots[solver->order[from]].settles) from++;
    if (desc->mode == WIGGLY_CUBIC || from == knots) return;
    p->settled = true;
    if (!p->y) problem_fill(y, desc->equilibrium.value, samples);
    p->y = y;
    const wiggly_knot *before = &desc->knots[solver->order[loops ? from : 0]];
    double level = before->settles ? before->value - y[before->sample] : 0;
    if (!loops) problem_fill(o, level, before->sample);
    for (int n = 1; n < knots + loops; n++) { // the gap before each knot; a loop comes back to the first that settles
        const wiggly_knot *knot = &desc->knots[solver->order[((loops ? from : 0) + n) % knots]];
        const int gap = knot->sample - before->sample + (knot->sample <= before->sample ? period : 0);
        const double to = knot->settles ? knot->value - y[knot->sample] : level;
        const poles at = poles_at(desc, knot->sample, 0);
        const double begin = problem_winds_up(p) ? fmax(0, gap - problem_reach(desc, &at)) : 0;
        for (int i = 0; i < gap; i++) {
            const double t = (i - begin) / (gap - begin); // no speed and no acceleration at the ends
            const int sample = before->sample + i;
            o[loops && sample >= period ? sample - period : sample] =
                level + (to - level) * (t > 0 ? t * t * t * (10 - 15 * t + 6 * t * t) : 0);
        }
        level = to;
        before = knot;
    }
    if (!loops) problem_fill(o + before->sample, level, samples - before->sample);
    if (loops) o[period] = o[0];
    for (int i = 0; i < samples; i++) y[i] += o[i];
    const extent all = extent_of(y, samples);
    if (all.low < all.high) return;
    p->level = all.low;
    if (!variation_is_set(desc)) p->y = NULL;
}

void problem_pose(wiggly_solver *solver, const wiggly_desc *desc, double *y, problem *p)
{
    *p = (problem){.desc = desc, .calm = desc->calm, .pulls = solver->pulls};
    if (desc->equilibrium.track) {
        memmove(y, desc->equilibrium.track, sizeof *y * (size_t)desc->samples);
        if (desc->start == WIGGLY_LOOP) y[desc->samples - 1] = y[0];
        p->y = y;
    } else if (variation_is_set(desc)) {
        problem_fill(y, desc->equilibrium.value, desc->samples);
        p->y = y;
    }
    p->level = desc->equilibrium.value;

    const int knots = desc->knot_count, earliest = p->pulls ? p->pulls->earliest : -1;
    const wiggly_knot *last = knots > 0 ? &desc->knots[solver->order[knots - 1]] : NULL;
    p->earliest = last ? desc->knots[solver->order[0]].sample : -1;
    p->latest = last ? last->sample : -1;
    if (earliest >= 0 && (knots == 0 || earliest < p->earliest)) p->earliest = earliest;
    if (earliest >= 0 && p->pulls->latest > p->latest) p->latest = p->pulls->latest;
    bool on_rest = p->earliest == 0 || p->earliest == 1;
    p->start = desc->start == WIGGLY_REST && on_rest ? WIGGLY_FREE : desc->start;
    p->first = p->start == WIGGLY_FREE && p->earliest > 0 ? p->earliest : 0;
    p->count = p->start == WIGGLY_LOOP ? desc->samples - 1 : desc->samples - p->first;
    p->settles = problem_oscillates(p) && p->start != WIGGLY_LOOP && p->latest >= 0 && p->count >= 3 &&
                 desc->mode != WIGGLY_REAL;
    if (p->settles && last && last->sample == p->latest && last->has_slope) {
        const poles at = poles_at(desc, p->latest, 0);
        p->settles = desc->mode == WIGGLY_COMPLEX && at.centre > slowest_settling * at.natural;
    }
    p->still = -1;
    for (int n = 0; n < knots && p->still < 0; n++) {
        const wiggly_knot *knot = &desc->knots[solver->order[n]];
        if (knot->still) p->still = knot->sample;
    }

    settle(solver, p, y);
    set_about(solver, p);
    set_start(solver, p);
}

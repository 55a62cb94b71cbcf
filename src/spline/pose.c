/// Sets up the problem from a description (docs/mathematics.md, Constraints): where the domain starts and ends, the level that knots are
/// measured from, and the cost of the start.
#include "maths/maths.h"
#include "spline/problem.h"
#include "spline/wide.h"
#include <float.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

/// Periods.
static const double longest_wind_up = 100;

/// At a lower share of ω_n the jets, and not the free motion, meet a last knot's slope.
static const double slowest_settling = 0.3;

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

static bool is_part(double x) { return x >= 0 && x <= 1; }

static wiggly_status check_settings(const wiggly_desc *desc, bool *y_is_safe)
{
    if (desc->start == WIGGLY_LOOP && desc->samples < 2) return WIGGLY_ERROR_LOOP;
    if (!(desc->step > 0 && desc->step < INFINITY) || !is_part(desc->calm)) return WIGGLY_ERROR_NUMBER;
    if (!(desc->variation >= 0 && desc->variation < INFINITY)) return WIGGLY_ERROR_NUMBER;
    if (!(desc->wind_up >= 0 && desc->wind_up <= longest_wind_up)) return WIGGLY_ERROR_NUMBER;
    if ((unsigned)desc->mode > WIGGLY_CUBIC || (unsigned)desc->start > WIGGLY_LOOP ||
        (unsigned)desc->passive > WIGGLY_FILTER)
        return WIGGLY_ERROR_NUMBER;
    for (const desc_member *m = desc_members; m->name; m++) {
        if (m->kind != DESC_PARAM) continue;
        const wiggly_param *param = desc_param(desc, m);
        const bool is_y = param == &desc->equilibrium,
                   is_within = param_is_within(*param, desc->samples, is_y ? SAFE_VALUE : DBL_MAX);
        if (is_y) *y_is_safe = is_within;
        if (!is_within && !(is_y && param_is_within(*param, desc->samples, LARGEST_VALUE)))
            return WIGGLY_ERROR_NUMBER;
    }
    return desc->low < desc->high ? WIGGLY_OK : WIGGLY_ERROR_LIMITS;
}

static wiggly_status check_knot(const wiggly_desc *desc, const wiggly_knot *knot)
{
    const int end = desc->samples - (desc->start == WIGGLY_LOOP ? 1 : 0);
    if (knot->sample < 0 || knot->sample >= end) return WIGGLY_ERROR_KNOT_OUTSIDE;
    if (knot->still) return knot->has_slope || knot->has_phase || knot->settles ? WIGGLY_ERROR_KNOT_STILL : WIGGLY_OK;
    if (!(fabs(knot->value) <= LARGEST_VALUE)) return WIGGLY_ERROR_KNOT_NUMBER;
    if (knot->has_phase && !(fabs(knot->phase) <= LARGEST_VALUE)) return WIGGLY_ERROR_KNOT_NUMBER;
    if (knot->has_slope && !(isfinite(knot->slope) && knot->stiffness >= 0 && knot->stiffness < INFINITY))
        return WIGGLY_ERROR_KNOT_NUMBER;
    return knot->value < desc->low || knot->value > desc->high ? WIGGLY_ERROR_KNOT_LIMIT : WIGGLY_OK;
}

wiggly_status desc_check(const wiggly_desc *desc, int *knot, bool *y_is_safe)
{
    *knot = -1;
    if (desc->samples < 0 || desc->knot_count < 0 || (desc->knot_count > 0 && !desc->knots))
        return WIGGLY_ERROR_ARGUMENT;
    wiggly_status status = check_settings(desc, y_is_safe);
    for (int k = 0; k < desc->knot_count && status == WIGGLY_OK; k++) {
        status = check_knot(desc, &desc->knots[k]);
        if (status != WIGGLY_OK) *knot = k;
    }
    return status;
}

/// Fills `order`; `knot` receives one on an earlier one's sample. Knots already in order, like a document's, are visited once.
static wiggly_status order_knots(wiggly_solver *solver, const wiggly_desc *desc, int *knot)
{
    bool ordered = true;
    for (int k = 0; k < desc->knot_count; k++) {
        ordered = ordered && (k == 0 || desc->knots[k].sample > desc->knots[k - 1].sample);
        solver->order[k] = k;
    }
    if (ordered) return WIGGLY_OK;
    for (int i = 0; i < desc->samples; i++) solver->knot_at[i] = -1;
    for (int k = 0; k < desc->knot_count; k++) {
        *knot = k;
        if (solver->knot_at[desc->knots[k].sample] >= 0) return WIGGLY_ERROR_KNOT_TWICE;
        solver->knot_at[desc->knots[k].sample] = k;
    }
    for (int i = 0, n = 0; i < desc->samples; i++) {
        if (solver->knot_at[i] >= 0) solver->order[n++] = solver->knot_at[i];
    }
    return WIGGLY_OK;
}

/// Whether w is free after the latest knot.
static bool is_settling(const wiggly_solver *solver, const problem *p)
{
    const wiggly_desc *desc = p->desc;
    if (!problem_oscillates(p) || p->start == WIGGLY_LOOP || p->latest < 0 || p->count < 3) return false;
    if (desc->mode == WIGGLY_REAL) return false;
    const wiggly_knot *last = desc->knot_count > 0 ? &desc->knots[solver->order[desc->knot_count - 1]] : NULL;
    if (!last || last->sample < p->latest || !last->has_slope) return true;
    poles at = poles_at(desc, p->latest, 0);
    return desc->mode == WIGGLY_COMPLEX && at.centre > slowest_settling * at.natural;
}

static void set_domain(wiggly_solver *solver, problem *p)
{
    const wiggly_desc *desc = p->desc;
    int knots = desc->knot_count, earliest = p->pulls ? p->pulls->earliest : -1;
    p->earliest = knots > 0 ? desc->knots[solver->order[0]].sample : -1;
    p->latest = knots > 0 ? desc->knots[solver->order[knots - 1]].sample : -1;
    if (earliest >= 0 && (knots == 0 || earliest < p->earliest)) p->earliest = earliest;
    if (earliest >= 0 && p->pulls->latest > p->latest) p->latest = p->pulls->latest;
    bool on_rest = p->earliest == 0 || p->earliest == 1;
    p->start = desc->start == WIGGLY_REST && on_rest ? WIGGLY_FREE : desc->start;
    p->first = p->start == WIGGLY_FREE && p->earliest > 0 ? p->earliest : 0;
    p->count = p->start == WIGGLY_LOOP ? desc->samples - 1 : desc->samples - p->first;
    p->settles = is_settling(solver, p);
    p->still = -1;
    for (int n = 0; n < knots && p->still < 0; n++) {
        const wiggly_knot *knot = &desc->knots[solver->order[n]];
        if (knot->still) p->still = knot->sample;
    }
}

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

/// The filter's start cost is that of the first sample. The oscillator's is that of the fastest sample up to the first still knot.
static start_cost cost_of_start(wiggly_solver *solver, problem *p)
{
    const wiggly_desc *desc = p->desc;
    if (poles_are_constant(desc)) return problem_filter(solver, p)->start;
    const int end = p->still >= 0 && p->still < p->latest ? p->still : p->latest;
    int at = problem_oscillates(p) ? poles_fastest(desc, p->first, end, NULL) : p->first;
    poles damped = poles_at(desc, at, LEAST_DAMPING), here = poles_at(desc, p->first, 0);
    start_cost cost = poles_start_cost(&damped, desc->step);
    if (!problem_oscillates(p)) return cost;
    double weight = maths_exp(poles_weight_exponent(&damped, desc->step) - poles_weight_exponent(&here, desc->step));
    for (int i = 0; i < 2; i++) cost.row[i].weight *= weight;
    return poles_start_seen_from(cost, &damped, &here, desc->step);
}

static double unit_of(wiggly_solver *solver, const problem *p)
{
    if (!problem_oscillates(p)) return 1;
    if (poles_are_constant(p->desc)) return problem_filter(solver, p)->unit;
    poles at = poles_at(p->desc, p->first, problem_least_damping(p));
    return maths_exp(-poles_weight_exponent(&at, p->desc->step));
}

/// c·H of the start, for the problem's present calm.
static void set_start(wiggly_solver *solver, problem *p)
{
    p->cost = (start_cost){0};
    p->unit = unit_of(solver, p);
    if (p->start == WIGGLY_FREE && p->latest >= 0 && !problem_starts_still(p)) {
        p->cost = cost_of_start(solver, p);
        for (int i = 0; i < 2; i++) p->cost.row[i].weight *= p->calm;
    }
    p->free_end = p->start == WIGGLY_FREE && !(p->cost.row[0].weight > 0) && !problem_starts_still(p);
}

void problem_set_calm(wiggly_solver *solver, problem *p, double calm)
{
    p->calm = calm;
    if (p->start == WIGGLY_LOOP && p->about) set_about(solver, p);
    set_start(solver, p);
}

static void fill(double *x, double value, int count)
{
    for (int i = 0; i < count; i++) x[i] = value;
}

/// From 0 to 1 with no speed and no acceleration at the ends.
static double ease(double t) { return t > 0 ? t * t * t * (10 - 15 * t + 6 * t * t) : 0; }

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
    if (!p->y) fill(y, desc->equilibrium.value, samples);
    p->y = y;
    const wiggly_knot *before = &desc->knots[solver->order[loops ? from : 0]];
    double level = before->settles ? before->value - y[before->sample] : 0;
    if (!loops) fill(o, level, before->sample);
    for (int n = 1; n < knots + loops;
         n++) { // the gap that ends in the next knot; a loop comes back to the first that settles
        const wiggly_knot *knot = &desc->knots[solver->order[((loops ? from : 0) + n) % knots]];
        const int gap = knot->sample - before->sample + (knot->sample <= before->sample ? period : 0);
        const double to = knot->settles ? knot->value - y[knot->sample] : level;
        const poles at = poles_at(desc, knot->sample, 0);
        const double begin = problem_winds_up(p) ? fmax(0, gap - problem_reach(desc, &at)) : 0;
        for (int i = 0; i < gap; i++) {
            const int sample = before->sample + i;
            o[loops && sample >= period ? sample - period : sample] =
                level + (to - level) * ease((i - begin) / (gap - begin));
        }
        level = to;
        before = knot;
    }
    if (!loops) fill(o + before->sample, level, samples - before->sample);
    if (loops) o[period] = o[0];
    for (int i = 0; i < samples; i++) y[i] += o[i];
    const extent all = extent_of(y, samples);
    if (all.low < all.high) return;
    p->level = all.low;
    if (!variation_is_set(desc)) p->y = NULL;
}

wiggly_status problem_check(wiggly_solver *solver, const wiggly_desc *desc, int *knot)
{
    wiggly_status status = desc_check(desc, knot, &solver->y_is_safe);
    if (status == WIGGLY_OK && (desc->samples > solver->samples || desc->knot_count > solver->knots))
        return WIGGLY_ERROR_CAPACITY;
    if (status == WIGGLY_OK) status = order_knots(solver, desc, knot);
    if (status == WIGGLY_OK) *knot = -1;
    return status;
}

void problem_pose(wiggly_solver *solver, const wiggly_desc *desc, double *y, problem *p)
{
    *p = (problem){.desc = desc, .calm = desc->calm, .pulls = solver->pulls};
    if (desc->equilibrium.track) {
        memmove(y, desc->equilibrium.track, sizeof *y * (size_t)desc->samples);
        if (desc->start == WIGGLY_LOOP) y[desc->samples - 1] = y[0];
        p->y = y;
    } else if (variation_is_set(desc)) {
        fill(y, desc->equilibrium.value, desc->samples);
        p->y = y;
    }
    p->level = desc->equilibrium.value;
    set_domain(solver, p);
    settle(solver, p, y);
    set_about(solver, p);
    set_start(solver, p);
}

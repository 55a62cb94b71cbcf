/// Solves a spline gap by gap in the order of time, each pushed only shortly before its knot (docs/mathematics.md, Wind-up).
///
/// From a knot at j the motion swings freely, w_{i+1} = e^{ph} w_i, to sample s. From there pushes e_i turn it to the knot at k:
///
///     w_{s+1} = v_{s+1} + e_s;   w_{i+1} = a_i w_i + b_i w_{i−1} + e_i,  s < i < k;   0 = ½a_k w_k + b_k w_{k−1} + e_k,
///
/// with the least Σ |e_i|² / q_i. w_k and the last row's t = ½a_k w_k + b_k w_{k−1} are what is asked for. In terms of w_i and its step
/// d_i = w_{i+1} − w_i, which keep their digits at high sample rates,
///
///     d_i = (1 + m_i) d_{i−1} − p_i w_{i−1} + e_i,
///
/// a backward pass finds how far each push moves the two, χ_i. So they are (w_k, t) = coast + Σ χ_i e_i, and of the covariance Σ q_i χ_i χ_i* only
/// four numbers are needed: t met with its own variance q_k leaves w_k a mean and a variance, Re w_k is given, Im w_k is given or the mean's.
/// Then e_i = q_i χ_i* λ, and a forward pass fills the gap. Nothing is squared that was not small, whatever the length.
#include "maths/maths.h"
#include "spline/problem.h"
#include <float.h>
#include <math.h>

/// Where the oscillator hardly turns a slope says nothing of the phase: how far from SLOWEST_SLOPE it fades in.
static const double slope_fade = 0.2;

static const double turn_of_period = 6.28318530717958647692;

/// A knot as a gap sees it: w there. The pull of its slope is a weight, times h³.
typedef struct goal {
    cplx w;
    bool is_whole; ///< both parts are known
    double swung;  ///< Im u; Im x is this and Im w
    double slope, pull;
} goal;

/// The sample of the domain; a loop goes round.
static int sample_of(const problem *p, int i) { return p->start == WIGGLY_LOOP && i >= p->count ? i - p->count : i; }

static poles poles_here(const wiggly_solver *solver, const problem *p, int i)
{
    if (solver->wind.is_constant) return solver->filter.at;
    return poles_at(p->desc, sample_of(p, i), problem_least_damping(p));
}

double problem_reach(const wiggly_desc *desc, const poles *at)
{
    return fmax(1, desc->wind_up * turn_of_period / (at->natural * desc->step));
}

static double fade_of(const poles *at)
{
    const double share = at->natural > 0 ? (at->centre / at->natural - SLOWEST_SLOPE) / slope_fade : 0;
    const double v = fmin(fmax(share, 0), 1);
    return v * v * (3 - 2 * v);
}

static goal goal_of(const wiggly_solver *solver, const problem *p, const wiggly_knot *knot)
{
    goal to = {.w.re = problem_knot_re(p, knot), .is_whole = problem_is_whole(p, knot)};
    to.swung = p->response.im ? p->response.im[knot->sample] : 0;
    if (to.is_whole) to.w.im = problem_knot_im(p, knot);
    if (to.is_whole || !knot->has_slope) return to;
    const poles at = poles_here(solver, p, knot->sample);
    const double h = p->desc->step;
    to.slope = knot->slope - (p->y ? p->response.speed[knot->sample] : 0);
    to.pull = fade_of(&at) * fmin(knot_stiffness(knot), STIFFEST) * (h * h * h);
    return to;
}

// --- the filter of each sample

/// Coefficients m, p to `at`, ln |g|⁻² to `im_weight` and the free motion to the next sample to `drive`. Constant ones are of row 0 alone.
static void set_filter(wiggly_solver *solver, const problem *p)
{
    system_rows *rows = &solver->rows;
    const wiggly_desc *desc = p->desc;
    const double floor = problem_least_damping(p), h = desc->step;
    solver->wind.is_constant = poles_are_constant(desc);
    if (solver->wind.is_constant) {
        rows->is_constant = true;
        rows->own = poles_coefficients(&problem_filter(solver, p)->at, h);
        return;
    }
    const int samples = p->start == WIGGLY_LOOP ? p->count : desc->samples;
    rows->is_constant = rows->fast = false;
    poles_block block;
    for (int from = 0; from < samples; from += POLES_BLOCK) {
        const int count = samples - from < POLES_BLOCK ? samples - from : POLES_BLOCK, end = from + count;
        poles_block_fill(desc, from, count, floor, &block);
        const poles next = poles_here(solver, p, end < desc->samples ? end : end - 1);
        double real[POLES_BLOCK], angle[POLES_BLOCK];
        for (int k = 0; k < count; k++) {
            const bool last = k + 1 == count;
            rows->m_re[from + k] = block.m_re[k], rows->m_im[from + k] = block.m_im[k];
            rows->p_re[from + k] = block.p_re[k], rows->p_im[from + k] = block.p_im[k];
            rows->im_weight[from + k] = block.exponent[k];
            real[k] = -0.25 * (block.exponent[k] + (last ? poles_weight_exponent(&next, h) : block.exponent[k + 1]));
            angle[k] = 0.5 * h * (block.centre[k] + (last ? next.centre : block.centre[k + 1]));
        }
        poles_block_turn(real, angle, count, rows->drive + from);
    }
}

// --- a gap

/// The part of a window that does not depend on where the gap begins: χ, and the covariance.
static void look_back(const wiggly_solver *solver, const problem *p, const poles *end, wind_gap *g)
{
    const system_rows *rows = &solver->rows;
    const bool constant = solver->wind.is_constant;
    const coefficients last = constant ? rows->own : poles_coefficients(end, p->desc->step);
    const bool is_fast = poles_weight_exponent(end, p->desc->step) > FAST; // then m and p hold no digit of a and b
    const cplx half = cplx_scale(0.5, coefficients_a(&last)), b = cplx_scale(-1, coefficients_b(&last));
    cplx w[2] = {{1, 0}, is_fast ? cplx_add(half, b) : cplx_sub(cplx_scale(-0.5, last.m), last.p)};
    cplx d[2] = {{1, 0}, half}, both = {0, 0};
    double knot = 0, missed = 0;
    for (int i = g->end - 1;; i--) {
        const int at = constant ? 0 : sample_of(p, i);
        const double q = (i == g->begin ? g->part : 1) * (constant ? 1 : rows->jet_weight[at]);
        g->push[i - g->begin] = (wind_push){d[0], d[1]};
        knot += q * cplx_norm(d[0]);
        missed += q * cplx_norm(d[1]);
        both = cplx_add(both, cplx_scale(q, cplx_mul(d[0], cplx_conj(d[1]))));
        if (i == g->begin) break;
        const coefficients row = system_coefficients(rows, at);
        for (int n = 0; n < 2; n++) {
            const cplx before = w[n];
            w[n] = cplx_sub(before, cplx_mul(row.p, d[n]));
            d[n] = cplx_add(cplx_add(before, d[n]), cplx_mul(row.m, d[n]));
        }
    }
    g->back[0] = w[0], g->back[1] = w[1];
    g->both = both;
    g->row = missed + 0.5;
    g->knot = knot - cplx_norm(both) / g->row;
    const double doubt = DBL_EPSILON * (g->end - g->begin + 8) * knot;
    g->doubt = doubt < 0.1 * g->knot ? doubt / g->knot : INFINITY;
}

/// How the free motion reaches the window: w at its first sample and the step from there, for w = 1 at the gap's knot.
static void begin_window(const wiggly_solver *solver, const problem *p, double back, wind_gap *g)
{
    const bool constant = solver->wind.is_constant;
    const double h = p->desc->step, share = ceil(back) - back;
    const int low = g->end - (int)ceil(back);
    const poles here = poles_here(solver, p, low), next = share > 0 ? poles_here(solver, p, low + 1) : here;
    const cplx pole = cplx_add(cplx_scale(1 - share, poles_passive(&here)), cplx_scale(share, poles_passive(&next)));
    // half the distance of the two poles: from σ on they turn apart, and go on with the speed of one
    const double apart =
        0.5 * h * ((1 - share) * (here.s[0].im - here.s[1].im) + share * (next.s[0].im - next.s[1].im));
    cplx before = {0, 0}, w = {1, 0};
    if (constant && g->begin > g->from) {
        const cplx exponent = solver->filter.passive;
        before = cplx_exp(cplx_scale(g->begin - 1 - g->from, exponent));
        w = cplx_mul(before, cplx_exp(exponent));
    }
    for (int i = g->from; !constant && i < g->begin; i++) {
        before = w;
        w = cplx_mul(w, solver->rows.drive[sample_of(p, i)]);
    }
    const double off = g->begin - g->end + back, m = 2 * fmax(0, off);
    g->at = cplx_scale(maths_cos(apart * off), w);
    cplx ahead = cplx_scale((1 - m) * maths_cos(apart * (off + 1)), cplx_mul(cplx_exp(cplx_scale(h, pole)), w));
    if (m > 0) {
        const poles at = poles_here(solver, p, g->begin);
        const coefficients row = poles_coefficients(&at, h);
        ahead = cplx_add(ahead, cplx_scale(m, cplx_mul(coefficients_a(&row), g->at)));
        before = cplx_scale(m * maths_cos(apart * (off - 1)), before);
        ahead = cplx_sub(ahead, cplx_mul(coefficients_b(&row), before));
    }
    g->step = cplx_sub(ahead, g->at);
}

/// Everything of a gap but values; `like` is one with the same window, or NULL. Pushes go to `push`.
static void set_gap(wiggly_solver *solver, const problem *p, int from, int end, const wind_gap *like, wind_push *push,
                    wind_gap *g)
{
    const poles at = poles_here(solver, p, end);
    const double reach = problem_reach(p->desc, &at);
    const double back =
        fmin(reach, end - from); // from σ; counted from the knot, so that no bit depends on when that is
    *g = (wind_gap){.from = from, .end = end, .begin = end - (int)ceil(back - 0.5), .is_cut = !(reach < end - from)};
    g->part = fmin(1, g->begin - end + back + 0.5);
    if (solver->wind.is_constant && like && !g->is_cut) {
        g->push = like->push;
        g->back[0] = like->back[0], g->back[1] = like->back[1];
        g->both = like->both, g->row = like->row, g->knot = like->knot, g->doubt = like->doubt;
    } else {
        g->push = push;
        double *const weight = solver->rows.jet_weight; // the squared gains of pushes, |g_i/g_k|²
        const double *exponent = solver->rows.im_weight, *last = exponent + sample_of(p, end);
        for (int i = g->begin; i < end && !solver->wind.is_constant;) {
            const int sample = sample_of(p, i), seam = p->start == WIGGLY_LOOP ? p->count - sample : end - i;
            const int left = seam < end - i ? seam : end - i, count = left < POLES_BLOCK ? left : POLES_BLOCK;
            for (int k = 0; k < count; k++) weight[sample + k] = *last - exponent[sample + k];
            poles_block_exp(weight + sample, count, weight + sample);
            i += count;
        }
        look_back(solver, p, &at, g);
    }
    begin_window(solver, p, back, g);
    const cplx first[2] = {g->push[0].knot, g->push[0].row};
    for (int n = 0; n < 2; n++) g->coast[n] = cplx_add(cplx_mul(g->back[n], g->at), cplx_mul(first[n], g->step));
}

/// w_k where nothing but the last row says what it is.
static cplx mean_of(const wind_gap *g, cplx w)
{
    return cplx_sub(cplx_mul(g->coast[0], w), cplx_scale(1 / g->row, cplx_mul(g->both, cplx_mul(g->coast[1], w))));
}

/// The same w at a knot where the phase is free, with the digits that it would have at a pose there: so a free knot can become one and what
/// follows does not change by a bit.
static cplx as_posed(const goal *to, cplx w)
{
    for (int n = 0; n < 2 && to->swung != 0; n++) w.im = (w.im + to->swung) - to->swung;
    return w;
}

/// What rounding may do to Im w at the end of a gap where nothing gives it, `before` having been w's error at the beginning: the passes of a gap
/// are sums of that many terms, and the mean is a difference of two.
static double error_at_end(const wind_gap *g, cplx w, double before, const goal *to)
{
    if (to->is_whole) return 0;
    const double unit = 32 * DBL_EPSILON * (g->end - g->from + 8), share = cplx_size(g->both) / g->row;
    const double size = cplx_size(g->coast[0]) + share * cplx_size(g->coast[1]);
    return cplx_size(mean_of(g, (cplx){before, 0})) + unit * size * cplx_size(w) + DBL_EPSILON * fabs(to->swung);
}

/// w at the end of a gap, from w at its beginning.
static cplx arrive(const wiggly_solver *solver, const problem *p, const wind_gap *g, cplx w, const goal *to)
{
    if (to->is_whole) return to->w;
    const cplx mean = mean_of(g, w);
    cplx there = {to->w.re, mean.im};
    if (to->pull > 0) {
        const poles at = poles_here(solver, p, g->end);
        const cplx pole = poles_passive(&at);
        const double pull = g->knot * to->pull * pole.im;
        there.im = (mean.im + pull * (pole.re * to->w.re - to->slope)) / (1 + pull * pole.im);
    }
    return as_posed(to, there);
}

/// Fills `count` samples after one by the free motion.
static void coast(wiggly_solver *solver, const problem *p, cplx w, int from, int count, double *re, double *im)
{
    const int at = from + 1, seam = p->start == WIGGLY_LOOP ? p->count - at : count;
    const int ahead = seam < 0 ? 0 : seam < count ? seam : count;
    if (solver->wind.is_constant) {
        problem_fill_tail(solver, p, w, 1, ahead, re + at, im + at);
        if (ahead < count)
            problem_fill_tail(solver, p, w, 1 + ahead, count - ahead, re + at + ahead - p->count,
                              im + at + ahead - p->count);
        return;
    }
    for (int i = from; i < from + count; i++) {
        const int next = sample_of(p, i + 1);
        w = cplx_mul(solver->rows.drive[sample_of(p, i)], w);
        re[next] = w.re, im[next] = w.im;
    }
}

/// Fills the samples after a gap's knot, to its end. Returns the larger of two errors: how far the pushes miss the end, and how far rounding
/// in them may move the curve.
static double fill_gap(wiggly_solver *solver, const problem *p, const wind_gap *g, cplx w, cplx end, double *re,
                       double *im)
{
    const system_rows *rows = &solver->rows;
    const bool constant = solver->wind.is_constant;
    coast(solver, p, w, g->from, g->begin - g->from, re, im);
    const cplx apart = cplx_sub(end, mean_of(g, w)), knot = cplx_scale(1 / g->knot, apart);
    const cplx missed = cplx_add(cplx_mul(g->coast[1], w), cplx_mul(cplx_conj(g->both), knot));
    const cplx row = cplx_scale(-1 / g->row, missed);
    cplx x = cplx_mul(g->at, w), d = cplx_mul(g->step, w);
    double largest = cplx_norm(apart);
    if (g->begin > g->from && g->part > 0.5) { // the wind-up begins before it
        const int at = sample_of(p, g->begin);
        re[at] = x.re, im[at] = x.im;
    }
    for (int i = g->begin; i < g->end; i++) {
        const int at = sample_of(p, i);
        const wind_push *push = &g->push[i - g->begin];
        const double q = (i == g->begin ? g->part : 1) * (constant ? 1 : rows->jet_weight[at]);
        const cplx e = cplx_add(cplx_mul(cplx_conj(push->knot), knot), cplx_mul(cplx_conj(push->row), row));
        if (i > g->begin) {
            const coefficients own = system_coefficients(rows, at);
            const cplx bent = cplx_sub(cplx_mul(own.m, d), cplx_mul(own.p, x));
            x = cplx_add(x, d);
            d = cplx_add(d, bent);
            re[at] = x.re, im[at] = x.im;
            largest = fmax(largest, cplx_norm(x));
        }
        d = cplx_add(d, cplx_scale(q, e));
    }
    const int at = sample_of(p, g->end);
    re[at] = end.re, im[at] = end.im;
    const double missed_by = fmax(fabs(x.re + d.re - end.re), fabs(x.im + d.im - end.im));
    return largest > 0 ? fmax(missed_by, g->doubt * sqrt(largest)) : missed_by;
}

// --- a spline

/// How the gaps follow from the knots: one before each knot after rest and round a loop, else one between every two.
typedef struct course {
    int first, gaps;
    int skipped; ///< knots before the first gap's end
} course;

static const wiggly_knot *knot_of(const wiggly_solver *solver, const problem *p, int n)
{
    return &p->desc->knots[solver->order[n % p->desc->knot_count]];
}

static int end_of(const wiggly_solver *solver, const problem *p, const course *c, int gap)
{
    const int n = gap + c->skipped;
    return knot_of(solver, p, n)->sample + (n == p->desc->knot_count ? p->count : 0);
}

/// Whether all gaps are those of the solve before.
static bool are_kept(const wiggly_solver *solver, const problem *p, const course *c)
{
    const wind_memory *m = &solver->wind;
    const wiggly_desc *desc = p->desc;
    if (!m->is_kept || m->count != c->gaps || m->floor != problem_least_damping(p) ||
        !desc_same_filter(&m->desc, desc) || m->desc.wind_up != desc->wind_up ||
        (m->desc.start == WIGGLY_LOOP) != (p->start == WIGGLY_LOOP) || m->desc.samples != desc->samples)
        return false;
    for (int n = 0; n < c->gaps; n++) {
        if (m->gap[n].from != (n > 0 ? m->gap[n - 1].end : c->first) || m->gap[n].end != end_of(solver, p, c, n))
            return false;
    }
    return true;
}

/// w at a free start's knot. A slope there gives the phase of a swing with that speed, unless the swing is slow against the gap.
static cplx start_of(const wiggly_solver *solver, const problem *p)
{
    const wiggly_knot *knot = knot_of(solver, p, 0);
    const goal to = goal_of(solver, p, knot);
    if (to.is_whole || !knot->has_slope) return to.w;
    const poles at = poles_here(solver, p, knot->sample);
    const int next = p->desc->knot_count > 1 ? knot_of(solver, p, 1)->sample : p->desc->samples - 1;
    const double turn = at.centre * ((next - knot->sample) * p->desc->step), turn4 = turn * turn * (turn * turn);
    const double fade = fade_of(&at) * turn4 / (1 + turn4);
    const cplx swings = {to.w.re, (-at.decay * to.w.re - to.slope) / at.centre * fade};
    return fade > 0 ? as_posed(&to, swings) : to.w;
}

/// Im w after going once round a loop, or what is left of w there if all knots ask for 0; and its error.
static double go_round(const wiggly_solver *solver, const problem *p, cplx w, bool asks, double *error)
{
    const double given = asks ? problem_response_error(p) : 0; // of Re w at knots
    *error = 0;
    for (int n = 0; n < p->desc->knot_count; n++) {
        goal to = goal_of(solver, p, knot_of(solver, p, n + 1));
        if (!asks) to.w = (cplx){0, 0}, to.swung = to.slope = 0;
        *error = error_at_end(&solver->wind.gap[n], w, *error + given, &to);
        w = arrive(solver, p, &solver->wind.gap[n], w, &to);
    }
    return w.im;
}

/// w at a loop's first knot, so that the loop closes: Im w is exactly the phase with which it comes back, unless nothing decides that.
static cplx close_round(const wiggly_solver *solver, const problem *p, double *error)
{
    goal to = goal_of(solver, p, knot_of(solver, p, 0));
    if (to.is_whole) return to.w;
    double of_a, of_b;
    const double a = go_round(solver, p, (cplx){to.w.re, 0}, true, &of_a);
    const double b = go_round(solver, p, (cplx){0, 1}, false, &of_b);
    const double whole = (1 - b) * (1 - b) + 1e-4 * b * b, turn = a * (1 - b) / whole;
    *error = (of_a * fabs(1 - b) + of_b * (fabs(a) + 2 * fabs(turn) * (fabs(1 - b) + 1e-4 * fabs(b)))) / whole;
    return as_posed(&to, (cplx){to.w.re, turn});
}

void problem_solve_gaps(wiggly_solver *solver, const problem *p, wiggly_curve *curve, minimum *result)
{
    const bool loops = p->start == WIGGLY_LOOP;
    const int knots = p->desc->knot_count, samples = p->desc->samples;
    double *re = curve->re, *im = curve->im;
    if (knots == 0) {
        for (int i = 0; i < samples; i++) re[i] = im[i] = 0;
        return;
    }
    const bool rests = p->start == WIGGLY_REST;
    const course c = {
        .first = rests ? 0 : p->earliest, .gaps = knots - (loops || rests ? 0 : 1), .skipped = rests ? 0 : 1};
    wind_memory *m = &solver->wind;
    set_filter(solver, p);
    if (!m->is_constant || !are_kept(solver, p, &c)) {
        const wind_gap *like = NULL;
        wind_push *push = m->push;
        for (int n = 0, from = c.first; n < c.gaps; n++) {
            wind_gap *g = &m->gap[n];
            set_gap(solver, p, from, end_of(solver, p, &c, n), like, push, g);
            if (g->push == push) push += g->end - g->begin;
            if (!like && !g->is_cut) like = g;
            from = g->end;
        }
        m->is_kept = m->is_constant;
        m->desc = desc_settings(p->desc);
        m->floor = problem_least_damping(p);
        m->count = c.gaps;
    }
    double off = 0;
    cplx w = loops ? close_round(solver, p, &off) : rests ? (cplx){0, 0} : start_of(solver, p);
    const cplx first = w;
    re[c.first] = w.re, im[c.first] = w.im;
    double most = off;
    for (int n = 0; n < c.gaps; n++) {
        const wind_gap *g = &solver->wind.gap[n];
        const goal to = goal_of(solver, p, knot_of(solver, p, n + c.skipped));
        const cplx end = loops && n + 1 == c.gaps ? first : arrive(solver, p, g, w, &to);
        off = error_at_end(g, w, off + problem_response_error(p), &to);
        most = fmax(most, fmax(off, fill_gap(solver, p, g, w, end, re, im)));
        w = end;
    }
    result->error += most;
    if (!loops) coast(solver, p, w, p->latest, samples - 1 - p->latest, re, im);
}

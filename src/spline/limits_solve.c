/// Solves a spline whose held samples are known: as knots up to the last one, and of a real spline that pushes the part after it.
//
// After the last knot w is free, w = e^{p…} w_L, until a limit pushes it: w = e^{p…} w_L + e, where Re e is the real oscillator's spline from
// rest at L, through the held samples' remaining distances. These are linear in v = Im w_L, so its energy is quadratic:
// E(v) = E₀ + D₀ v + ½ D₁ v², and D = dE/dv follows from the pulls at the held samples. For the part up to the last knot this is a slope there
// (its speed Re(p w_L) is linear in v, too), with stiffness ½ D₁ / (Im p)² and target v = −D₀ / D₁.
#include "maths/maths.h"
#include "spline/bound_tail.h"
#include "spline/limits.h"
#include <math.h>
#include <string.h>

/// The knot at rest from which a tail starts; its stiffness makes the force there, e₁ of its row, count like any other.
static wiggly_knot at_rest(const wiggly_desc *desc)
{
    const poles at = poles_at(desc, 0, 0);
    const double seen = poles_speed(&at, desc->step, false).on_e.re;
    const double weight = maths_exp(poles_weight_exponent(&at, desc->step)) / (seen * seen);
    return (wiggly_knot){.has_slope = true, .stiffness = weight / (1 - 0.5 * weight) / desc->step};
}

/// What a held sample must reach, in the body and in both parts of the tail.
enum what { REACH_BOUND, PUSH_FREE, PUSH_TURN };

static double target(const limits_work *w, int sample, enum what what)
{
    const limit_memory *m = &w->solver->limits;
    if (what == REACH_BOUND) return limits_bound(w, sample);
    if (what == PUSH_TURN) return -m->free[1][sample];
    return limits_bound(w, sample) - problem_about(w->p, sample) - m->free[0][sample];
}

/// Inserts the part's held samples among the `count` knots in `all`, in order. Returns the new count; -1: no room.
static int add_held(const limits_work *w, const limits_part *part, enum what what, const wiggly_knot *own,
                    int own_count)
{
    const limit_memory *m = &w->solver->limits;
    int count = 0, next = 0;
    if (own_count + part->held > w->solver->knots) return -1;
    for (int i = part->from; i <= part->to && count < own_count + part->held; i++) {
        for (; next < own_count && own[next].sample + part->begin <= i; next++) m->all[count++] = own[next];
        if (limits_hold(w, i))
            m->all[count++] = (wiggly_knot){.sample = i - part->begin, .value = target(w, i, what)};
    }
    for (; next < own_count; next++) m->all[count++] = own[next];
    return count;
}

static void take_knots(wiggly_solver *solver, limits_part *part, int count)
{
    part->desc.knots = solver->limits.all;
    part->desc.knot_count = count;
    part->p.desc = &part->desc;
    for (int k = 0; k < count; k++) solver->order[k] = k;
}

/// Adds the slope at the last knot that stands for the tail's cost, merged with the knot's own slope.
static void add_slope(const limits_work *w, wiggly_knot *last, const double on_turn[2])
{
    const problem *p = w->p;
    const poles at = poles_at(p->desc, p->latest, 0);
    const cplx pole = poles_passive(&at);
    double stiffness = 0.5 * on_turn[1] / (pole.im * pole.im), w_re = last->value - problem_about(p, p->latest);
    if (!(stiffness > 0 && stiffness < INFINITY)) return;
    double speed = pole.re * w_re + pole.im * on_turn[0] / on_turn[1];
    if (p->response.speed) speed += p->response.speed[p->latest];
    double own = last->has_slope ? knot_stiffness(last) : 0;
    last->slope = (own * (last->has_slope ? last->slope : 0) + stiffness * speed) / (own + stiffness);
    last->stiffness = own + stiffness;
    last->has_slope = true;
}

/// The rows' pull at each sample of a curve that begins with the system, into the real parts of their gradient; `im` may be NULL in a real
/// one.
static void find_forces(const system_rows *rows, const double *re, const double *im)
{
    for (int k = 0; k < rows->count; k++)
        rows->x[2 * k] = re[k], rows->x[2 * k + 1] = im && rows->is_complex ? im[k] : 0;
    system_gradient(rows, NULL, NULL);
}

/// Re e of a part of the tail; returns Σ pull · free[1] over the held samples in units of E, -1 if there is no room.
static bool push(limits_work *w, enum what what, double *along_turn)
{
    wiggly_solver *solver = w->solver;
    limit_memory *m = &solver->limits;
    limits_part *tail = &w->tail;
    const wiggly_knot start = at_rest(&tail->desc);
    double *re = m->pushed[what == PUSH_TURN] + tail->begin;
    int count = add_held(w, tail, what, &start, 1);
    if (count < 0) return false;
    take_knots(solver, tail, count);
    problem_pose(solver, &tail->desc, NULL, &tail->p);
    wiggly_curve curve = {.re = re, .im = re};
    minimum result;
    problem_find(solver, &tail->p, &curve, &result);
    w->tail_error += result.error;
    problem_set_rows(solver, &tail->p);
    find_forces(&solver->rows, re, NULL);
    const double h = tail->desc.step, unit = h * h * h * tail->p.unit, *force = solver->rows.gradient;
    *along_turn = 0;
    for (int i = tail->from; i <= tail->to; i++) {
        if (limits_hold(w, i)) *along_turn += 2 * force[2 * (i - tail->begin)] * m->free[1][i] / unit;
    }
    return true;
}

/// The free w after the last knot, for Re w there and for an Im w of 1.
static void set_free(const limits_work *w)
{
    wiggly_solver *solver = w->solver;
    const problem *p = w->p;
    limit_memory *m = &solver->limits;
    int L = w->tail.begin, count = p->desc->samples - L - 1;
    m->free[0][L] = m->free[1][L] = 0;
    if (p->latest < 0) {
        memset(m->free[0] + L, 0, sizeof(double) * (size_t)(count + 1));
        memset(m->free[1] + L, 0, sizeof(double) * (size_t)(count + 1));
        return;
    }
    const wiggly_knot *last = &m->own[p->desc->knot_count - 1];
    const cplx known = {problem_knot_re(p, last), problem_is_whole(p, last) ? problem_knot_im(p, last) : 0};
    problem_fill_tail(solver, p, known, 1, count, m->free[0] + L + 1, m->pushed[0] + L + 1);
    problem_fill_tail(solver, p, (cplx){0, 1}, 1, count, m->free[1] + L + 1, m->pushed[0] + L + 1);
}

void limits_set_tail_rows(limits_work *w)
{
    wiggly_solver *solver = w->solver;
    set_free(w);
    solver->limits.all[0] = at_rest(&w->tail.desc);
    take_knots(solver, &w->tail, 1);
    problem_pose(solver, &w->tail.desc, NULL, &w->tail.p);
    problem_set_rows(solver, &w->tail.p);
}

/// Whether there is a last knot with a free Im w.
static bool turn_is_free(const limits_work *w)
{
    const int knots = w->p->desc->knot_count;
    return knots > 0 && !problem_is_whole(w->p, &w->solver->limits.own[knots - 1]);
}

/// Adds the tail's push to w, and records the held samples' pulls.
static void add_push(limits_work *w)
{
    wiggly_solver *solver = w->solver;
    limit_memory *m = &solver->limits;
    limits_part *tail = &w->tail;
    const int L = tail->begin, n = tail->desc.samples;
    const bool turns = turn_is_free(w);
    double turn = turns ? w->curve->im[L] : 0, *e = m->pushed[0] + L;
    const double unit = w->p->unit / tail->p.unit;
    for (int i = 0; turns && i < n; i++) e[i] += turn * m->pushed[1][L + i];
    m->all[0] = at_rest(&tail->desc); // it held the body's knots until now
    take_knots(solver, tail, 1);
    problem_set_rows(solver, &tail->p);
    find_forces(&solver->rows, e, NULL);
    for (int i = tail->from; i <= tail->to; i++) {
        if (limits_hold(w, i)) m->pull[i] = unit * solver->rows.gradient[2 * (i - L)];
    }
    const bound_tail moved = bound_tail_of(w->p, 1);
    bound_tail_add(&moved, m->pushed[0], w->curve);
}

static bool solve_body(limits_work *w, const double on_turn[2])
{
    wiggly_solver *solver = w->solver;
    limit_memory *m = &solver->limits;
    limits_part *body = &w->body;
    int count = add_held(w, body, REACH_BOUND, m->own, w->p->desc->knot_count);
    if (count < 0) return false;
    if (on_turn[1] > 0) add_slope(w, &m->all[count - 1], on_turn);
    body->p = *w->p;
    body->p.level_slope = problem_implies_slope(w->p);
    body->desc = *w->p->desc;
    take_knots(solver, body, count);
    if (!problem_is_asked(&body->p) && count > 0) { // the held samples do
        body->p.earliest = m->all[0].sample;
        body->p.latest = m->all[count - 1].sample;
    }
    minimum result;
    wiggly_status status = problem_find(solver, &body->p, w->curve, &result);
    w->status = status > w->status ? status : w->status;
    result.error += w->tail_error;
    *w->result = result;
    if (body->held == 0) return true;
    problem_set_rows(solver, &body->p);
    find_forces(&solver->rows, w->curve->re + body->p.first, w->curve->im + body->p.first);
    for (int i = body->from; i <= body->to; i++) {
        if (limits_hold(w, i)) m->pull[i] = solver->rows.gradient[2 * (i - body->p.first)];
    }
    return true;
}

bool limits_solve(limits_work *w)
{
    double on_turn[2] = {0, 0};
    w->tail_error = 0;
    w->solver->limits.solves++;
    const int knots = w->p->desc->knot_count;
    if (w->tail.held > 0) {
        set_free(w);
        if (!push(w, PUSH_FREE, &on_turn[0])) return false;
        if (turn_is_free(w) && !push(w, PUSH_TURN, &on_turn[1])) return false;
    }
    if (limits_has_body(w) || knots > 0) {
        if (!solve_body(w, on_turn)) return false;
    } else {
        memset(w->curve->re, 0, sizeof(double) * (size_t)w->p->desc->samples);
        memset(w->curve->im, 0, sizeof(double) * (size_t)w->p->desc->samples);
        *w->result = (minimum){.solved = true, .error = w->tail_error};
    }
    if (w->tail.held > 0) add_push(w);
    return true;
}

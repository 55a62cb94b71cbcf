/// Sets up the chain from a problem: whether it can be used, and its nodes.
#include "maths/maths.h"
#include "spline/problem.h"
#include <float.h>
#include <math.h>
#include <string.h>

/// If a row's b almost vanishes, the jet at a sample and the motion after it are unrelated: the chain cannot handle speeds seen from there.
static const double least_b = 1e-3;

/// The n-th knot in order of samples.
static const wiggly_knot *knot_at(const wiggly_solver *solver, const problem *p, int n)
{
    return &p->desc->knots[solver->order[n]];
}

/// Whether the chain may solve it: constant parameters, for the paper's filter a constant equilibrium; no loop, no still knots, none side by
/// side.
static bool fits_chain(wiggly_solver *solver, const problem *p)
{
    const wiggly_desc *desc = p->desc;
    if (solver->method == WIGGLY_BAND || p->pulls || p->level_slope || p->still >= 0 || desc->knot_count == 0)
        return false;
    if (p->start == WIGGLY_LOOP || !poles_are_constant(desc)) return false;
    const bool oscillates = problem_oscillates(p);
    const constant_filter *f = problem_filter(solver, p);
    if (oscillates ? f->cut : p->about != NULL) return false; // only the band knows what a cut changes
    if (p->start == WIGGLY_REST && knot_at(solver, p, 0)->sample < 2)
        return false; // held at a limit: too close to the node at rest
    const bool faint = maths_exp(2 * desc->step * (f->at.s[0].re + f->at.s[1].re)) < least_b;
    int before = -2;
    for (int n = 0; n < desc->knot_count; n++) {
        const wiggly_knot *knot = knot_at(solver, p, n);
        if (knot->sample == before + 1) return false;
        if (knot->has_slope && (oscillates ? faint : knot->sample == desc->samples - 1)) return false;
        before = knot->sample;
    }
    return true;
}

/// The slope of a knot. An oscillator's speed seen from behind differs from that seen ahead by the jet between.
static void put_slope(const problem *p, const wiggly_knot *knot, const constant_filter *f, chain_node *node)
{
    const slope_row slope = problem_slope(p, knot->sample, knot->slope, knot_stiffness(knot));
    const bool ahead = knot->sample + 1 < p->first + p->count, behind = knot->sample > p->first;
    chain_place *at = &node->at;
    node->slope = slope.target;
    node->slope_error = slope.target_error;
    at->slope_weight = slope.weight;
    if (p->settles && knot->sample == p->latest) {
        at->on_x = f->passive;
        return;
    }
    const bool oscillates = problem_oscillates(p);
    const speed_form form = oscillates ? f->ahead : (speed_form){.on_e = {1, 0}};
    const cplx growth = {f->lambda.re - 1, f->lambda.im}; // e = d + growth x
    at->on_x = cplx_add(form.on_x, cplx_mul(form.on_e, growth));
    at->on_d = form.on_e;
    node->loss_x = form.loss.x + cplx_size(growth) * form.loss.e;
    node->loss_d = form.loss.e;
    if (oscillates) at->on_r = cplx_scale(!behind ? 0 : ahead ? 0.5 : 1, form.on_e);
}

/// Writes the nodes; true if only values differ from those before.
static bool make_nodes(wiggly_solver *solver, const problem *p, const constant_filter *f)
{
    chain *c = &solver->chain;
    chain_node *node = c->nodes;
    const bool is_complex = p->desc->mode == WIGGLY_COMPLEX, rests = p->start == WIGGLY_REST;
    const int count = p->desc->knot_count + rests;
    bool same = count == c->node_count;
    for (int n = 0; n < count; n++, node++) {
        const chain_place before = node->at;
        memset(node, 0, sizeof *node); // places are compared as bytes
        node->at.free[0] = node->at.free[2] = is_complex ? 1 : 0;
        node->at.free[1] = 1;
        if (rests && n == 0) { // x is 0 there; the filter's next one, too
            node->at.free[0] = 0;
            if (!problem_oscillates(p)) {
                node->at.free[1] = node->at.free[2] = 0;
                node->d.re = p->y && !p->about ? p->y[1] - p->level : 0;
            }
        } else {
            const wiggly_knot *knot = knot_at(solver, p, n - rests);
            node->at.sample = knot->sample - p->first;
            node->x.re = problem_knot_re(p, knot);
            if (problem_is_whole(p, knot)) node->x.im = problem_knot_im(p, knot), node->at.free[0] = 0;
            if (p->settles && n == count - 1) {
                const cplx tail = is_complex ? cplx_sub((cplx){1 + f->tail.re, f->tail.im}, f->lambda) : (cplx){0, 0};
                node->at.free[1] = node->at.free[2] = 0;
                node->at.tie = (cplx){-tail.im, tail.re};
                node->d = cplx_mul(tail, node->x);
            }
            if (knot->has_slope) put_slope(p, knot, f, node);
        }
        same = memcmp(&before, &node->at, sizeof before) == 0 && same;
    }
    c->node_count = count;
    return same;
}

static bool same_cplx(cplx a, cplx b) { return a.re == b.re && a.im == b.im; }

/// Sets up the chain, and clears what it has cached from another problem.
static void set_chain(wiggly_solver *solver, const problem *p)
{
    chain *c = &solver->chain;
    const constant_filter *f = problem_filter(solver, p);
    start_cost start = p->cost;
    if (p->start == WIGGLY_REST && problem_oscillates(p)) // d is the jet there, and counts twice
        start.row[0] = (struct start_row){.weight = 2, .on_e = {1, 0}};
    if (!same_cplx(f->lambda, c->lambda) || !same_cplx(f->delta2, c->delta2)) chain_forget(c);
    if (memcmp(&start, &c->start, sizeof start) != 0 || c->count != problem_rows(p)) c->kept = false;
    c->count = problem_rows(p);
    c->start = start;
    c->lambda = f->lambda;
    c->delta2 = f->delta2;
    const double reach = fmax(cplx_size(f->at.s[0]), cplx_size(f->at.s[1])) * p->desc->step;
    c->loss = 4 * DBL_EPSILON * (1 + reach);
    c->fade = p->desc->step * fmax(fabs(f->at.s[0].re), fabs(f->at.s[1].re));
    const double passive = cplx_size(f->passive),
                 on_e = cplx_norm(f->ahead.on_e); // the tail is h (p − s₀) / on_e + e^{h s₀} − 1
    c->tail_loss = 8 * DBL_EPSILON * (2 + reach) + (on_e > 0 ? f->ahead.loss.e * (passive + reach) / on_e : 0);
    c->noise = p->about ? problem_noise(p) + problem_response_error(p) : 0;
    c->im_weight = p->desc->mode == WIGGLY_COMPLEX ? p->unit * problem_im_weight(p, f->at.natural) : 0;
    if (!make_nodes(solver, p, f)) c->kept = false;
}

bool problem_solve_chain(wiggly_solver *solver, const problem *p, double *x_re, double *x_im)
{
    if (!fits_chain(solver, p)) return false;
    solver->band.is_kept = false; // its memory is that of the chain's tables
    set_chain(solver, p);
    double *const im = p->desc->mode == WIGGLY_COMPLEX ? x_im : solver->rows.x; // for a real curve it may be x_re
    if (!chain_solve(&solver->chain, x_re, im)) return false;
    problem_settle(solver, p, x_re - p->first, x_im - p->first);
    return true;
}

/// From the description to a chain: which documents it serves, and their nodes.
#include "spline/problem.h"
#include <math.h>

/// Below this many radians of the natural frequency over the domain the imaginary rows hold Im x and may not be left out; above,
/// what they change is about 1e-14 of x, and below 1e-9 where x hangs on the start alone.
static const double least_phase = 48;

/// No slope may act between two nodes: on a knot beside the one before, or on the last sample.
bool problem_fits_chain(wiggly_solver *solver, const problem *p)
{
    const wiggly_desc *desc = p->desc;
    if (p->start == WIGGLY_LOOP || p->level_slope || !poles_are_constant(desc) || desc->equilibrium.track) return false;
    if (problem_oscillates(p)) return false;
    double t = (p->count - 1) * desc->step;
    if (desc->mode == WIGGLY_COMPLEX && solver_filter(solver, desc)->at.natural * t < least_phase) return false;
    for (int n = 0; n < desc->knot_count; n++) {
        const wiggly_knot *knot = &desc->knots[solver->order[n]];
        bool beside = n > 0 && desc->knots[solver->order[n - 1]].sample == knot->sample - 1;
        if (knot->has_slope && (beside || knot->sample == desc->samples - 1)) return false;
    }
    return true;
}

/// Writes what a knot says into a node, field by field; true where the node there differed in nothing but its values.
static bool put_node(chain_node *at, int sample, unsigned fixed, double slope, double slope_weight)
{
    bool same = at->sample == sample && at->fixed == fixed && at->slope_weight == slope_weight;
    at->sample = sample;
    at->fixed = fixed;
    at->slope = slope;
    at->slope_weight = slope_weight;
    return same;
}

/// Two keyed samples side by side are one node, whose e is known. true where only values differ from the nodes before.
static bool make_nodes(wiggly_solver *solver, const problem *p)
{
    const wiggly_desc *desc = p->desc;
    chain *c = &solver->chain;
    chain_node *node = c->nodes;
    bool same = true;
    if (p->start == WIGGLY_REST) {
        same = put_node(node, 0, NODE_AT_REST, 0, 0);
        node->value = node->e = 0;
        node++;
    }
    for (int n = 0; n < desc->knot_count; n++, node++) {
        const wiggly_knot *knot = &desc->knots[solver->order[n]];
        const wiggly_knot *next = n + 1 < desc->knot_count ? &desc->knots[solver->order[n + 1]] : NULL;
        double y = problem_y(p, knot->sample);
        bool pair = next && next->sample == knot->sample + 1;
        double slope = knot->has_slope ? desc->step * knot->slope : 0;
        double weight = knot->has_slope ? fmin(knot->stiffness * desc->step, STIFFEST) : 0;
        same = put_node(node, knot->sample - p->first, pair ? NODE_FIXED_E : 0, slope, weight) && same;
        node->value = knot->value - y;
        node->e = pair ? (next->value - y) - node->value : 0;
        if (pair) n++;
    }
    int count = (int)(node - c->nodes);
    same = same && count == c->node_count;
    c->node_count = count;
    return same;
}

static bool same_cplx(cplx a, cplx b) { return a.re == b.re && a.im == b.im; }

static bool same_row(struct start_row a, struct start_row b)
{
    return a.weight == b.weight && same_cplx(a.on_x, b.on_x) && same_cplx(a.on_e, b.on_e);
}

static bool same_start(start_cost a, start_cost b) { return same_row(a.row[0], b.row[0]) && same_row(a.row[1], b.row[1]); }

static bool same_filter(const wiggly_solver *solver, const problem *p)
{
    const chain *c = &solver->chain;
    const constant_filter *f = &solver->filter;
    return (p->desc->mode == WIGGLY_COMPLEX) == c->is_complex && same_cplx(f->lambda, c->lambda) &&
           same_cplx(f->delta2, c->delta2);
}

/// Sets filter and start, and forgets what was made for another.
static void set_chain(wiggly_solver *solver, const problem *p)
{
    chain *c = &solver->chain;
    const constant_filter *f = solver_filter(solver, p->desc);
    if (!same_filter(solver, p)) chain_forget(c);
    if (!same_start(p->cost, c->start)) c->kept = false;
    c->is_complex = p->desc->mode == WIGGLY_COMPLEX;
    c->count = problem_rows(p);
    c->start = p->cost;
    c->lambda = f->lambda;
    c->delta2 = f->delta2;
}

bool problem_shares_chain(wiggly_solver *solver, const problem *p)
{
    solver_filter(solver, p->desc);
    return same_filter(solver, p) && same_start(p->cost, solver->chain.start);
}

/// One knot without any hold has no single answer.
static bool is_held(const chain *c) { return c->node_count >= 2 || c->start.row[0].weight > 0; }

bool problem_join(wiggly_solver *solver, const problem *p)
{
    chain *c = &solver->chain;
    c->kept = false;
    problem_make_chain(solver, p);
    if (!is_held(c)) return false;
    chain_make_tables(c);
    chain_reset_nodes(c);
    return true;
}

bool problem_make_chain(wiggly_solver *solver, const problem *p)
{
    set_chain(solver, p);
    return make_nodes(solver, p);
}

bool problem_solve_chain(wiggly_solver *solver, const problem *p, double *x_re, double *x_im)
{
    chain *c = &solver->chain;
    bool same_nodes = problem_make_chain(solver, p);
    c->kept = c->kept && same_nodes;
    if (!is_held(c)) return false;
    return chain_solve(c, x_re, x_im);
}

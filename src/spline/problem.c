// From the description to a chain: which documents it serves, and their nodes.
#include "spline/problem.h"
#include <math.h>

/// Below this many radians of the band's centre over the domain the imaginary rows hold Im x and may not be left out; above,
/// what they change is below 1e-10 of x.
static const double least_phase = 16;

/// No slope may act between two nodes: on a knot beside the one before, or on the last sample.
bool problem_fits_chain(const wiggly_solver *solver, const problem *p)
{
    const wiggly_desc *desc = p->desc;
    const system_rows *rows = &solver->rows;
    if (rows->loop || p->level || !poles_are_constant(desc) || desc->equilibrium.track) return false;
    double t = (rows->count - 1) * desc->step;
    if (rows->is_complex && poles_at(desc, 0, 0).natural * t < least_phase) return false;
    for (int n = 0; n < desc->knot_count; n++) {
        const wiggly_knot *knot = &desc->knots[solver->order[n]];
        bool beside = n > 0 && desc->knots[solver->order[n - 1]].sample == knot->sample - 1;
        if (knot->has_slope && (beside || knot->sample == desc->samples - 1)) return false;
    }
    return true;
}

/// Two keyed samples side by side are one node, whose e is known.
static void make_nodes(wiggly_solver *solver, const problem *p)
{
    const wiggly_desc *desc = p->desc;
    chain *c = &solver->chain;
    c->node_count = 0;
    if (p->start == WIGGLY_REST) c->nodes[c->node_count++] = (chain_node){.fixed = NODE_AT_REST};
    for (int n = 0; n < desc->knot_count; n++) {
        const wiggly_knot *knot = &desc->knots[solver->order[n]];
        const wiggly_knot *next = n + 1 < desc->knot_count ? &desc->knots[solver->order[n + 1]] : NULL;
        double y = p->y[knot->sample];
        chain_node *node = &c->nodes[c->node_count++];
        *node = (chain_node){.sample = knot->sample - p->first, .value = knot->value - y};
        if (knot->has_slope) {
            node->slope = desc->step * knot->slope;
            node->slope_weight = fmin(knot->stiffness * desc->step, STIFFEST);
        }
        if (next && next->sample == knot->sample + 1) {
            node->fixed = NODE_FIXED_E;
            node->e = (next->value - y) - node->value;
            n++;
        }
    }
}

/// 0·x is NaN for what is not finite; eight sums at once, so that none waits for the last.
static bool all_finite(const double *x, int count)
{
    double sum[8] = {0}, all = 0;
    int i = 0;
    for (; i + 8 <= count; i += 8) {
        for (int k = 0; k < 8; k++) sum[k] += 0 * x[i + k];
    }
    for (; i < count; i++) all += 0 * x[i];
    for (int k = 0; k < 8; k++) all += sum[k];
    return all == 0;
}

bool problem_solve_chain(wiggly_solver *solver, const problem *p, double *x_re, double *x_im)
{
    chain *c = &solver->chain;
    const system_rows *rows = &solver->rows;
    poles at = poles_at(p->desc, 0, 0);
    c->is_complex = rows->is_complex;
    c->count = rows->count;
    poles_mean(&at, p->desc->step, &c->lambda, &c->delta2);
    c->start = rows->start;
    make_nodes(solver, p);
    if (c->node_count < 2 && !(c->start.h00 > 0)) return false;
    if (!chain_solve(c, x_re, c->is_complex ? x_im : NULL)) return false;
    return all_finite(x_re, c->count) && (!c->is_complex || all_finite(x_im, c->count));
}

/// Sets up the chain from a problem: whether it can be used, and its nodes.
#include "spline/problem.h"
#include "maths/maths.h"
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

/// The index of the knot after n, wrapped around.
static int in_turn(const problem *p, int n) { return n < p->desc->knot_count ? n : n - p->desc->knot_count; }

/// Whether there is a knot on the sample after knot n; in a loop the first knot follows the last.
static bool has_company(const wiggly_solver *solver, const problem *p, int n)
{
    int knots = p->desc->knot_count, sample = knot_at(solver, p, n)->sample + 1;
    if (n + 1 < knots) return knot_at(solver, p, n + 1)->sample == sample;
    return p->start == WIGGLY_LOOP && knots > 1 && sample == p->count && knot_at(solver, p, 0)->sample == 0;
}

/// The chain's first knot: the first; in a loop the first without a knot on the sample before, or that is still. -1: none.
static int first_of_chain(const wiggly_solver *solver, const problem *p)
{
    int knots = p->desc->knot_count;
    if (p->start != WIGGLY_LOOP) return 0;
    for (int n = 0; n < knots; n++) {
        if (knot_at(solver, p, n)->still || !has_company(solver, p, n > 0 ? n - 1 : knots - 1)) return n;
    }
    return -1;
}

/// Two knots side by side allow no slope but at the first of them; at the domain's last sample the paper's slope is not allowed. A still knot
/// has no neighbour.
static bool knots_fit(wiggly_solver *solver, const problem *p, int begin)
{
    const wiggly_desc *desc = p->desc;
    const poles *at = &problem_filter(solver, p)->at;
    bool oscillates = problem_oscillates(p),
         faint = maths_exp(2 * desc->step * (at->s[0].re + at->s[1].re)) < least_b;
    bool second = false;
    for (int i = 0; i < desc->knot_count; i++) {
        int n = in_turn(p, begin + i);
        const wiggly_knot *knot = knot_at(solver, p, n);
        bool on_last = !oscillates && p->start != WIGGLY_LOOP && knot->sample == desc->samples - 1;
        const bool company = has_company(solver, p, n);
        if (knot->has_slope && (second || on_last || (oscillates && faint))) return false;
        if (company && (knot->still || knot_at(solver, p, in_turn(p, n + 1))->still)) return false;
        second = !second && company;
    }
    return true;
}

bool problem_fits_chain(wiggly_solver *solver, const problem *p)
{
    const wiggly_desc *desc = p->desc;
    if (solver->method == WIGGLY_BAND || p->pulls || p->level_slope || !poles_are_constant(desc)) return false;
    if (p->about && !problem_oscillates(p)) return false; // the paper's filter is driven by a moving equilibrium
    if (problem_oscillates(p) && problem_filter(solver, p)->cut > 0)
        return false; // only the band knows what that changes
    if (p->start == WIGGLY_REST && desc->knot_count > 0 && knot_at(solver, p, 0)->sample < 2)
        return false; // held at a limit: too close to the node at rest
    int begin = first_of_chain(solver, p);
    return begin >= 0 && knots_fit(solver, p, begin);
}

/// Writes a knot to a node, field by field. True if the node there differed only in values.
static bool put_node(chain_node *at, int sample, unsigned fixed, chain_view view, double slope, double slope_weight)
{
    bool same = at->sample == sample && at->fixed == fixed && at->view == view && at->slope_weight == slope_weight;
    at->sample = sample;
    at->fixed = fixed;
    at->view = view;
    at->slope = slope;
    at->slope_weight = slope_weight;
    return same;
}

/// From which side the speed at a knot is seen.
static chain_view view_of(const problem *p, int sample)
{
    if (!problem_oscillates(p)) return VIEW_AHEAD;
    if (p->start == WIGGLY_LOOP) return VIEW_BOTH;
    if (p->settles && sample == p->latest) return VIEW_TAIL;
    bool ahead = sample + 1 < p->first + p->count, behind = sample > p->first;
    return ahead && behind ? VIEW_BOTH : ahead ? VIEW_AHEAD : VIEW_BEHIND;
}

/// The unknowns of a node that its knot, or pair of knots, fixes.
static unsigned known_of(const problem *p, const wiggly_knot *knot, const wiggly_knot *pair)
{
    const bool settled = p->settles && knot->sample == p->latest;
    if (knot->still) return NODE_STILL | (settled ? NODE_AT_REST | NODE_SETTLED : NODE_FROM_REST);
    unsigned fixed = problem_is_whole(p, knot) ? NODE_POSE : 0;
    if (!pair) return fixed | (settled ? NODE_SETTLED : 0);
    return fixed | NODE_FIXED_E | (problem_is_whole(p, pair) ? NODE_FIXED_E_IM : 0);
}

/// Writes a knot to a node, with the knot on the next sample if there is one; true if only values changed.
static bool put_knot(const problem *p, chain_node *node, const wiggly_knot *knot, const wiggly_knot *pair)
{
    slope_row slope = {0};
    const bool inside =
        pair && !problem_oscillates(p); // the paper's slope between two knots is met to rounding, or not at all
    if (knot->has_slope && !inside) slope = problem_slope(p, knot->sample, knot->slope, knot_stiffness(knot));
    const unsigned fixed = known_of(p, knot, pair);
    node->value = problem_knot_re(p, knot);
    node->im = fixed & NODE_POSE ? problem_knot_im(p, knot) : 0;
    node->e = pair ? problem_knot_re(p, pair) - node->value : 0;
    node->next_im = fixed & NODE_FIXED_E_IM ? problem_knot_im(p, pair) : 0;
    return put_node(node, knot->sample - p->first, fixed, view_of(p, knot->sample), slope.target, slope.weight);
}

/// Two neighbouring keyed samples are one node with a known e. True if only values differ from the nodes before.
static bool make_nodes(wiggly_solver *solver, const problem *p)
{
    const int knots = p->desc->knot_count, begin = first_of_chain(solver, p);
    chain *c = &solver->chain;
    chain_node *node = c->nodes;
    bool same = true;
    unsigned fixed = 0; // of any node
    int turned = p->start == WIGGLY_LOOP ? knot_at(solver, p, begin)->sample : 0;
    if (p->start == WIGGLY_REST) {
        same = put_node(node, 0, problem_oscillates(p) ? NODE_FROM_REST : NODE_AT_REST, VIEW_AHEAD, 0, 0);
        node->value = node->im = 0;
        node->e = p->y && !p->about ? p->y[1] - p->level : 0;
        node++;
    }
    for (int i = 0; i < knots; i++, node++) {
        int n = in_turn(p, begin + i);
        bool pair = has_company(solver, p, n);
        same = put_knot(p, node, knot_at(solver, p, n), pair ? knot_at(solver, p, in_turn(p, n + 1)) : NULL) && same;
        if (p->start == WIGGLY_LOOP) node->sample = (node->sample - turned + p->count) % p->count;
        if (pair) i++;
        fixed |= node->fixed;
    }
    c->posed = fixed & (NODE_POSE | NODE_FIXED_E_IM);
    int count = (int)(node - c->nodes);
    same = same && count == c->node_count && turned == c->turned;
    c->node_count = count;
    c->turned = turned;
    return same;
}

static bool same_cplx(cplx a, cplx b) { return a.re == b.re && a.im == b.im; }

/// The coefficient of the free motion in the last sample's jet.
static cplx tail_of(const constant_filter *f, const problem *p)
{
    if (p->desc->mode != WIGGLY_COMPLEX) return (cplx){0, 0};
    return cplx_sub((cplx){1 + f->tail.re, f->tail.im}, f->lambda);
}

static bool same_filter(const wiggly_solver *solver, const problem *p)
{
    const chain *c = &solver->chain;
    const constant_filter *f = &solver->filter;
    return (p->desc->mode == WIGGLY_COMPLEX) == c->is_complex && same_cplx(f->lambda, c->lambda) &&
           same_cplx(f->delta2, c->delta2) && same_cplx(tail_of(f, p), c->tail) && f->run == c->run;
}

/// h times the speed, for a node with d = e − (λ−1) x; seen from behind it differs only by the jet between.
static chain_speed speed_of(speed_form form, cplx lambda, double jet)
{
    cplx growth = {lambda.re - 1, lambda.im};
    return (chain_speed){cplx_add(form.on_x, cplx_mul(form.on_e, growth)), form.on_e, cplx_scale(jet, form.on_e)};
}

static void set_speeds(chain *c, const problem *p, const constant_filter *f)
{
    speed_form form = {.on_e = {1, 0}};
    if (problem_oscillates(p)) form = f->ahead;
    c->speed[VIEW_AHEAD] = speed_of(form, f->lambda, 0);
    c->speed[VIEW_BOTH] = speed_of(form, f->lambda, 0.5);
    c->speed[VIEW_BEHIND] = speed_of(form, f->lambda, 1);
    c->speed[VIEW_TAIL] = (chain_speed){.on_x = f->passive};
    c->tail = tail_of(f, p);
}

/// Sets the chain's filter, start and end, and clears its caches.
static void set_chain(wiggly_solver *solver, const problem *p)
{
    chain *c = &solver->chain;
    const constant_filter *f = problem_filter(solver, p);
    if (!same_filter(solver, p)) chain_forget(c);
    if (memcmp(&p->cost, &c->start, sizeof p->cost) != 0 || c->count != problem_rows(p)) c->kept = false;
    if (c->settles != p->settles || c->cyclic != (p->start == WIGGLY_LOOP) || c->oscillates != problem_oscillates(p))
        c->kept = false;
    c->is_complex = p->desc->mode == WIGGLY_COMPLEX;
    c->count = problem_rows(p);
    c->start = p->cost;
    c->settles = p->settles;
    c->cyclic = p->start == WIGGLY_LOOP;
    c->oscillates = problem_oscillates(p);
    c->lambda = f->lambda;
    c->delta2 = f->delta2;
    c->run = f->run;
    const double reach = fmax(cplx_size(f->at.s[0]), cplx_size(f->at.s[1])) * p->desc->step;
    c->loss = 4 * DBL_EPSILON * (1 + reach);
    c->noise = p->about ? problem_noise(p) : 0;
    c->im_weight = c->is_complex ? p->unit * problem_im_weight(p, f->at.natural) : 0;
    set_speeds(c, p, f);
}

/// A single knot with nothing else has no unique solution.
static bool is_held(const chain *c) { return c->cyclic || c->node_count >= 2 || c->start.row[0].weight > 0; }

/// Sets the chain's filter, start and nodes; true if the nodes differ from those before only in values.
static bool make_chain(wiggly_solver *solver, const problem *p)
{
    set_chain(solver, p);
    return make_nodes(solver, p);
}

bool problem_solve_chain(wiggly_solver *solver, const problem *p, double *x_re, double *x_im)
{
    chain *c = &solver->chain;
    solver->band.is_kept = false; // its memory is that of the chain's tables
    bool same_nodes = make_chain(solver, p);
    c->kept = c->kept && same_nodes;
    if (!is_held(c) || !chain_solve(c, x_re, x_im)) return false;
    problem_settle(solver, p, x_re - p->first, x_im - p->first);
    return true;
}

/// The nodes of a pulled spline: one at each knot and pull that has none on the sample before, else it serves that sample too.
#include "spline/pull_nodes.h"
#include <string.h>

/// The knots and the pulls of a spline, merged by sample; a loop's from where its chain begins.
typedef struct cursor {
    int knot, pull; ///< how many are behind
} cursor;

/// A keyed or pulled sample, or both.
typedef struct stop {
    int sample;
    const wiggly_knot *knot; ///< or NULL
    int pull;                ///< or -1
} stop;

/// The n-th knot of the chain, NULL behind the last.
static const wiggly_knot *knot_in_turn(const pulled *of, int n)
{
    const wiggly_desc *desc = of->problem.desc;
    if (n >= desc->knot_count) return NULL;
    return &desc->knots[of->solver->order[(of->first_knot + n) % desc->knot_count]];
}

/// Samples from where the chain begins.
static int samples_on(const pulled *of, int sample)
{
    const int at = sample - of->problem.first - of->solver->chain.turned;
    return at < 0 ? at + of->problem.count : at;
}

static bool next_stop(const pulled *of, cursor *at, stop *s)
{
    const wiggly_knot *knot = knot_in_turn(of, at->knot);
    int pull = at->pull < of->pulls.count ? pull_in_turn(of, at->pull) : -1;
    if (!knot && pull < 0) return false;
    if (knot && pull >= 0 && knot->sample != of->pulls.sample[pull]) {
        if (samples_on(of, knot->sample) < samples_on(of, of->pulls.sample[pull]))
            pull = -1;
        else
            knot = NULL;
    }
    *s = (stop){knot ? knot->sample : of->pulls.sample[pull], knot, pull};
    at->knot += knot != NULL;
    at->pull += pull >= 0;
    return true;
}

/// Begins the chain of a loop with a stop that has none on the sample before; false where there is no such stop.
static bool find_beginning(pulled *of)
{
    cursor at = {0}, begin = {0};
    stop s, last;
    of->first_knot = of->first_pull = of->solver->chain.turned = 0;
    if (of->problem.start != WIGGLY_LOOP) return true;
    while (next_stop(of, &at, &last)) {
    }
    at = begin;
    for (int before = last.sample - of->problem.count; next_stop(of, &at, &s); before = s.sample, begin = at) {
        if (s.sample == before + 1) continue;
        of->first_knot = begin.knot, of->first_pull = begin.pull;
        of->solver->chain.turned = s.sample;
        return true;
    }
    return false;
}

static void hold(pull_node *node, int unknown, double value)
{
    for (int i = 0; i < 4; i++) node->to[i][unknown] = 0;
    node->known[unknown] += value;
}

/// Everything unknown, and in cubic and real mode nothing imaginary.
static void set_free(pull_node *node, bool is_complex)
{
    memset(node, 0, sizeof *node);
    for (int i = 0; i < 4; i++) node->to[i][i] = is_complex || i % 2 == 0;
}

/// Row i of the state is c · (Re x, Im x) + value, in place of an unknown of its own.
static void tie(pull_node *node, int i, double on_re, double on_im, double value)
{
    for (int u = 0; u < 4; u++) node->to[i][u] = on_re * node->to[0][u] + on_im * node->to[1][u];
    node->known[i] = on_re * node->known[0] + on_im * node->known[1] + value;
}

/// What holds a node: a knot there or on the sample after it, or that d follows x.
static void hold_node(const chain *c, const problem *p, pull_node *node, const stop *at, const stop *pair,
                      bool settled)
{
    set_free(node, c->is_complex);
    if (at->knot) hold(node, 0, at->knot->value - problem_about(p, at->sample));
    if (settled) {
        tie(node, 2, c->tail.re, -c->tail.im, 0);
        tie(node, 3, c->tail.im, c->tail.re, 0);
    } else if (pair && pair->knot) { // e is small beside x and x after it, and so is λ − 1
        double after = pair->knot->value - problem_about(p, pair->sample), before = at->knot ? node->known[0] : 0;
        tie(node, 2, at->knot ? 1 - c->lambda.re : -c->lambda.re, c->lambda.im, after - before);
    }
}

static void put_rest(const pulled *of, chain_node *node, pull_node *state)
{
    const problem *p = &of->problem;
    bool oscillates = problem_oscillates(p), is_complex = of->solver->chain.is_complex;
    *node = (chain_node){.fixed = oscillates ? NODE_FROM_REST : NODE_AT_REST};
    set_free(state, is_complex);
    hold(state, 0, 0), hold(state, 1, 0);
    if (oscillates) return;
    hold(state, 2, p->y && !p->about ? p->y[1] - p->level : 0);
    hold(state, 3, 0);
}

static void place_pull(const pulled *of, const stop *s, int node, bool second)
{
    if (s->pull >= 0) of->place[s->pull] = (pull_place){node, second};
}

bool pull_make_nodes(pulled *of)
{
    const problem *p = &of->problem;
    chain *c = &of->solver->chain;
    cursor at = {0};
    stop s, after;
    int n = 0;
    if (!find_beginning(of)) return false;
    if (p->start == WIGGLY_REST) put_rest(of, &c->nodes[0], &of->nodes[0]), n = 1;
    for (bool more = next_stop(of, &at, &s); more; n++) {
        cursor ahead = at;
        bool pair = next_stop(of, &ahead, &after) && samples_on(of, after.sample) == samples_on(of, s.sample) + 1;
        chain_node *node = &c->nodes[n];
        *node = (chain_node){0};
        if (s.knot) problem_put_knot(p, node, s.knot, NULL);
        node->sample = samples_on(of, s.sample);
        bool settled = p->settles && s.sample == p->latest;
        if (settled) node->fixed |= NODE_SETTLED;
        hold_node(c, p, &of->nodes[n], &s, pair ? &after : NULL, settled);
        place_pull(of, &s, n, false);
        if (pair && after.knot && after.knot->has_slope) return false;
        if (pair) place_pull(of, &after, n, true);
        if (pair) at = ahead;
        more = next_stop(of, &at, &s);
    }
    c->node_count = n;
    return true;
}

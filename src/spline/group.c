/// Solves splines of one filter side by side, in vector lanes.
#include "spline/group.h"
#include "spline/problem.h"
#include <stdint.h>

enum { TRACKS = 4 };

/// A spline in a lane.
typedef struct member {
    int index;
    problem problem;
} member;

struct group {
    wiggly_solver *solver;
    int lanes;
    chain_group chains; ///< its count is that of the members
    member members[MOST_LANES];
    double *
        tracks; ///< for each lane, TRACKS arrays: the equilibrium and the answer to it, of as many samples as the solver has
    unsigned joined; ///< members ever
    int taken;
    const wiggly_desc *desc[GROUP_ROOM];
    wiggly_curve *curve[GROUP_ROOM];
    wiggly_status status[GROUP_ROOM];
    int alone[GROUP_ROOM]; ///< those that are left to wiggly_solve(): afterwards, because it may overwrite the tables
    int alone_count;
};

typedef struct layout {
    size_t rows, nodes, stretches, tracks, solver, size; ///< bytes
    int lengths;
} layout;

static bool plan(layout *l, int samples, int knots)
{
    size_t k = (size_t)knots + 1, n = (size_t)samples;
    l->lengths = samples;
    l->solver = wiggly_memsize(samples, knots);
    return l->solver && !__builtin_mul_overflow(k, DOUBLES_PER_LANE_ROW * sizeof(double), &l->rows) &&
           !__builtin_mul_overflow(k, MOST_LANES * sizeof(chain_node), &l->nodes) &&
           !__builtin_mul_overflow(n, sizeof(chain_stretch), &l->stretches) &&
           !__builtin_mul_overflow(n, MOST_LANES * TRACKS * sizeof(double), &l->tracks) &&
           !__builtin_add_overflow(l->rows, l->nodes, &l->size) &&
           !__builtin_add_overflow(l->size, l->stretches, &l->size) &&
           !__builtin_add_overflow(l->size, l->tracks, &l->size) &&
           !__builtin_add_overflow(l->size, l->solver, &l->size) &&
           !__builtin_add_overflow(l->size, sizeof(group) + 2 * LANE_ALIGNMENT, &l->size);
}

/// Memory of the lanes, and room for more stretches than a single spline has: many splines have many lengths.
static void hand_out(group *g, const layout *l, int samples, int knots)
{
    unsigned char *at = (unsigned char *)(g + 1);
    at += (LANE_ALIGNMENT - (uintptr_t)at % LANE_ALIGNMENT) % LANE_ALIGNMENT;
    g->chains.rows = (double *)(void *)at;
    at += l->rows;
    for (int k = 0; k < MOST_LANES; k++) g->chains.nodes[k] = (chain_node *)(void *)at + k * (knots + 1);
    at += l->nodes;
    g->solver = solver_lay_out(at + l->stretches + l->tracks, samples, knots);
    chain *c = &g->solver->chain;
    c->stretches = (chain_stretch *)(void *)at;
    c->stretch_capacity = l->lengths;
    g->tracks = (double *)(void *)(at + l->stretches);
    g->chains.common = c;
}

size_t group_memsize(int samples, int knots)
{
    layout l;
    return plan(&l, samples, knots) ? l.size - l.size % sizeof(double) : 0; // less than the slack of the alignment
}

group *group_lay_out(void *memory, int samples, int knots, int lanes)
{
    layout l;
    if (!plan(&l, samples, knots)) return NULL;
    group *g = memory;
    g->lanes = lanes;
    hand_out(g, &l, samples, knots);
    return g;
}

static void leave_alone(group *g, int index) { g->alone[g->alone_count++] = index; }

/// Writes a member's curve from its nodes; false where it is one for wiggly_solve().
static bool finish_member(group *g, int k)
{
    chain *c = &g->solver->chain, own = *c;
    const member *m = &g->members[k];
    if (g->chains.rank[k] != CHAIN_FIRM) return false;
    c->nodes = g->chains.nodes[k];
    c->node_count = g->chains.node_count[k];
    c->count = m->problem.count;
    bool good = problem_finish(g->solver, &m->problem, g->curve[m->index]);
    c->nodes = own.nodes, c->node_count = own.node_count, c->count = own.count;
    return good;
}

/// Solves the members.
static void flush(group *g)
{
    int count = g->chains.count;
    if (count == 0) return;
    (g->lanes == 8 ? chain_solve_by_8 : chain_solve_by_4)(&g->chains);
    for (int k = 0; k < count; k++) {
        int index = g->members[k].index;
        g->status[index] = WIGGLY_OK;
        if (!finish_member(g, k)) leave_alone(g, index);
    }
    g->chains.count = 0;
}

/// The members' stretches are gone.
static void dissolve(group *g)
{
    for (int k = 0; k < g->chains.count; k++) leave_alone(g, g->members[k].index);
    g->chains.count = 0;
}

/// Makes a spline a member; false where nothing holds it.
static bool join(group *g, const problem *p, int index)
{
    chain *c = &g->solver->chain;
    chain_node *own = c->nodes;
    c->nodes = g->chains.nodes[g->chains.count];
    c->node_count = 0;
    unsigned forgotten = c->forgotten;
    bool held = problem_join(g->solver, p);
    if (c->forgotten != forgotten && g->chains.count > 0) {
        chain_node *first = g->chains.nodes[0];
        g->chains.nodes[0] = c->nodes;
        g->chains.nodes[g->chains.count] = first;
        dissolve(g);
    }
    if (held) {
        int k = g->chains.count++;
        g->chains.node_count[k] = c->node_count;
        g->members[k] = (member){index, *p};
        g->joined++;
    }
    c->nodes = own;
    c->node_count = 0;
    return held;
}

/// Lends the solver arrays for the equilibrium of a spline that might join: the members keep theirs.
static void lend_tracks(group *g)
{
    wiggly_solver *solver = g->solver;
    const size_t n = (size_t)solver->samples;
    double *at = g->tracks + g->joined % MOST_LANES * TRACKS * n;
    solver->y = at;
    solver->swing = (swing){.total = at + n, .im = at + 2 * n, .speed = at + 3 * n};
}

void group_add(group *g, const wiggly_desc *desc, wiggly_curve *curve)
{
    int index = g->taken++;
    g->desc[index] = desc;
    g->curve[index] = curve;
    problem p;
    lend_tracks(g);
    if (g->lanes == 0 || !problem_pose_for_group(g->solver, desc, &p)) {
        leave_alone(g, index);
        return;
    }
    if (g->chains.count > 0 && !problem_shares_chain(g->solver, &p)) flush(g);
    if (!join(g, &p, index)) leave_alone(g, index);
    if (g->chains.count == g->lanes) flush(g);
}

int group_finish(group *g, wiggly_status *statuses)
{
    flush(g);
    for (int k = 0; k < g->alone_count; k++) {
        int index = g->alone[k];
        g->status[index] = wiggly_solve(g->solver, g->desc[index], g->curve[index]);
    }
    int count = g->taken;
    for (int i = 0; i < count; i++) statuses[i] = g->status[i];
    g->taken = g->alone_count = 0;
    return count;
}

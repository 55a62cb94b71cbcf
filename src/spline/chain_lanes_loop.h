/// The nodes' systems of LANES chains, each in a lane: assembled, factored and swept forward in one pass over the rows, then swept
/// backward. Included once for each width.
#include <stdint.h>
typedef double lane __attribute__((vector_size(8 * LANES)));
typedef int64_t flag __attribute__((vector_size(8 * LANES)));
#include "spline/chain_kernel.h"
#include "spline/chain_lanes.h"

#if LANES == 8
#define GATHER(of) ((lane){of(0), of(1), of(2), of(3), of(4), of(5), of(6), of(7)})
#else
#define GATHER(of) ((lane){of(0), of(1), of(2), of(3)})
#endif

/// A row as it is kept for the way back: inverse of the pivot, L to the next row, right-hand side → solution.
typedef struct lane_row {
    lane pivot[6], lower[9], right[3];
} lane_row;

_Static_assert(sizeof(lane_row) <= sizeof(double) * DOUBLES_PER_LANE_ROW, "rows fit their memory");

/// In place of a node or a stretch that a chain does not have.
static const chain_node no_node = {.fixed = NODE_AT_REST};
static const double no_form[FORM_SIZE];

/// Nodes j of all lanes.
static void node_row(const chain_group *g, int j, const chain_node *n[LANES])
{
    for (int k = 0; k < LANES; k++) n[k] = k < g->count && j < g->node_count[k] ? &g->nodes[k][j] : &no_node;
}

static kernel_node gather_node(const chain_group *g, int j)
{
    const chain_node *n[LANES];
    cplx tie[LANES];
    node_row(g, j, n);
    for (int k = 0; k < LANES; k++) tie[k] = chain_node_tie(g->common, n[k]);
#define X(k) n[k]->value
#define D(k) n[k]->d_re
#define D_IM(k) n[k]->d_im
#define TIE(k) tie[k].re
#define TIE_IM(k) tie[k].im
#define KEEP_X(k) (n[k]->fixed & (NODE_AT_REST | NODE_FROM_REST) ? 0.0 : 1.0)
#define KEEP_D(k) (n[k]->fixed & (NODE_AT_REST | NODE_FIXED_E | NODE_SETTLED) ? 0.0 : 1.0)
#define KEEP_I(k) (n[k]->fixed & (NODE_AT_REST | NODE_SETTLED) ? 0.0 : 1.0)
    return (kernel_node){
        GATHER(X),      GATHER(D),      GATHER(D_IM),   GATHER(TIE),
        GATHER(TIE_IM), GATHER(KEEP_X), GATHER(KEEP_D), GATHER(KEEP_I),
    };
}

/// The slopes at nodes j; false where there are none.
static bool gather_slope(const chain_group *g, int j, kernel_slope *slope)
{
    const chain_node *n[LANES];
    chain_speed s[LANES];
    bool any = false;
    node_row(g, j, n);
    for (int k = 0; k < LANES; k++) any = any || n[k]->slope_weight > 0;
    if (!any) return false;
    for (int k = 0; k < LANES; k++) s[k] = g->common->speed[n[k]->view];
#define TARGET(k) n[k]->slope
#define WEIGHT(k) n[k]->slope_weight
#define ON_X_RE(k) s[k].on_x.re
#define ON_X_IM(k) s[k].on_x.im
#define ON_D_RE(k) s[k].on_d.re
#define ON_D_IM(k) s[k].on_d.im
#define ON_R_RE(k) s[k].on_r.re
#define ON_R_IM(k) s[k].on_r.im
    *slope = (kernel_slope){
        GATHER(TARGET),  GATHER(WEIGHT),  GATHER(ON_X_RE), GATHER(ON_X_IM),
        GATHER(ON_D_RE), GATHER(ON_D_IM), GATHER(ON_R_RE), GATHER(ON_R_IM),
    };
    return true;
}

/// The forms of the stretches after node j.
static void gather_form(const chain_group *g, int j, lane *form)
{
    const double *f[LANES];
    for (int k = 0; k < LANES; k++) {
        bool has = k < g->count && j + 1 < g->node_count[k];
        f[k] = has ? g->common->stretches[g->nodes[k][j].stretch].form : no_form;
    }
#define ENTRY(k) f[k][i]
    for (int i = 0; i < FORM_SIZE; i++) form[i] = GATHER(ENTRY);
}

/// Assembles, factors, sweeps forward.
static kernel_rank forward_blocks(const chain_group *g, lane_row *rows, int count)
{
    const state_form h = chain_start_form(g->common);
    const lane zero = {0};
    const lane h11 = zero + h.h11, h01_re = zero + h.h01.re, h01_im = zero + h.h01.im;
    kernel_rank all = {(flag){0} - 1, (flag){0} - 1, (flag){0} - 1, (lane){0}};
    kernel_node node = gather_node(g, 0);
    kernel_slope slope;
    lane_row before = {0}, row = {0};
    lane n_before[9] = {0};
    kernel_form(row.pivot, zero + h.h00, h01_re, h01_im, h11);
    kernel_form_pull(row.right, h01_re, h01_im, h11, node.x, node.d);
    if (gather_slope(g, 0, &slope)) {
        const kernel_link link = kernel_link_first(&slope, &node);
        kernel_add_square(row.pivot, link.weight, link.at);
        kernel_add_pull(row.right, link.miss, link.at);
    }
    for (int j = 0; j < count; j++) {
        lane form[FORM_SIZE], n[9];
        lane_row after = {0};
        kernel_node next = gather_node(g, j + 1);
        gather_form(g, j, form);
        kernel_leave(row.pivot, n, form);
        kernel_enter(after.pivot, form);
        kernel_leave_pull(row.right, form, &node, &next);
        kernel_enter_pull(after.right, form, &node, &next);
        if (gather_slope(g, j + 1, &slope)) {
            const kernel_link link = kernel_link_of(&slope, form, &node, &next);
            kernel_add_square(row.pivot, link.weight, link.before);
            kernel_add_square(after.pivot, link.weight, link.at);
            kernel_add_coupling(n, &link);
            kernel_add_pull(row.right, link.miss, link.before);
            kernel_add_pull(after.right, link.miss, link.at);
        }
        kernel_hold_columns(n, &node);
        kernel_hold(row.pivot, &node);
        kernel_hold_rows(n, &next);
        kernel_hold_pull(row.right, &node);

        kernel_rank rank = kernel_pivot(row.pivot, before.lower, n_before);
        kernel_add_rank(&all, rank);
        kernel_lower(row.lower, n, row.pivot);
        kernel_forward(row.right, before.lower, before.right);
        rows[j] = before = row;
        for (int i = 0; i < 9; i++) n_before[i] = n[i];
        row = after;
        node = next;
    }
    return all;
}

static kernel_rank forward_scalars(const chain_group *g, lane_row *rows, int count)
{
    const state_form h = chain_start_form(g->common);
    const lane zero = {0};
    kernel_rank all = {(flag){0} - 1, (flag){0} - 1, (flag){0} - 1, (lane){0}};
    kernel_node node = gather_node(g, 0);
    kernel_slope slope;
    lane n_before = zero, l_before = zero, z_before = zero, s = zero + 1.0;
    lane d = zero + h.h11, right = -(h.h01.re * node.x + h.h11 * node.d);
    if (gather_slope(g, 0, &slope)) {
        d += slope.weight * slope.d_re * slope.d_re;
        right += slope.weight * (slope.target - (slope.x_re * node.x + slope.d_re * node.d)) * slope.d_re;
    }
    for (int j = 0; j < count; j++) {
        lane form[FORM_SIZE];
        kernel_node next = gather_node(g, j + 1);
        gather_form(g, j, form);
        lane_row *row = &rows[j];
        lane entering = form[FORM_V11], n = -form[FORM_C11];
        d += form[FORM_P11];
        right += kernel_leave_pull_one(form, &node, &next);
        lane pull = kernel_enter_pull_one(form, &node, &next);
        if (gather_slope(g, j + 1, &slope)) {
            const kernel_link_one link = kernel_link_of_one(&slope, form, &node, &next);
            d += link.weight * link.before * link.before;
            entering += link.weight * link.at * link.at;
            n += link.weight * link.at * link.before;
            right += link.miss * link.before;
            pull += link.miss * link.at;
        }
        n *= node.keep_d * next.keep_d;

        kernel_rank rank = kernel_pivot_one(&s, kernel_hold_one(d, &node), n_before);
        kernel_add_rank(&all, rank);
        row->pivot[0] = 1.0 / s;
        row->lower[0] = n * row->pivot[0];
        row->right[0] = right * node.keep_d - l_before * z_before;
        l_before = row->lower[0], z_before = row->right[0], n_before = n;
        d = entering, right = pull;
        node = next;
    }
    return all;
}

static void backward(const chain_group *g, lane_row *rows, int count)
{
    const lane_row none = {0};
    for (int j = count - 1; j >= 0; j--) {
        const lane *u = j + 1 < count ? rows[j + 1].right : none.right;
        if (g->common->is_complex) {
            kernel_backward(rows[j].right, rows[j].pivot, rows[j].lower, u);
        } else {
            rows[j].right[0] = rows[j].pivot[0] * rows[j].right[0] - rows[j].lower[0] * u[0];
        }
    }
}

void chain_solve_by_lanes(chain_group *g)
{
    lane_row *rows = (lane_row *)(void *)g->rows;
    int count = 0;
    for (int k = 0; k < g->count; k++) count = g->node_count[k] > count ? g->node_count[k] : count;
    kernel_rank rank = g->common->is_complex ? forward_blocks(g, rows, count) : forward_scalars(g, rows, count);
    backward(g, rows, count);
    for (int k = 0; k < g->count; k++) {
        bool firm = rank.firm[k] && rank.quiet[k];
        g->rank[k] = !rank.sound[k] ? CHAIN_LOST : firm ? CHAIN_FIRM : CHAIN_WEAK;
        for (int j = 0; j < g->node_count[k]; j++) {
            const lane *r = rows[j].right;
            chain_add_to_node(g->common, &g->nodes[k][j], (const double[3]){r[0][k], r[1][k], r[2][k]});
        }
    }
}

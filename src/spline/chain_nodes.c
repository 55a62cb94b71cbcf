/// The nodes' block-tridiagonal system of one spline: assembled from stretches, start and slopes, factored, solved (see chain.c for
/// the mathematics, chain_kernel.h for the rows).
typedef double lane;
typedef int flag;
#include "spline/chain_kernel.h"

/// Each row's |on_x x + on_e e|² with e = x_1 − x_0 = d + (λ−1) x.
start_form chain_start_form(const chain *c)
{
    start_form form = {0};
    const cplx growth = {c->lambda.re - 1, c->lambda.im};
    for (int i = 0; i < 2; i++) {
        const struct start_row *row = &c->start.row[i];
        cplx on_x = cplx_add(row->on_x, cplx_mul(row->on_e, growth)), on_d = row->on_e;
        form.h00 += row->weight * cplx_norm(on_x);
        form.h01 = cplx_add(form.h01, cplx_scale(row->weight, cplx_mul(cplx_conj(on_x), on_d)));
        form.h11 += row->weight * cplx_norm(on_d);
    }
    return form;
}

static kernel_node kernel_node_of(const chain *c, const chain_node *node)
{
    return (kernel_node){.x = node->value,
                         .d = node->d_re,
                         .slope = node->slope,
                         .weight = node->slope_weight,
                         .tie = chain_node_tie(c, node),
                         .keep_x = node->fixed & NODE_AT_REST ? 0 : 1,
                         .keep_d = node->fixed ? 0 : 1};
}

static const double *form_after(const chain *c, int j) { return c->stretches[c->nodes[j].stretch].form; }

/// Row by row in local arrays, which the compiler keeps in registers.
static void assemble_blocks(chain *c)
{
    const start_form h = chain_start_form(c);
    const double turn = c->lambda.im;
    const int last = c->node_count - 1;
    kernel_node node = kernel_node_of(c, &c->nodes[0]), next;
    double d[6] = {0};
    kernel_form(d, h.h00, h.h01.re, h.h01.im, h.h11);
    for (int j = 0; j <= last; j++, node = next) {
        double n[9] = {0}, entering[6] = {0};
        kernel_slope(d, &node, turn);
        next = node;
        if (j < last) {
            const double *form = form_after(c, j);
            next = kernel_node_of(c, &c->nodes[j + 1]);
            kernel_leave(d, n, form);
            kernel_enter(entering, form);
            kernel_hold_columns(n, &node);
            kernel_hold_rows(n, &next);
        }
        kernel_hold(d, &node);
        for (int i = 0; i < 6; i++) c->rows[j].diagonal[i] = d[i], d[i] = entering[i];
        for (int i = 0; i < 9; i++) c->rows[j].below[i] = n[i];
    }
}

static void assemble_scalars(chain *c)
{
    double entering = chain_start_form(c).h11, keep_before = 0;
    for (int j = 0; j < c->node_count; j++) {
        chain_row *row = &c->rows[j];
        const kernel_node node = kernel_node_of(c, &c->nodes[j]);
        row->diagonal[0] = entering + node.weight;
        row->below[0] = 0;
        if (j > 0) row[-1].below[0] *= node.keep_d * keep_before;
        keep_before = node.keep_d;
        if (j + 1 < c->node_count) {
            const double *form = form_after(c, j);
            row->diagonal[0] += form[FORM_P11];
            row->below[0] = -form[FORM_C11];
            entering = form[FORM_V11];
        }
        row->diagonal[0] = kernel_hold_one(row->diagonal[0], &node);
    }
}

void chain_assemble(chain *c)
{
    if (c->is_complex) {
        assemble_blocks(c);
    } else {
        assemble_scalars(c);
    }
}

static chain_rank rank_of(kernel_rank rank) { return !rank.sound ? CHAIN_LOST : rank.firm ? CHAIN_FIRM : CHAIN_WEAK; }

chain_rank chain_invert(const double *s, double *p) { return rank_of(kernel_invert(s, p)); }

static kernel_rank factor_blocks(chain *c)
{
    kernel_rank all = {1, 1};
    double n[9] = {0}, l[9] = {0};
    for (chain_row *row = c->rows; row < c->rows + c->node_count; row++) {
        kernel_rank rank = kernel_pivot(row->diagonal, l, n);
        all.sound &= rank.sound, all.firm &= rank.firm;
        for (int i = 0; i < 9; i++) n[i] = row->below[i];
        kernel_lower(l, n, row->diagonal);
        for (int i = 0; i < 9; i++) row->below[i] = l[i];
    }
    return all;
}

static kernel_rank factor_scalars(chain *c)
{
    kernel_rank all = {1, 1};
    double n = 0, s = 1;
    for (chain_row *row = c->rows; row < c->rows + c->node_count; row++) {
        kernel_rank rank = kernel_pivot_one(&s, row->diagonal[0], n);
        all.sound &= rank.sound, all.firm &= rank.firm;
        n = row->below[0];
        row->diagonal[0] = 1.0 / s;
        row->below[0] = n * row->diagonal[0];
    }
    return all;
}

chain_rank chain_factor(chain *c) { return rank_of(c->is_complex ? factor_blocks(c) : factor_scalars(c)); }

static void solve_scalars(chain *c)
{
    for (int j = 1; j < c->node_count; j++) c->rows[j].right[0] -= c->rows[j - 1].below[0] * c->rows[j - 1].right[0];
    double after = 0;
    for (int j = c->node_count - 1; j >= 0; j--) {
        chain_row *row = &c->rows[j];
        after = row->right[0] = row->diagonal[0] * row->right[0] - row->below[0] * after;
    }
}

static void solve_blocks(chain *c)
{
    chain_row *last = &c->rows[c->node_count - 1];
    for (chain_row *row = c->rows; row < last; row++) kernel_forward(row[1].right, row->below, row->right);
    const double none[3] = {0};
    for (chain_row *row = last; row >= c->rows; row--) {
        kernel_backward(row->right, row->diagonal, row->below, row < last ? row[1].right : none);
    }
}

void chain_solve_nodes(chain *c)
{
    if (c->is_complex) {
        solve_blocks(c);
    } else {
        solve_scalars(c);
    }
}

static void pull_blocks(chain *c)
{
    const start_form h = chain_start_form(c);
    const double growth = c->lambda.re - 1, turn = c->lambda.im;
    kernel_node node = kernel_node_of(c, &c->nodes[0]), next;
    double entering[3] = {0};
    kernel_form_pull(entering, h.h01.re, h.h01.im, h.h11, node.x, node.d);
    for (int j = 0; j < c->node_count; j++, node = next) {
        double *right = c->rows[j].right;
        for (int i = 0; i < 3; i++) right[i] = entering[i], entering[i] = 0;
        kernel_slope_pull(right, &node, growth, turn);
        next = node;
        if (j + 1 < c->node_count) {
            next = kernel_node_of(c, &c->nodes[j + 1]);
            kernel_leave_pull(right, form_after(c, j), &node, &next);
            kernel_enter_pull(entering, form_after(c, j), &node, &next);
        }
        kernel_hold_pull(right, &node);
    }
}

static void pull_scalars(chain *c)
{
    const start_form h = chain_start_form(c);
    const double growth = c->lambda.re - 1;
    kernel_node node = kernel_node_of(c, &c->nodes[0]), next;
    double entering = -(h.h01.re * node.x + h.h11 * node.d);
    for (int j = 0; j < c->node_count; j++, node = next) {
        double right = entering + kernel_slope_miss(&node, growth);
        next = node;
        if (j + 1 < c->node_count) {
            next = kernel_node_of(c, &c->nodes[j + 1]);
            right += kernel_leave_pull_one(form_after(c, j), &node, &next);
            entering = kernel_enter_pull_one(form_after(c, j), &node, &next);
        }
        c->rows[j].right[0] = right * node.keep_d;
    }
}

void chain_pull_known(chain *c)
{
    if (c->is_complex) {
        pull_blocks(c);
    } else {
        pull_scalars(c);
    }
}

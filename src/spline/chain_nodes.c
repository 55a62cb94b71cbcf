/// The block-tridiagonal system of a spline's nodes: assembled from stretches, start and slopes, factored and solved (chain.c has the
/// mathematics, chain_nodes.h the rows).
#include "spline/chain_nodes.h"

/// Each row's |on_x x + on_e e|² with e = x_1 − x_0 = d + (λ−1) x.
state_form chain_start_form(const chain *c)
{
    state_form form = {0};
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

/// r_L = x_{L+1} − a x_L − b x_{L−1} for (x_{L−1}, x_L) = (x, λ x + d) and x_{L+1} = (λ + tail) x_L, counted twice.
state_form chain_end_form(const chain *c)
{
    const chain_node *last = &c->nodes[c->node_count - 1];
    if (!c->settles || last->fixed & NODE_SETTLED) return (state_form){0};
    cplx on_x = cplx_sub(cplx_mul(c->tail, c->lambda), c->delta2), on_d = cplx_sub(c->tail, c->lambda);
    return (state_form){.h00 = 2 * cplx_norm(on_x),
                        .h01 = cplx_scale(2, cplx_mul(cplx_conj(on_x), on_d)),
                        .h11 = 2 * cplx_norm(on_d)};
}

ALWAYS_INLINE kernel_node kernel_node_of(const chain *c, const chain_node *node)
{
    const unsigned fixed = node->fixed;
    const cplx tie = chain_node_tie(c, node);
    return (kernel_node){.x = node->value,
                         .x_im = node->x_im,
                         .d = node->d_re,
                         .d_im = node->d_im,
                         .tie = tie.re,
                         .tie_im = tie.im,
                         .keep_x = fixed & NODE_KNOWN_X ? 0 : 1,
                         .keep_d = fixed & NODE_KNOWN_D ? 0 : 1,
                         .keep_i = fixed & NODE_KNOWN_D_IM ? 0 : 1};
}

static kernel_slope kernel_slope_of(const chain *c, const chain_node *node)
{
    const chain_speed *s = &c->speed[node->view];
    return (kernel_slope){node->slope, node->slope_weight, s->on_x.re, s->on_x.im,
                          s->on_d.re,  s->on_d.im,         s->on_r.re, s->on_r.im};
}

static const double *form_after(const chain *c, int j) { return c->stretches[c->nodes[j].stretch].form; }

/// Adds a stretch and the slope at its end to the block of its first node, the coupling and the block of its last.
ALWAYS_INLINE void assemble_stretch(const chain *c, int j, const kernel_node *p, const kernel_node *q, double *d,
                                    double *n, double *entering)
{
    const double *form = form_after(c, j);
    const chain_node *end = &c->nodes[chain_next(c, j)];
    kernel_leave(d, n, form);
    kernel_enter(entering, form);
    if (end->slope_weight > 0) {
        const kernel_slope slope = kernel_slope_of(c, end);
        const kernel_link link = kernel_link_of(false, &slope, form, p, q);
        kernel_add_square(d, link.weight, link.before);
        kernel_add_square(entering, link.weight, link.at);
        kernel_add_coupling(n, &link);
    }
    if (end->fixed & NODE_STILL) {
        for (int i = 0; i < 6; i++) entering[i] = 0;
        for (int i = 0; i < 9; i++) n[i] = 0;
    }
    kernel_hold_columns(n, p);
    kernel_hold_rows(n, q);
}

/// The first node's block: the start and its slope, in a loop also the last stretch.
ALWAYS_INLINE void assemble_first(const chain *c, const kernel_node *node, double *d)
{
    if (c->cyclic) {
        const kernel_node last = kernel_node_of(c, &c->nodes[c->node_count - 1]);
        double leaving[6] = {0}, n[9];
        assemble_stretch(c, c->node_count - 1, &last, node, leaving, n, d);
        return;
    }
    const state_form h = chain_start_form(c);
    kernel_form(d, h.h00, h.h01.re, h.h01.im, h.h11);
    if (c->nodes[0].slope_weight > 0) {
        const kernel_slope slope = kernel_slope_of(c, &c->nodes[0]);
        const kernel_link link = kernel_link_first(false, &slope, node);
        kernel_add_square(d, link.weight, link.at);
    }
}

/// Row by row in local arrays, so that the compiler keeps them in registers.
ALWAYS_INLINE void assemble(chain *c, const bool is_complex)
{
    kernel_node node = kernel_node_of(c, &c->nodes[0]), next;
    double d[6] = {0};
    assemble_first(c, &node, d);
    for (int j = 0; j < c->node_count; j++, node = next) {
        const state_form own = chain_node_form(&c->nodes[j]);
        double n[9] = {0}, entering[6] = {0};
        next = node;
        if (j < chain_stretches(c)) {
            next = kernel_node_of(c, &c->nodes[chain_next(c, j)]);
            assemble_stretch(c, j, &node, &next, d, n, entering);
        } else {
            const state_form end = chain_end_form(c);
            kernel_form(d, end.h00, end.h01.re, end.h01.im, end.h11);
        }
        d[3] += own.h11, d[5] += own.h11;
        kernel_hold(d, &node);
        c->rows[j].entry[0] = d[0], c->rows[j].entry[1] = d[3], c->rows[j].entry[2] = d[5];
        for (int i = 0; i < 6; i++) {
            if (is_complex || i == 3) c->rows[j].diagonal[i] = d[i];
            d[i] = entering[i];
        }
        for (int i = 0; i < 9; i++) {
            if (is_complex || i == 4) c->rows[j].below[i] = n[i];
        }
    }
}

void chain_assemble(chain *c)
{
    if (c->is_complex) {
        assemble(c, true);
    } else {
        assemble(c, false);
    }
}

static kernel_rank factor_blocks(chain *c)
{
    kernel_rank all = {true, 1};
    double n[9] = {0}, l[9] = {0};
    for (chain_row *row = c->rows; row < c->rows + c->node_count; row++) {
        kernel_rank rank = kernel_pivot(row->diagonal, l, n);
        chain_add_rank(&all, rank);
        for (int i = 0; i < 9; i++) n[i] = row->below[i];
        kernel_lower(l, n, row->diagonal);
        for (int i = 0; i < 9; i++) row->below[i] = l[i];
    }
    return all;
}

static kernel_rank factor_scalars(chain *c)
{
    kernel_rank all = {true, 1};
    double n = 0, s = 1;
    for (chain_row *row = c->rows; row < c->rows + c->node_count; row++) {
        kernel_rank rank = kernel_pivot_one(&s, row->diagonal[3], n);
        chain_add_rank(&all, rank);
        n = row->below[4];
        row->diagonal[3] = 1.0 / s;
        row->below[4] = n * row->diagonal[3];
    }
    return all;
}

bool chain_factor(chain *c)
{
    const kernel_rank rank = c->cyclic ? chain_close(c) : c->is_complex ? factor_blocks(c) : factor_scalars(c);
    c->lost = rank.lost;
    return rank.sound;
}

ALWAYS_INLINE double solve(chain *c, const bool is_complex)
{
    chain_row *last = &c->rows[c->node_count - 1];
    double energy = 0;
    for (chain_row *row = c->rows; row < last; row++)
        kernel_forward(is_complex, row[1].right, row->below, row->right);
    const double none[3] = {0};
    for (chain_row *row = last; row >= c->rows; row--) {
        energy += kernel_energy(is_complex, row->right, row->diagonal);
        kernel_backward(is_complex, row->right, row->diagonal, row->below, row < last ? row[1].right : none);
    }
    return energy;
}

double chain_solve_nodes(chain *c)
{
    if (c->cyclic) return chain_solve_loop(c);
    return c->is_complex ? solve(c, true) : solve(c, false);
}

/// The pull of a stretch and the slope at its end.
ALWAYS_INLINE void pull_along(const chain *c, int j, const kernel_node *p, const kernel_node *q, bool is_complex,
                              bool posed, double *right, double *entering)
{
    const double *form = form_after(c, j);
    const chain_node *end = &c->nodes[chain_next(c, j)];
    kernel_node at_rest = *q;
    if (end->fixed & NODE_STILL) at_rest.d = at_rest.d_im = 0, q = &at_rest;
    kernel_leave_pull(is_complex, posed, right, form, p, q);
    kernel_enter_pull(is_complex, posed, entering, form, p, q);
    if (end->slope_weight > 0) {
        const kernel_slope slope = kernel_slope_of(c, end);
        const kernel_link link = kernel_link_of(posed, &slope, form, p, q);
        kernel_add_pull(right, link.miss, link.before);
        kernel_add_pull(entering, link.miss, link.at);
    }
    if (end->fixed & NODE_STILL) entering[0] = entering[1] = entering[2] = 0;
}

ALWAYS_INLINE void pull_first(const chain *c, const kernel_node *node, bool is_complex, bool posed, double *right)
{
    if (c->cyclic) {
        const kernel_node last = kernel_node_of(c, &c->nodes[c->node_count - 1]);
        double leaving[3] = {0};
        pull_along(c, c->node_count - 1, &last, node, is_complex, posed, leaving, right);
        return;
    }
    const state_form h = chain_start_form(c);
    kernel_form_pull(posed, right, h.h00, h.h01.re, h.h01.im, h.h11, node);
    if (c->nodes[0].slope_weight > 0) {
        const kernel_slope slope = kernel_slope_of(c, &c->nodes[0]);
        const kernel_link link = kernel_link_first(posed, &slope, node);
        kernel_add_pull(right, link.miss, link.at);
    }
}

ALWAYS_INLINE void pull_known(chain *c, const bool is_complex, const bool posed)
{
    kernel_node node = kernel_node_of(c, &c->nodes[0]), next;
    double entering[3] = {0};
    pull_first(c, &node, is_complex, posed, entering);
    for (int j = 0; j < c->node_count; j++, node = next) {
        double right[3];
        for (int i = 0; i < 3; i++) right[i] = entering[i], entering[i] = 0;
        next = node;
        if (j < chain_stretches(c)) {
            next = kernel_node_of(c, &c->nodes[chain_next(c, j)]);
            pull_along(c, j, &node, &next, is_complex, posed, right, entering);
        } else {
            const state_form end = chain_end_form(c);
            kernel_form_pull(posed, right, end.h00, end.h01.re, end.h01.im, end.h11, &node);
        }
        const double own = chain_node_form(&c->nodes[j]).h11;
        right[1] -= own * node.d, right[2] -= own * node.d_im;
        kernel_hold_pull(right, &node);
        for (int i = 0; i < 3; i++) {
            if (is_complex || i == 1) c->rows[j].right[i] = right[i];
        }
    }
}

void chain_pull_known(chain *c)
{
    if (!c->is_complex) {
        pull_known(c, false, false);
    } else if (c->posed) {
        pull_known(c, true, true);
    } else {
        pull_known(c, true, false);
    }
}

void chain_pull(chain *c)
{
    if (c->is_complex) {
        pull_known(c, true, true);
    } else {
        pull_known(c, false, false);
    }
}

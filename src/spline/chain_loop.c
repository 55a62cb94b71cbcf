/// The nodes' system of a loop: block-tridiagonal, with a corner.
#include "spline/chain_nodes.h"
#include "spline/wide.h"

/// Rows 1 … of a loop are factored like an open chain's. Each also couples to row 0 by F, which fills in from the row after it:
///     F_1 = A_10,   F_{k+1} = −L_k F_k,   in the last row also A_0k*,     A_00 −= Σ F_k* P_k F_k.
/// Only P_k F_k is stored. A single row couples to itself; two rows couple to each other twice.
WIDEST static kernel_rank close_blocks(chain *c)
{
    const int last = c->node_count - 1;
    chain_row *first = &c->rows[0];
    double f[9], n[9] = {0}, l[9] = {0};
    kernel_rank all = {true, 1};
    if (last == 0) { // couples to itself: A + Aᵀ
        const double *a = first->below;
        const double twice[6] = {2 * a[0], a[1] + a[3], a[2] + a[6], 2 * a[4], a[5] + a[7], 2 * a[8]};
        for (int i = 0; i < 6; i++) first->diagonal[i] += twice[i];
    }
    for (int i = 0; i < 9; i++) f[i] = first->below[i];
    for (int k = 1; k <= last; k++) {
        chain_row *row = &c->rows[k];
        double *g = c->to_first + 9 * k;
        for (int i = 0; k == last && i < 9; i++) f[i] += row->below[3 * (i % 3) + i / 3];
        kernel_rank rank = kernel_pivot(row->diagonal, l, n);
        chain_add_rank(&all, rank);
        kernel_times(g, row->diagonal, f);
        kernel_subtract_square(first->diagonal, f, g);
        if (k == last) break;
        for (int i = 0; i < 9; i++) n[i] = row->below[i];
        kernel_lower(l, n, row->diagonal);
        for (int i = 0; i < 9; i++) row->below[i] = l[i];
        kernel_fill_down(f, l);
    }
    const double none[9] = {0};
    kernel_rank rank = kernel_pivot(first->diagonal, none, none);
    chain_add_rank(&all, rank);
    return all;
}

static kernel_rank close_scalars(chain *c)
{
    const int last = c->node_count - 1;
    chain_row *first = &c->rows[0];
    double s = 1, n = 0, f = first->below[4], closed = first->diagonal[3] + (last == 0 ? 2 * f : 0), whole = closed;
    kernel_rank all = {true, 1};
    for (int k = 1; k <= last; k++) {
        chain_row *row = &c->rows[k];
        if (k == last) f += row->below[4];
        kernel_rank rank = kernel_pivot_one(&s, row->diagonal[3], n);
        chain_add_rank(&all, rank);
        n = row->below[4];
        row->diagonal[3] = 1 / s;
        c->to_first[k] = f * row->diagonal[3];
        closed -= f * c->to_first[k];
        if (k == last) break;
        row->below[4] = n * row->diagonal[3];
        f *= -row->below[4];
    }
    first->diagonal[3] = 1 / closed;
    chain_add_rank(&all, (kernel_rank){closed > 0 && closed < INFINITY, whole / closed});
    return all;
}

static double solve_loop_scalars(chain *c)
{
    double energy = 0;
    const int last = c->node_count - 1;
    chain_row *first = &c->rows[0];
    for (int k = 1; k <= last; k++) {
        if (k > 1) c->rows[k].right[1] -= c->rows[k - 1].below[4] * c->rows[k - 1].right[1];
        energy += kernel_energy(false, c->rows[k].right, c->rows[k].diagonal);
        first->right[1] -= c->to_first[k] * c->rows[k].right[1];
    }
    energy += kernel_energy(false, first->right, first->diagonal);
    double closed = first->right[1] *= first->diagonal[3], after = 0;
    for (int k = last; k > 0; k--) {
        chain_row *row = &c->rows[k];
        row->right[1] = row->diagonal[3] * row->right[1] - c->to_first[k] * closed;
        if (k < last) row->right[1] -= row->below[4] * after;
        after = row->right[1];
    }
    return energy;
}

WIDEST static double solve_loop_blocks(chain *c)
{
    double energy = 0;
    const int last = c->node_count - 1;
    chain_row *first = &c->rows[0];
    const double none[9] = {0};
    for (int k = 1; k <= last; k++) {
        if (k > 1) kernel_forward(true, c->rows[k].right, c->rows[k - 1].below, c->rows[k - 1].right);
        energy += kernel_energy(true, c->rows[k].right, c->rows[k].diagonal);
        kernel_subtract_transposed(first->right, c->to_first + 9 * k, c->rows[k].right);
    }
    energy += kernel_energy(true, first->right, first->diagonal);
    kernel_backward(true, first->right, first->diagonal, none, none);
    for (int k = last; k > 0; k--) {
        chain_row *row = &c->rows[k];
        kernel_backward(true, row->right, row->diagonal, k < last ? row->below : none,
                        k < last ? row[1].right : none);
        kernel_forward(true, row->right, c->to_first + 9 * k, first->right);
    }
    return energy;
}

double chain_solve_loop(chain *c) { return c->is_complex ? solve_loop_blocks(c) : solve_loop_scalars(c); }

kernel_rank chain_close(chain *c) { return c->is_complex ? close_blocks(c) : close_scalars(c); }

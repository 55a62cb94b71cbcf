/// A pulled spline by the chain: as chain.c, but with nodes at pulled samples too, where Re x is not known.
//
// The unknowns of a node are those of its state (Re x, Im x, Re d, Im d) that nothing holds; where the next sample is keyed, or d
// follows x, the state is an affine function of what is left. Nodes side by side would have no stretch between them, so a node serves
// the sample after it too: x_{k+1} = d + λ x. With A = L D L* the response at a node to a pull there is the selected inverse,
//
//     Σ_j = D_j⁻¹ + L_j* Σ_{j+1} L_j,
//
// and further back it is −L_i* of the node after: one sweep from the last node to the first gives all responses to all pulls.
//
// A loop is that chain without its first node, which borders it: with T = L D L* of the others, B their coupling to the first and
// U = T⁻¹ B, its pivot is S = A_00 − B* U, and the responses are T⁻¹ + U S⁻¹ U*, −U S⁻¹ and S⁻¹.
#include "spline/pull_nodes.h"
#include "spline/wide.h"
#include <math.h>
#include <string.h>

/// Below this part of its entry a pivot has lost too many digits: the band, which refines, is to solve it.
static const double weakest = 1e-9;

// --- the system ------------------------------------------------------------------------------------------------------

/// Adds the complex entry (row, column) of a 2×2 block of (x, d), as a block of real and imaginary parts.
static void add_entry(double block[4][4], int row, int column, cplx z)
{
    double *re = &block[2 * row][2 * column], *im = &block[2 * row + 1][2 * column];
    re[0] += z.re, re[1] -= z.im;
    im[0] += z.im, im[1] += z.re;
}

/// The Hermitian form [h00 h01; h01* h11] of a state.
static void add_form(double block[4][4], double h00, cplx h01, double h11)
{
    add_entry(block, 0, 0, (cplx){h00, 0});
    add_entry(block, 0, 1, h01);
    add_entry(block, 1, 0, cplx_conj(h01));
    add_entry(block, 1, 1, (cplx){h11, 0});
}

/// A slope as a row of the states before and at its node: weight (before · s_p + at · s_q − target)².
typedef struct slope_link {
    double before[4], at[4], weight, target;
} slope_link;

static void put_part(double row[4], int i, cplx z) { row[2 * i] = z.re, row[2 * i + 1] = -z.im; }

/// The jet at the node is ν_d of the stretch before it, known up to a variance (chain.c); at the first node there is none.
static slope_link link_of(const chain *c, const chain_node *node, const chain_stretch *before)
{
    const chain_speed *speed = &c->speed[node->view];
    slope_link link = {.weight = node->slope_weight, .target = node->slope};
    put_part(link.at, 0, speed->on_x);
    put_part(link.at, 1, speed->on_d);
    if (!before) return link;
    const cplx jet = speed->on_r;
    const double v11 = before->form[FORM_V11];
    put_part(link.at, 0, cplx_sub(speed->on_x, cplx_mul(jet, cplx_conj(chain_entry(before, FORM_V01)))));
    put_part(link.at, 1, cplx_sub(speed->on_d, cplx_scale(v11, jet)));
    put_part(link.before, 0, cplx_mul(jet, chain_entry(before, FORM_C10)));
    put_part(link.before, 1, cplx_mul(jet, chain_entry(before, FORM_C11)));
    link.weight /= 1 + link.weight * cplx_norm(jet) * (1 - v11);
    return link;
}

static void add_square(double block[4][4], double weight, const double row[4])
{
    for (int i = 0; i < 4; i++) {
        for (int j = 0; j < 4; j++) block[i][j] += weight * row[i] * row[j];
    }
}

static void add_slope(const chain *c, pull_node *p, pull_node *q, const chain_node *node, const chain_stretch *before)
{
    if (!(node->slope_weight > 0)) return;
    const slope_link link = link_of(c, node, before);
    add_square(q->pivot, link.weight, link.at);
    for (int i = 0; i < 4; i++) q->right[i] += link.weight * link.target * link.at[i];
    if (!p) return;
    add_square(p->pivot, link.weight, link.before);
    for (int i = 0; i < 4; i++) {
        p->right[i] += link.weight * link.target * link.before[i];
        for (int j = 0; j < 4; j++) p->below[i][j] += link.weight * link.at[i] * link.before[j];
    }
}

/// A stretch s_q* V s_q − 2 Re s_q* C s_p + s_p* P s_p.
static void add_stretch(pull_node *p, pull_node *q, const chain_stretch *s)
{
    add_form(p->pivot, s->form[FORM_P00], chain_entry(s, FORM_P01), s->form[FORM_P11]);
    add_form(q->pivot, s->form[FORM_V00], chain_entry(s, FORM_V01), s->form[FORM_V11]);
    static const int entry[2][2] = {{FORM_C00, FORM_C01}, {FORM_C10, FORM_C11}};
    for (int i = 0; i < 2; i++) {
        for (int j = 0; j < 2; j++) add_entry(p->below, i, j, cplx_scale(-1, chain_entry(s, entry[i][j])));
    }
}

static void add_ends(const chain *c, pull_node *nodes)
{
    const state_form start = chain_start_form(c), end = chain_end_form(c);
    add_form(nodes[0].pivot, start.h00, start.h01, start.h11);
    add_slope(c, NULL, &nodes[0], &c->nodes[0], NULL);
    add_form(nodes[c->node_count - 1].pivot, end.h00, end.h01, end.h11);
}

/// Blocks and pulls of the states.
static void assemble(const chain *c, pull_node *nodes)
{
    if (!c->cyclic) add_ends(c, nodes);
    for (int j = 0; j < chain_stretches(c); j++) {
        const chain_stretch *stretch = &c->stretches[c->nodes[j].stretch];
        const int next = chain_next(c, j);
        add_stretch(&nodes[j], &nodes[next], stretch);
        add_slope(c, &nodes[j], &nodes[next], &c->nodes[next], stretch);
    }
}

/// out ← aᵀ m b.
static void transform(double a[4][4], double m[4][4], double b[4][4], double out[4][4])
{
    double mb[4][4] = {0}, amb[4][4] = {0};
    for (int i = 0; i < 4; i++) {
        for (int k = 0; k < 4; k++) {
            for (int j = 0; j < 4; j++) mb[i][j] += m[i][k] * b[k][j];
        }
    }
    for (int k = 0; k < 4; k++) {
        for (int i = 0; i < 4; i++) {
            for (int j = 0; j < 4; j++) amb[i][j] += a[k][i] * mb[k][j];
        }
    }
    memcpy(out, amb, sizeof amb);
}

static void subtract_product(double right[4], double m[4][4], const double x[4])
{
    for (int i = 0; i < 4; i++) {
        for (int k = 0; k < 4; k++) right[i] -= m[i][k] * x[k];
    }
}

static void subtract_transposed(double right[4], double m[4][4], const double x[4])
{
    for (int k = 0; k < 4; k++) {
        for (int i = 0; i < 4; i++) right[i] -= m[k][i] * x[k];
    }
}

/// v ← toᵀ v: a pull on the state as one on the unknowns.
static void pull_back(const pull_node *node, double v[4])
{
    double out[4] = {0};
    for (int k = 0; k < 4; k++) {
        for (int i = 0; i < 4; i++) out[i] += node->to[k][i] * v[k];
    }
    memcpy(v, out, sizeof out);
}

/// From states to unknowns; 1 on the diagonal of what is none.
static void reduce(const chain *c, pull_node *nodes)
{
    for (int j = 0; j < c->node_count; j++) {
        subtract_product(nodes[j].right, nodes[j].pivot, nodes[j].known);
        if (j >= chain_stretches(c)) continue;
        pull_node *next = &nodes[chain_next(c, j)];
        subtract_product(next->right, nodes[j].below, nodes[j].known);
        subtract_transposed(nodes[j].right, nodes[j].below, next->known);
    }
    for (int j = 0; j < c->node_count; j++) {
        pull_node *node = &nodes[j];
        transform(node->to, node->pivot, node->to, node->pivot);
        if (j < chain_stretches(c)) transform(nodes[chain_next(c, j)].to, node->below, node->to, node->below);
        pull_back(node, node->right);
        for (int i = 0; i < 4; i++) node->pivot[i][i] += node->pivot[i][i] == 0;
    }
}

/// m ← its inverse, by Gauss and Jordan; false where a pivot has lost its digits.
static bool invert(double m[4][4], const double entry[4])
{
    for (int k = 0; k < 4; k++) {
        double pivot = m[k][k];
        if (!(pivot > weakest * entry[k])) return false;
        m[k][k] = 1;
        for (int j = 0; j < 4; j++) m[k][j] /= pivot;
        for (int i = 0; i < 4; i++) {
            if (i == k) continue;
            double factor = m[i][k];
            m[i][k] = 0;
            for (int j = 0; j < 4; j++) m[i][j] -= factor * m[k][j];
        }
    }
    return true;
}

/// L D L*: pivots inverted, `below` ← L.
static bool factor(pull_node *nodes, int count)
{
    double coupling[4][4] = {0}, lower[4][4] = {0};
    for (int j = 0; j < count; j++) {
        pull_node *node = &nodes[j];
        double entry[4];
        for (int i = 0; i < 4; i++) {
            entry[i] = node->pivot[i][i];
            for (int k = 0; k < 4; k++) {
                for (int n = 0; n < 4; n++) node->pivot[i][n] -= lower[i][k] * coupling[n][k];
            }
        }
        if (!invert(node->pivot, entry)) return false;
        memcpy(coupling, node->below, sizeof coupling);
        memset(lower, 0, sizeof lower);
        for (int i = 0; i < 4; i++) {
            for (int k = 0; k < 4; k++) {
                for (int n = 0; n < 4; n++) lower[i][n] += coupling[i][k] * node->pivot[k][n];
            }
        }
        memcpy(node->below, lower, sizeof lower);
    }
    return true;
}

/// What a loop's nodes behind the first are to it, before they are factored.
static void border(pull_node *nodes, int count)
{
    const pull_node *last = &nodes[count - 1];
    for (int j = 1; j < count; j++) memset(nodes[j].border, 0, sizeof nodes[j].border);
    if (count > 1) memcpy(nodes[1].border, nodes[0].below, sizeof nodes[1].border);
    for (int i = 0; i < 4; i++) {
        for (int k = 0; k < 4; k++) {
            if (count > 1)
                nodes[count - 1].border[i][k] += last->below[k][i];
            else
                nodes[0].pivot[i][k] += last->below[i][k] + last->below[k][i]; // its own neighbour on both sides
        }
    }
}

/// out ← out − a b.
static void subtract_product_of(double out[4][4], double a[4][4], double b[4][4])
{
    for (int i = 0; i < 4; i++) {
        for (int k = 0; k < 4; k++) {
            for (int j = 0; j < 4; j++) out[i][j] -= a[i][k] * b[k][j];
        }
    }
}

/// out ← out − aᵀ b.
static void subtract_transposed_product(double out[4][4], double a[4][4], double b[4][4])
{
    for (int k = 0; k < 4; k++) {
        for (int i = 0; i < 4; i++) {
            for (int j = 0; j < 4; j++) out[i][j] -= a[k][i] * b[k][j];
        }
    }
}

/// Borders ← U, and the first node's block ← the inverse of S; false where that has lost its digits.
static bool close_loop(pull_node *nodes, int count)
{
    double s[4][4], u[4][4], entry[4];
    memcpy(s, nodes[0].pivot, sizeof s);
    for (int i = 0; i < 4; i++) entry[i] = s[i][i];
    for (int j = 1; j + 1 < count; j++) subtract_product_of(nodes[j + 1].border, nodes[j].below, nodes[j].border);
    for (int j = count - 1; j > 0; j--) {
        pull_node *node = &nodes[j];
        memset(u, 0, sizeof u);
        subtract_product_of(u, node->pivot, node->border);
        for (int i = 0; i < 4; i++) {
            for (int k = 0; k < 4; k++) u[i][k] = -u[i][k];
        }
        subtract_transposed_product(s, node->border, u);
        if (j + 1 < count) subtract_transposed_product(u, node->below, nodes[j + 1].border);
        memcpy(node->border, u, sizeof u);
    }
    if (!invert(s, entry)) return false;
    memcpy(nodes[0].pivot, s, sizeof s);
    return true;
}

static bool factor_nodes(const chain *c, pull_node *nodes)
{
    const int count = c->node_count;
    if (!c->cyclic) return factor(nodes, count);
    border(nodes, count);
    return factor(nodes + 1, count - 1) && close_loop(nodes, count);
}

/// How Re or Im x of a pulled sample depends on its node's unknowns; nothing but that.
static void see(const pulled *of, int pull, int part, double on[4])
{
    const pull_place place = of->place[pull];
    const cplx lambda = of->solver->chain.lambda;
    memset(on, 0, 4 * sizeof *on);
    on[part] = 1;
    if (place.second) {
        on[0] = part == 0 ? lambda.re : lambda.im;
        on[1] = part == 0 ? -lambda.im : lambda.re;
        on[2 + part] = 1;
    }
    pull_back(&of->nodes[place.node], on);
}

/// solved ← the unknowns under the pulls that solved holds.
static void solve(pull_node *nodes, int count)
{
    for (int j = 0; j + 1 < count; j++) subtract_product(nodes[j + 1].solved, nodes[j].below, nodes[j].solved);
    for (int j = count - 1; j >= 0; j--) {
        double x[4] = {0};
        for (int i = 0; i < 4; i++) {
            for (int k = 0; k < 4; k++) x[i] += nodes[j].pivot[i][k] * nodes[j].solved[k];
        }
        if (j + 1 < count) subtract_transposed(x, nodes[j].below, nodes[j + 1].solved);
        memcpy(nodes[j].solved, x, sizeof x);
    }
}

static void solve_nodes(const chain *c, pull_node *nodes)
{
    const int count = c->node_count;
    double *first = nodes[0].solved, x[4] = {0};
    if (!c->cyclic) {
        solve(nodes, count);
        return;
    }
    for (int j = 1; j < count; j++) subtract_transposed(first, nodes[j].border, nodes[j].solved);
    subtract_product(x, nodes[0].pivot, first);
    for (int i = 0; i < 4; i++) first[i] = -x[i];
    solve(nodes + 1, count - 1);
    for (int j = 1; j < count; j++) subtract_product(nodes[j].solved, nodes[j].border, first);
}

// --- responses -------------------------------------------------------------------------------------------------------

/// u ← −L* u, in columns from … to; each of the four rows is `stride` long.
WIDEST static void carry(double *restrict u, size_t stride, int from, int to, double lower[4][4])
{
    double *restrict a = u, *restrict b = u + stride, *restrict c = b + stride, *restrict d = c + stride;
    for (int k = from; k < to; k++) {
        double w = a[k], x = b[k], y = c[k], z = d[k];
        a[k] = -(lower[0][0] * w + lower[1][0] * x + lower[2][0] * y + lower[3][0] * z);
        b[k] = -(lower[0][1] * w + lower[1][1] * x + lower[2][1] * y + lower[3][1] * z);
        c[k] = -(lower[0][2] * w + lower[1][2] * x + lower[2][2] * y + lower[3][2] * z);
        d[k] = -(lower[0][3] * w + lower[1][3] * x + lower[2][3] * y + lower[3][3] * z);
    }
}

/// row ← row + on · u, in columns from … to.
WIDEST static void observe(const double on[4], const double *restrict u, size_t stride, int from, int to,
                           double *restrict row)
{
    const double *restrict a = u, *restrict b = u + stride, *restrict c = b + stride, *restrict d = c + stride;
    for (int k = from; k < to; k++) row[k] += on[0] * a[k] + on[1] * b[k] + on[2] * c[k] + on[3] * d[k];
}

/// selected ← D⁻¹ + L* selected L, from the node after.
static void select_inverse(pull_node *node, bool is_last, double selected[4][4])
{
    if (is_last)
        memset(selected, 0, sizeof(double[4][4]));
    else
        transform(node->below, selected, node->below, selected);
    for (int i = 0; i < 4; i++) {
        for (int j = 0; j < 4; j++) selected[i][j] += node->pivot[i][j];
    }
}

/// The upper triangle of the compliance, from the last pull to the first; a loop's without its first node.
static void respond(const pulled *of, double *compliance, double *columns)
{
    const chain *c = &of->solver->chain;
    const int count = c->node_count, width = 2 * of->pulls.count;
    const size_t stride = (size_t)width;
    double selected[4][4], on[4];
    int pull = of->pulls.count - 1;
    memset(compliance, 0, sizeof *compliance * stride * stride);
    for (int j = count - 1; j >= c->cyclic && pull >= 0; j--) {
        pull_node *node = &of->nodes[j];
        carry(columns, stride, 2 * (pull + 1), width, node->below);
        select_inverse(node, j == count - 1, selected);
        int from = pull;
        for (; from >= 0 && of->place[pull_in_turn(of, from)].node == j; from--) {
            for (int part = 0; part < 2; part++) {
                double column[4] = {0};
                see(of, pull_in_turn(of, from), part, on);
                subtract_product(column, selected, on);
                for (int i = 0; i < 4; i++) columns[stride * (size_t)i + (size_t)(2 * from + part)] = -column[i];
            }
        }
        for (; pull > from; pull--) {
            for (int part = 0; part < 2; part++) {
                see(of, pull_in_turn(of, pull), part, on);
                observe(on, columns, stride, 2 * pull, width, compliance + width * (2 * pull + part));
            }
        }
    }
}

/// Adds what goes by a loop's first node: V S⁻¹ V*, where V is −U as pulls see it.
static void respond_by_first(const pulled *of, double *compliance, double *columns)
{
    const int width = 2 * of->pulls.count;
    for (int r = 0; r < width; r++) {
        const int pull = pull_in_turn(of, r / 2), node = of->place[pull].node;
        double on[4], seen[4] = {0};
        see(of, pull, r % 2, on);
        if (node > 0)
            subtract_transposed(seen, of->nodes[node].border, on);
        else
            memcpy(seen, on, sizeof seen);
        for (int i = 0; i < 4; i++) columns[width * i + r] = seen[i];
    }
    for (int r = 0; r < width; r++) {
        const double seen[4] = {columns[r], columns[width + r], columns[2 * width + r], columns[3 * width + r]};
        double by[4] = {0};
        subtract_product(by, of->nodes[0].pivot, seen);
        for (int i = 0; i < 4; i++) by[i] = -by[i];
        observe(by, columns, (size_t)width, r, width, compliance + width * r);
    }
}

/// x_i ← x_{i + by}, round and round; `was` is room for all.
static void turn(double *x, int stride, int count, int by, double *was)
{
    for (int i = 0; i < count; i++) was[i] = x[stride * i];
    for (int i = 0; i < count; i++) x[stride * i] = was[(i + by) % count];
}

/// The other triangle, and pulls in the order of their samples.
static void complete(const pulled *of, double *compliance, double *columns)
{
    const int width = 2 * of->pulls.count, by = 2 * (of->pulls.count - of->first_pull);
    for (int i = 0; i < width; i++) {
        for (int j = 0; j < i; j++) compliance[width * i + j] = compliance[width * j + i];
    }
    for (int i = 0; i < width && of->first_pull > 0; i++) turn(compliance + width * i, 1, width, by, columns);
    for (int i = 0; i < width && of->first_pull > 0; i++) turn(compliance + i, width, width, by, columns);
}

/// The state of a node, and what a pulled sample sees of it.
static void state_of(const pull_node *node, double state[4])
{
    for (int i = 0; i < 4; i++) {
        state[i] = node->known[i];
        for (int k = 0; k < 4; k++) state[i] += node->to[i][k] * node->solved[k];
    }
}

static cplx pulled_x(const pulled *of, int pull)
{
    const problem *p = &of->problem;
    const pull_place place = of->place[pull];
    const int sample = of->pulls.sample[pull];
    double s[4];
    state_of(&of->nodes[place.node], s);
    cplx x = {s[0], s[1]};
    if (place.second) x = cplx_add(cplx_mul(of->solver->chain.lambda, x), (cplx){s[2], s[3]});
    if (p->swing.total) x.re += p->about[sample] - p->y[sample];
    if (p->swing.im) x.im += p->swing.im[sample];
    return x;
}

static void reset(pulled *of)
{
    for (int j = 0; j < of->solver->chain.node_count; j++)
        memcpy(of->nodes[j].solved, of->nodes[j].right, sizeof of->nodes[j].solved);
}

bool pull_chain_respond(pulled *of, double *compliance, double *alone, double *columns)
{
    chain *c = &of->solver->chain;
    if (!problem_takes_pulls(of->solver, &of->problem)) return false;
    problem_set_chain(of->solver, &of->problem);
    c->kept = false;
    if (!pull_make_nodes(of)) return false;
    chain_make_tables(c);
    assemble(c, of->nodes);
    reduce(c, of->nodes);
    if (!factor_nodes(c, of->nodes)) return false;
    respond(of, compliance, columns);
    if (c->cyclic) respond_by_first(of, compliance, columns);
    complete(of, compliance, columns);
    reset(of);
    solve_nodes(c, of->nodes);
    for (int i = 0; i < of->pulls.count; i++) {
        cplx x = pulled_x(of, i);
        alone[2 * i] = x.re, alone[2 * i + 1] = x.im;
    }
    return true;
}

bool pull_chain_solve(pulled *of, wiggly_curve *curve)
{
    chain *c = &of->solver->chain;
    reset(of);
    for (int i = 0; i < of->pulls.count; i++) {
        double *right = of->nodes[of->place[i].node].solved, re[4], im[4];
        see(of, i, 0, re);
        see(of, i, 1, im);
        for (int k = 0; k < 4; k++) right[k] += re[k] * of->pulls.pull[i].re + im[k] * of->pulls.pull[i].im;
    }
    solve_nodes(c, of->nodes);
    for (int j = 0; j < c->node_count; j++) {
        double s[4];
        state_of(&of->nodes[j], s);
        chain_node *node = &c->nodes[j];
        node->value = s[0], node->x_im = s[1], node->d_re = s[2], node->d_im = s[3];
    }
    return problem_finish(of->solver, &of->problem, curve);
}

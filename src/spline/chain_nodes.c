// The nodes' block-tridiagonal system: assembled from stretches, start and slopes, factored, solved (see chain.c).
#include "spline/chain.h"
#include <math.h>

/// A pivot below this part of what its diagonal would give has lost digits that refinement must bring back.
static const double weakest = 1e-6;

/// Adds the Hermitian form [h00 h01; h01* h11] of a node's state.
static void add_form(chain_row *row, bool z, double h00, cplx h01, double h11)
{
    double *d = row->diagonal;
    if (z) {
        d[0] += h00, d[1] += h01.im, d[2] += h01.re, d[3] += h11, d[5] += h11;
    } else {
        d[0] += h11;
    }
}

/// −2 Re s_q* C s_p between a node and the next.
static void set_coupling(chain_row *p, bool z, const chain_stretch *s)
{
    double *n = p->below;
    if (!z) {
        n[0] = -s->c11.re;
        return;
    }
    n[0] = -s->c00.re, n[1] = -s->c01.im, n[2] = -s->c01.re;
    n[3] = s->c10.im, n[4] = -s->c11.re, n[5] = s->c11.im;
    n[6] = -s->c10.re, n[7] = -s->c11.im, n[8] = -s->c11.re;
}

/// Unknown 1 (Re d) of node j is `tie` times unknown 0 (Im x) plus a known number: folds it into unknown 0.
static void tie_to_im(chain *c, int j, double tie)
{
    chain_row *row = &c->rows[j];
    double *d = row->diagonal;
    d[0] += tie * (2 * d[1] + tie * d[3]);
    d[1] += tie * d[3];
    d[2] += tie * d[4];
    for (int v = 0; v < 3; v++) {
        if (j > 0) c->rows[j - 1].below[v] += tie * c->rows[j - 1].below[3 + v];
        if (j + 1 < c->node_count) row->below[3 * v] += tie * row->below[3 * v + 1];
    }
}

/// Takes the known unknown `u` of node j out of the system.
static void fix(chain *c, int j, int u)
{
    static const int entry[3][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}};
    int width = c->is_complex ? 3 : 1;
    chain_row *row = &c->rows[j];
    for (int v = 0; v < width; v++) {
        row->diagonal[entry[v][u]] = v == u;
        if (j > 0) c->rows[j - 1].below[width * u + v] = 0;
        row->below[width * v + u] = 0;
    }
}

/// |x + e_0| and |e_0 − e (x + e_0)| of the start, with e_0 = x_1 − x_0 = d + (λ−1) x, as forms in the first state.
static void add_start(chain *c)
{
    const start_cost *h = &c->start;
    const cplx l1 = {c->lambda.re - 1, c->lambda.im}, e1 = {h->e.re - 1, h->e.im};
    cplx on_x = cplx_add(cplx_mul(e1, l1), h->e);
    cplx h01 = cplx_add(cplx_scale(h->h00, cplx_mul(cplx_conj(on_x), e1)), cplx_scale(h->d, cplx_conj(c->lambda)));
    add_form(&c->rows[0], c->is_complex, h->h00 * cplx_norm(on_x) + h->d * cplx_norm(c->lambda), h01,
             h->h00 * cplx_norm(e1) + h->d);
}

/// slope_weight (Re e − slope)², where Re e = Re d + Re (λ−1) Re x − Im λ Im x.
static void add_slope(const chain *c, chain_row *row, double w)
{
    double turn = c->lambda.im;
    if (c->is_complex) {
        row->diagonal[0] += w * turn * turn;
        row->diagonal[1] -= w * turn;
    }
    row->diagonal[c->is_complex ? 3 : 0] += w;
}

void chain_assemble(chain *c)
{
    bool z = c->is_complex;
    for (int j = 0; j < c->node_count; j++) c->rows[j] = (chain_row){0};
    add_start(c);
    for (int j = 0; j < c->node_count; j++) {
        if (c->nodes[j].slope_weight > 0) add_slope(c, &c->rows[j], c->nodes[j].slope_weight);
        if (j + 1 == c->node_count) break;
        const chain_stretch *s = &c->stretches[c->nodes[j].stretch];
        add_form(&c->rows[j], z, s->p00, s->p01, s->p11);
        add_form(&c->rows[j + 1], z, s->v00, s->v01, s->v11);
        set_coupling(&c->rows[j], z, s);
    }
    for (int j = 0; j < c->node_count; j++) {
        if (c->nodes[j].fixed & NODE_AT_REST) {
            for (int u = 0; u < (z ? 3 : 1); u++) fix(c, j, u);
        } else if (c->nodes[j].fixed & NODE_FIXED_E) {
            if (z) tie_to_im(c, j, c->lambda.im);
            fix(c, j, z ? 1 : 0);
        }
    }
}

static chain_rank factor_scalars(chain *c)
{
    chain_rank rank = CHAIN_FIRM;
    double below = 0, l = 0; // A_{j,j−1} and L_{j,j−1}
    for (int j = 0; j < c->node_count; j++) {
        chain_row *row = &c->rows[j];
        double s = row->diagonal[0] - l * below;
        if (!(s > 0 && s < INFINITY)) return CHAIN_LOST;
        if (s < weakest * row->diagonal[0]) rank = CHAIN_WEAK;
        below = row->below[0];
        row->diagonal[0] = 1 / s;
        l = row->below[0] *= row->diagonal[0];
    }
    return rank;
}

chain_rank chain_invert(const double *s, double *p)
{
    double c00 = s[3] * s[5] - s[4] * s[4], c01 = s[2] * s[4] - s[1] * s[5], c02 = s[1] * s[4] - s[2] * s[3];
    double det = s[0] * c00 + s[1] * c01 + s[2] * c02, full = s[0] * s[3] * s[5];
    if (!(s[0] > 0 && s[3] > 0 && s[5] > 0 && det > 0 && det < INFINITY)) return CHAIN_LOST;
    double inverse = 1 / det;
    p[0] = c00 * inverse, p[1] = c01 * inverse, p[2] = c02 * inverse;
    p[3] = (s[0] * s[5] - s[2] * s[2]) * inverse;
    p[4] = (s[1] * s[2] - s[0] * s[4]) * inverse;
    p[5] = (s[0] * s[3] - s[1] * s[1]) * inverse;
    return det > weakest * full ? CHAIN_FIRM : CHAIN_WEAK;
}

static chain_rank factor_blocks(chain *c)
{
    chain_rank rank = CHAIN_FIRM;
    double n[9] = {0}; // A_{j,j−1}, which L_{j,j−1} has replaced
    for (int j = 0; j < c->node_count; j++) {
        chain_row *row = &c->rows[j];
        double *d = row->diagonal, s[6], p[6];
        for (int i = 0; i < 6; i++) s[i] = d[i];
        if (j > 0) {
            const double *l = row[-1].below;
            s[0] -= l[0] * n[0] + l[1] * n[1] + l[2] * n[2];
            s[1] -= l[0] * n[3] + l[1] * n[4] + l[2] * n[5];
            s[2] -= l[0] * n[6] + l[1] * n[7] + l[2] * n[8];
            s[3] -= l[3] * n[3] + l[4] * n[4] + l[5] * n[5];
            s[4] -= l[3] * n[6] + l[4] * n[7] + l[5] * n[8];
            s[5] -= l[6] * n[6] + l[7] * n[7] + l[8] * n[8];
        }
        chain_rank block = chain_invert(s, p);
        if (block == CHAIN_LOST) return block;
        if (block == CHAIN_WEAK || s[0] < weakest * d[0] || s[3] < weakest * d[3] || s[5] < weakest * d[5]) {
            rank = CHAIN_WEAK;
        }
        for (int i = 0; i < 6; i++) d[i] = p[i];
        for (int i = 0; i < 9; i++) n[i] = row->below[i];
        for (int i = 0; i < 3; i++) {
            const double *a = n + 3 * i;
            double *l = row->below + 3 * i;
            l[0] = a[0] * p[0] + a[1] * p[1] + a[2] * p[2];
            l[1] = a[0] * p[1] + a[1] * p[3] + a[2] * p[4];
            l[2] = a[0] * p[2] + a[1] * p[4] + a[2] * p[5];
        }
    }
    return rank;
}

chain_rank chain_factor(chain *c) { return c->is_complex ? factor_blocks(c) : factor_scalars(c); }

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
    for (int j = 1; j < c->node_count; j++) {
        const double *l = c->rows[j - 1].below, *z = c->rows[j - 1].right;
        double *right = c->rows[j].right;
        for (int i = 0; i < 3; i++) right[i] -= l[3 * i] * z[0] + l[3 * i + 1] * z[1] + l[3 * i + 2] * z[2];
    }
    double u[3] = {0};
    for (int j = c->node_count - 1; j >= 0; j--) {
        chain_row *row = &c->rows[j];
        const double *p = row->diagonal, *l = row->below, *z = row->right;
        double x0 = p[0] * z[0] + p[1] * z[1] + p[2] * z[2] - (l[0] * u[0] + l[3] * u[1] + l[6] * u[2]);
        double x1 = p[1] * z[0] + p[3] * z[1] + p[4] * z[2] - (l[1] * u[0] + l[4] * u[1] + l[7] * u[2]);
        double x2 = p[2] * z[0] + p[4] * z[1] + p[5] * z[2] - (l[2] * u[0] + l[5] * u[1] + l[8] * u[2]);
        row->right[0] = u[0] = x0, row->right[1] = u[1] = x1, row->right[2] = u[2] = x2;
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

// With λ = a/2, the mean of the two poles, and the state s_k = (x_k, d_k), d_k = x_{k+1} − λ x_k (the envelope's step), a jet
// row is one step of a linear system driven by the jet, whose eigenvalues λ ± δ are the poles:
//
//     s_{k+1} = F s_k + B r_{k+1},     F = | λ   1 |,   B = | 0 |,   δ² = (λ₀ − λ₁)²/4
//                                          | δ²  λ |        | 1 |
//
// The least Σ|r|² that brings s_p to s_q in L steps is (s_q − F^L s_p)* W_L⁻¹ (s_q − F^L s_p), with the Gramian
// W_L = Σ_{i<L} F^i B B* F^i*: a knot-free stretch is a 2×2 Hermitian form in its end states, exact at any length, because
// W is a sum of positive terms. What is left are the states at the knots, where Re x is known: a block-tridiagonal system of
// (Im x, Re d, Im d) a knot, in cubic and real mode of d alone (there it is the classical spline's tridiagonal system).
// Inside a stretch
//
//     x_{p+i} = [F^i s_p]_x + [W_i F*^{L−i} ν]_x,     ν = W_L⁻¹ (s_q − F^L s_p),
//
// a sum of four tabled columns a sample, the same for all stretches of one length. After the last knot x runs free.
#include "spline/chain.h"
#include <math.h>

/// A block of the nodes' system whose determinant falls below this part of what its diagonal would give has lost so many
/// digits that the refined solver is the better one.
static const double weakest = 1e-6;

static cplx entry(const cplx_array *a, int k, bool is_complex) { return (cplx){a->re[k], is_complex ? a->im[k] : 0}; }

static void set_entry(const cplx_array *a, int k, bool is_complex, cplx value)
{
    a->re[k] = value.re;
    if (is_complex) a->im[k] = value.im;
}

static cplx cplx_sub(cplx a, cplx b) { return (cplx){a.re - b.re, a.im - b.im}; }
static cplx cplx_scale(double s, cplx a) { return (cplx){s * a.re, s * a.im}; }

/// Tables F^k and W_k up to `longest`: F^{k+1} = F F^k, W_{k+1} = F W_k F* + B B*.
static void make_powers(const chain *c, int longest)
{
    const chain_powers *t = &c->powers;
    bool z = c->is_complex;
    const cplx l = c->lambda, d = c->delta2, ls = cplx_conj(l), ds = cplx_conj(d);
    cplx f00 = {1, 0}, f01 = {0, 0}, f10 = {0, 0}, f11 = {1, 0}, w01 = {0, 0};
    double w00 = 0, w11 = 0;
    for (int k = 0; k <= longest; k++) {
        set_entry(&t->f00, k, z, f00), set_entry(&t->f01, k, z, f01);
        set_entry(&t->f10, k, z, f10), set_entry(&t->f11, k, z, f11);
        set_entry(&t->w01, k, z, w01);
        t->w00[k] = w00, t->w11[k] = w11;
        cplx g00 = cplx_add(cplx_mul(l, f00), f10), g01 = cplx_add(cplx_mul(l, f01), f11);
        f10 = cplx_add(cplx_mul(d, f00), cplx_mul(l, f10));
        f11 = cplx_add(cplx_mul(d, f01), cplx_mul(l, f11));
        f00 = g00, f01 = g01;
        cplx w10 = cplx_conj(w01); // rows of F W, then times F*
        cplx a0 = cplx_add(cplx_scale(w00, l), w10), a1 = cplx_add(cplx_mul(l, w01), (cplx){w11, 0});
        cplx b0 = cplx_add(cplx_scale(w00, d), cplx_mul(l, w10)), b1 = cplx_add(cplx_mul(d, w01), cplx_scale(w11, l));
        w00 = cplx_mul(a0, ls).re + a1.re;
        w01 = cplx_add(cplx_mul(a0, ds), cplx_mul(a1, ls));
        w11 = cplx_mul(b0, ds).re + cplx_mul(b1, ls).re + 1;
    }
}

/// V = W⁻¹, C = V F, P = F* V F at the stretch's length, and its table of forced columns.
static void make_stretch(const chain *c, chain_stretch *s)
{
    const chain_powers *t = &c->powers;
    bool z = c->is_complex;
    int n = s->length;
    cplx f00 = entry(&t->f00, n, z), f01 = entry(&t->f01, n, z), f10 = entry(&t->f10, n, z),
         f11 = entry(&t->f11, n, z);
    cplx w01 = entry(&t->w01, n, z);
    double det = t->w00[n] * t->w11[n] - cplx_norm(w01);
    s->v00 = t->w11[n] / det, s->v11 = t->w00[n] / det;
    s->v01 = cplx_scale(-1 / det, w01);
    cplx v10 = cplx_conj(s->v01);
    s->c00 = cplx_add(cplx_scale(s->v00, f00), cplx_mul(s->v01, f10));
    s->c01 = cplx_add(cplx_scale(s->v00, f01), cplx_mul(s->v01, f11));
    s->c10 = cplx_add(cplx_mul(v10, f00), cplx_scale(s->v11, f10));
    s->c11 = cplx_add(cplx_mul(v10, f01), cplx_scale(s->v11, f11));
    s->p00 = cplx_mul(cplx_conj(f00), s->c00).re + cplx_mul(cplx_conj(f10), s->c10).re;
    s->p01 = cplx_add(cplx_mul(cplx_conj(f00), s->c01), cplx_mul(cplx_conj(f10), s->c11));
    s->p11 = cplx_mul(cplx_conj(f01), s->c01).re + cplx_mul(cplx_conj(f11), s->c11).re;
    for (int i = 0; i < n; i++) {
        cplx g00 = cplx_conj(entry(&t->f00, n - i, z)), g01 = cplx_conj(entry(&t->f01, n - i, z));
        cplx g10 = cplx_conj(entry(&t->f10, n - i, z)), g11 = cplx_conj(entry(&t->f11, n - i, z));
        cplx w = entry(&t->w01, i, z); // F* has the conjugates transposed
        set_entry(&c->forced[0], s->first + i, z, cplx_add(cplx_scale(t->w00[i], g00), cplx_mul(w, g01)));
        set_entry(&c->forced[1], s->first + i, z, cplx_add(cplx_scale(t->w00[i], g10), cplx_mul(w, g11)));
    }
}

/// Adds the Hermitian form [h00 h01; h01* h11] of a node's state, Re x = `value` being known.
static void add_form(chain_row *row, bool z, double value, double h00, cplx h01, double h11)
{
    if (!z) {
        row->diagonal[0] += h11;
        row->right[0] -= value * h01.re;
        return;
    }
    double *d = row->diagonal;
    d[0] += h00, d[1] += h01.im, d[2] += h01.re, d[3] += h11, d[5] += h11;
    row->right[1] -= value * h01.re;
    row->right[2] += value * h01.im;
}

/// −2 Re s_q* C s_p between a node and the next.
static void add_coupling(chain_row *p, chain_row *q, bool z, double p_value, double q_value, const chain_stretch *s)
{
    if (!z) {
        p->below[0] = -s->c11.re;
        p->right[0] += q_value * s->c01.re;
        q->right[0] += p_value * s->c10.re;
        return;
    }
    double *n = p->below;
    n[0] = -s->c00.re, n[1] = -s->c01.im, n[2] = -s->c01.re;
    n[3] = s->c10.im, n[4] = -s->c11.re, n[5] = s->c11.im;
    n[6] = -s->c10.re, n[7] = -s->c11.im, n[8] = -s->c11.re;
    p->right[0] -= q_value * s->c00.im, p->right[1] += q_value * s->c01.re, p->right[2] -= q_value * s->c01.im;
    q->right[0] += p_value * s->c00.im, q->right[1] += p_value * s->c10.re, q->right[2] += p_value * s->c10.im;
}

/// Unknown 1 (Re d) of node j is `tie` times unknown 0 (Im x) plus what fix() will make known: folds it into unknown 0.
static void tie_to_im(chain *c, int j, double tie)
{
    chain_row *row = &c->rows[j];
    double *d = row->diagonal;
    d[0] += tie * (2 * d[1] + tie * d[3]);
    d[1] += tie * d[3];
    d[2] += tie * d[4];
    row->right[0] += tie * row->right[1];
    for (int v = 0; v < 3; v++) {
        if (j > 0) c->rows[j - 1].below[v] += tie * c->rows[j - 1].below[3 + v];
        if (j + 1 < c->node_count) row->below[3 * v] += tie * row->below[3 * v + 1];
    }
}

/// Takes unknown `u` of node j out of the system: it is `known`.
static void fix(chain *c, int j, int u, double known)
{
    static const int diagonal_of[3] = {0, 3, 5}, off_diagonal[3][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}};
    int width = c->is_complex ? 3 : 1;
    chain_row *row = &c->rows[j];
    for (int v = 0; v < width; v++) {
        if (v != u) row->right[v] -= row->diagonal[off_diagonal[v][u]] * known, row->diagonal[off_diagonal[v][u]] = 0;
        if (j > 0) {
            double *n = &c->rows[j - 1].below[width * u + v];
            c->rows[j - 1].right[v] -= *n * known, *n = 0;
        }
        if (j + 1 < c->node_count) {
            double *n = &row->below[width * v + u];
            c->rows[j + 1].right[v] -= *n * known, *n = 0;
        }
    }
    row->diagonal[diagonal_of[u]] = 1;
    row->right[u] = known;
}

/// |x + e_0| and |e_0 − e (x + e_0)| of the start, with e_0 = x_1 − x_0 = d + (λ−1) x, as forms in the first state.
static void add_start(chain *c)
{
    const start_cost *h = &c->start;
    const cplx l1 = {c->lambda.re - 1, c->lambda.im}, e1 = {h->e.re - 1, h->e.im};
    cplx on_x = cplx_add(cplx_mul(e1, l1), h->e);
    cplx h01 = cplx_add(cplx_scale(h->h00, cplx_mul(cplx_conj(on_x), e1)), cplx_scale(h->d, cplx_conj(c->lambda)));
    add_form(&c->rows[0], c->is_complex, c->nodes[0].value, h->h00 * cplx_norm(on_x) + h->d * cplx_norm(c->lambda),
             h01, h->h00 * cplx_norm(e1) + h->d);
}

/// slope_weight (Re e − slope)², where Re e = Re d + Re (λ−1) Re x − Im λ Im x.
static void add_slope(const chain *c, chain_row *row, const chain_node *node)
{
    double w = node->slope_weight, turn = c->lambda.im;
    double target = node->slope - (c->lambda.re - 1) * node->value;
    if (!c->is_complex) {
        row->diagonal[0] += w;
        row->right[0] += w * target;
        return;
    }
    row->diagonal[0] += w * turn * turn;
    row->diagonal[1] -= w * turn;
    row->diagonal[3] += w;
    row->right[0] -= w * turn * target;
    row->right[1] += w * target;
}

static void assemble(chain *c)
{
    bool z = c->is_complex;
    for (int j = 0; j < c->node_count; j++) c->rows[j] = (chain_row){0};
    add_start(c);
    for (int j = 0; j < c->node_count; j++) {
        const chain_node *p = &c->nodes[j], *q = p + 1;
        if (p->slope_weight > 0) add_slope(c, &c->rows[j], p);
        if (j + 1 == c->node_count) break;
        const chain_stretch *s = &c->stretches[p->stretch];
        add_form(&c->rows[j], z, p->value, s->p00, s->p01, s->p11);
        add_form(&c->rows[j + 1], z, q->value, s->v00, s->v01, s->v11);
        add_coupling(&c->rows[j], &c->rows[j + 1], z, p->value, q->value, s);
    }
    for (int j = 0; j < c->node_count; j++) {
        const chain_node *node = &c->nodes[j];
        if (node->fixed & NODE_AT_REST) {
            for (int u = 0; u < (z ? 3 : 1); u++) fix(c, j, u, 0);
        } else if (node->fixed & NODE_FIXED_E) {
            if (z) tie_to_im(c, j, c->lambda.im);
            fix(c, j, z ? 1 : 0, node->e - (c->lambda.re - 1) * node->value);
        }
    }
}

static bool sweep_scalars(chain *c)
{
    chain_row *before = NULL;
    for (int j = 0; j < c->node_count; before = &c->rows[j++]) {
        chain_row *row = &c->rows[j];
        double s = row->diagonal[0], full = s;
        if (before) {
            s -= before->below[0] * before->diagonal[1];
            row->right[0] -= before->below[0] * before->right[0];
        }
        if (!(s > weakest * full && s < INFINITY)) return false;
        row->diagonal[0] = 1 / s;
        row->diagonal[1] = row->below[0];
        row->below[0] *= row->diagonal[0];
    }
    double after = 0;
    for (int j = c->node_count - 1; j >= 0; j--) {
        chain_row *row = &c->rows[j];
        after = row->right[0] = row->diagonal[0] * row->right[0] - row->below[0] * after;
    }
    return true;
}

/// p ← inverse of the symmetric 3×3 s (00 01 02 11 12 22); false where its determinant is lost.
static bool invert(const double *s, double *p)
{
    double c00 = s[3] * s[5] - s[4] * s[4], c01 = s[2] * s[4] - s[1] * s[5], c02 = s[1] * s[4] - s[2] * s[3];
    double det = s[0] * c00 + s[1] * c01 + s[2] * c02;
    if (!(s[0] > 0 && s[3] > 0 && s[5] > 0 && det > weakest * s[0] * s[3] * s[5] && det < INFINITY)) return false;
    double inverse = 1 / det;
    p[0] = c00 * inverse, p[1] = c01 * inverse, p[2] = c02 * inverse;
    p[3] = (s[0] * s[5] - s[2] * s[2]) * inverse;
    p[4] = (s[1] * s[2] - s[0] * s[4]) * inverse;
    p[5] = (s[0] * s[3] - s[1] * s[1]) * inverse;
    return true;
}

static bool sweep_blocks(chain *c)
{
    double n[9] = {0}; // A_{j,j−1}, which L_{j,j−1} has replaced
    for (int j = 0; j < c->node_count; j++) {
        chain_row *row = &c->rows[j];
        double s[6], p[6];
        for (int i = 0; i < 6; i++) s[i] = row->diagonal[i];
        if (j > 0) {
            const double *l = row[-1].below, *z = row[-1].right;
            s[0] -= l[0] * n[0] + l[1] * n[1] + l[2] * n[2];
            s[1] -= l[0] * n[3] + l[1] * n[4] + l[2] * n[5];
            s[2] -= l[0] * n[6] + l[1] * n[7] + l[2] * n[8];
            s[3] -= l[3] * n[3] + l[4] * n[4] + l[5] * n[5];
            s[4] -= l[3] * n[6] + l[4] * n[7] + l[5] * n[8];
            s[5] -= l[6] * n[6] + l[7] * n[7] + l[8] * n[8];
            for (int i = 0; i < 3; i++) row->right[i] -= l[3 * i] * z[0] + l[3 * i + 1] * z[1] + l[3 * i + 2] * z[2];
        }
        if (!(s[0] > weakest * row->diagonal[0] && s[3] > weakest * row->diagonal[3] &&
              s[5] > weakest * row->diagonal[5])) {
            return false;
        }
        if (!invert(s, p)) return false;
        for (int i = 0; i < 6; i++) row->diagonal[i] = p[i];
        for (int i = 0; i < 9; i++) n[i] = row->below[i];
        for (int i = 0; i < 3; i++) {
            const double *a = n + 3 * i;
            double *l = row->below + 3 * i;
            l[0] = a[0] * p[0] + a[1] * p[1] + a[2] * p[2];
            l[1] = a[0] * p[1] + a[1] * p[3] + a[2] * p[4];
            l[2] = a[0] * p[2] + a[1] * p[4] + a[2] * p[5];
        }
    }
    double u[3] = {0};
    for (int j = c->node_count - 1; j >= 0; j--) {
        chain_row *row = &c->rows[j];
        const double *p = row->diagonal, *l = row->below, *z = row->right;
        double x0 = p[0] * z[0] + p[1] * z[1] + p[2] * z[2] - (l[0] * u[0] + l[3] * u[1] + l[6] * u[2]);
        double x1 = p[1] * z[0] + p[3] * z[1] + p[4] * z[2] - (l[1] * u[0] + l[4] * u[1] + l[7] * u[2]);
        double x2 = p[2] * z[0] + p[4] * z[1] + p[5] * z[2] - (l[2] * u[0] + l[5] * u[1] + l[8] * u[2]);
        u[0] = x0, u[1] = x1, u[2] = x2;
        row->right[0] = x0, row->right[1] = x1, row->right[2] = x2;
    }
    return true;
}

/// x inside a stretch: four columns, weighted with the state it starts from and the costate of where it ends.
static void fill_complex(const chain *c, const chain_stretch *s, const cplx weight[4], double *restrict re,
                         double *restrict im)
{
    const double *restrict f0r = c->powers.f00.re, *restrict f0i = c->powers.f00.im;
    const double *restrict f1r = c->powers.f01.re, *restrict f1i = c->powers.f01.im;
    const double *restrict g0r = c->forced[0].re + s->first, *restrict g0i = c->forced[0].im + s->first;
    const double *restrict g1r = c->forced[1].re + s->first, *restrict g1i = c->forced[1].im + s->first;
    const cplx a = weight[0], b = weight[1], d = weight[2], e = weight[3];
    for (int i = 0; i < s->length; i++) {
        re[i] = (f0r[i] * a.re - f0i[i] * a.im) + (f1r[i] * b.re - f1i[i] * b.im) + (g0r[i] * d.re - g0i[i] * d.im) +
                (g1r[i] * e.re - g1i[i] * e.im);
        im[i] = (f0r[i] * a.im + f0i[i] * a.re) + (f1r[i] * b.im + f1i[i] * b.re) + (g0r[i] * d.im + g0i[i] * d.re) +
                (g1r[i] * e.im + g1i[i] * e.re);
    }
}

static void fill_real(const chain *c, const chain_stretch *s, const cplx weight[4], double *restrict re)
{
    const double *restrict f0 = c->powers.f00.re, *restrict f1 = c->powers.f01.re;
    const double *restrict g0 = c->forced[0].re + s->first, *restrict g1 = c->forced[1].re + s->first;
    const double a = weight[0].re, b = weight[1].re, d = weight[2].re, e = weight[3].re;
    for (int i = 0; i < s->length; i++) re[i] = (f0[i] * a + f1[i] * b) + (g0[i] * d + g1[i] * e);
}

/// Fills the samples from node p to before node q.
static void fill_stretch(const chain *c, const chain_node *p, const chain_node *q, double *x_re, double *x_im)
{
    const chain_stretch *s = &c->stretches[p->stretch];
    cplx xp = {p->value, p->x_im}, ep = {p->d_re, p->d_im}, xq = {q->value, q->x_im}, eq = {q->d_re, q->d_im};
    cplx weight[4] = {
        xp,
        ep,
        cplx_sub(cplx_add(cplx_scale(s->v00, xq), cplx_mul(s->v01, eq)),
                 cplx_add(cplx_mul(s->c00, xp), cplx_mul(s->c01, ep))),
        cplx_sub(cplx_add(cplx_mul(cplx_conj(s->v01), xq), cplx_scale(s->v11, eq)),
                 cplx_add(cplx_mul(s->c10, xp), cplx_mul(s->c11, ep))),
    };
    if (c->is_complex) {
        fill_complex(c, s, weight, x_re + p->sample, x_im + p->sample);
    } else {
        fill_real(c, s, weight, x_re + p->sample);
    }
}

/// After the last node nothing pulls: r = 0.
static void run_free(const chain *c, const chain_node *last, double *x_re, double *x_im)
{
    cplx x = {last->value, last->x_im}, d = {last->d_re, last->d_im};
    for (int k = last->sample; k < c->count; k++) {
        x_re[k] = x.re;
        if (x_im) x_im[k] = x.im;
        cplx next = cplx_add(cplx_mul(c->lambda, x), d);
        d = cplx_add(cplx_mul(c->delta2, x), cplx_mul(c->lambda, d));
        x = next;
    }
}

static void make_tables(chain *c)
{
    int longest = 0, used = 0;
    c->stretch_count = 0;
    for (int j = 0; j + 1 < c->node_count; j++) {
        int length = c->nodes[j + 1].sample - c->nodes[j].sample;
        longest = length > longest ? length : longest;
    }
    for (int k = 0; k <= longest; k++) c->stretch_of[k] = -1;
    make_powers(c, longest);
    for (int j = 0; j + 1 < c->node_count; j++) {
        int length = c->nodes[j + 1].sample - c->nodes[j].sample;
        if (c->stretch_of[length] < 0) {
            c->stretch_of[length] = c->stretch_count;
            chain_stretch *s = &c->stretches[c->stretch_count++];
            *s = (chain_stretch){.length = length, .first = used};
            used += length;
            make_stretch(c, s);
        }
        c->nodes[j].stretch = c->stretch_of[length];
    }
}

bool chain_solve(chain *c, double *x_re, double *x_im)
{
    make_tables(c);
    assemble(c);
    if (!(c->is_complex ? sweep_blocks(c) : sweep_scalars(c))) return false;
    for (int j = 0; j < c->node_count; j++) {
        chain_node *node = &c->nodes[j];
        const double *solved = c->rows[j].right;
        node->x_im = c->is_complex ? solved[0] : 0;
        node->d_re = c->is_complex ? solved[1] : solved[0];
        node->d_im = c->is_complex ? solved[2] : 0;
        if (c->is_complex && node->fixed & NODE_FIXED_E) node->d_re += c->lambda.im * node->x_im;
    }
    for (int j = 0; j + 1 < c->node_count; j++) fill_stretch(c, &c->nodes[j], &c->nodes[j + 1], x_re, x_im);
    run_free(c, &c->nodes[c->node_count - 1], x_re, x_im);
    return true;
}

/// The chain: solves a spline of constant parameters using only the states at its knots.
//
// With λ = a/2, the mean of the two poles, and the state s_k = (x_k, d_k), d_k = x_{k+1} − λ x_k (the envelope's step), a jet
// row is one step of a linear system driven by the jet, whose eigenvalues λ ± δ are the poles:
//
//     s_{k+1} = F s_k + B r_{k+1},     F = | λ   1 |,   B = | 0 |,   δ² = (λ₀ − λ₁)²/4
//                                          | δ²  λ |        | 1 |
//
// The least Σ|r|² that brings s_p to s_q in L steps is (s_q − F^L s_p)* W_L⁻¹ (s_q − F^L s_p), with the Gramian
// W_L = Σ_{i<L} F^i B B* F^i*. So a knot-free stretch is a 2×2 Hermitian form in its end states, exact at any length, because W is a sum
// of positive terms. Unknown are only the states at the knots, where Re x is given: a block-tridiagonal system with (Im x, Re d, Im d) per
// knot, in cubic and real mode d alone (there it is the classical spline's tridiagonal system).
// Inside a stretch
//
//     x_{p+i} = [F^i s_p]_x + [W_i F*^{−i} μ]_x,     μ = F*^L ν,     ν = W_L⁻¹ (s_q − F^L s_p),
//
// a sum of four tabulated columns per sample, the same for all stretches. F*^{−i} grows, which costs digits if the poles decay differently.
// So state and costate are computed anew every `run` samples, s_{p+k} = F^k s_p + W_k F*^{L−k} ν. After the last knot x is free, r = 0. If it
// settles there, d_L is a multiple of x_L and the last jet counts twice: the last input's share of W is then a half, W_L − ½ B B*. The same
// holds if a stretch ends in a still knot, with s = (0, 0); the next one begins there with (0, d), and d costs 2 |d|².
//
// A slope at s_q acts on h times a speed, φ = Re(on_x x_q + on_d d_q − on_r r_q), where r_q is the last jet of the stretch before. Given both
// ends, that jet is ν_d = B* ν ± √(1 − V₁₁). So with s = weight / (1 + weight |on_r|² (1 − V₁₁)) the slope costs
// s (Re(on_x x_q + on_d d_q − on_r ν_d) − target)², a row of the two nodes alone. In the stretch it moves r_q from B* ν by
// η = s (φ − target) on_r*, and the samples follow the costate ν − V B η, which is μ − C* B η at the stretch's start.
#include "spline/chain.h"
#include "spline/wide.h"
#include <float.h>
#include <math.h>

/// Whether sums of tabulated columns (each below 1e25) weighted with z stay finite; false for NaN.
static bool is_tame(cplx z) { return fabs(z.re) < 1e250 && fabs(z.im) < 1e250; }

double chain_slope_pull(const chain *c, const chain_node *node, cplx jet, double v11)
{
    const chain_speed *speed = &c->speed[node->view];
    cplx seen = cplx_sub(cplx_add(cplx_mul(speed->on_x, (cplx){node->value, node->x_im}),
                                  cplx_mul(speed->on_d, (cplx){node->d_re, node->d_im})),
                         cplx_mul(speed->on_r, jet));
    double weight = node->slope_weight / (1 + node->slope_weight * cplx_norm(speed->on_r) * (1 - v11));
    return weight * (seen.re - node->slope);
}

/// What a slope at a stretch's last node adds to the jet ν_d there: η at the top of this file.
static cplx jet_of_slope(const chain *c, const chain_stretch *s, const chain_node *q, cplx nu_d)
{
    return cplx_scale(chain_slope_pull(c, q, nu_d, s->form[FORM_V11]), cplx_conj(c->speed[q->view].on_r));
}

void chain_costate(const chain *c, const chain_node *p, const chain_node *q, cplx nu[2])
{
    const chain_stretch *s = &c->stretches[p->stretch];
    const cplx xp = {p->value, p->x_im}, dp = {p->d_re, p->d_im}, xq = {q->value, q->x_im}, dq = chain_end_d(q);
    const cplx v01 = chain_entry(s, FORM_V01);
    nu[0] = cplx_sub(cplx_add(cplx_scale(s->form[FORM_V00], xq), cplx_mul(v01, dq)),
                     cplx_add(cplx_mul(chain_entry(s, FORM_C00), xp), cplx_mul(chain_entry(s, FORM_C01), dp)));
    nu[1] = cplx_sub(cplx_add(cplx_mul(cplx_conj(v01), xq), cplx_scale(s->form[FORM_V11], dq)),
                     cplx_add(cplx_mul(chain_entry(s, FORM_C10), xp), cplx_mul(chain_entry(s, FORM_C11), dp)));
    if (q->slope_weight > 0) {
        cplx eta = jet_of_slope(c, s, q, nu[1]);
        nu[0] = cplx_sub(nu[0], cplx_mul(v01, eta));
        nu[1] = cplx_sub(nu[1], cplx_scale(s->form[FORM_V11], eta));
    }
}

/// State and costate at a stretch's start; the costate is F*^L ν = C* s_q − P s_p.
static void begin_real(const chain *c, const chain_node *p, const chain_node *q, cplx weight[4])
{
    const chain_stretch *s = &c->stretches[p->stretch];
    const double *f = s->form, xp = p->value, dp = p->d_re, xq = q->value;
    const double dq = q->fixed & NODE_STILL ? 0 : q->d_re;
    double on_x = f[FORM_C00] * xq + f[FORM_C10] * dq - (f[FORM_P00] * xp + f[FORM_P01] * dp);
    double on_d = f[FORM_C01] * xq + f[FORM_C11] * dq - (f[FORM_P01] * xp + f[FORM_P11] * dp);
    if (q->slope_weight > 0) {
        double nu_d = f[FORM_V01] * xq + f[FORM_V11] * dq - (f[FORM_C10] * xp + f[FORM_C11] * dp);
        double eta = jet_of_slope(c, s, q, (cplx){nu_d, 0}).re;
        on_x -= f[FORM_C10] * eta, on_d -= f[FORM_C11] * eta;
    }
    weight[0] = (cplx){xp, 0}, weight[1] = (cplx){dp, 0}, weight[2] = (cplx){on_x, 0}, weight[3] = (cplx){on_d, 0};
}

static void begin_complex(const chain *c, const chain_node *p, const chain_node *q, cplx weight[4])
{
    const chain_stretch *s = &c->stretches[p->stretch];
    const cplx xp = {p->value, p->x_im}, dp = {p->d_re, p->d_im}, xq = {q->value, q->x_im}, dq = chain_end_d(q);
    const cplx p01 = chain_entry(s, FORM_P01);
    const cplx c00 = cplx_conj(chain_entry(s, FORM_C00)), c01 = cplx_conj(chain_entry(s, FORM_C01)),
               c10 = cplx_conj(chain_entry(s, FORM_C10)), c11 = cplx_conj(chain_entry(s, FORM_C11));
    weight[0] = xp;
    weight[1] = dp;
    weight[2] = cplx_sub(cplx_add(cplx_mul(c00, xq), cplx_mul(c10, dq)),
                         cplx_add(cplx_scale(s->form[FORM_P00], xp), cplx_mul(p01, dp)));
    weight[3] = cplx_sub(cplx_add(cplx_mul(c01, xq), cplx_mul(c11, dq)),
                         cplx_add(cplx_mul(cplx_conj(p01), xp), cplx_scale(s->form[FORM_P11], dp)));
    if (q->slope_weight > 0) {
        cplx v01 = chain_entry(s, FORM_V01);
        cplx nu_d = cplx_sub(cplx_add(cplx_mul(cplx_conj(v01), xq), cplx_scale(s->form[FORM_V11], dq)),
                             cplx_add(cplx_mul(cplx_conj(c10), xp), cplx_mul(cplx_conj(c11), dp)));
        cplx eta = jet_of_slope(c, s, q, nu_d);
        weight[2] = cplx_sub(weight[2], cplx_mul(c10, eta));
        weight[3] = cplx_sub(weight[3], cplx_mul(c11, eta));
    }
}

/// The same at sample k of a stretch: the costate F*^{L−k} ν, and the state F^k s_p + W_k F*^{L−k} ν.
static void go_on(const chain *c, const chain_node *p, int left, int k, const cplx nu[2], cplx weight[4])
{
    const chain_powers *t = &c->powers;
    const cplx x = {p->value, p->x_im}, d = {p->d_re, p->d_im}, w01 = chain_power(c, &t->w01, k);
    const cplx f = chain_power(c, &t->p, left), g = chain_power(c, &t->q, left), dg = cplx_mul(c->delta2, g);
    const cplx a = chain_power(c, &t->p, k), b = chain_power(c, &t->q, k), db = cplx_mul(c->delta2, b);
    const cplx m = cplx_add(cplx_mul(cplx_conj(f), nu[0]), cplx_mul(cplx_conj(dg), nu[1]));
    const cplx n = cplx_add(cplx_mul(cplx_conj(g), nu[0]), cplx_mul(cplx_conj(f), nu[1]));
    weight[0] =
        cplx_add(cplx_add(cplx_mul(a, x), cplx_mul(b, d)), cplx_add(cplx_scale(t->w00[k], m), cplx_mul(w01, n)));
    weight[1] = cplx_add(cplx_add(cplx_mul(db, x), cplx_mul(a, d)),
                         cplx_add(cplx_mul(cplx_conj(w01), m), cplx_scale(t->w11[k], n)));
    weight[2] = m;
    weight[3] = n;
}

/// x of `count` samples of a run, from its sample `from` on: four tabulated columns, weighted with the state (x, d) and the costate at the
/// run's start.
WIDEST static void fill_complex(const chain *c, const cplx weight[4], int from, int count, double *restrict re,
                                double *restrict im)
{
    const double *restrict f0r = c->powers.p.re + from, *restrict f0i = c->powers.p.im + from;
    const double *restrict f1r = c->powers.q.re + from, *restrict f1i = c->powers.q.im + from;
    const double *restrict g0r = c->pulled[0].re + from, *restrict g0i = c->pulled[0].im + from;
    const double *restrict g1r = c->pulled[1].re + from, *restrict g1i = c->pulled[1].im + from;
    const cplx a = weight[0], b = weight[1], d = weight[2], e = weight[3];
    for (int i = 0; i < count; i++) {
        re[i] = ((f0r[i] * a.re - f0i[i] * a.im) + (f1r[i] * b.re - f1i[i] * b.im)) +
                ((g0r[i] * d.re - g0i[i] * d.im) + (g1r[i] * e.re - g1i[i] * e.im));
        im[i] = ((f0r[i] * a.im + f0i[i] * a.re) + (f1r[i] * b.im + f1i[i] * b.re)) +
                ((g0r[i] * d.im + g0i[i] * d.re) + (g1r[i] * e.im + g1i[i] * e.re));
    }
}

WIDEST static void fill_real(const chain *c, const cplx weight[4], int from, int count, double *restrict re)
{
    const double *restrict f0 = c->powers.p.re + from, *restrict f1 = c->powers.q.re + from;
    const double *restrict g0 = c->pulled[0].re + from, *restrict g1 = c->pulled[1].re + from;
    const double a = weight[0].re, b = weight[1].re, d = weight[2].re, e = weight[3].re;
    for (int i = 0; i < count; i++) re[i] = (f0[i] * a + f1[i] * b) + (g0[i] * d + g1[i] * e);
}

/// Fills samples of a run, in whole blocks if they end by `end`; samples past the run are overwritten later.
static void fill_samples(const chain *c, const cplx weight[4], int from, int count, int at, int end, double *re,
                         double *im)
{
    int whole = (count + CHAIN_BLOCK - 1) & -CHAIN_BLOCK;
    if (from + whole <= CHAIN_RUN && at + whole <= end) count = whole;
    if (c->is_complex) {
        fill_complex(c, weight, from, count, re + at, im + at);
    } else {
        fill_real(c, weight, from, count, re + at);
    }
}

/// A run that begins at sample `at`. A loop's samples are counted from its first node; those past the end continue at sample 0.
static void fill_run(const chain *c, const cplx weight[4], int at, int count, double *re, double *im)
{
    int end = c->cyclic && at < c->turned ? c->turned : c->count;
    if (at + count <= c->count) {
        fill_samples(c, weight, 0, count, at, end, re, im);
    } else {
        fill_samples(c, weight, 0, c->count - at, at, end, re, im);
        fill_samples(c, weight, c->count - at, at + count - c->count, 0, c->turned, re, im);
    }
}

/// State and costate at the start of the run at sample k of a stretch. ν is that of the stretch's end, set with the second run.
static void begin_run(const chain *c, const chain_node *p, const chain_node *q, int k, cplx nu[2], cplx weight[4])
{
    if (k > 0) {
        if (k == c->run) chain_costate(c, p, q, nu);
        go_on(c, p, c->stretches[p->stretch].length - k, k, nu, weight);
    } else if (c->is_complex) {
        begin_complex(c, p, q, weight);
    } else {
        begin_real(c, p, q, weight);
    }
}

/// x from node p up to node q, into arrays that begin at the system's first sample (im is NULL outside complex mode). False if sums might
/// overflow.
static bool fill_stretch(const chain *c, const chain_node *p, const chain_node *q, double *re, double *im)
{
    const int n = c->stretches[p->stretch].length;
    cplx weight[4], nu[2];
    bool tame = true;
    for (int k = 0; k < n; k += c->run) {
        int at = p->sample + c->turned + k, count = n - k < c->run ? n - k : c->run;
        if (c->cyclic && at >= c->count) at -= c->count;
        begin_run(c, p, q, k, nu, weight);
        for (int i = 0; i < 4; i++) tame = tame && is_tame(weight[i]);
        fill_run(c, weight, at, count, re, im);
    }
    return tame;
}

/// x after the last node, where r = 0.
static bool run_free(const chain *c, double *re, double *im)
{
    const chain_node *last = &c->nodes[c->node_count - 1];
    cplx weight[4] = {{last->value, last->x_im}, {last->d_re, last->d_im}};
    const bool tame = is_tame(weight[0]) && is_tame(weight[1]);
    for (int at = last->sample; at < c->count; at += c->run) {
        const int run = c->count - at < c->run ? c->count - at : c->run;
        fill_samples(c, weight, 0, run, at, c->count, re, im);
        if (at + run == c->count) break;
        cplx p = chain_power(c, &c->powers.p, run), q = chain_power(c, &c->powers.q, run);
        cplx next = cplx_add(cplx_mul(p, weight[0]), cplx_mul(q, weight[1]));
        weight[1] = cplx_add(cplx_mul(cplx_mul(c->delta2, q), weight[0]), cplx_mul(p, weight[1]));
        weight[0] = next;
    }
    return tame;
}

/// Adds unknowns (Im x, Re d, Im d) to a node; returns their size.
static double add_to_node(const chain *c, chain_node *node, const double *solved)
{
    cplx tie = chain_node_tie(c, node);
    double x_im = solved[0], d_re = solved[1] + tie.re * x_im, d_im = solved[2] + tie.im * x_im;
    node->x_im += x_im, node->d_re += d_re, node->d_im += d_im;
    return fabs(x_im) + fabs(d_re) + fabs(d_im);
}

/// Adds the solution to the nodes; returns the largest unknown.
static double take_solution(chain *c)
{
    double largest = 0;
    if (!c->is_complex) {
        for (int j = 0; j < c->node_count; j++) {
            double d = c->rows[j].right[1];
            c->nodes[j].d_re += d;
            if (!(fabs(d) <= largest)) largest = fabs(d);
        }
        return largest;
    }
    for (int j = 0; j < c->node_count; j++) {
        double size = add_to_node(c, &c->nodes[j], c->rows[j].right);
        if (!(size <= largest)) largest = size;
    }
    return largest;
}

/// Sets all unknowns of the nodes to 0.
static void reset_nodes(chain *c)
{
    for (int j = 0; j < c->node_count; j++) {
        chain_node *node = &c->nodes[j];
        const cplx x = {node->value, node->im}, growth = {c->lambda.re - 1, c->lambda.im};
        cplx d = {0, 0};
        if (node->fixed & NODE_SETTLED) d = cplx_mul(c->tail, x);
        if (node->fixed & (NODE_FIXED_E | NODE_AT_REST)) d.re = node->e - cplx_mul(growth, x).re;
        if (node->fixed & NODE_FIXED_E_IM) d.im = node->next_im - cplx_mul(c->lambda, x).im;
        node->x_im = x.im, node->d_re = d.re, node->d_im = d.im;
    }
}

/// A bound for |x| of a cubic between two nodes L samples apart. x is a cubic polynomial: the line between its ends plus r with
/// r(0) = r(L) = 0, and |r| ≤ L (|u| + |v|), where u and v are the differences at the ends minus the line's.
static double bound_of_piece(const chain_node *from, const chain_node *to, int length)
{
    return 5 * (fabs(from->value) + fabs(to->value)) + length * (fabs(from->d_re) + fabs(to->d_re));
}

/// x everywhere, from the solved nodes. False if sums might overflow.
static bool fill(chain *c, double *x_re, double *x_im)
{
    const chain_node *last = &c->nodes[c->node_count - 1];
    double *im = c->is_complex ? x_im : NULL;
    bool tame = true;
    c->cubic_bound = fabs(last->value) + (c->count - last->sample) * fabs(last->d_re);
    for (int j = 0; j < chain_stretches(c); j++) {
        const chain_node *p = &c->nodes[j], *q = &c->nodes[chain_next(c, j)];
        const double piece = c->is_complex ? 0 : bound_of_piece(p, q, c->stretches[p->stretch].length);
        c->cubic_bound = piece > c->cubic_bound ? piece : c->cubic_bound;
        tame = fill_stretch(c, p, q, x_re, im) && tame;
    }
    return (c->cyclic || run_free(c, x_re, im)) && tame;
}

static double largest_value(const chain *c)
{
    double largest = 0;
    for (int j = 0; j < c->node_count; j++) largest = fmax(largest, fabs(c->nodes[j].value) + fabs(c->nodes[j].im));
    return largest;
}

bool chain_solve(chain *c, double *x_re, double *x_im)
{
    if (!c->kept) {
        chain_make_tables(c);
        chain_assemble(c);
        c->sound = chain_factor(c);
        if (c->sound) chain_find_spread(c);
        c->kept = true;
    }
    if (!c->sound) return false;
    reset_nodes(c);
    chain_pull_known(c);
    chain_solve_nodes(c);
    c->size = fmax(take_solution(c), largest_value(c));
    chain_pull(c); // once more, for what the inverses of blocks have lost
    const double energy = chain_solve_nodes(c);
    take_solution(c);
    if (!fill(c, x_re, x_im)) return false;
    c->error = chain_bound(c, energy, x_im);
    return true;
}

/// The imaginary rows of a short spline, ω Σ (Im x_k)², which the chain leaves out, as a load on its nodes.
//
// Below two periods they affect x noticeably, but so little that one or a few corrections are enough: at the x found so far each sample
// pulls with −ω j Im x_k. Their effect at the nodes,
//
//     Σ (∂x_k / ∂s)* (−ω j Im x_k),
//
// is solved with the existing factor. A sample is a sum of four tabulated columns (chain.c), so its pull acts on the state and costate of
// its run, s_{p+k} = F^k s_p + W_k m and m = F*^{L−k} ν, and through ν = V s_q − C s_p on the stretch's ends. The bending between the ends is
// left out: a stretch is stiffer than the whole by the fourth power of their lengths.
#include "spline/chain_nodes.h"
#include "spline/wide.h"
#include <stdint.h>

typedef double four __attribute__((vector_size(32), may_alias));
typedef int64_t four_counts __attribute__((vector_size(32), may_alias));

/// The pull of a run's samples on its state and costate: −jω Σ f_k* Im x_k for each column f of x. Samples of its last four that lie past
/// the run do not count.
WIDEST static void pull_of_run(const chain *c, const cplx weight[4], int count, cplx pulled[4])
{
    const double *const columns[8] = {c->powers.p.re,  c->powers.p.im,  c->powers.q.re,  c->powers.q.im,
                                      c->pulled[0].re, c->pulled[0].im, c->pulled[1].re, c->pulled[1].im};
    const four_counts number = {0, 1, 2, 3};
    four sum[8] = {{0}};
    for (int k = 0; k < count; k += 4) {
        four f[8], im = {0};
        for (int i = 0; i < 8; i++) f[i] = *(const four *)(columns[i] + k);
        for (int i = 0; i < 4; i++) im += f[2 * i] * weight[i].im + f[2 * i + 1] * weight[i].re;
        im = (four)((four_counts)im & (number < count - k));
        for (int i = 0; i < 8; i++) sum[i] += f[i] * im;
    }
    for (int i = 0; i < 4; i++) {
        const four re = sum[2 * i + 1], im = sum[2 * i];
        pulled[i] =
            cplx_scale(-c->im_weight, (cplx){(re[0] + re[1]) + (re[2] + re[3]), (im[0] + im[1]) + (im[2] + im[3])});
    }
}

typedef struct pair {
    cplx x, d;
} pair;

static void add(pair *to, pair what) { to->x = cplx_add(to->x, what.x), to->d = cplx_add(to->d, what.d); }

/// F^k v.
static pair step(const chain *c, int k, pair v)
{
    cplx p = chain_power(c, &c->powers.p, k), q = chain_power(c, &c->powers.q, k), r = cplx_mul(c->delta2, q);
    return (pair){cplx_add(cplx_mul(p, v.x), cplx_mul(q, v.d)), cplx_add(cplx_mul(r, v.x), cplx_mul(p, v.d))};
}

/// F*^k v.
static pair step_back(const chain *c, int k, pair v)
{
    cplx p = cplx_conj(chain_power(c, &c->powers.p, k)), q = cplx_conj(chain_power(c, &c->powers.q, k));
    cplx r = cplx_mul(cplx_conj(c->delta2), q);
    return (pair){cplx_add(cplx_mul(p, v.x), cplx_mul(r, v.d)), cplx_add(cplx_mul(q, v.x), cplx_mul(p, v.d))};
}

/// W_k v.
static pair gramian(const chain *c, int k, pair v)
{
    const chain_powers *t = &c->powers;
    cplx w01 = chain_power(c, &t->w01, k);
    return (pair){cplx_add(cplx_scale(t->w00[k], v.x), cplx_mul(w01, v.d)),
                  cplx_add(cplx_mul(cplx_conj(w01), v.x), cplx_scale(t->w11[k], v.d))};
}

/// How a pull on ν at a stretch's end acts through the slope there (top of chain.c): `jet` is its pull on the last jet.
static void pull_slope(const chain *c, const chain_stretch *s, const chain_node *q, cplx jet, pair *on_p, pair *on_q)
{
    const chain_speed *speed = &c->speed[q->view];
    const double v11 = s->form[FORM_V11];
    double weight = q->slope_weight / (1 + q->slope_weight * cplx_norm(speed->on_r) * (1 - v11));
    double pulled = weight * cplx_mul(jet, speed->on_r).re;
    cplx on_r = cplx_scale(pulled, cplx_conj(speed->on_r));
    add(on_q, (pair){cplx_mul(on_r, chain_entry(s, FORM_V01)), cplx_scale(v11, on_r)});
    add(on_q, (pair){cplx_scale(-pulled, cplx_conj(speed->on_x)), cplx_scale(-pulled, cplx_conj(speed->on_d))});
    on_r = cplx_scale(-1, on_r);
    add(on_p, (pair){cplx_mul(on_r, cplx_conj(chain_entry(s, FORM_C10))),
                     cplx_mul(on_r, cplx_conj(chain_entry(s, FORM_C11)))});
}

static void pull_stretch(chain *c, int j)
{
    const int next = chain_next(c, j);
    const chain_node *p = &c->nodes[j], *q = &c->nodes[next];
    const chain_stretch *s = &c->stretches[p->stretch];
    cplx weight[4], pulled[4], nu[2];
    pair on_p = {{0, 0}, {0, 0}}, on_nu = on_p;
    for (int k = 0; k < s->length; k += c->run) {
        chain_begin_run(c, p, q, k, nu, weight);
        pull_of_run(c, weight, s->length - k < c->run ? s->length - k : c->run, pulled);
        pair state = {pulled[0], pulled[1]}, costate = {pulled[2], pulled[3]};
        add(&costate, gramian(c, k, state));
        add(&on_p, step_back(c, k, state));
        add(&on_nu, step(c, s->length - k, costate));
    }
    const cplx v01 = chain_entry(s, FORM_V01), x = cplx_scale(-1, on_nu.x), d = cplx_scale(-1, on_nu.d);
    pair on_q = {cplx_add(cplx_scale(s->form[FORM_V00], on_nu.x), cplx_mul(v01, on_nu.d)),
                 cplx_add(cplx_mul(cplx_conj(v01), on_nu.x), cplx_scale(s->form[FORM_V11], on_nu.d))};
    add(&on_p, (pair){cplx_add(cplx_mul(cplx_conj(chain_entry(s, FORM_C00)), x),
                               cplx_mul(cplx_conj(chain_entry(s, FORM_C10)), d)),
                      cplx_add(cplx_mul(cplx_conj(chain_entry(s, FORM_C01)), x),
                               cplx_mul(cplx_conj(chain_entry(s, FORM_C11)), d))});
    if (q->slope_weight > 0) pull_slope(c, s, q, on_q.d, &on_p, &on_q);
    chain_pull(c, j, on_p.x, on_p.d);
    chain_pull(c, next, on_q.x, on_q.d);
}

/// The last node's own sample and the free samples after it.
static void pull_tail(chain *c)
{
    const int last = c->node_count - 1, count = c->count - c->nodes[last].sample;
    const chain_node *node = &c->nodes[last];
    pair state = {{node->value, node->x_im}, {node->d_re, node->d_im}}, on_node = {{0, 0}, {0, 0}};
    for (int k = 0; k < count; k += CHAIN_RUN) {
        const cplx weight[4] = {state.x, state.d};
        cplx pulled[4];
        pull_of_run(c, weight, count - k < CHAIN_RUN ? count - k : CHAIN_RUN, pulled);
        pair on_state = {pulled[0], pulled[1]};
        for (int i = 0; i < k; i += CHAIN_RUN) on_state = step_back(c, CHAIN_RUN, on_state);
        add(&on_node, on_state);
        if (k + CHAIN_RUN < count) state = step(c, CHAIN_RUN, state);
    }
    chain_pull(c, last, on_node.x, on_node.d);
}

void chain_pull_imaginary(chain *c, bool again)
{
    for (int j = 0; j < c->node_count; j++) c->rows[j].right[0] = c->rows[j].right[1] = c->rows[j].right[2] = 0;
    if (again || c->lost > TELLING_LOSS) chain_gradient(c); // includes the first solve's error
    for (int j = 0; j < chain_stretches(c); j++) pull_stretch(c, j);
    if (!c->cyclic) pull_tail(c);
    for (int j = 0; j < c->node_count; j++) {
        if (c->nodes[j].fixed) chain_hold_known(c, j);
    }
}

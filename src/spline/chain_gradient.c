/// The gradient at the chain's nodes, without squaring.
//
// This is −½ of the energy's gradient. A stretch from s_p that ends in s_q has the mismatch ε = s_q − F s_p. It is a small difference of
// both, so it is summed in double-double. Its costate ν = V ε then pulls with −ν at q and with +F* ν at p. (With all unknowns 0 nothing
// cancels: chain_pull_known().)
#include "spline/chain.h"
#include "spline/dd.h"

/// a·b added to a sum.
static dd add_product(dd sum, double a, double b) { return dd_add(sum, dd_product(a, b)); }

/// end − (f x + g d), a complex number.
static cplx mismatch(cplx end, cplx f, cplx x, cplx g, cplx d)
{
    dd re = dd_from(end.re), im = dd_from(end.im);
    re = add_product(add_product(re, -f.re, x.re), f.im, x.im);
    re = add_product(add_product(re, -g.re, d.re), g.im, d.im);
    im = add_product(add_product(im, -f.re, x.im), -f.im, x.re);
    im = add_product(add_product(im, -g.re, d.im), -g.im, d.re);
    return (cplx){re.hi + re.lo, im.hi + im.lo};
}

void chain_pull(const chain *c, int j, cplx on_x, cplx on_d)
{
    double *right = c->rows[j].right;
    right[0] += on_x.im, right[1] += on_d.re, right[2] += on_d.im;
}

/// A slope's pull on the state at its node.
static void pull_speed(const chain *c, int j, double pulled)
{
    const chain_speed *speed = &c->speed[c->nodes[j].view];
    chain_pull(c, j, cplx_scale(-pulled, cplx_conj(speed->on_x)), cplx_scale(-pulled, cplx_conj(speed->on_d)));
}

/// The pull of the stretch from node j and of the slope at its end, whose jet is the costate's second part.
static void pull_stretch(const chain *c, int j)
{
    const int next = chain_next(c, j);
    const chain_node *p = &c->nodes[j], *q = &c->nodes[next];
    const chain_stretch *s = &c->stretches[p->stretch];
    const chain_powers *t = &c->powers;
    cplx f00 = chain_power(c, &t->p, s->length), f01 = chain_power(c, &t->q, s->length);
    cplx f10 = cplx_mul(c->delta2, f01), f11 = f00;
    cplx xp = {p->value, p->x_im}, dp = {p->d_re, p->d_im};
    cplx e0 = mismatch((cplx){q->value, q->x_im}, f00, xp, f01, dp);
    cplx e1 = mismatch(chain_end_d(q), f10, xp, f11, dp);
    cplx v01 = chain_entry(s, FORM_V01);
    double v11 = s->form[FORM_V11];
    cplx n0 = cplx_add(cplx_scale(s->form[FORM_V00], e0), cplx_mul(v01, e1));
    cplx n1 = cplx_add(cplx_mul(cplx_conj(v01), e0), cplx_scale(v11, e1));
    if (q->slope_weight > 0) {
        double pulled = chain_slope_pull(c, q, n1, v11);
        pull_speed(c, next, pulled);
        cplx eta = cplx_scale(pulled, cplx_conj(c->speed[q->view].on_r)); // ν − V B η
        n0 = cplx_sub(n0, cplx_mul(v01, eta));
        n1 = cplx_sub(n1, cplx_scale(v11, eta));
    }
    if (!(q->fixed & NODE_STILL)) chain_pull(c, next, cplx_scale(-1, n0), cplx_scale(-1, n1));
    chain_pull(c, j, cplx_add(cplx_mul(cplx_conj(f00), n0), cplx_mul(cplx_conj(f10), n1)),
               cplx_add(cplx_mul(cplx_conj(f01), n0), cplx_mul(cplx_conj(f11), n1)));
}

static void pull_start(const chain *c)
{
    const chain_node *node = &c->nodes[0];
    const cplx growth = {c->lambda.re - 1, c->lambda.im}, x = {node->value, node->x_im}, d = {node->d_re, node->d_im};
    for (int i = 0; i < 2; i++) {
        const struct start_row *row = &c->start.row[i];
        cplx on_x = cplx_add(row->on_x, cplx_mul(row->on_e, growth)), on_d = row->on_e;
        cplx miss = cplx_scale(-row->weight, cplx_add(cplx_mul(on_x, x), cplx_mul(on_d, d)));
        chain_pull(c, 0, cplx_mul(cplx_conj(on_x), miss), cplx_mul(cplx_conj(on_d), miss));
    }
}

static void pull_form(const chain *c, int j, const state_form *h)
{
    const chain_node *node = &c->nodes[j];
    cplx x = {node->value, node->x_im}, d = {node->d_re, node->d_im};
    cplx on_x = cplx_add(cplx_scale(h->h00, x), cplx_mul(h->h01, d));
    cplx on_d = cplx_add(cplx_mul(cplx_conj(h->h01), x), cplx_scale(h->h11, d));
    chain_pull(c, j, cplx_scale(-1, on_x), cplx_scale(-1, on_d));
}

void chain_hold_known(const chain *c, int j)
{
    double *right = c->rows[j].right;
    const unsigned fixed = c->nodes[j].fixed;
    const cplx tie = chain_node_tie(c, &c->nodes[j]);
    right[0] += tie.re * right[1] + tie.im * right[2];
    if (fixed & NODE_KNOWN_X) right[0] = 0;
    if (fixed & NODE_KNOWN_D) right[1] = 0;
    if (fixed & NODE_KNOWN_D_IM) right[2] = 0;
}

void chain_gradient(chain *c)
{
    for (int j = 0; j < c->node_count; j++) c->rows[j].right[0] = c->rows[j].right[1] = c->rows[j].right[2] = 0;
    for (int j = 0; j < chain_stretches(c); j++) pull_stretch(c, j);
    if (!c->cyclic) {
        const state_form end = chain_end_form(c);
        pull_start(c);
        if (c->nodes[0].slope_weight > 0) pull_speed(c, 0, chain_slope_pull(c, &c->nodes[0], (cplx){0, 0}, 1));
        pull_form(c, c->node_count - 1, &end);
    }
    for (int j = 0; j < c->node_count; j++) {
        const state_form own = chain_node_form(&c->nodes[j]);
        if (own.h11 > 0) pull_form(c, j, &own);
        if (c->nodes[j].fixed) chain_hold_known(c, j);
    }
}

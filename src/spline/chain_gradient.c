/// The gradient at the chain's nodes, without squaring.
//
// −½ of the energy's gradient at the nodes, without squaring: a stretch that ends in s_q and would run freely to F s_p has the
// mismatch ε = s_q − F s_p, which cancels to a small part of both and is summed in double-double. Its costate ν = V ε then pulls
// with −ν at q and with +F* ν at p. (At the state where everything unknown is 0 nothing cancels: chain_pull_known().)
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

/// A pull on a node's x and d; Re x is known and takes none.
static void pull(const chain *c, int j, cplx on_x, cplx on_d)
{
    double *right = c->rows[j].right;
    if (!c->is_complex) {
        right[0] += on_d.re;
        return;
    }
    right[0] += on_x.im, right[1] += on_d.re, right[2] += on_d.im;
}

static void pull_stretch(const chain *c, int j)
{
    const chain_node *p = &c->nodes[j], *q = p + 1;
    const chain_stretch *s = &c->stretches[p->stretch];
    const chain_powers *t = &c->powers;
    cplx f00 = chain_power(c, &t->p, s->length), f01 = chain_power(c, &t->q, s->length);
    cplx f10 = cplx_mul(c->delta2, f01), f11 = f00;
    cplx xp = {p->value, p->x_im}, dp = {p->d_re, p->d_im};
    cplx e0 = mismatch((cplx){q->value, q->x_im}, f00, xp, f01, dp);
    cplx e1 = mismatch((cplx){q->d_re, q->d_im}, f10, xp, f11, dp);
    cplx v01 = chain_entry(s, FORM_V01);
    cplx n0 = cplx_add(cplx_scale(s->form[FORM_V00], e0), cplx_mul(v01, e1));
    cplx n1 = cplx_add(cplx_mul(cplx_conj(v01), e0), cplx_scale(s->form[FORM_V11], e1));
    pull(c, j + 1, cplx_scale(-1, n0), cplx_scale(-1, n1));
    pull(c, j, cplx_add(cplx_mul(cplx_conj(f00), n0), cplx_mul(cplx_conj(f10), n1)),
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
        pull(c, 0, cplx_mul(cplx_conj(on_x), miss), cplx_mul(cplx_conj(on_d), miss));
    }
}

static void pull_slope(const chain *c, int j)
{
    const chain_node *node = &c->nodes[j];
    double e = node->d_re + (c->lambda.re - 1) * node->value - c->lambda.im * node->x_im;
    double miss = -node->slope_weight * (e - node->slope);
    pull(c, j, (cplx){0, -c->lambda.im * miss}, (cplx){miss, 0});
}

/// Known unknowns take no correction; where Re e is known, Re d follows Im x.
static void hold_fixed(const chain *c, int j)
{
    double *right = c->rows[j].right;
    int width = c->is_complex ? 3 : 1;
    if (c->nodes[j].fixed & NODE_AT_REST) {
        for (int u = 0; u < width; u++) right[u] = 0;
    } else if (c->nodes[j].fixed & NODE_FIXED_E) {
        if (c->is_complex) right[0] += c->lambda.im * right[1];
        right[c->is_complex ? 1 : 0] = 0;
    }
}

void chain_gradient(chain *c)
{
    for (int j = 0; j < c->node_count; j++) c->rows[j].right[0] = c->rows[j].right[1] = c->rows[j].right[2] = 0;
    pull_start(c);
    for (int j = 0; j < c->node_count; j++) {
        if (c->nodes[j].slope_weight > 0) pull_slope(c, j);
        if (j + 1 < c->node_count) pull_stretch(c, j);
    }
    for (int j = 0; j < c->node_count; j++) {
        if (c->nodes[j].fixed) hold_fixed(c, j);
    }
}

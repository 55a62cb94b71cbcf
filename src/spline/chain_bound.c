/// A bound of the chain's error, from the inverse of its nodes' system: that of the band (minimise.c), with the stretches for rows.
//
// A stretch is the rows W^{−½}(s_q − F^L s_p). Its powers and Gramian are known to u, some ε for every sample of it. That moves its rows by
// ‖u |F| |s_p|‖_V and by a share u W₀₀W₁₁ / det W of themselves, and pulls on s_p by u |F|* |ν|. What the factor has lost is ρ times the
// solution, in the norm of the energy. The imaginary rows that are left out pull with ω |Im x_j| at every sample.
//
// What a sum of the gradient rounds pulls as well: 8 ε of each term.
//
// With D of the nodes, x between them is within Σ |column| √D of its state and costate, and √W₀₀ for what both ends leave open.
#include "spline/chain_nodes.h"
#include "spline/wide.h"
#include <float.h>

/// Rounding of a block L D Lᵀ of 3×3 blocks, and of its solve.
static const double of_blocks = 24 * DBL_EPSILON;

/// z ← Lᵀ Z L added to P, all symmetric: 00 01 02 11 12 22.
static void widen(double *z, const double *p, const double *l)
{
    const double full[9] = {z[0], z[1], z[2], z[1], z[3], z[4], z[2], z[4], z[5]};
    double zl[9];
    for (int r = 0; r < 3; r++) {
        for (int v = 0; v < 3; v++)
            zl[3 * r + v] = full[3 * r] * l[v] + full[3 * r + 1] * l[3 + v] + full[3 * r + 2] * l[6 + v];
    }
    for (int r = 0, i = 0; r < 3; r++) {
        for (int v = r; v < 3; v++, i++) z[i] = p[i] + l[r] * zl[v] + l[3 + r] * zl[3 + v] + l[6 + r] * zl[6 + v];
    }
}

/// The spread of a node's unknowns, and of what is tied to them; sums ρ.
static void put_spread(chain *c, int j, const double diagonal[3])
{
    static const unsigned known[3] = {NODE_KNOWN_X, NODE_KNOWN_D, NODE_KNOWN_D_IM};
    const chain_node *node = &c->nodes[j];
    chain_row *row = &c->rows[j];
    for (int i = 0; i < 3; i++) {
        const bool used = (c->is_complex || i == 1) && !(node->fixed & known[i]);
        const double z = diagonal[i] > 0 ? diagonal[i] : 0;
        row->spread[i] = used ? sqrt(z) : 0;
        if (used) c->rounding += of_blocks * z * row->entry[i];
    }
    const cplx tie = chain_node_tie(c, node);
    row->spread[1] += fabs(tie.re) * row->spread[0];
    row->spread[2] += fabs(tie.im) * row->spread[0];
}

static const int on_diagonal[3] = {0, 3, 5};

/// Of a loop's rows beside the first one, the open chain's inverse and what the first row adds by X.
static void spread_round(chain *c)
{
    const int last = c->node_count - 1;
    const double *first = c->rows[0].diagonal;
    double z[6] = {0}, x[9] = {0};
    for (int j = last; j > 0; j--) {
        const chain_row *row = &c->rows[j];
        double diagonal[3];
        if (!c->is_complex) {
            const double l = j < last ? row->below[4] : 0;
            z[3] = row->diagonal[3] + l * l * z[3], x[4] = c->to_first[j] - l * x[4];
            diagonal[0] = diagonal[2] = 0, diagonal[1] = z[3] + x[4] * x[4] * first[3];
        } else {
            const double none[9] = {0}, *l = j < last ? row->below : none, *g = c->to_first + 9 * j;
            double moved[9];
            widen(z, row->diagonal, l);
            for (int r = 0; r < 3; r++) {
                for (int v = 0; v < 3; v++)
                    moved[3 * r + v] = g[3 * r + v] - (l[r] * x[v] + l[3 + r] * x[3 + v] + l[6 + r] * x[6 + v]);
            }
            for (int i = 0; i < 9; i++) x[i] = moved[i];
            for (int r = 0; r < 3; r++) {
                const double a = x[3 * r], b = x[3 * r + 1], d = x[3 * r + 2];
                diagonal[r] = z[on_diagonal[r]] + (a * a * first[0] + b * b * first[3] + d * d * first[5]) +
                              2 * (a * b * first[1] + a * d * first[2] + b * d * first[4]);
            }
        }
        put_spread(c, j, diagonal);
    }
    put_spread(c, 0, (double[]){first[0], first[3], first[5]});
}

void chain_find_spread(chain *c)
{
    c->rounding = 0;
    if (c->cyclic) {
        spread_round(c);
    } else {
        double z[6] = {0};
        for (int j = c->node_count - 1; j >= 0; j--) {
            const chain_row *row = &c->rows[j];
            if (c->is_complex) {
                widen(z, row->diagonal, row->below);
            } else {
                z[3] = row->diagonal[3] + row->below[4] * row->below[4] * z[3];
            }
            put_spread(c, j, (double[]){z[0], z[3], z[5]});
        }
    }
    c->rounding *= c->lost; // the blocks are inverted as such
}

/// Rounding of a sum of the gradient.
static const double of_sums = 8 * DBL_EPSILON;

/// At least |z|.
static inline double size_of(cplx z) { return fabs(z.re) + fabs(z.im); }

/// What is summed over the rows.
typedef struct row_sums {
    double misses, pulls; ///< as of the band (system.h)
    double spread;        ///< the largest √D between nodes
    double steps;         ///< the largest rounding of what is filled between them
} row_sums;

static inline double square(double x) { return x * x; }
static inline double larger(double a, double b) { return a >= b ? a : b; } // NaN stays

void chain_measure(const chain *c, chain_stretch *s)
{
    const cplx_array *const columns[4] = {&c->powers.p, &c->powers.q, &c->pulled[0], &c->pulled[1]};
    const int run = s->length < c->run ? s->length : c->run;
    static const int entries[5] = {FORM_C00, FORM_C01, FORM_C10, FORM_C11, FORM_P01};
    const double delta = sqrt(size_of(c->delta2)), reach = fmin(s->length, 1 / delta);
    const double power = size_of(chain_power(c, &c->powers.p, s->length)),
                 step = size_of(chain_power(c, &c->powers.q, s->length));
    s->power[0] = power + delta * step, s->power[1] = step + reach * power, s->power[2] = delta * delta * s->power[1];
    for (int n = 0; n < 5; n++)
        s->size[n] = size_of((cplx){s->form[entries[n]], c->is_complex ? s->form[entries[n] + 1] : 0});
    for (int n = 0; n < 4; n++) {
        double largest = 0;
        for (int i = 0; i < run; i++) largest = fmax(largest, size_of(chain_power(c, columns[n], i)));
        s->column[n] = largest;
    }
}

static void add_stretch(const chain *c, int j, row_sums *sums)
{
    const chain_node *p = &c->nodes[j], *q = &c->nodes[chain_next(c, j)];
    const double *of_p = c->rows[j].spread, *of_q = c->rows[chain_next(c, j)].spread;
    const chain_stretch *s = &c->stretches[p->stretch];
    const int length = s->length;
    const double u = c->loss * (length + 8), *f = s->form;
    const double f00 = s->power[0], f01 = s->power[1], f10 = s->power[2], w00 = c->powers.w00[length],
                 w11 = c->powers.w11[length];
    const double xp = size_of((cplx){p->value, p->x_im}), dp = size_of((cplx){p->d_re, p->d_im});
    cplx nu[2];
    chain_costate(c, p, q, nu);
    const double n0 = size_of(nu[0]), n1 = size_of(nu[1]);
    const double energy = 2 * (w00 * n0 * n0 + w11 * n1 * n1), ratio = f[FORM_V00] * w00; // W₀₀ W₁₁ / det W
    sums->misses += square(2 * u * ratio) * energy;
    sums->misses +=
        2 * (f[FORM_V00] * square(u * (f00 * xp + f01 * dp)) + f[FORM_V11] * square(u * (f10 * xp + f00 * dp)));
    sums->misses += square(c->noise + DBL_EPSILON * fabs(p->value)) * (f[FORM_P00] + 2);
    sums->misses += square(c->noise + DBL_EPSILON * fabs(q->value)) * (f[FORM_V00] + 2);
    sums->pulls += u * ((f00 * n0 + f10 * n1) * of_p[0] + (f01 * n0 + f00 * n1) * (of_p[1] + of_p[2]));
    const double p0 = of_p[0], p1 = of_p[1] + of_p[2], q0 = of_q[0], q1 = of_q[1] + of_q[2], *size = s->size;
    const double xq = size_of((cplx){q->value, q->x_im}), dq = size_of((cplx){q->d_re, q->d_im}),
                 v01 = size_of(chain_entry(s, FORM_V01));
    sums->pulls += of_sums * (p0 * (size[0] * xq + size[2] * dq + f[FORM_P00] * xp + size[4] * dp) +
                              p1 * (size[1] * xq + size[3] * dq + size[4] * xp + f[FORM_P11] * dp) +
                              q0 * (size[0] * xp + size[1] * dp + f[FORM_V00] * xq + v01 * dq) +
                              q1 * (size[2] * xp + size[3] * dp + v01 * xq + f[FORM_V11] * dq));
    // between the nodes
    const double of_x = size[0] * q0 + size[2] * q1 + f[FORM_P00] * p0 + size[4] * p1;
    const double of_d = size[1] * q0 + size[3] * q1 + size[4] * p0 + f[FORM_P11] * p1;
    const double m0 = f00 * n0 + f10 * n1, m1 = f01 * n0 + f00 * n1, *most = s->column; // F*^L ν
    const double between = most[0] * p0 + most[1] * p1 + most[2] * of_x + most[3] * of_d + sqrt(w00);
    sums->spread = larger(sums->spread, between);
    sums->steps = larger(sums->steps, u * (most[0] * xp + most[1] * dp + most[2] * m0 + most[3] * m1));
}

/// A slope's weight at a node, with the jet before it known only to its variance, and how much of it rounding is.
static void add_slope(const chain *c, int j, row_sums *sums)
{
    const chain_node *node = &c->nodes[j];
    if (!(node->slope_weight > 0)) return;
    const chain_speed *speed = &c->speed[node->view];
    const double x = size_of((cplx){node->value, node->x_im}), d = size_of((cplx){node->d_re, node->d_im});
    const double off =
        32 * DBL_EPSILON * (size_of(speed->on_x) * x + size_of(speed->on_d) * d + fabs(node->slope)) + c->noise;
    const double pulled = node->slope_weight * off *
                          (size_of(speed->on_x) * c->rows[j].spread[0] +
                           size_of(speed->on_d) * (c->rows[j].spread[1] + c->rows[j].spread[2]));
    const double miss = sqrt(node->slope_weight) * off;
    sums->pulls += pulled;
    if (pulled > miss) sums->misses += miss * miss; // else it moves x as a pull alone
}

static void add_start(const chain *c, row_sums *sums)
{
    const chain_node *node = &c->nodes[0];
    const cplx growth = {c->lambda.re - 1, c->lambda.im}, x = {node->value, node->x_im}, d = {node->d_re, node->d_im};
    const cplx e = cplx_add(d, cplx_mul(growth, x));
    for (int i = 0; i < 2 && !c->cyclic; i++) {
        const struct start_row *row = &c->start.row[i];
        const cplx seen = cplx_add(cplx_mul(row->on_x, x), cplx_mul(row->on_e, e));
        const double off = row->loss.x * size_of(x) + row->loss.e * size_of(e) + 32 * DBL_EPSILON * size_of(seen);
        sums->misses +=
            row->weight * (off * off + square(c->noise + DBL_EPSILON * fabs(node->value)) * cplx_norm(row->on_x));
        sums->pulls += row->weight * size_of(seen) *
                       ((row->loss.x + row->loss.e) * c->rows[0].spread[0] +
                        row->loss.e * (c->rows[0].spread[1] + c->rows[0].spread[2]));
    }
}

/// Σ x².
WIDEST static double sum_squares(const double *x, int count)
{
    enum { LANES = 8 };
    double sum[LANES] = {0}, all = 0;
    int i = 0;
    for (; i + LANES <= count; i += LANES) {
        for (int n = 0; n < LANES; n++) sum[n] += x[i + n] * x[i + n];
    }
    for (; i < count; i++) all += x[i] * x[i];
    for (int n = 0; n < LANES; n++) all += sum[n];
    return all;
}

double chain_bound(const chain *c, double energy, const double *x_im)
{
    row_sums sums = {0};
    for (int j = 0; j < chain_stretches(c); j++) add_stretch(c, j, &sums);
    for (int j = 0; j < c->node_count; j++) add_slope(c, j, &sums);
    add_start(c, &sums);
    if (!c->cyclic) { // and the samples that run free after the last node
        const double *of = c->rows[c->node_count - 1].spread;
        const chain_node *last = &c->nodes[c->node_count - 1];
        const int after = c->count - last->sample;
        const double swing = fmin(after, 1 / sqrt(size_of(c->delta2)));
        sums.spread = fmax(sums.spread, of[0] + swing * (of[1] + of[2]));
        sums.steps += c->loss * (after + 8) *
                      (size_of((cplx){last->value, last->x_im}) + swing * size_of((cplx){last->d_re, last->d_im}));
    }
    if (c->im_weight > 0) { // as rows that miss, or as pulls
        const double norm = sqrt(sum_squares(x_im, c->count)), root = sqrt(c->im_weight);
        sums.pulls += norm * root * fmin(1, root * sums.spread * sqrt(c->count));
    }
    const double lost = c->rounding < 0.5 ? sqrt(fmax(energy, 0)) * c->rounding / (1 - c->rounding) : INFINITY;
    return sums.spread * (lost + sqrt(sums.misses) + sums.pulls) + sums.steps;
}

/// The spline in quadruple precision.
#include "quad.h"

#include "quad_math.h"
#include <assert.h>
#include <stdlib.h>

enum { BELOW = 5 }; ///< unknowns 2k (Re x_k) and 2k + 1 (Im x_k): a row reaches from x_{i−1} to x_{i+1}

/// A symmetric band: entry (i, j), i − BELOW ≤ j ≤ i, is at band[i][i − j].
typedef real band_row[BELOW + 1];

struct quad {
    int first, count;
    bool is_complex;
    number s[2], start_s[2]; ///< continuous poles; those of the start's cost
    real omega;
    band_row *band;
    real *right;
    bool *fixed;
};

static number poles(const wiggly_desc *d, real least, int which, real *omega)
{
    real w = 2 * M_PIq * (real)d->frequency.value, zeta = fmaxq(d->damping.value, least);
    *omega = d->mode == WIGGLY_CUBIC ? 0 : w;
    if (d->mode == WIGGLY_CUBIC) return 0;
    real sign = which ? -1 : 1;
    if (d->mode == WIGGLY_REAL && zeta > 1) return w * (-zeta + sign * sqrtq(zeta * zeta - 1));
    real turn = w * sqrtq(1 - zeta * zeta);
    number j = 1.0Qi;
    if (d->mode == WIGGLY_REAL) return -zeta * w + j * sign * turn;
    return -zeta * w + j * (turn + sign * (real)d->bandwidth.value * w);
}

/// Adds weight·|Σ c_k x_k|² for n neighbouring samples from `sample` on; its real part only outside complex mode.
static void add_row(struct quad *q, real weight, int sample, int n, const number *c)
{
    for (int part = 0; part < (q->is_complex ? 2 : 1); part++) {
        real value[6];
        for (int k = 0; k < n; k++) {
            value[2 * k] = part ? cimagq(c[k]) : crealq(c[k]);
            value[2 * k + 1] = !q->is_complex ? 0 : part ? crealq(c[k]) : -cimagq(c[k]);
        }
        for (int i = 0; i < 2 * n; i++) {
            for (int j = 0; j <= i; j++) q->band[2 * sample + i][i - j] += weight * value[i] * value[j];
        }
    }
}

static void add_start(struct quad *q, const wiggly_desc *d)
{
    real h = d->step;
    number l0 = cexpq(q->start_s[0] * h), l1 = cexpq(q->start_s[1] * h), a = l0 + l1, b = -l0 * l1;
    real h00 = (real)d->calm * (1 - cabsq(b) * cabsq(b));
    number h10 = -(real)d->calm * (a + conjq(a) * b);
    if (!(h00 > 1e-30Q)) return;
    add_row(q, h00, 0, 2, (number[]){1, conjq(h10) / h00});
    add_row(q, h00 - cabsq(h10) * cabsq(h10) / h00, 1, 1, (number[]){1});
}

/// A known unknown: its column goes to the right, its row becomes the identity's.
static void fix(struct quad *q, int u, real value)
{
    int n = 2 * q->count;
    for (int i = u - BELOW < 0 ? 0 : u - BELOW; i <= u + BELOW && i < n; i++) {
        real *entry = i < u ? &q->band[u][u - i] : &q->band[i][i - u];
        if (i != u) q->right[i] -= *entry * value;
        *entry = 0;
    }
    q->band[u][0] = 1;
    q->right[u] = value;
    q->fixed[u] = true;
}

static void factor_and_solve(struct quad *q)
{
    int n = 2 * q->count;
    for (int i = 0; i < n; i++) { // band[i][k] becomes L_{i,i−k}, band[i][0] the pivot
        for (int k = BELOW; k >= 0; k--) {
            int j = i - k;
            if (j < 0) continue;
            real sum = q->band[i][k];
            for (int m = j - BELOW + k < 0 ? 0 : i - BELOW < 0 ? 0 : i - BELOW; m < j; m++) {
                if (j - m <= BELOW) sum -= q->band[i][i - m] * q->band[j][j - m] * q->band[m][0];
            }
            q->band[i][k] = k ? sum / q->band[j][0] : sum;
        }
        assert(q->band[i][0] > 0);
        for (int k = 1; k <= BELOW && k <= i; k++) q->right[i] -= q->band[i][k] * q->right[i - k];
    }
    for (int i = n - 1; i >= 0; i--) {
        q->right[i] /= q->band[i][0];
        for (int k = 1; k <= BELOW && i + k < n; k++) q->right[i] -= q->band[i + k][k] * q->right[i + k];
    }
}

void quad_solve(const wiggly_desc *d, double *re, double *im)
{
    int earliest = d->samples;
    for (int k = 0; k < d->knot_count; k++) earliest = d->knots[k].sample < earliest ? d->knots[k].sample : earliest;
    struct quad q = {.first = earliest, .count = d->samples - earliest, .is_complex = d->mode == WIGGLY_COMPLEX};
    size_t n = 2 * (size_t)q.count;
    q.band = calloc(n, sizeof *q.band);
    q.right = calloc(n, sizeof *q.right);
    q.fixed = calloc(n, sizeof *q.fixed);
    real ignored, h = d->step, intervals = q.count - 1;
    for (int k = 0; k < 2; k++) {
        q.s[k] = poles(d, 0, k, &q.omega);
        q.start_s[k] = poles(d, 0.05Q, k, &ignored);
    }
    number l0 = cexpq(q.s[0] * h), l1 = cexpq(q.s[1] * h);
    for (int i = 1; i < q.count - 1; i++) add_row(&q, 1, i - 1, 3, (number[]){l0 * l1, -(l0 + l1), 1});
    real held = 1 / (powq(intervals, 4) * (1 + powq(q.omega * intervals * h, 8)));
    for (int i = 0; i < q.count; i++) q.band[2 * i + 1][0] += q.is_complex ? held : 1;
    add_start(&q, d);
    for (int k = 0; k < d->knot_count; k++) {
        const wiggly_knot *knot = &d->knots[k];
        int j = knot->sample - q.first;
        if (knot->has_slope) { // on x_j and x_{j+1}, the real part
            real w = (real)knot->stiffness * h, target = h * (real)knot->slope;
            q.band[2 * j][0] += w, q.band[2 * j + 2][0] += w, q.band[2 * j + 2][2] -= w;
            q.right[2 * j] -= w * target, q.right[2 * j + 2] += w * target;
        }
    }
    for (int k = 0; k < d->knot_count; k++) fix(&q, 2 * (d->knots[k].sample - q.first), d->knots[k].value);
    factor_and_solve(&q);
    for (int i = 0; i < d->samples; i++) {
        int k = i < q.first ? 0 : i - q.first;
        re[i] = (double)q.right[2 * k];
        if (im) im[i] = q.is_complex ? (double)q.right[2 * k + 1] : 0;
    }
    free(q.band);
    free(q.right);
    free(q.fixed);
}

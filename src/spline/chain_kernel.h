/// The nodes' system of a chain, one row at a time: the one text for a spline by itself and for several side by side. Whoever
/// includes this says what a `lane` is (a double, or a vector of one number a spline) and a `flag` (what comparing lanes gives).
/// Every lane goes through the same operations in the same order whatever its knots are, without fused multiply-add, so a spline
/// has the same bits by itself and in company.
///
/// Unknowns of a row are (Im x, Re d, Im d), a diagonal block is 00 01 02 11 12 22, a coupling A_{j+1,j} row-major; functions in
/// _one are for cubic and real mode, where Re d is the only unknown.
#ifndef SPLINE_CHAIN_KERNEL_H
#define SPLINE_CHAIN_KERNEL_H

#include "spline/chain.h"
#include <math.h>

/// A pivot below this part of what its diagonal would give has lost digits that refinement must bring back.
#define WEAKEST 1e-6

/// What a row takes from its node. A known unknown is kept out of the system by 0 in place of 1.
typedef struct kernel_node {
    lane x, d; ///< Re x, and Re d as far as it is known
    lane slope, weight;
    lane tie;            ///< Re d follows Im x by this much where Re e is known
    lane keep_x, keep_d; ///< whether Im x and Im d, whether Re d is unknown
} kernel_node;

/// Which lanes have positive pivots, and which have lost no digits.
typedef struct kernel_rank {
    flag sound, firm;
} kernel_rank;

/// The Hermitian form [h00 h01; h01* h11] of a node's state.
static inline void kernel_form(lane *d, lane h00, lane h01_re, lane h01_im, lane h11)
{
    d[0] += h00;
    d[1] += h01_im;
    d[2] += h01_re;
    d[3] += h11;
    d[5] += h11;
}

/// Its gradient, times −½, at a state that is real.
static inline void kernel_form_pull(lane *r, lane h01_re, lane h01_im, lane h11, lane x, lane d)
{
    r[0] -= h01_im * d;
    r[1] -= h01_re * x + h11 * d;
    r[2] += h01_im * x;
}

/// A stretch in the row of its first node, p, and the coupling.
static inline void kernel_leave(lane *d, lane *n, const lane *f)
{
    kernel_form(d, f[FORM_P00], f[FORM_P01], f[FORM_P01 + 1], f[FORM_P11]);
    n[0] = -f[FORM_C00], n[1] = -f[FORM_C01 + 1], n[2] = -f[FORM_C01];
    n[3] = f[FORM_C10 + 1], n[4] = -f[FORM_C11], n[5] = f[FORM_C11 + 1];
    n[6] = -f[FORM_C10], n[7] = -f[FORM_C11 + 1], n[8] = -f[FORM_C11];
}

/// The same in the row of its last node.
static inline void kernel_enter(lane *d, const lane *f)
{
    kernel_form(d, f[FORM_V00], f[FORM_V01], f[FORM_V01 + 1], f[FORM_V11]);
}

/// C* s_q − P s_p at the first node.
static inline void kernel_leave_pull(lane *r, const lane *f, const kernel_node *p, const kernel_node *q)
{
    r[0] -= f[FORM_C00 + 1] * q->x + f[FORM_C10 + 1] * q->d;
    r[1] += f[FORM_C01] * q->x + f[FORM_C11] * q->d;
    r[2] -= f[FORM_C01 + 1] * q->x + f[FORM_C11 + 1] * q->d;
    kernel_form_pull(r, f[FORM_P01], f[FORM_P01 + 1], f[FORM_P11], p->x, p->d);
}

/// C s_p − V s_q at the last node.
static inline void kernel_enter_pull(lane *r, const lane *f, const kernel_node *p, const kernel_node *q)
{
    r[0] += f[FORM_C00 + 1] * p->x + f[FORM_C01 + 1] * p->d;
    r[1] += f[FORM_C10] * p->x + f[FORM_C11] * p->d;
    r[2] += f[FORM_C10 + 1] * p->x + f[FORM_C11 + 1] * p->d;
    kernel_form_pull(r, f[FORM_V01], f[FORM_V01 + 1], f[FORM_V11], q->x, q->d);
}

/// weight (Re e − slope)², Re e = Re d + Re (λ−1) Re x − Im λ Im x.
static inline void kernel_slope(lane *d, const kernel_node *node, double turn)
{
    lane across = node->weight * turn;
    d[0] += across * turn;
    d[1] -= across;
    d[3] += node->weight;
}

static inline lane kernel_slope_miss(const kernel_node *node, double growth)
{
    return node->weight * (node->slope - (node->d + growth * node->x));
}

static inline void kernel_slope_pull(lane *r, const kernel_node *node, double growth, double turn)
{
    lane miss = kernel_slope_miss(node, growth);
    r[0] -= turn * miss;
    r[1] += miss;
}

/// Folds a tied Re d into Im x, and takes what is known out of the block; 1 on its diagonal.
static inline void kernel_hold(lane *d, const kernel_node *node)
{
    lane kx = node->keep_x, kd = node->keep_d, t = node->tie;
    d[0] = (d[0] + t * (2.0 * d[1] + t * d[3])) * kx + (1.0 - kx);
    d[1] = (d[1] + t * d[3]) * (kx * kd);
    d[2] = (d[2] + t * d[4]) * kx;
    d[3] = d[3] * kd + (1.0 - kd);
    d[4] = d[4] * (kx * kd);
    d[5] = d[5] * kx + (1.0 - kx);
}

/// The same in the columns of the coupling to the next node.
static inline void kernel_hold_columns(lane *n, const kernel_node *node)
{
    for (int v = 0; v < 9; v += 3) {
        n[v] = (n[v] + node->tie * n[v + 1]) * node->keep_x;
        n[v + 1] *= node->keep_d;
        n[v + 2] *= node->keep_x;
    }
}

/// The same in the rows of the coupling to the node before.
static inline void kernel_hold_rows(lane *n, const kernel_node *node)
{
    for (int v = 0; v < 3; v++) {
        n[v] = (n[v] + node->tie * n[3 + v]) * node->keep_x;
        n[3 + v] *= node->keep_d;
        n[6 + v] *= node->keep_x;
    }
}

static inline void kernel_hold_pull(lane *r, const kernel_node *node)
{
    r[0] = (r[0] + node->tie * r[1]) * node->keep_x;
    r[1] *= node->keep_d;
    r[2] *= node->keep_x;
}

/// p ← inverse of the symmetric s.
static inline kernel_rank kernel_invert(const lane *s, lane *p)
{
    lane c00 = s[3] * s[5] - s[4] * s[4], c01 = s[2] * s[4] - s[1] * s[5], c02 = s[1] * s[4] - s[2] * s[3];
    lane det = s[0] * c00 + s[1] * c01 + s[2] * c02;
    lane inverse = 1.0 / det;
    p[0] = c00 * inverse, p[1] = c01 * inverse, p[2] = c02 * inverse;
    p[3] = (s[0] * s[5] - s[2] * s[2]) * inverse;
    p[4] = (s[1] * s[2] - s[0] * s[4]) * inverse;
    p[5] = (s[0] * s[3] - s[1] * s[1]) * inverse;
    return (kernel_rank){
        .sound = (s[0] > 0.0) & (s[3] > 0.0) & (s[5] > 0.0) & (det > 0.0) & (det < INFINITY),
        .firm = det > WEAKEST * (s[0] * s[3] * s[5]),
    };
}

/// d ← inverse of the pivot d − L N*, with L and N the coupling to the node before: L = N times the inverse of its pivot.
static inline kernel_rank kernel_pivot(lane *d, const lane *l, const lane *n)
{
    lane s[6] = {
        d[0] - (l[0] * n[0] + l[1] * n[1] + l[2] * n[2]), d[1] - (l[0] * n[3] + l[1] * n[4] + l[2] * n[5]),
        d[2] - (l[0] * n[6] + l[1] * n[7] + l[2] * n[8]), d[3] - (l[3] * n[3] + l[4] * n[4] + l[5] * n[5]),
        d[4] - (l[3] * n[6] + l[4] * n[7] + l[5] * n[8]), d[5] - (l[6] * n[6] + l[7] * n[7] + l[8] * n[8]),
    };
    flag kept = (s[0] >= WEAKEST * d[0]) & (s[3] >= WEAKEST * d[3]) & (s[5] >= WEAKEST * d[5]);
    kernel_rank rank = kernel_invert(s, d);
    rank.firm &= kept;
    return rank;
}

/// L = N P for a symmetric P.
static inline void kernel_lower(lane *l, const lane *n, const lane *p)
{
    for (int v = 0; v < 9; v += 3) {
        lane a = n[v], b = n[v + 1], c = n[v + 2];
        l[v] = a * p[0] + b * p[1] + c * p[2];
        l[v + 1] = a * p[1] + b * p[3] + c * p[4];
        l[v + 2] = a * p[2] + b * p[4] + c * p[5];
    }
}

/// r −= L z.
static inline void kernel_forward(lane *r, const lane *l, const lane *z)
{
    for (int i = 0; i < 3; i++) r[i] -= l[3 * i] * z[0] + l[3 * i + 1] * z[1] + l[3 * i + 2] * z[2];
}

/// r ← P r − L* u, u the solution at the next node.
static inline void kernel_backward(lane *r, const lane *p, const lane *l, const lane *u)
{
    lane z0 = r[0], z1 = r[1], z2 = r[2];
    r[0] = p[0] * z0 + p[1] * z1 + p[2] * z2 - (l[0] * u[0] + l[3] * u[1] + l[6] * u[2]);
    r[1] = p[1] * z0 + p[3] * z1 + p[4] * z2 - (l[1] * u[0] + l[4] * u[1] + l[7] * u[2]);
    r[2] = p[2] * z0 + p[4] * z1 + p[5] * z2 - (l[2] * u[0] + l[5] * u[1] + l[8] * u[2]);
}

static inline lane kernel_leave_pull_one(const lane *f, const kernel_node *p, const kernel_node *q)
{
    return f[FORM_C01] * q->x + f[FORM_C11] * q->d - (f[FORM_P01] * p->x + f[FORM_P11] * p->d);
}

static inline lane kernel_enter_pull_one(const lane *f, const kernel_node *p, const kernel_node *q)
{
    return f[FORM_C10] * p->x + f[FORM_C11] * p->d - (f[FORM_V01] * q->x + f[FORM_V11] * q->d);
}

static inline lane kernel_hold_one(lane d, const kernel_node *node)
{
    return d * node->keep_d + (1.0 - node->keep_d);
}

/// s ← d − n² / s, the pivot: only a division and a difference wait for the pivot before.
static inline kernel_rank kernel_pivot_one(lane *s, lane d, lane n)
{
    *s = d - n * n / *s;
    return (kernel_rank){.sound = (*s > 0.0) & (*s < INFINITY), .firm = *s >= WEAKEST * d};
}

#endif

/// The nodes' system of a chain, row by row: shared by open chains and loops.
///
/// Unknowns of a row are (Im x, Re d, Im d), a diagonal block is 00 01 02 11 12 22, a coupling A_{j+1,j} row-major. In cubic and real mode
/// Re d is the only unknown; the compiler then drops the unused results of these functions.
#ifndef SPLINE_CHAIN_NODES_H
#define SPLINE_CHAIN_NODES_H

#include "spline/chain.h"
#include <math.h>

/// A row's numbers stay in registers from step to step.
#define ALWAYS_INLINE static inline __attribute__((always_inline))

/// A row's data from its node. Known unknowns are removed from the system by 0 instead of 1.
typedef struct kernel_node {
    double x, x_im, d, d_im;       ///< the known parts of x and d
    double tie, tie_im;            ///< change of Re d and Im d with Im x
    double keep_x, keep_d, keep_i; ///< whether Im x, Re d, Im d is unknown
} kernel_node;

/// A node's slope: (h speed − target)², with chain_speed's speed. Weight 0 if there is none.
typedef struct kernel_slope {
    double target, weight;
    double x_re, x_im, d_re, d_im, r_re, r_im;
} kernel_slope;

/// The slope as a row of the unknowns before and at the node, and its residual with all of these 0.
typedef struct kernel_link {
    double before[3], at[3], weight, miss;
} kernel_link;

/// Whether all pivots are positive, and how far they are below their entries, for all three of a row together.
typedef struct kernel_rank {
    bool sound;
    double lost;
} kernel_rank;

/// The Hermitian form [h00 h01; h01* h11] of a node's state.
ALWAYS_INLINE void kernel_form(double *d, double h00, double h01_re, double h01_im, double h11)
{
    d[0] += h00;
    d[1] += h01_im;
    d[2] += h01_re;
    d[3] += h11;
    d[5] += h11;
}

/// Its gradient, times −½, at a node. `posed`, here and below: Im x of some nodes is known.
ALWAYS_INLINE void kernel_form_pull(bool posed, double *r, double h00, double h01_re, double h01_im, double h11,
                                    const kernel_node *at)
{
    r[0] -= h01_im * at->d + h01_re * at->d_im;
    r[1] -= h01_re * at->x + h11 * at->d;
    r[2] -= h11 * at->d_im - h01_im * at->x;
    if (posed) r[0] -= h00 * at->x_im, r[1] -= h01_im * at->x_im, r[2] -= h01_re * at->x_im;
}

/// A stretch in the row of its first node, p, and the coupling.
ALWAYS_INLINE void kernel_leave(double *d, double *n, const double *f)
{
    kernel_form(d, f[FORM_P00], f[FORM_P01], f[FORM_P01 + 1], f[FORM_P11]);
    n[0] = -f[FORM_C00], n[1] = -f[FORM_C01 + 1], n[2] = -f[FORM_C01];
    n[3] = f[FORM_C10 + 1], n[4] = -f[FORM_C11], n[5] = f[FORM_C11 + 1];
    n[6] = -f[FORM_C10], n[7] = -f[FORM_C11 + 1], n[8] = -f[FORM_C11];
}

/// The same in the row of its last node.
ALWAYS_INLINE void kernel_enter(double *d, const double *f)
{
    kernel_form(d, f[FORM_V00], f[FORM_V01], f[FORM_V01 + 1], f[FORM_V11]);
}

/// C* s_q − P s_p at the first node.
ALWAYS_INLINE void kernel_leave_pull(bool is_complex, bool posed, double *r, const double *f, const kernel_node *p,
                                     const kernel_node *q)
{
    if (!is_complex) {
        r[1] += f[FORM_C01] * q->x + f[FORM_C11] * q->d - (f[FORM_P01] * p->x + f[FORM_P11] * p->d);
        return;
    }
    r[0] += f[FORM_C10] * q->d_im - (f[FORM_C00 + 1] * q->x + f[FORM_C10 + 1] * q->d);
    r[1] += f[FORM_C01] * q->x + f[FORM_C11] * q->d + f[FORM_C11 + 1] * q->d_im;
    r[2] += f[FORM_C11] * q->d_im - (f[FORM_C01 + 1] * q->x + f[FORM_C11 + 1] * q->d);
    if (posed) r[0] += f[FORM_C00] * q->x_im, r[1] += f[FORM_C01 + 1] * q->x_im, r[2] += f[FORM_C01] * q->x_im;
    kernel_form_pull(posed, r, f[FORM_P00], f[FORM_P01], f[FORM_P01 + 1], f[FORM_P11], p);
}

/// C s_p − V s_q at the last node.
ALWAYS_INLINE void kernel_enter_pull(bool is_complex, bool posed, double *r, const double *f, const kernel_node *p,
                                     const kernel_node *q)
{
    if (!is_complex) {
        r[1] += f[FORM_C10] * p->x + f[FORM_C11] * p->d - (f[FORM_V01] * q->x + f[FORM_V11] * q->d);
        return;
    }
    r[0] += f[FORM_C00 + 1] * p->x + f[FORM_C01 + 1] * p->d;
    r[1] += f[FORM_C10] * p->x + f[FORM_C11] * p->d;
    r[2] += f[FORM_C10 + 1] * p->x + f[FORM_C11 + 1] * p->d;
    if (posed) {
        r[0] += f[FORM_C00] * p->x_im + f[FORM_C01] * p->d_im;
        r[1] -= f[FORM_C10 + 1] * p->x_im + f[FORM_C11 + 1] * p->d_im;
        r[2] += f[FORM_C10] * p->x_im + f[FORM_C11] * p->d_im;
    }
    kernel_form_pull(posed, r, f[FORM_V00], f[FORM_V01], f[FORM_V01 + 1], f[FORM_V11], q);
}

/// The slope at node q, the jet there being ν_d = V₁₀ x_q + V₁₁ d_q − C₁₀ x_p − C₁₁ d_p of the stretch from p (see chain.c).
ALWAYS_INLINE kernel_link kernel_link_of(bool posed, const kernel_slope *s, const double *f, const kernel_node *p,
                                         const kernel_node *q)
{
    double a_re = s->x_re - (s->r_re * f[FORM_V01] + s->r_im * f[FORM_V01 + 1]);
    double a_im = s->x_im - (s->r_im * f[FORM_V01] - s->r_re * f[FORM_V01 + 1]);
    double b_re = s->d_re - s->r_re * f[FORM_V11], b_im = s->d_im - s->r_im * f[FORM_V11];
    double c_re = s->r_re * f[FORM_C10] - s->r_im * f[FORM_C10 + 1],
           c_im = s->r_re * f[FORM_C10 + 1] + s->r_im * f[FORM_C10];
    double e_re = s->r_re * f[FORM_C11] - s->r_im * f[FORM_C11 + 1],
           e_im = s->r_re * f[FORM_C11 + 1] + s->r_im * f[FORM_C11];
    double seen = (a_re * q->x + (b_re * q->d - b_im * q->d_im)) + (c_re * p->x + e_re * p->d);
    if (posed) seen -= a_im * q->x_im + (c_im * p->x_im + e_im * p->d_im);
    double size = s->r_re * s->r_re + s->r_im * s->r_im;
    double weight = s->weight / (1.0 + s->weight * size * (1.0 - f[FORM_V11]));
    return (kernel_link){{-c_im, e_re, -e_im}, {-a_im, b_re, -b_im}, weight, weight * (s->target - seen)};
}

/// The slope at the first node, without a jet.
ALWAYS_INLINE kernel_link kernel_link_first(bool posed, const kernel_slope *s, const kernel_node *q)
{
    double seen = s->x_re * q->x + (s->d_re * q->d - s->d_im * q->d_im);
    if (posed) seen -= s->x_im * q->x_im;
    double none = s->weight * 0.0;
    return (kernel_link){
        {none, none, none}, {-s->x_im, s->d_re, -s->d_im}, s->weight, s->weight * (s->target - seen)};
}

/// w g g* into a diagonal block.
ALWAYS_INLINE void kernel_add_square(double *d, double w, const double *g)
{
    double w0 = w * g[0], w1 = w * g[1];
    d[0] += w0 * g[0], d[1] += w0 * g[1], d[2] += w0 * g[2];
    d[3] += w1 * g[1], d[4] += w1 * g[2], d[5] += w * g[2] * g[2];
}

/// The coupling's part of a link.
ALWAYS_INLINE void kernel_add_coupling(double *n, const kernel_link *l)
{
    for (int v = 0; v < 3; v++) {
        double w = l->weight * l->at[v];
        n[3 * v] += w * l->before[0], n[3 * v + 1] += w * l->before[1], n[3 * v + 2] += w * l->before[2];
    }
}

ALWAYS_INLINE void kernel_add_pull(double *r, double miss, const double *g)
{
    for (int v = 0; v < 3; v++) r[v] += miss * g[v];
}

/// Moves a tied d to Im x, and removes known parts from the block; 1 on its diagonal.
ALWAYS_INLINE void kernel_hold(double *d, const kernel_node *node)
{
    double kx = node->keep_x, kd = node->keep_d, ki = node->keep_i, t = node->tie, s = node->tie_im;
    double d1 = d[1] + t * d[3] + s * d[4], d2 = d[2] + t * d[4] + s * d[5];
    d[0] = (d[0] + (t * (d[1] + d1) + s * (d[2] + d2))) * kx + (1.0 - kx);
    d[1] = d1 * (kx * kd);
    d[2] = d2 * (kx * ki);
    d[3] = d[3] * kd + (1.0 - kd);
    d[4] = d[4] * (kd * ki);
    d[5] = d[5] * ki + (1.0 - ki);
}

/// The same for the columns of the coupling to the next node.
ALWAYS_INLINE void kernel_hold_columns(double *n, const kernel_node *node)
{
    for (int v = 0; v < 9; v += 3) {
        n[v] = (n[v] + (node->tie * n[v + 1] + node->tie_im * n[v + 2])) * node->keep_x;
        n[v + 1] *= node->keep_d;
        n[v + 2] *= node->keep_i;
    }
}

/// The same for the rows of the coupling to the node before.
ALWAYS_INLINE void kernel_hold_rows(double *n, const kernel_node *node)
{
    for (int v = 0; v < 3; v++) {
        n[v] = (n[v] + (node->tie * n[3 + v] + node->tie_im * n[6 + v])) * node->keep_x;
        n[3 + v] *= node->keep_d;
        n[6 + v] *= node->keep_i;
    }
}

ALWAYS_INLINE void kernel_hold_pull(double *r, const kernel_node *node)
{
    r[0] = (r[0] + (node->tie * r[1] + node->tie_im * r[2])) * node->keep_x;
    r[1] *= node->keep_d;
    r[2] *= node->keep_i;
}

/// p ← inverse of the symmetric s.
ALWAYS_INLINE kernel_rank kernel_invert(const double *s, double *p)
{
    double c00 = s[3] * s[5] - s[4] * s[4], c01 = s[2] * s[4] - s[1] * s[5], c02 = s[1] * s[4] - s[2] * s[3];
    double det = s[0] * c00 + s[1] * c01 + s[2] * c02;
    double inverse = 1.0 / det;
    p[0] = c00 * inverse, p[1] = c01 * inverse, p[2] = c02 * inverse;
    p[3] = (s[0] * s[5] - s[2] * s[2]) * inverse;
    p[4] = (s[1] * s[2] - s[0] * s[4]) * inverse;
    p[5] = (s[0] * s[3] - s[1] * s[1]) * inverse;
    const bool sound = s[0] > 0.0 && s[3] > 0.0 && s[5] > 0.0 && det > 0.0 && det < INFINITY;
    return (kernel_rank){.sound = sound, .lost = inverse};
}

/// d ← inverse of the pivot d − L N*, with L and N the coupling to the node before: L = N times the inverse of its pivot.
ALWAYS_INLINE kernel_rank kernel_pivot(double *d, const double *l, const double *n)
{
    double s[6] = {
        d[0] - (l[0] * n[0] + l[1] * n[1] + l[2] * n[2]), d[1] - (l[0] * n[3] + l[1] * n[4] + l[2] * n[5]),
        d[2] - (l[0] * n[6] + l[1] * n[7] + l[2] * n[8]), d[3] - (l[3] * n[3] + l[4] * n[4] + l[5] * n[5]),
        d[4] - (l[3] * n[6] + l[4] * n[7] + l[5] * n[8]), d[5] - (l[6] * n[6] + l[7] * n[7] + l[8] * n[8]),
    };
    double entries = d[0] * d[3] * d[5];
    kernel_rank rank = kernel_invert(s, d);
    rank.lost *= entries;
    return rank;
}

/// L = N P for a symmetric P.
ALWAYS_INLINE void kernel_lower(double *l, const double *n, const double *p)
{
    for (int v = 0; v < 9; v += 3) {
        double a = n[v], b = n[v + 1], c = n[v + 2];
        l[v] = a * p[0] + b * p[1] + c * p[2];
        l[v + 1] = a * p[1] + b * p[3] + c * p[4];
        l[v + 2] = a * p[2] + b * p[4] + c * p[5];
    }
}

/// r −= L z.
ALWAYS_INLINE void kernel_forward(bool is_complex, double *r, const double *l, const double *z)
{
    if (!is_complex) r[1] -= l[4] * z[1];
    for (int i = 0; is_complex && i < 3; i++) r[i] -= l[3 * i] * z[0] + l[3 * i + 1] * z[1] + l[3 * i + 2] * z[2];
}

/// r ← P r − L* u, u the solution at the next node.
ALWAYS_INLINE void kernel_backward(bool is_complex, double *r, const double *p, const double *l, const double *u)
{
    if (!is_complex) {
        r[1] = p[3] * r[1] - l[4] * u[1];
        return;
    }
    double z0 = r[0], z1 = r[1], z2 = r[2];
    r[0] = p[0] * z0 + p[1] * z1 + p[2] * z2 - (l[0] * u[0] + l[3] * u[1] + l[6] * u[2]);
    r[1] = p[1] * z0 + p[3] * z1 + p[4] * z2 - (l[1] * u[0] + l[4] * u[1] + l[7] * u[2]);
    r[2] = p[2] * z0 + p[4] * z1 + p[5] * z2 - (l[2] * u[0] + l[5] * u[1] + l[8] * u[2]);
}

/// zᵀ P z.
ALWAYS_INLINE double kernel_energy(bool is_complex, const double *z, const double *p)
{
    if (!is_complex) return p[3] * (z[1] * z[1]);
    return (p[0] * (z[0] * z[0]) + p[3] * (z[1] * z[1]) + p[5] * (z[2] * z[2])) +
           2 * (p[1] * (z[0] * z[1]) + p[2] * (z[0] * z[2]) + p[4] * (z[1] * z[2]));
}

/// g = P F for a symmetric P.
ALWAYS_INLINE void kernel_times(double *g, const double *p, const double *f)
{
    for (int v = 0; v < 3; v++) {
        double a = f[v], b = f[3 + v], c = f[6 + v];
        g[v] = p[0] * a + p[1] * b + p[2] * c;
        g[3 + v] = p[1] * a + p[3] * b + p[4] * c;
        g[6 + v] = p[2] * a + p[4] * b + p[5] * c;
    }
}

/// d −= F* G; only the upper triangle is kept.
ALWAYS_INLINE void kernel_subtract_square(double *d, const double *f, const double *g)
{
    for (int r = 0, i = 0; r < 3; r++) {
        for (int c = r; c < 3; c++, i++) d[i] -= f[r] * g[c] + f[3 + r] * g[3 + c] + f[6 + r] * g[6 + c];
    }
}

/// f ← −L f.
ALWAYS_INLINE void kernel_fill_down(double *f, const double *l)
{
    for (int v = 0; v < 3; v++) {
        double a = f[v], b = f[3 + v], c = f[6 + v];
        for (int r = 0; r < 3; r++) f[3 * r + v] = -(l[3 * r] * a + l[3 * r + 1] * b + l[3 * r + 2] * c);
    }
}

/// r −= G* z.
ALWAYS_INLINE void kernel_subtract_transposed(double *r, const double *g, const double *z)
{
    for (int v = 0; v < 3; v++) r[v] -= g[v] * z[0] + g[3 + v] * z[1] + g[6 + v] * z[2];
}

/// s ← d − n² / s, the pivot outside complex mode: only a division and a difference wait for the pivot before.
ALWAYS_INLINE kernel_rank kernel_pivot_one(double *s, double d, double n)
{
    *s = d - n * n / *s;
    return (kernel_rank){.sound = *s > 0.0 && *s < INFINITY, .lost = d / *s};
}

/// Merges one row's rank into the total.
static inline void chain_add_rank(kernel_rank *all, kernel_rank rank)
{
    all->sound = all->sound && rank.sound;
    all->lost = rank.lost > all->lost ? rank.lost : all->lost;
}

/// Factors a loop's rows.
kernel_rank chain_close(chain *chain);

/// chain_solve_nodes() of a loop.
double chain_solve_loop(chain *chain);

#endif

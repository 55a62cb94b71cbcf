/// The least-squares problem of one spline: its rows, before anything is squared (docs/mathematics.md, Energy, times h³).
///
/// Unknowns are x_0 … x_{M−1}, M = `count`, sample k of the system being sample first + k of the spline; in a loop indices
/// are taken modulo M. Rows, each with the weight by which its square enters E·h³:
///     jet     1       r_i = x_{i+1} − a_i x_i − b_i x_{i−1} + f_i        i = 1 … M−2, in a loop 0 … M−1      (eq. 25)
///     slope   c_t h   Re(x_q − x_p) − target                              q = p + 1                           (eq. 9)
///     start   c H₀₀   x_0 + (−1+e) x_1   and   c d   x_1
///     im      w_k     Im x_k                                              complex mode
/// Fixed unknowns (knots on Re x, rest on both) keep the value that x holds.
#ifndef SPLINE_SYSTEM_H
#define SPLINE_SYSTEM_H

#include "spline/pentadiagonal.h"
#include "spline/poles.h"

enum { FIXED_RE = 1, FIXED_IM = 2 };

typedef struct slope_row {
    int p, q;
    double weight, target;
} slope_row;

typedef struct system_rows {
    int count; ///< M
    bool loop, is_complex;
    coefficients *at; ///< of row i; g is folded into `drive` and not kept
    cplx *drive;      ///< f_i
    double *im_weight;
    unsigned char *fixed;
    slope_row *slopes;
    int slope_count;
    start_cost start; ///< times calm; h00 = 0 where it is free
    double *x;        ///< 2M: re, im; in cubic and real mode M
    double *gradient; ///< like x
    double *jet;      ///< scratch of the residual: r as double-doubles, 4M or 2M
} system_rows;

/// gradient = −½ ∇(E·h³) at x, 0 at fixed unknowns; jets in double-double through the un-squared rows, so that it is right to
/// the last digits of x even where the squared matrix has lost them.
void system_gradient(const system_rows *rows);

/// The squared matrix Rᵀ W R with fixed unknowns as rows of the identity, ready to be factored.
void system_matrix(const system_rows *rows, pentadiagonal *matrix);

#endif

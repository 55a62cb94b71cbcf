/// Splines with constant parameters: a chain of knot-free stretches, each condensed to its end states.
#ifndef SPLINE_CHAIN_H
#define SPLINE_CHAIN_H

#include "spline/poles.h"

/// F^k = [p q; δ²q p] and W_k = [w00 w01; w01* w11] by k, real and imaginary parts apart.
typedef struct chain_powers {
    double *p_re, *p_im, *q_re, *q_im, *w01_re, *w01_im, *w00, *w11;
    int count;
} chain_powers;

/// A stretch of a given length, condensed: s_q* V s_q − 2 Re s_q* C s_p + s_p* P s_p.
typedef struct chain_stretch {
    int length;
    bool settles; ///< the jet of its last sample counts twice
    cplx p, q, r; ///< F^L = [p q; r p]
    double v00, v11, p00, p11;
    cplx v01, p01, c00, c01, c10, c11;
    double loss;                   ///< rounding of its powers, a share of 1, `reach` and `turn`
    double reach, turn;            ///< at least |q| and |r|
    double weight0, weight1, open; ///< √2V₀₀, √2V₁₁, √W₀₀
    double half_reach, half_open;  ///< of half the stretch
    double growth;                 ///< at least |p| and |q| / reach of F⁻ᵏ for that half
    double ratio;                  ///< W₀₀W₁₁ / det W
    double w00, w01, w11;          ///< sizes
} chain_stretch;

/// What the nodes' matrix depends on, by node.
typedef struct chain_place {
    int sample;
    double free[3]; ///< 1 for each of Im x, Re d and Im d that is unknown, else 0
    cplx tie;       ///< change of d with Im x, where d is not free
    double slope_weight;
    cplx on_x, on_d, on_r; ///< slope_weight (Re(on_x x + on_d d − on_r r) − slope)², r the jet at the node itself
} chain_place;

/// A node: the state (x, d) at a sample of the system, of which Re x is known.
typedef struct chain_node {
    chain_place at;
    double slope, slope_error; ///< of that row; and what the rounding of `slope` may be,
    double loss_x, loss_d;     ///< of on_x and on_d
    cplx x, d;                 ///< what is known → solution
} chain_node;

/// One block row of the nodes' system, L D Lᵀ, with unknowns Im x, Re d, Im d.
typedef struct chain_row {
    const chain_stretch *stretch; ///< to the next node
    double lower[3];              ///< 10 20 21 of L's own block
    double inverse[3];            ///< of D
    double below[9];              ///< of the next row: L's block times L's own block of this row, row-major
    double right[3];              ///< the gradient, times L⁻¹
    double entry[3];              ///< the matrix's diagonal
    double spread[2];             ///< √ of its inverse's diagonal: of Im x, and both of d
    double reach;                 ///< R of these (chain.c)
    double end[2], pull;          ///< sizes of ν and the slope's pull at the stretch's end
} chain_row;

typedef struct chain {
    cplx lambda, delta2; ///< mean of the poles, square of half their difference
    start_cost start;    ///< on the first node
    int count;           ///< samples of the system
    double im_weight;    ///< of (Im x)² at every sample; 0 if negligible
    double loss;         ///< rounding of the poles' powers, of a sample
    double fade;         ///< how fast the faster pole decays, a sample
    double tail_loss;    ///< of the free motion's step
    double noise;        ///< of the level that values are measured from
    chain_powers powers;
    chain_stretch *stretches; ///< by the node before; of a stretch as long as the one before unused
    chain_node *nodes;
    chain_row *rows;
    int node_count, stretch_count; ///< stretch_count: as far as they are used
    bool kept;                     ///< tables and factor are those of the filter, the start and all places
    bool sound;                    ///< the factor's pivots are positive
    double rounding;               ///< ρ of the factor
    double spread;                 ///< the largest √ of the inverse's diagonal, also between nodes
    double error;                  ///< bound of x's error
    double size;                   ///< of the solution
} chain;

/// Clears tables and factor, because the filter has changed or their memory was used otherwise.
void chain_forget(chain *chain);

#endif

/// Inside of a wiggly_solver: one block of memory, carved at creation.
#ifndef SPLINE_SOLVER_H
#define SPLINE_SOLVER_H

#include "spline/desc.h"
#include "spline/forced_response.h"
#include "spline/system.h"

// --- splines with constant parameters: a chain of knot-free stretches, each condensed to its end states (chain.c)

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

// --- what else a solver keeps

/// Results of constant parameters, computed anew only when they change.
typedef struct constant_filter {
    bool known;
    wiggly_desc desc; ///< its description, without knots
    double floor;     ///< least damping ratio
    poles at;
    start_cost start; ///< at calm 1; the oscillator's is in units of the jets' weight
    bool cut;         ///< of the speeds that it sees
    cplx lambda, delta2;
    speed_form ahead; ///< the speed that the poles give from a sample and the next
    double unit;      ///< |g|² of the oscillator: unit of all weights but the jets'
    cplx passive;     ///< h p of the free motion
    cplx tail;        ///< relative change of the free motion in one sample, as the poles give it
} constant_filter;

/// Memory for limits (limits.c).
typedef struct limit_memory {
    wiggly_knot *own, *all; ///< the knots by sample; with held samples
    int from, to;           ///< samples that may be held; to < from: none
    signed char *held;      ///< per sample: -1, at the low limit, 0, 1, at the high one, or 2, a knot
    double *pull;           ///< per held sample: how hard the limit holds it
    double *spare;          ///< for the search for them
    double *by_push;        ///< the same, two numbers a sample
    double *search;         ///< the same, four
    double *stiffness;      ///< the same
    double *free[2];        ///< after the last knot: the free Re w, and the effect of an Im w of 1 there
    double *pushed[2];      ///< the limits' effect on each of them
    int solves;             ///< after the first one, of the last limited spline
} limit_memory;

enum { FREE_RUN = 64 }; ///< samples of a free motion that are filled from one

/// Powers of a free motion's step, as far as they were needed.
typedef struct free_powers {
    cplx exponent; ///< of the step
    int count;
    double re[FREE_RUN], im[FREE_RUN];
} free_powers;

/// How far a push on one sample moves w at its gap's knot, and the row there.
typedef struct wind_push {
    cplx knot, row;
} wind_push;

/// From a knot to the next one. All is linear in w at the first.
typedef struct wind_gap {
    int from, end;    ///< their samples; in a loop the last end lies beyond the seam
    int begin;        ///< the first sample that is pushed
    double part;      ///< of that sample's interval
    bool is_cut;      ///< the gap is shorter than the wind-up
    wind_push *push;  ///< from `begin` to end − 1
    cplx back[2];     ///< how far w at `begin` moves knot and row, if its step to the next sample stays
    cplx at, step;    ///< w at `begin` and that step
    cplx coast[2];    ///< knot and row without a push
    cplx both;        ///< the covariance of knot and row
    double row, knot; ///< the variance of the row, with its own; of the knot where the row is met
    double doubt;     ///< how much of `knot` may be rounding, as a share: it is a difference of two
} wind_gap;

/// Memory for splines that wind up (wind_up.c).
typedef struct wind_memory {
    bool is_kept, is_constant; ///< the gaps are those of a solve before; parameters are constant
    wiggly_desc desc;          ///< its description, without knots
    double floor;              ///< its least damping ratio
    int count;
    wind_gap *gap;
    wind_push *push; ///< one a sample
} wind_memory;

struct wiggly_solver {
    int samples, knots; ///< capacity
    bool owned;
    const system_pulls *pulls; ///< on the splines to be solved, or NULL
    wiggly_method method;
    int longest_squared; ///< longer domains are factored without squaring: none, but tests set it
    system_rows rows;
    band_matrix band;
    constant_filter filter;
    chain chain; ///< shares its large arrays' memory with the matrix: a solve uses one of the two
    limit_memory limits;
    wind_memory wind;
    free_powers powers;
    forced_response response; ///< to the moving equilibrium
    double *y, *re, *im;      ///< arrays of a solve if the curve lacks them
    double *offset;           ///< what settling knots add to it
    wiggly_knot *filled;      ///< the knots of one of many
    wiggly_knot *scaled;      ///< the knots in other units
    bool y_is_safe;           ///< no equilibrium of the description that was checked last is beyond SAFE_VALUE
    double scale;             ///< those units: the power of two that all values are multiplied by
    int *order;               ///< indices of the description's knots by sample
    int *knot_at;             ///< scratch: index of the knot on each sample, or -1
};

/// How a minimisation went.
typedef struct minimum {
    bool solved;    ///< false: there is no factor, or a number overflowed
    bool by_chain;  ///< the chain found it
    bool lost;      ///< the rows hardly determine x: if the problem can be singular, it is
    double largest; ///< max |x|
    double error;   ///< bound of x's error, absolute
    int sweeps;     ///< corrections
} minimum;

/// A block handed out piece by piece; without one it is only measured.
typedef struct arena {
    unsigned char *block;
    size_t used;
    bool too_large;
} arena;

void *arena_take(arena *a, size_t count, size_t size);

/// Lays a solver into wiggly_memsize() bytes of zeroes, aligned for double. Their owner frees them.
wiggly_solver *solver_lay_out(void *memory, int samples, int knots);

/// Minimises the rows' energy over the unknowns that are not fixed; rows->x holds the fixed ones and 0 elsewhere.
minimum solver_minimise(wiggly_solver *solver);

/// The same with the factor that it left, for rows whose known values, targets, drives and pulls have changed.
minimum solver_find(wiggly_solver *solver);

/// wiggly_solve() of a description that was read (desc_read()).
wiggly_status solver_solve(wiggly_solver *solver, const wiggly_desc *desc, wiggly_curve *curve);

/// The same of one that was checked last (problem_check()), and whose values' squares a double can hold.
wiggly_status solver_solve_scaled(wiggly_solver *solver, const wiggly_desc *desc, wiggly_curve *curve);

/// Divides such a curve by the power of two that scale_values() multiplied `desc` by, and fills its slopes.
void solver_scale_back(const wiggly_solver *solver, const wiggly_desc *desc, wiggly_curve *curve);

/// Fills `slope` of a curve that is solved otherwise (evaluate.c).
void evaluate_slopes(const wiggly_desc *desc, wiggly_curve *curve);

/// Adds an error of x to that of the curve just solved. Returns the status, WIGGLY_INEXACT for WIGGLY_OK if that is too much.
wiggly_status solver_add_error(const wiggly_solver *solver, wiggly_curve *curve, double error, wiggly_status status);

#endif

/// Splines with constant parameters: a chain of knot-free stretches, each condensed to its end states.
#ifndef SPLINE_CHAIN_H
#define SPLINE_CHAIN_H

#include "spline/poles.h"

/// A complex array, real and imaginary parts apart; im is not used outside complex mode.
typedef struct cplx_array {
    double *re, *im;
} cplx_array;

/// Block sizes: powers are computed, and samples filled, this many at a time.
enum { CHAIN_BLOCK = 8 };

/// F^k = p + q [0 1; δ² 0] and W_k = [w00 w01; w01* w11] for k = 0 … longest stretch, in whole blocks.
typedef struct chain_powers {
    cplx_array p, q, w01;
    double *w00, *w11;
} chain_powers;

/// Indices of the entries of a stretch's form; the complex ones are two numbers, re and im.
enum {
    FORM_V00,
    FORM_V11,
    FORM_P00,
    FORM_P11,
    FORM_V01,
    FORM_P01 = FORM_V01 + 2,
    FORM_C00 = FORM_P01 + 2,
    FORM_C01 = FORM_C00 + 2,
    FORM_C10 = FORM_C01 + 2,
    FORM_C11 = FORM_C10 + 2,
    FORM_SIZE = FORM_C11 + 2
};

/// A stretch of a given length, condensed: s_q* V s_q − 2 Re s_q* C s_p + s_p* P s_p.
typedef struct chain_stretch {
    int length;
    bool settles; ///< the jet of its last sample counts twice
    double form[FORM_SIZE];
    double power[3];  ///< what |F^L|'s entries may be off by, in units of rounding: 00 and 11, 01, 10
    double size[5];   ///< of C and of P₀₁
    double column[4]; ///< the largest of each column that a run is filled from
} chain_stretch;

/// The known parts of a node's state (x, d) besides Re x.
enum {
    NODE_FIXED_E = 1,     ///< Re e: the next sample is keyed
    NODE_AT_REST = 2,     ///< all of it
    NODE_FROM_REST = 4,   ///< x, and d costs twice what a jet does
    NODE_SETTLED = 8,     ///< d, from x: the motion after it is free
    NODE_POSE = 16,       ///< Im x
    NODE_FIXED_E_IM = 32, ///< Im e: the next sample is a pose
    NODE_STILL = 64,      ///< d of the stretch before it is 0, and its two sides are independent

    NODE_KNOWN_X = NODE_AT_REST | NODE_FROM_REST | NODE_POSE,
    NODE_KNOWN_D = NODE_AT_REST | NODE_FIXED_E | NODE_SETTLED,
    NODE_KNOWN_D_IM = NODE_AT_REST | NODE_FIXED_E_IM | NODE_SETTLED,
};

/// From which side a node's speed is seen: the sample ahead, both neighbours, the sample behind, or the free motion.
typedef enum chain_view { VIEW_AHEAD, VIEW_BOTH, VIEW_BEHIND, VIEW_TAIL, VIEW_COUNT } chain_view;

/// h times a speed: Re(on_x x + on_d d − on_r r), r the jet at the node itself.
typedef struct chain_speed {
    cplx on_x, on_d, on_r;
} chain_speed;

/// A node: the state (x, d) at a sample k of the system, of which Re x is known. e is x_{k+1} − x_k.
typedef struct chain_node {
    int sample;
    unsigned fixed;
    double value;   ///< Re x
    double im;      ///< Im x of a pose, else 0
    double e;       ///< Re e if it is known
    double next_im; ///< Im x of the next sample where Im e is fixed
    chain_view view;
    double slope, slope_weight; ///< slope_weight (h speed − slope)²
    int stretch;                ///< to the next node
    double x_im, d_re, d_im;    ///< solution
} chain_node;

/// One block row of the nodes' system: unknowns (Im x, Re d, Im d), outside complex mode the middle one alone.
typedef struct chain_row {
    double diagonal[6]; ///< 00 01 02 11 12 22 → inverse of the pivot block
    double below[9];    ///< A_{j+1,j}, row-major → L_{j+1,j}
    double right[3];    ///< → solution
    double entry[3];    ///< the diagonal before
    double spread[3];   ///< √ of the inverse's diagonal, 0 for what is known; of d also where it is tied to Im x
} chain_row;

enum { CHAIN_RUN = 64 }; ///< the most samples that are filled from one state

typedef struct chain {
    bool is_complex;
    bool cyclic;         ///< a loop: the first node follows the last
    int count;           ///< samples of the system; a loop's are counted from its first node on
    int turned;          ///< a loop's: sample of its first node
    cplx lambda, delta2; ///< mean of the poles, square of half their difference
    start_cost start;    ///< times calm; on the first node
    double im_weight;    ///< of (Im x)² at every sample; 0 if negligible
    chain_speed speed[VIEW_COUNT];
    cplx tail;       ///< d / x of a settled node
    bool oscillates; ///< speeds are those given by the poles
    bool settles;    ///< the last node is settled, or the second sample of a last pair is
    bool posed;      ///< some Im x is known
    int run;         ///< samples of a stretch that are filled from one state and costate
    chain_powers powers;
    cplx_array pulled[2]; ///< first row of W_i F*^{−i}, i = 0 … run − 1
    cplx_array back;      ///< (det F)*^{−i}, for these
    int *stretch_of[2];   ///< by length: 1 + index of the stretch, 0: none yet; the second are those that settle
    chain_stretch *stretches;
    int stretch_count, stretch_capacity;
    int powers_count; ///< k for which there are powers
    chain_node *nodes;
    int node_count;
    chain_row *rows;
    /// A loop's: for each row but the first, the inverse of its pivot times its coupling to the first, 3×3 or 1.
    double *to_first;
    bool kept; ///< tables and factor are those of the nodes' samples, fixed and slope_weight, and of everything above
    bool sound;         ///< the factor's pivots are positive
    double loss;        ///< rounding of the poles' powers, of a sample
    double noise;       ///< rounding of the level that values are measured from
    double lost;        ///< entries over pivots of the factor, the largest of its rows
    double rounding;    ///< ρ of the factor
    double error;       ///< bound of x's error
    double size;        ///< of the solution
    double cubic_bound; ///< both poles at 1: a bound for |x|
} chain;

/// Solves for the nodes and writes x of every sample of the system (x_im only in complex mode). If `kept` is set, only values have changed
/// since the last solve, and its factor is reused. false if the nodes' system has no factor, or numbers are so large that sums might overflow.
bool chain_solve(chain *chain, double *x_re, double *x_im);

/// Clears tables and factor, because the filter has changed or their memory was used otherwise.
void chain_forget(chain *chain);

/// A form [h00 h01; h01* h11] of a state.
typedef struct state_form {
    double h00, h11;
    cplx h01;
} state_form;

/// The start's cost on the first state; and the jet's cost of a settled sample that is the second of the last node's pair, else 0.
state_form chain_start_form(const chain *chain);
state_form chain_end_form(const chain *chain);
/// From rest d is the jet there, and counts twice.
static inline state_form chain_node_form(const chain_node *node)
{
    return (state_form){.h11 = node->fixed & NODE_FROM_REST ? 2 : 0};
}

/// How much Re d and Im d of a node change with its Im x.
static inline cplx chain_node_tie(const chain *c, const chain_node *node)
{
    if (node->fixed & NODE_SETTLED) return (cplx){-c->tail.im, c->tail.re};
    return (cplx){node->fixed & NODE_FIXED_E && c->is_complex ? c->lambda.im : 0,
                  node->fixed & NODE_FIXED_E_IM ? -c->lambda.re : 0};
}

/// d of a node, as the end of the stretch before it.
static inline cplx chain_end_d(const chain_node *node)
{
    if (node->fixed & NODE_STILL) return (cplx){0, 0};
    return (cplx){node->d_re, node->d_im};
}

/// Weight times the excess of a slope's speed at the nodes' present state. `jet` is the jet from the stretch before, and V₁₁ of its form how
/// much it is held; 0 and 1 if there is no stretch.
double chain_slope_pull(const chain *chain, const chain_node *node, cplx jet, double v11);

/// An entry of a table of powers.
static inline cplx chain_power(const chain *c, const cplx_array *table, int k)
{
    return (cplx){table->re[k], c->is_complex ? table->im[k] : 0};
}

/// An entry of a stretch's form.
static inline cplx chain_entry(const chain_stretch *stretch, int at)
{
    return (cplx){stretch->form[at], stretch->form[at + 1]};
}

/// The steps of chain_solve().
void chain_make_tables(chain *chain);
void chain_assemble(chain *chain);
bool chain_factor(chain *chain);
/// rows' right ← solution; returns b·A⁻¹b.
double chain_solve_nodes(chain *chain);
/// rows' right ← the right-hand side: −½ of the energy's gradient with all unknowns 0.
void chain_pull_known(chain *chain);
/// The same at the nodes' present state.
void chain_pull(chain *chain);
/// rows' spread, and ρ.
void chain_find_spread(chain *chain);
/// Of a stretch what the bound needs.
void chain_measure(const chain *chain, chain_stretch *stretch);
/// A bound of the error of x, for the energy that chain_solve_nodes() returned of the last correction.
double chain_bound(const chain *chain, double energy, const double *x_im);
/// The costate ν at a stretch's end.
void chain_costate(const chain *chain, const chain_node *p, const chain_node *q, cplx nu[2]);
static inline int chain_next(const chain *c, int j) { return j + 1 < c->node_count ? j + 1 : 0; }
/// Number of stretches: one less than nodes, in a loop the same.
static inline int chain_stretches(const chain *c) { return c->cyclic ? c->node_count : c->node_count - 1; }
#endif

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
} chain_row;

enum { CHAIN_RUN = 64 }; ///< the most samples that are filled from one state

/// Ratio of entries to pivots from which the remaining error is reported.
#define TELLING_LOSS 300

typedef enum chain_rank {
    CHAIN_LOST, ///< a pivot is not positive
    CHAIN_WEAK, ///< a pivot has lost digits: to be refined
    CHAIN_FIRM,
} chain_rank;

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
    chain_rank rank;    ///< of the factor
    bool loose;         ///< the start is nearly free, so errors are larger
    double rounding;    ///< of the poles
    double lost;        ///< entries over pivots of the factor, the largest of its rows
    double error;       ///< estimated error of x
    double size;        ///< of the solution
    double cubic_bound; ///< both poles at 1: a bound for |x|
} chain;

/// Solves for the nodes and writes x of every sample of the system (x_im only in complex mode). If `kept` is set, only values have changed
/// since the last solve, and its factor is reused. false if the nodes' system has lost too many digits, or numbers are so large that sums
/// might overflow.
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
chain_rank chain_factor(chain *chain);
/// rows' right ← solution.
void chain_solve_nodes(chain *chain);
/// rows' right ← the right-hand side: −½ of the energy's gradient with all unknowns 0.
void chain_pull_known(chain *chain);
/// The same at the nodes' present state, in double-double.
void chain_gradient(chain *chain);
/// Adds a pull on a node's x and d to rows' right, except on Re x, which is known.
void chain_pull(const chain *chain, int j, cplx on_x, cplx on_d);
/// Removes it from known parts, and moves it from a tied d to Im x.
void chain_hold_known(const chain *chain, int j);
/// The same for the imaginary rows alone; from the second time on with the gradient, which is then not yet 0.
void chain_pull_imaginary(chain *chain, bool again);
static inline int chain_next(const chain *c, int j) { return j + 1 < c->node_count ? j + 1 : 0; }
/// Number of stretches: one less than nodes, in a loop the same.
static inline int chain_stretches(const chain *c) { return c->cyclic ? c->node_count : c->node_count - 1; }
/// State and costate at the start of the run at sample k of a stretch. ν is that of the stretch's end, set with the second run.
void chain_begin_run(const chain *chain, const chain_node *p, const chain_node *q, int k, cplx nu[2], cplx weight[4]);
#endif

/// The least-squares problem of one spline: its rows, before squaring (docs/mathematics.md, Energy, times h³).
///
/// Unknowns are x_0 … x_{M−1}, M = `count`, sample k of the system being sample first + k of the spline; in a loop indices
/// are taken modulo M. Rows, each with the weight by which its square enters E·h³:
///     jet     w_i     r_i = x_{i+1} − a_i x_i − b_i x_{i−1} + f_i        i = jet_from … jet_to                (eq. 25)
///     slope   w       Re(here x_j + ahead (x_{j+1} − x_j) + behind (x_j − x_{j−1})) − target                  (eq. 9)
///     start   w       on_x x_0 + on_e (x_1 − x_0), twice
///     im      w_k     Im x_k                                              complex mode
/// Outside a loop x_{−1} is 0 and x_M is (1 + tail) x_{M−1}. Fixed unknowns keep the value in x: Re x at knots, both parts at poses and at
/// rest, every Im x outside complex mode. A still knot has two jet rows, r_i with x_i for x_{i+1} and with x_i for x_{i−1}, if there are samples
/// on that side, so that its two sides are independent.
#ifndef SPLINE_SYSTEM_H
#define SPLINE_SYSTEM_H

#include "spline/pentadiagonal.h"
#include "spline/poles.h"

enum { FIXED_RE = 1, FIXED_IM = 2, FIXED_STILL = 4 };

typedef struct slope_row {
    int sample;
    cplx here, ahead, behind;
    double weight, target;
} slope_row;

/// Pulls on x of one spline, by sample. They fix nothing, but for where a spline starts and ends, samples from the first to the last pin count
/// as knots (pins.c).
typedef struct system_pulls {
    int count;
    int earliest, latest; ///< samples of pins, -1: none
    int *sample;          ///< of the spline
    cplx *pull;           ///< on Re x and Im x: added to −½ ∇(E·h³)
} system_pulls;

typedef struct system_rows {
    int count; ///< M
    bool loop, is_complex;
    bool fast;      ///< some coefficients have a rest
    bool unlike;    ///< jets' weights differ so much that a squared matrix would lose the light ones
    bool cut;       ///< a jet would weigh more beside another than it does here
    double steep;   ///< the largest cut of a speed that a row sees (speed_form)
    bool is_tested; ///< knots so far apart, or jets so unlike, that the pivots alone do not show the digits lost
    bool is_held;   ///< the start costs enough, or there is none: only knot-free stretches cost digits
    double noise;   ///< rounding of the known values, if they are differences to an equilibrium
    bool is_open;   ///< the start costs nothing
    int jet_from, jet_to; ///< a loop has a jet at every sample
    double stretch;       ///< samples of the longest knot-free stretch, or until x swings back if that is less
    coefficients *at;     ///< of row i, except g, which is included in `drive`
    cplx *drive;          ///< f_i
    const double *driven; ///< y from row 0 on, for f_i = g_i ÿ_i with all its digits; or NULL
    double *jet_weight;
    double *im_weight;
    unsigned char *fixed;
    slope_row *slopes; ///< by sample
    int slope_count;
    start_cost start;          ///< times calm; weights 0 if it is free
    const system_pulls *pulls; ///< or NULL
    int first;                 ///< the spline's sample of row 0, from which pulls are counted
    cplx tail;                 ///< x_M / x_{M−1} − 1, for the free motion after the last sample
    double *x;                 ///< 2M: re, im
    double *gradient;          ///< like x
    double *jet;               ///< scratch of the residual: w r as double-doubles, 4M
} system_rows;

/// A row's coefficients on the existing ones of the samples j − 1, j and j + 1: `before` and `after` are their numbers or -1.
typedef struct stencil {
    int before, at, after;
    cplx c[3];
} stencil;

/// A slope row as coefficients; a sample after the last is expressed by the last.
stencil system_slope_stencil(const system_rows *rows, const slope_row *slope);

/// gradient = −½ ∇(E·h³) at x, 0 at fixed unknowns. Jets are double-double through the unsquared rows, so that it is right to the last digits
/// of x even if the squared matrix has lost them.
void system_gradient(const system_rows *rows);

/// The same if x holds only known values: these are small sums, and plain double is enough.
void system_right_side(const system_rows *rows);

/// The rows' pull at x, in plain double, at fixed unknowns, too: the force that holds them is its opposite.
void system_forces(const system_rows *rows);

/// Sets all known values, targets and drives to 0: the solution is then the response to pulls.
void system_forget_known(system_rows *rows);

/// The squared matrix Rᵀ W R with fixed unknowns as rows of the identity, ready to be factored.
void system_matrix(const system_rows *rows, pentadiagonal *matrix);

/// The same factor as pentadiagonal_factor() of that, but by rotations from the rows themselves, so that the condition is not squared. For
/// long domains.
pentadiagonal_rank orthogonal_factor(const system_rows *rows, pentadiagonal *matrix);

#endif

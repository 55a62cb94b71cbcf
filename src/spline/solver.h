/// Inside of a wiggly_solver: one block of memory, carved at creation.
#ifndef SPLINE_SOLVER_H
#define SPLINE_SOLVER_H

#include "spline/chain.h"
#include "spline/desc.h"
#include "spline/forced_response.h"
#include "spline/system.h"

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

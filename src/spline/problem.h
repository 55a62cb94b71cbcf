/// A description with the rules of the start applied. Internal to src/spline.
#ifndef SPLINE_PROBLEM_H
#define SPLINE_PROBLEM_H

#include "spline/forced_response.h"
#include "spline/solver.h"
#include <math.h>

/// Larger values and equilibria are refused, so that sums of them do not overflow.
#define LARGEST_VALUE 1e300

/// Up to this, and from its inverse on, squares and products with weights stay in range.
#define SAFE_VALUE 0x1p100

/// A heavier slope row is met to the last digit anyway, and might overflow.
#define STIFFEST 1e20

/// Replaces a calm of 0 if the document is singular.
#define FALLBACK_CALM 0.05

/// Below this share of ω_n a wind-up takes no slope.
#define SLOWEST_SLOPE 0.3

/// Default cost of missing a slope, 1/s.
#define USUAL_STIFFNESS 1000

static inline double knot_stiffness(const wiggly_knot *knot)
{
    return knot->stiffness > 0 ? knot->stiffness : USUAL_STIFFNESS;
}

/// A solve in progress: the description with the rules of start and end applied. x = u + w: u is the response to the moving equilibrium, w is
/// solved for. A cubic on a moving equilibrium is solved for its total.
typedef struct problem {
    const wiggly_desc *desc;
    const double *y;     ///< equilibrium of the whole domain, if it moves; a loop's last is its first
    const double *about; ///< y + Re u of every sample, the level that w is measured from; NULL if that is `level`
    double level;
    forced_response response; ///< u, if there is one, with the noise of a variation; else its arrays are NULL
    cplx held;                ///< the noise before `first`
    wiggly_start start;
    double calm;
    wiggly_status status;      ///< WIGGLY_CALMED if u is for another calm than the given one
    int first;                 ///< sample of the system's row 0
    int count;                 ///< samples from there to the domain's end (in a loop, round it)
    const system_pulls *pulls; ///< or NULL
    int earliest, latest;      ///< samples of the earliest and of the latest knot or pull, or -1
    bool settles;              ///< w is free after the latest knot: the system ends there
    bool settled;              ///< knots that settle move the equilibrium
    bool thorough;             ///< a first bound was too wide: no chain, and what rows see of the response's error
    bool level_slope;          ///< a level slope is implied at the earliest knot
    bool free_end;             ///< c·H = 0
    int still;                 ///< sample of the earliest still knot, or -1
    double unit;               ///< unit of all weights but the jets': the oscillator's |g|² at `first`, else 1
    start_cost cost;           ///< of the start's swing, times calm; weights 0 if it is free
} problem;

static inline double problem_y(const problem *p, int sample) { return p->y ? p->y[sample] : p->level; }

/// The level that w is measured from: a knot's w is its value minus this.
static inline double problem_about(const problem *p, int sample) { return p->about ? p->about[sample] : p->level; }

/// A knot's target for w. For a still knot it is 0 or, if a cubic is solved for its total, keeps that at the equilibrium.
static inline double problem_knot_re(const problem *p, const wiggly_knot *knot)
{
    if (!knot->still) return knot->value - problem_about(p, knot->sample);
    return p->about ? 0 : problem_y(p, knot->sample) - p->level;
}
static inline double problem_knot_im(const problem *p, const wiggly_knot *knot)
{
    if (!knot->has_phase) return 0;
    return knot->phase - (p->response.im ? p->response.im[knot->sample] : 0);
}

/// Whether Im x of a knot is known, too.
static inline bool problem_is_whole(const problem *p, const wiggly_knot *knot)
{
    return p->desc->mode == WIGGLY_COMPLEX && (knot->has_phase || knot->still);
}

/// Rows of the system: the samples that are solved for.
static inline int problem_rows(const problem *p) { return p->settles ? p->latest - p->first + 1 : p->count; }

/// The lowest damping ratio that the problem uses.
static inline double problem_least_damping(const problem *p)
{
    return p->start == WIGGLY_LOOP ? LEAST_DAMPING * p->calm : 0;
}

/// The filter of a problem without pole tracks.
const constant_filter *problem_filter(wiggly_solver *solver, const problem *p);

/// Whether there are knots or pulls.
static inline bool problem_is_asked(const problem *p) { return p->earliest >= 0; }

/// Whether the oscillator's rules apply: jets weighted by |g|⁻², speeds given by the poles, the tail.
static inline bool problem_oscillates(const problem *p) { return p->desc->passive == WIGGLY_OSCILLATOR; }

/// The error of the response. An infinite one is reported elsewhere, and counts as none here.
static inline double problem_response_error(const problem *p)
{
    return p->response.error < INFINITY ? p->response.error : 0;
}

/// Rounding of the level that knots are measured from.
double problem_noise(const problem *p);

/// The cost of Im x at a sample of that natural frequency, times h³: T⁻⁴ (1 + (ω_n T)⁸)⁻¹, without `unit`.
double problem_im_weight(const problem *p, double natural);

/// Writes the whole system to the solver's rows; x holds the fixed values and 0 elsewhere.
void problem_set_rows(wiggly_solver *solver, const problem *p);

/// A knot's slope row, or the implied one, without an oscillator's coefficients; weight 0 if it has no effect.
slope_row problem_slope(const problem *p, int sample, double slope, double stiffness);

/// Another calm, with the start's cost and a loop's forced response for it.
void problem_set_calm(wiggly_solver *solver, problem *p, double calm);

/// w of `count` samples of the tail, starting `from` ≥ 1 samples after the latest knot, from w there; im is written only in complex mode.
void problem_fill_tail(wiggly_solver *solver, const problem *p, cplx w, int from, int count, double *re, double *im);

/// The same for all samples after the latest knot; arrays of the whole spline.
void problem_settle(wiggly_solver *solver, const problem *p, double *re, double *im);

/// Checks a description that was read, but not whether two knots are on one sample; `knot` receives the index of a wrong one, else -1;
/// `y_is_safe` whether the equilibrium is within SAFE_VALUE.
wiggly_status desc_check(const wiggly_desc *desc, int *knot, bool *y_is_safe);

/// Checks a description. Returns the error or WIGGLY_OK; `knot` receives the index of a knot that is wrong, or -1.
wiggly_status problem_check(wiggly_solver *solver, const wiggly_desc *desc, int *knot);

/// Applies the rules of the start to a description that was checked last; y receives the equilibrium if it moves, N numbers.
void problem_pose(wiggly_solver *solver, const wiggly_desc *desc, double *y, problem *p);

/// The magnitude of a description's curve, from its values alone; of one that the solver checked last.
double scale_size(const wiggly_solver *solver, const wiggly_desc *desc);

/// 1, or for a magnitude whose squares a double cannot hold the power of two that brings it near 1.
double scale_for(double size);

/// Multiplies all values of a description by a power of two, in the solver's memory. The rest of the solve is the same but for that.
void scale_values(wiggly_solver *solver, double scale, wiggly_desc *desc);

/// Solves by the chain: x of the system, M numbers each. false if the chain cannot: parameters that vary, loops, still knots, knots side by
/// side, the paper's filter on a moving equilibrium, a single knot with nothing else, digits lost.
bool problem_solve_chain(wiggly_solver *solver, const problem *p, double *x_re, double *x_im);

static inline bool limits_are_set(const wiggly_desc *desc) { return desc->low > -INFINITY || desc->high < INFINITY; }

/// Sorts the knots of a limited spline that was just posed into the solver's memory, with room for held samples between them: its
/// description becomes `ordered`. Returns the index of a still knot whose total is beyond a limit, else -1.
int limits_prepare(wiggly_solver *solver, problem *p, wiggly_desc *ordered);

/// problem_find() for a limited spline. WIGGLY_ERROR_CAPACITY if more samples must be held than there is room for.
wiggly_status limits_find(wiggly_solver *solver, problem *p, wiggly_curve *curve, minimum *result);

/// Rounds the completed total to the limits where it exceeds them in the last digits.
void limits_clamp(const wiggly_solver *solver, const problem *p, wiggly_curve *curve);

/// w of a posed spline into re and im of the curve, and its status. If the problem is singular, solves the nearest one that is not, and `p`
/// becomes that.
wiggly_status problem_find(wiggly_solver *solver, problem *p, wiggly_curve *curve, minimum *result);

/// Whether the motion has a direction: it winds up before each knot, and swings freely after it.
static inline bool problem_winds_up(const problem *p)
{
    const wiggly_desc *desc = p->desc;
    return desc->wind_up > 0 && desc->mode == WIGGLY_COMPLEX && problem_oscillates(p) && !p->pulls &&
           !limits_are_set(desc);
}

/// The samples of the wind-up before a knot with these poles; infinite at frequency 0.
double problem_reach(const wiggly_desc *desc, const poles *at);

/// Solves such a problem: w into re and im of the curve. The result's error is by how far the pushes miss a knot.
void problem_solve_gaps(wiggly_solver *solver, const problem *p, wiggly_curve *curve, minimum *result);

/// Whether a slope is implied at the earliest knot, because nothing else holds the spline.
bool problem_implies_slope(const problem *p);

/// The smallest and the largest of at least one value.
typedef struct extent {
    double low, high;
} extent;

extent extent_of(const double *values, int count);

void problem_fill(double *x, double value, int count);

/// The largest magnitude.
static inline double extent_size(extent e) { return fmax(fabs(e.low), fabs(e.high)); }

#endif

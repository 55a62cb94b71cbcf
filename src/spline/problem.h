/// A description with the rules of the start applied. Internal to src/spline.
#ifndef SPLINE_PROBLEM_H
#define SPLINE_PROBLEM_H

#include "spline/forced_response.h"
#include "spline/solver.h"
#include <math.h>

/// Values and equilibria beyond this are refused: sums of them must not overflow.
#define LARGEST_VALUE 1e300

/// A slope row heavier than this is met to the last digit anyway, and could overflow.
#define STIFFEST 1e20

/// Below this calm a start or a loop may be loose.
#define LOOSE_CALM 0.05

/// What a singular document is solved with in place of calm 0.
#define FALLBACK_CALM 0.05

/// What missing a slope costs where nothing says so, 1/s.
#define USUAL_STIFFNESS 1000

static inline double knot_stiffness(const wiggly_knot *knot)
{
    return knot->stiffness > 0 ? knot->stiffness : USUAL_STIFFNESS;
}

/// One solve in progress: the description with the rules of start and end applied. x = u + w: u is what moves by itself as the
/// equilibrium does, w what is solved for. A cubic on a moving equilibrium is solved for its total.
typedef struct problem {
    const wiggly_desc *desc;
    const double *y;     ///< equilibrium of the whole domain, where it moves; a loop's last is its first
    const double *about; ///< y + Re u of every sample, which w is measured from; NULL where that is `level`
    double level;
    forced_response response; ///< u, where there is one, with the noise of a variation; else its arrays are NULL
    cplx held;                ///< the noise before `first`
    wiggly_start start;
    double calm;
    wiggly_status status;      ///< WIGGLY_CALMED where u is not that of the calm as asked
    int first;                 ///< sample of the system's row 0
    int count;                 ///< samples from there to the domain's end (in a loop, round it)
    const system_pulls *pulls; ///< or NULL
    int earliest, latest;      ///< samples of the earliest and of the latest knot or pull, or -1
    bool settles;              ///< behind the latest knot w moves by itself: the system ends there
    bool strict;               ///< one plain solve is not enough: the total is far smaller than x
    bool level_slope;          ///< a level slope is implied at the earliest knot
    bool free_end;             ///< c·H = 0
    int still;                 ///< sample of the earliest still knot, or -1
    int knot;                  ///< of what problem_pose() refuses: index of the knot that it is about, or -1
    double unit;     ///< what weights are times that are not jets': the oscillator's |g|² at `first`, else 1
    start_cost cost; ///< of the start's swing, times calm; weights 0 where it is free
} problem;

static inline double problem_y(const problem *p, int sample)
{
    return p->y ? p->y[sample] : p->desc->equilibrium.value;
}

/// What w is measured from: a knot's w is its value less this.
static inline double problem_about(const problem *p, int sample) { return p->about ? p->about[sample] : p->level; }

/// w that a knot asks for; of a still one 0, or where a cubic is solved for its total, what keeps that at the equilibrium.
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

/// Whether the first sample is a still knot's: what is before it is at rest.
static inline bool problem_starts_still(const problem *p) { return p->still >= 0 && p->still == p->first; }

/// Rows of the system: the samples that are solved for.
static inline int problem_rows(const problem *p) { return p->settles ? p->latest - p->first + 1 : p->count; }

/// The least damping ratio that the problem takes.
static inline double problem_least_damping(const problem *p)
{
    return p->start == WIGGLY_LOOP ? LEAST_DAMPING * p->calm : 0;
}

/// Whether next to nothing holds the start, or brakes a loop.
static inline bool problem_is_loose(const problem *p)
{
    return p->calm < LOOSE_CALM && p->start != WIGGLY_REST && p->desc->mode != WIGGLY_CUBIC;
}

/// The filter of a problem without pole tracks.
static inline const constant_filter *problem_filter(wiggly_solver *solver, const problem *p)
{
    return solver_filter(solver, p->desc, problem_least_damping(p));
}

/// Whether anything asks for a motion: knots or pulls.
static inline bool problem_is_asked(const problem *p) { return p->earliest >= 0; }

/// Whether the oscillator's rules hold: jets weighed by |g|⁻², speeds that the poles see, the tail.
static inline bool problem_oscillates(const problem *p) { return p->desc->passive == WIGGLY_OSCILLATOR; }

/// What Im x costs at a sample of that natural frequency, times h³: T⁻⁴ (1 + (ω_n T)⁸)⁻¹, without `unit`.
double problem_im_weight(const problem *p, double natural);

/// Puts everything of the system into the solver's rows; x holds the fixed values and 0 elsewhere.
void problem_set_rows(wiggly_solver *solver, const problem *p);

/// Slope row of a knot that has one, or of the implied one, without an oscillator's coefficients; weight 0 where it is without effect.
slope_row problem_slope(const problem *p, int sample, double slope, double stiffness);

/// Another calm, with the start's cost and a loop's forced response for it.
void problem_set_calm(wiggly_solver *solver, problem *p, double calm);

/// w of `count` samples of the tail, the first of them `from` ≥ 1 samples behind the latest knot, from w there; im outside complex mode
/// is not written.
void problem_fill_tail(wiggly_solver *solver, const problem *p, cplx w, int from, int count, double *re, double *im);

/// The same for all samples behind the latest knot; arrays of the whole spline.
void problem_settle(wiggly_solver *solver, const problem *p, double *re, double *im);

/// Whether the document is one for the chain: constant parameters, a constant equilibrium, no seam.
bool problem_fits_chain(wiggly_solver *solver, const problem *p);

/// Whether a description has noise that its knots are solved over: some amount, an oscillator of constant poles that has a frequency.
bool variation_is_set(const wiggly_desc *desc);

/// Adds the noise of every sample to u of a problem whose domain is known, and its value before `first` to what is held there.
void variation_add(problem *p);

/// Checks a description and applies the rules of the start; y receives the equilibrium where it moves, N numbers. What is wrong,
/// or WIGGLY_OK.
wiggly_status problem_pose(wiggly_solver *solver, const wiggly_desc *desc, double *y, problem *p);

/// Solves by the chain: x of the system, M numbers each (x_im in complex mode). false where it declines: one knot without any
/// hold, digits lost, or numbers so large that something might overflow.
bool problem_solve_chain(wiggly_solver *solver, const problem *p, double *x_re, double *x_im);

/// w of a posed spline into re and im of the curve, and how that went; where a problem is singular as asked, of the nearest one that is
/// not, which `p` becomes.
wiggly_status problem_find(wiggly_solver *solver, problem *p, wiggly_curve *curve, minimum *result);

/// Whether a slope is implied at the earliest knot, because nothing else holds the spline.
bool problem_implies_slope(const problem *p);

/// The smallest and the largest of at least one value.
typedef struct extent {
    double low, high;
} extent;

extent extent_of(const double *values, int count);

/// The largest magnitude.
static inline double extent_size(extent e) { return fmax(fabs(e.low), fabs(e.high)); }

/// Whether max |x| is beyond what the knots can mean. `solved` is the chain where that found x, else NULL.
bool problem_blew_up(const problem *p, const chain *solved, const wiggly_curve *curve);

/// What follows from x: samples outside the system, the total, the equilibrium, the band's centre.
void problem_complete(wiggly_solver *solver, const problem *p, wiggly_curve *curve);

#endif

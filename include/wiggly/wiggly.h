/// libwiggly: curves through knots that swing, overshoot and follow through.
///
/// After "Interactive Spacetime Constraints: Wiggly Splines" (Kass, Anderson). A spline has N samples, a step apart.
/// At each, x swings about an equilibrium y; the curve that you key and show is the total y + Re x. Of all curves
/// through the knots, it needs the least force on top of a damped oscillator's.
///
///     wiggly_knot knots[] = {{.sample = 0, .value = 0}, {.sample = 36, .value = 1}};
///     wiggly_desc desc = {.size = sizeof desc, .knots = knots, .knot_count = 2, .samples = 121, .frequency = {1.5}};
///     wiggly_curve curve = {.size = sizeof curve, .total = total};
///     wiggly_solve(solver, &desc, &curve);
///
/// Units: seconds, Hz, radians; values in whatever you key.
/// Memory: a solver and a batch are one block each, from malloc() or from you; curves are your arrays. Nothing is
/// allocated after that.
/// Threads: no globals. Use a solver on one thread at a time; any number of threads may read a finished curve.
/// Versions: a structure with a `size` may grow in version 1, and you set its size; one without never changes.
///
/// wiggly/more.h has what few programs need.
#ifndef WIGGLY_H
#define WIGGLY_H

#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/// The version of this header.
#define WIGGLY_VERSION "1.0.0"

/// The version of the library at run time, "major.minor.patch"; a shared library may be newer than the header.
const char *wiggly_version(void);

// --- what a call returns ---------------------------------------------------------------------------------------------

/// From WIGGLY_ERROR_ARGUMENT on nothing was solved, and of the curve only `knot` is set.
typedef enum wiggly_status {
    WIGGLY_OK = 0,
    WIGGLY_CALMED,   ///< solved with calm 0.05 instead of 0, with which the swing has no limit
    WIGGLY_LEVELLED, ///< solved with slope 0 at the earliest knot: the knots do not determine the curve
    WIGGLY_INEXACT,  ///< solved, but perhaps not to all digits: see wiggly_curve.error
    WIGGLY_SINGULAR, ///< not solved: straight lines join the knots

    WIGGLY_ERROR_ARGUMENT = 16, ///< a pointer is missing or a count is out of range
    WIGGLY_ERROR_SIZE,          ///< a `size` is not set or too small, or asks for members that this version lacks
    WIGGLY_ERROR_MEMORY,        ///< out of memory
    WIGGLY_ERROR_CAPACITY,      ///< more samples or knots than the solver has room for
    WIGGLY_ERROR_NUMBER,        ///< a number is NaN, infinite or out of its range, or a mode is unknown
    WIGGLY_ERROR_LOOP,          ///< a loop of one sample
    WIGGLY_ERROR_LIMITS,        ///< a limit is not finite, or the low one is not below the high one
    WIGGLY_ERROR_KNOT_NUMBER,   ///< a knot's number is NaN, infinite or beyond 1e300, or its stiffness is below 0
    WIGGLY_ERROR_KNOT_OUTSIDE,  ///< a knot is outside the samples (a loop's last sample is its first)
    WIGGLY_ERROR_KNOT_TWICE,    ///< two knots share a sample
    WIGGLY_ERROR_KNOT_STILL,    ///< a still knot has a slope or a phase, or settles
    WIGGLY_ERROR_KNOT_LIMIT,    ///< a knot is beyond a limit; a still one where the equilibrium takes it
    WIGGLY_ERROR_PIN,           ///< a pin is outside the samples, or on a spline without a motion of its own
    WIGGLY_STATUS_COUNT
} wiggly_status;

/// A sentence for people, without a full stop; never NULL.
const char *wiggly_status_text(wiggly_status status);

// --- what to solve ---------------------------------------------------------------------------------------------------

/// The cubic's ends: at the first knot it is natural (no second derivative), or has the knot's slope; from rest it
/// begins flat at sample 0, and as a loop it is periodic. At the last knot it is flat, or has the knot's slope and goes
/// straight on; with WIGGLY_FILTER it is natural and goes straight on. Before the first knot and after a flat end it
/// stands still.
typedef enum wiggly_mode {
    WIGGLY_COMPLEX = 0, ///< swings at a frequency that may shift within a band (section 5 of the paper)
    WIGGLY_REAL,        ///< a damped spring (section 3)
    WIGGLY_CUBIC        ///< the classical cubic spline (section 2)
} wiggly_mode;

typedef enum wiggly_start {
    WIGGLY_FREE = 0, ///< mid-swing, at the earliest knot; before it x stands still
    WIGGLY_REST,     ///< at rest, at sample 0
    WIGGLY_LOOP      ///< goes round: the last sample is the first one again
} wiggly_start;

/// How the curve moves by itself: after the last knot, and when the equilibrium moves.
typedef enum wiggly_passive {
    WIGGLY_OSCILLATOR = 0, ///< a damped oscillator: it swings on and dies away
    WIGGLY_FILTER          ///< the paper's filter: in complex mode its two poles ring up together first
} wiggly_passive;

/// A number or, where `track` is set, your N numbers, one per sample, which are read only during the solve. Numbers
/// out of range are clamped.
typedef struct wiggly_param {
    double value;
    const double *track;
} wiggly_param;

/// A knot fixes the total at its sample. Its phase, Im x, stays free unless has_phase is set: that makes it a pose,
/// which holds lagging parts too. At a still knot the motion comes to rest and begins again from rest.
/// (This structure never grows: later versions will add arrays to wiggly_desc.)
typedef struct wiggly_knot {
    int sample;                       ///< 0 … N − 1; of a loop, to N − 2
    bool has_slope, has_phase, still; ///< a still knot has neither
    bool settles;     ///< the equilibrium comes to its value and stays; not in cubic mode, nor of a still knot
    double value;     ///< of the total; ignored at a still knot
    double slope;     ///< value per second; read where has_slope
    double stiffness; ///< 1/s, the cost of missing the slope; 0: 1000, which is firm
    double phase;     ///< Im x, like a value; read where has_phase, in complex mode
} wiggly_knot;

/// What to solve. Zeroes with `size` set are valid; the comments say what 0 means. In an array, every element has the
/// size of the first.
typedef struct wiggly_desc {
    size_t size;              ///< sizeof(wiggly_desc)
    const wiggly_knot *knots; ///< in any order, at most one a sample
    int knot_count;
    int samples; ///< N; 0: nothing to solve
    double step; ///< seconds from sample to sample; 0: 1/24
    wiggly_mode mode;
    wiggly_start start;
    wiggly_passive passive;
    wiggly_param frequency;   ///< Hz, undamped; 0: no swing, as a cubic
    wiggly_param damping;     ///< ratio: 0 swings on, 1 is critical, more (in real mode only) creeps
    wiggly_param bandwidth;   ///< 0 … 1, how far the frequency may shift, as a fraction of it; complex mode only
    wiggly_param equilibrium; ///< y, what it swings about
    double calm;              ///< 0 … 1, the cost of a swing at the start; 0 means 1 unless has_calm is set
    double wind_up;   ///< 0 … 100, how long before a knot the motion is pushed, in periods there; 0: at any time
    double low, high; ///< limits of the total; read where has_low, has_high
    double variation; ///< another motion through the same knots (wiggly/more.h); 0: none
    bool has_calm, has_low, has_high;
    int variation_seed; ///< which one
} wiggly_desc;

/// A description with its size set, one sample, step 1/24, bandwidth 0.1 and calm 1 (has_calm); everything else is 0.
wiggly_desc wiggly_default_desc(void);

// --- solving ---------------------------------------------------------------------------------------------------------

/// A solved spline: a solve fills your arrays of N numbers each and skips those that are NULL. In an array, every
/// element has the size of the first.
typedef struct wiggly_curve {
    size_t size;   ///< sizeof(wiggly_curve)
    double *total; ///< y + Re x; at knots exactly the knot's value
    double *y;     ///< the equilibrium
    double *re;    ///< Re x
    double *im;    ///< Im x; 0 but in complex mode
    double *omega; ///< the band's centre, rad/s
    double *slope; ///< the total's change per second at knots with a slope, elsewhere NaN; needs y, re, im, omega
    float *floats; ///< the total once more, for graphics; beyond 3.4e38 infinite
    size_t stride; ///< floats from one to the next; 0: 1

    // Filled:
    int samples;      ///< N
    int first;        ///< before this sample no knot moves x
    double step;      ///< seconds
    double before[2]; ///< Re and Im x there, without what the equilibrium's motion adds
    wiggly_mode mode;
    wiggly_start start;
    double error; ///< bound of the largest error, as a part of the total's range or of its size, whichever is larger
    int refinements; ///< corrections by the band; 0 by the chain
    int knot;        ///< index of the knot that an error is about; else -1
} wiggly_curve;

/// Memory for solves, which you can use for any number of splines.
typedef struct wiggly_solver wiggly_solver;

/// A solver for up to `samples` ≥ 1 samples and `knots` ≥ 0 knots. A sample that a limit holds needs the room of a
/// knot: with limits, knots + samples is always enough. WIGGLY_ERROR_ARGUMENT, WIGGLY_ERROR_MEMORY.
wiggly_status wiggly_create(int samples, int knots, wiggly_solver **solver);

/// Bytes for wiggly_create_at(); 0 where an argument is out of range or the size does not fit.
size_t wiggly_memsize(int samples, int knots);

/// The same in your memory: `size` bytes, aligned for double. Nothing needs to be destroyed. WIGGLY_ERROR_ARGUMENT;
/// WIGGLY_ERROR_MEMORY if `size` is too small.
wiggly_status wiggly_create_at(void *memory, size_t size, int samples, int knots, wiggly_solver **solver);

/// Frees what wiggly_create() made; NULL is fine.
void wiggly_destroy(wiggly_solver *solver);

/// Solves one spline, in time proportional to N. The same description gives the same bits. Returns any status but
/// WIGGLY_ERROR_MEMORY and WIGGLY_ERROR_PIN.
wiggly_status wiggly_solve(wiggly_solver *solver, const wiggly_desc *desc, wiggly_curve *curve);

// --- reading a curve -------------------------------------------------------------------------------------------------

/// A curve at one time, in parts: the total is y + re. Or the change of each part per second.
typedef struct wiggly_value {
    double y, re, im;
} wiggly_value;

/// The curve at a time in seconds; sample i is at i × step. `per_second` receives its change there, or is NULL.
/// Before the first sample and after the last the curve stands still; a loop goes round. At samples it is what was
/// solved; in between, x turns by the band's centre. The curve must have y, re and im, in complex mode omega, too:
/// without one of them all is NaN, as at a time that is NaN. If it has `slope`, too, its change at a knot with a firm
/// slope is that slope. Of a curve that was never solved all is 0.
wiggly_value wiggly_evaluate_at(const wiggly_curve *curve, double seconds, wiggly_value *per_second);

/// The same at `count` times, in less time for each. `values` or `per_second` may be NULL.
void wiggly_evaluate_many(const wiggly_curve *curve, const double *seconds, size_t count, wiggly_value *values,
                          wiggly_value *per_second);

/// y + cos(lag) re + sin(lag) im: the total of a part that lags by `lag` radians. With 0 it is the curve's own; of a
/// value per second it is the part's change.
double wiggly_lagged(wiggly_value value, double lag);

// --- many splines ----------------------------------------------------------------------------------------------------

/// Solves many splines over threads of its own.
typedef struct wiggly_batch wiggly_batch;

/// For splines of up to `samples` samples and `knots` knots each, on 1 … 256 threads, yours counted.
/// WIGGLY_ERROR_ARGUMENT, WIGGLY_ERROR_MEMORY.
wiggly_status wiggly_batch_create(int samples, int knots, int threads, wiggly_batch **batch);

/// Bytes for wiggly_batch_create_at(); 0 where an argument is out of range or the size does not fit.
size_t wiggly_batch_memsize(int samples, int knots, int threads);

/// The same in your memory: `size` bytes, aligned for double. Destroy the batch before you free them: it has threads.
wiggly_status wiggly_batch_create_at(void *memory, size_t size, int samples, int knots, int threads,
                                     wiggly_batch **batch);

/// Ends the threads and frees what wiggly_batch_create() made; NULL is fine.
void wiggly_batch_destroy(wiggly_batch *batch);

/// Solves desc[i] into curve[i] for each i < count: the same bits as wiggly_solve(), on any number of threads.
/// status[i] receives the status of each; `status` may be NULL. Returns the largest one. WIGGLY_ERROR_ARGUMENT
/// and WIGGLY_ERROR_SIZE without touching anything.
wiggly_status wiggly_batch_solve(wiggly_batch *batch, const wiggly_desc *desc, wiggly_curve *curve,
                                 wiggly_status *status, int count);

/// Numbers of many splines in one array of yours: number k of spline i is at[i * by_spline + k * by_number]. A stride
/// of 0 repeats: with by_spline 0 all splines share theirs. `at` NULL: none.
typedef struct wiggly_numbers {
    const double *at;
    ptrdiff_t by_spline, by_number;
} wiggly_numbers;

/// The same for output: no two splines may share memory.
typedef struct wiggly_rows {
    double *at;
    ptrdiff_t by_spline, by_number;
} wiggly_rows;

/// Splines that differ in their knots alone. Zeroes with `size` set are valid: no splines.
typedef struct wiggly_many {
    size_t size;                  ///< sizeof(wiggly_many)
    int count;                    ///< splines
    int knot_count;               ///< knots per spline in the arrays: the most that a spline can have
    wiggly_numbers sample;        ///< of each knot, rounded to a whole one; NaN: no knot
    wiggly_numbers value;         ///< the others as in wiggly_knot
    wiggly_numbers slope;         ///< NaN: none
    wiggly_numbers stiffness;     ///< 0: 1000
    wiggly_numbers phase;         ///< NaN: free
    wiggly_numbers still;         ///< above 0: a still knot
    wiggly_numbers settles;       ///< above 0: the motion settles there
    wiggly_rows total, y, re, im; ///< filled: N numbers a spline, as in wiggly_curve
    wiggly_status *status;        ///< filled, or NULL: one a spline, as of wiggly_solve()
    int *knot;                    ///< filled, or NULL: one a spline, as in wiggly_curve, by the place in the arrays
} wiggly_many;

/// Solves many splines of one description, whose own knots are not read: the same bits as one by one. The rows of a
/// spline with an error are not touched. Returns the largest status; for an error of `desc` or `many` itself nothing
/// is touched at all.
wiggly_status wiggly_batch_solve_many(wiggly_batch *batch, const wiggly_desc *desc, const wiggly_many *many);

#ifdef __cplusplus
}
#endif
#endif

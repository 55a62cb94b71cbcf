/// libwiggly: splines that oscillate, overshoot and follow through.
///
/// After "Interactive Spacetime Constraints: Wiggly Splines" (Kass, Anderson). A spline is a displacement x from an
/// equilibrium y, sampled at N equidistant times; the curve that is keyed and shown is the total y + Re x. Of all curves
/// through the knots it is the one that needs the smallest "jet engine" force beside that of a damped oscillator.
///
/// Memory: one block for each solver, batch or take, from malloc() or the caller, and the caller's arrays for curves; nothing is
/// allocated after that.
/// Threads: no globals. One solver must not be used by two threads at once; a finished curve may be read by any number.
/// Units: time in seconds, frequency in Hz, angles in radians, values in whatever the animator keys.
#ifndef WIGGLY_H
#define WIGGLY_H

#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Of this header.
#define WIGGLY_VERSION "0.1.0"

/// Of the library that is linked, "major.minor.patch": a shared one may be newer than the header.
const char *wiggly_version(void);

/// What a call returns. From WIGGLY_ERROR_ARGUMENT on nothing was solved, and of the curve only `knot` was touched.
typedef enum wiggly_status {
    WIGGLY_OK = 0,
    WIGGLY_CALMED,         ///< singular as asked: solved with calm 0.05 in place of 0
    WIGGLY_LEVELLED,       ///< singular as asked: solved with a level slope at the earliest knot
    WIGGLY_INEXACT,        ///< solved, but the error estimate is above the tolerance (wiggly_curve.error)
    WIGGLY_SINGULAR,       ///< singular whatever was tried: knots joined by straight lines
    WIGGLY_ERROR_ARGUMENT, ///< a pointer is missing or a count is out of range
    WIGGLY_ERROR_SIZE,   ///< a structure's `size` is not set, too small, or of a version with more than this one has
    WIGGLY_ERROR_MEMORY, ///< out of memory
    WIGGLY_ERROR_CAPACITY,     ///< more samples or knots than the solver was created for
    WIGGLY_ERROR_NUMBER,       ///< a number that is no knot's is NaN, infinite or out of its range
    WIGGLY_ERROR_LOOP,         ///< a loop of one sample
    WIGGLY_ERROR_LIMITS,       ///< a limit is not finite, or the low one is not below the high one
    WIGGLY_ERROR_KNOT_NUMBER,  ///< a knot's number is NaN, infinite or beyond 1e300, or its stiffness below 0
    WIGGLY_ERROR_KNOT_OUTSIDE, ///< a knot is outside the samples; a loop's last one is its first
    WIGGLY_ERROR_KNOT_TWICE,   ///< two knots are on one sample
    WIGGLY_ERROR_KNOT_STILL,   ///< a still knot has a slope or a phase
    WIGGLY_ERROR_KNOT_LIMIT,   ///< a knot is beyond a limit
    WIGGLY_ERROR_PIN,          ///< a pin is outside the samples, or on a spline that has no motion of its own
    WIGGLY_STATUS_COUNT
} wiggly_status;

/// A sentence for people, without full stop; never NULL.
const char *wiggly_status_text(wiggly_status status);

typedef enum wiggly_mode {
    WIGGLY_COMPLEX = 0, ///< two poles on one side of the axis: a band-pass (section 5)
    WIGGLY_REAL,        ///< a conjugate or real pair of poles: the damped spring (section 3)
    WIGGLY_CUBIC        ///< both poles at 1: the classical spline (section 2)
} wiggly_mode;

typedef enum wiggly_start {
    WIGGLY_FREE =
        0,       ///< from the earliest knot on; its swing costs what it would have taken to build it up, times calm
    WIGGLY_REST, ///< from rest at sample 0
    WIGGLY_LOOP  ///< the last sample is the first one again
} wiggly_start;

/// What happens where no knot asks for anything: after the last one, and as the equilibrium moves.
typedef enum wiggly_passive {
    WIGGLY_OSCILLATOR = 0, ///< what a damped oscillator does, of one pole: it swings on and dies away
    WIGGLY_FILTER          ///< what the paper's filter does, of two: in complex mode they ring up together first
} wiggly_passive;

/// A parameter: a number, or where `track` is set one number a sample (N of them, caller's, read during the solve only).
/// Values out of range are clamped.
typedef struct wiggly_param {
    double value;
    const double *track;
} wiggly_param;

/// A knot fixes the total at its sample, and leaves the phase, Im x, free. One that has a phase is a pose: it fixes both, and with
/// them every part that lags. A still one is where the motion comes to rest and begins from rest. What a later version adds to
/// knots comes in arrays of its own: this structure stays as it is.
typedef struct wiggly_knot {
    int sample;
    bool has_slope, has_phase, still; ///< a still one has neither
    double value;                     ///< of the total; a still knot's is not read
    double slope;                     ///< value per second (eq. 9); read where has_slope
    double stiffness;                 ///< 1/s: what missing the slope costs; 0: 1000, which is firm
    double phase;                     ///< Im x; read where has_phase, in complex mode
} wiggly_knot;

/// What to solve. Zeroes with `size` set are a valid description: what a 0 means is said beside each member. In an array, all have the
/// size of the first.
typedef struct wiggly_desc {
    size_t size;              ///< sizeof(wiggly_desc), by which a later version knows which members there are
    const wiggly_knot *knots; ///< in any order
    int knot_count;
    int samples; ///< N; 0: nothing to solve
    double step; ///< h, seconds between samples; 0: 1/24
    wiggly_mode mode;
    wiggly_start start;
    wiggly_passive passive;
    wiggly_param frequency;   ///< Hz, undamped natural frequency; 0 is the cubic
    wiggly_param damping;     ///< ratio; 1 is critical, above 1 (real mode only) overdamped
    wiggly_param bandwidth;   ///< fraction of the frequency, 0 … 1; complex mode only
    wiggly_param equilibrium; ///< y (eq. 25)
    double calm;              ///< 0 … 1; 0: 1, but where has_calm, the paper's formula to the letter
    double low, high;         ///< what the total stays within wherever it is solved for; read where has_low, has_high
    double variation;         ///< how far another motion through the same knots strays (wiggly/more.h); 0: not at all
    bool has_calm, has_low, has_high;
    int variation_seed; ///< which one
} wiggly_desc;

/// Size set, one sample, step 1/24, bandwidth 0.1, calm 1 (has_calm); everything else 0.
wiggly_desc wiggly_default_desc(void);

/// A solved spline: the caller's arrays of N numbers each, filled by wiggly_solve(). Arrays that are NULL are not filled;
/// wiggly_evaluate_at() needs all but total. In an array, all have the size of the first.
typedef struct wiggly_curve {
    size_t size;   ///< sizeof(wiggly_curve)
    double *total; ///< y + Re x; at knots exactly the knot's value
    double *y;     ///< equilibrium
    double *re;    ///< Re x
    double *im;    ///< Im x; 0 outside complex mode
    double *omega; ///< band centre, rad/s, for values between samples
    float *floats; ///< the total once more, for graphics: `stride` floats apart (0: 1); beyond 3.4e38 infinite
    size_t stride;
    int samples; ///< N of the last solve
    int first;   ///< before this sample no knot moves x: it is constant but for what the equilibrium's motion adds
    double step; ///< h, seconds
    double before[2]; ///< that constant, re and im
    wiggly_mode mode;
    wiggly_start start;
    double error;    ///< estimated largest error, relative to the larger of the total's range and magnitude
    int refinements; ///< sweeps of iterative refinement that were taken
    int knot;        ///< of an error: index of the knot that it is about; -1: of none
} wiggly_curve;

/// A solver's memory: factors and right-hand sides. Reusable for any number of splines.
typedef struct wiggly_solver wiggly_solver;

/// A solver for up to `samples` samples and `knots` knots. A sample that is held at a limit takes the room of a knot: as many more as
/// there are samples are always enough. WIGGLY_ERROR_ARGUMENT, WIGGLY_ERROR_MEMORY.
wiggly_status wiggly_create(int samples, int knots, wiggly_solver **solver);

/// Bytes that wiggly_create_at() needs, or 0 where samples < 1 or knots < 0 or the size does not fit.
size_t wiggly_memsize(int samples, int knots);

/// The same in the caller's memory (aligned for double, `size` bytes); never destroyed, only forgotten.
wiggly_status wiggly_create_at(void *memory, size_t size, int samples, int knots, wiggly_solver **solver);

/// Frees what wiggly_create() made; NULL is fine.
void wiggly_destroy(wiggly_solver *solver);

/// Solves one spline, O(samples), allocating nothing. Deterministic: the same description gives the same bits.
wiggly_status wiggly_solve(wiggly_solver *solver, const wiggly_desc *desc, wiggly_curve *curve);

/// Many splines at once, over threads of its own.
typedef struct wiggly_batch wiggly_batch;

/// For splines of up to `samples` samples and `knots` knots each; `threads` counts the caller's, at least 1.
/// WIGGLY_ERROR_ARGUMENT, WIGGLY_ERROR_MEMORY.
wiggly_status wiggly_batch_create(int samples, int knots, int threads, wiggly_batch **batch);

/// Bytes that wiggly_batch_create_at() needs, or 0 where an argument is out of range or the size does not fit.
size_t wiggly_batch_memsize(int samples, int knots, int threads);

/// The same in the caller's memory (aligned for double, `size` bytes), which wiggly_batch_destroy() does not free, but ends the
/// threads in: it must be called first.
wiggly_status wiggly_batch_create_at(void *memory, size_t size, int samples, int knots, int threads,
                                     wiggly_batch **batch);

/// Solves desc[i] into curve[i] for i in 0 … count − 1, allocating nothing; status[i] (or NULL) is what wiggly_solve() would have
/// said, and the curves are the same to the last bit, whatever the number of threads. Returns the largest status.
wiggly_status wiggly_batch_solve(wiggly_batch *batch, const wiggly_desc *desc, wiggly_curve *curve,
                                 wiggly_status *status, int count);

/// Numbers of many splines in one array: number k of spline i is at[i * by_spline + k * by_number]. A stride of 0 repeats: with
/// by_spline 0 all splines have the same ones. at NULL: none.
typedef struct wiggly_numbers {
    const double *at;
    ptrdiff_t by_spline, by_number;
} wiggly_numbers;

/// The same to be filled: no two splines on the same places.
typedef struct wiggly_rows {
    double *at;
    ptrdiff_t by_spline, by_number;
} wiggly_rows;

/// Many splines of one kind: their knots, and what is filled. Zeroes with `size` set are none.
typedef struct wiggly_many {
    size_t size;           ///< sizeof(wiggly_many)
    int count;             ///< splines
    int knot_count;        ///< rows of knots: the most that a spline has
    wiggly_numbers sample; ///< of each knot, rounded to a whole one; NaN where a spline has fewer knots
    wiggly_numbers value;
    wiggly_numbers slope;         ///< NaN: none
    wiggly_numbers stiffness;     ///< 0: 1000
    wiggly_numbers phase;         ///< NaN: free
    wiggly_numbers still;         ///< above 0: a still knot
    wiggly_rows total, y, re, im; ///< filled, `samples` numbers a spline, as in wiggly_curve
    wiggly_status *status;        ///< filled, one a spline, or NULL: what wiggly_solve() would have said
    int *knot; ///< filled, one a spline, or NULL: of an error, the row of the knot that it is about, else -1
} wiggly_many;

/// Solves many splines that differ in their knots alone; knots in `desc` are not read. The same bits as one by one, with nothing to fill in for
/// each, and nothing allocated. The arrays of one with an error are not touched. Returns the largest status; at an
/// error of `desc` or `many` themselves nothing is filled.
wiggly_status wiggly_batch_solve_many(wiggly_batch *batch, const wiggly_desc *desc, const wiggly_many *many);

/// Ends the threads and frees; NULL is fine.
void wiggly_batch_destroy(wiggly_batch *batch);

/// What a curve is at a time, in parts: the total is y + re. Or what each part changes by in a second.
typedef struct wiggly_value {
    double y, re, im;
} wiggly_value;

/// The curve at a time in seconds; sample i is at i times its step. `per_second` receives how it changes there, or is NULL. Before the
/// first sample and after the last the curve stands still; a loop goes round. At samples it is what was solved; from one to the next x
/// turns by the band's centre. Needs y, re, im, and in complex mode omega: NaN where one is
/// missing; 0 where nothing was solved.
wiggly_value wiggly_evaluate_at(const wiggly_curve *curve, double seconds, wiggly_value *per_second);

/// y + Re(e^{−j·lag} x): the value of a part that lags behind by `lag` radians (eq. 27), 0: the total. Of changes per second: its change.
double wiggly_lagged(wiggly_value value, double lag);

#ifdef __cplusplus
}
#endif
#endif

/// What few programs need besides wiggly.h: pins and bounds, the frequency that explains knots, curves by position,
/// another method, poles.
///
/// And variations: `variation` 0.3 in wiggly_desc lets the curve stray by about 0.3 of the farthest knot's distance
/// from the equilibrium, through the same knots, as if random pushes moved it; `variation_seed` chooses one of these
/// motions. A variation needs WIGGLY_OSCILLATOR, a frequency above 0, and no track on frequency, damping or bandwidth;
/// cubic mode ignores it.
#ifndef WIGGLY_MORE_H
#define WIGGLY_MORE_H

#include <wiggly/wiggly.h>

#ifdef __cplusplus
extern "C" {
#endif

// --- points that are held --------------------------------------------------------------------------------------------

/// How a spline of a group moves a point: by Re(c x) along x, y and z. Each c is (re, im).
typedef struct wiggly_pull {
    int spline;
    double c[3][2];
} wiggly_pull;

/// A point and its place at one sample. `to` is the offset from where the point is with every x at 0 to that place:
/// the sum of its pulls' Re(c x).
typedef struct wiggly_pin {
    int sample;
    const wiggly_pull *pulls; ///< at most one per spline
    int pull_count;
    double to[3];
    double left[3]; ///< filled: the offset that remains
} wiggly_pin;

/// A side on which a point stays at one sample: the sum of Re(c x) over the group's splines is at least `least`.
typedef struct wiggly_bound {
    int sample;
    const double (*c)[2]; ///< (re, im), one a spline
    double least;
    double push; ///< filled: how hard it presses, half the derivative of the weighted energy by `least`; ≥ 0
    double left; ///< filled: what is missing; ≤ 0: nothing
} wiggly_bound;

/// Splines that are solved together, because several of them move one point.
typedef struct wiggly_group wiggly_group;

/// The most pins of a group, and the most bounds.
#define WIGGLY_MOST_PINS 4096

/// For up to `splines` ≥ 1 splines of up to `samples` ≥ 1 samples and `knots` ≥ 0 knots each, and `pins` pins.
/// WIGGLY_ERROR_ARGUMENT, WIGGLY_ERROR_MEMORY.
wiggly_status wiggly_group_create(int samples, int knots, int splines, int pins, wiggly_group **group);

/// The same with room for bounds.
wiggly_status wiggly_group_create_bounded(int samples, int knots, int splines, int pins, int bounds,
                                          wiggly_group **group);

/// Frees; NULL is fine.
void wiggly_group_destroy(wiggly_group *group);

/// Solves descs[s] into curves[s] so that the sum of weights[s] times the energy of spline s is least, through their
/// knots and the pins. Weights are above 0 and make the energies comparable: the mean of |c|² over what a spline
/// moves serves. A spline's pins count as knots where it starts and ends; its limits are then ignored. A place that
/// the splines can barely reach is met only in part; `left` holds the remaining offset. Returns the largest status of
/// wiggly_solve(). WIGGLY_ERROR_PIN: a pin is outside a spline's samples, or on a spline that is cubic, of calm 0, or
/// of frequency 0 from its first knot or pin to its last. Allocates nothing.
wiggly_status wiggly_group_solve(wiggly_group *group, const wiggly_desc *descs, const double *weights,
                                 wiggly_curve *curves, int spline_count, wiggly_pin *pins, int pin_count);

/// The same with bounds; the curves must have total, re and im. A bound does not count as a knot, and one that
/// presses nothing changes nothing. After a complex spline's last knot it presses on the motion that goes on by
/// itself. A bound that knots and pins leave no way to meet is met in part.
wiggly_status wiggly_group_solve_bounded(wiggly_group *group, const wiggly_desc *descs, const double *weights,
                                         wiggly_curve *curves, int spline_count, wiggly_pin *pins, int pin_count,
                                         wiggly_bound *bounds, int bound_count);

/// How free the knots and pins of the last solve leave a bound's point at its sample: 0 (not at all) … 1.
double wiggly_group_reach(const wiggly_group *group, const wiggly_bound *bound);

// --- the frequency of knots ------------------------------------------------------------------------------------------

/// An oscillation that may explain knots.
typedef struct wiggly_explanation {
    double frequency; ///< Hz
    double damping;   ///< ratio
    double cost;      ///< the lower the better; a difference of 1 is e times less likely
} wiggly_explanation;

/// The fewest knots that determine a frequency.
#define WIGGLY_FEWEST_EXPLAINED 4

/// The frequency and damping that explain a description's knots best, and the runner-up. Returns how many it found, 0
/// … 2; 0 where there are too few knots, all are at the equilibrium, or the description is not valid. In real mode
/// for that mode, else for complex mode without bandwidth. It searches from half a swing over all knots to a little
/// more than half a swing over the smallest gap, and uses the first 48 knots. Allocates nothing.
int wiggly_explain(const wiggly_desc *desc, wiggly_explanation best[2]);

/// Frequency, Hz, and damping ratio of a spring k, 1/s², and a friction gamma, 1/s (eq. 12), neither below 0: √k/2π
/// and gamma/2√k. The damping is 10⁸ at most: friction without a spring is that of a spring too weak to show.
void wiggly_from_spring(double k, double gamma, double *frequency, double *damping);

// --- curves by position ----------------------------------------------------------------------------------------------

/// wiggly_evaluate_at() by position in samples: 2.5 is halfway from sample 2 to sample 3. The curve must have y, re,
/// im and, in complex mode, omega.
wiggly_value wiggly_evaluate(const wiggly_curve *curve, double position);

/// The total as floats for graphics: at `count` positions, from `from` on, `by` samples apart, written `stride`
/// floats apart.
void wiggly_evaluate_float(const wiggly_curve *curve, double from, double by, int count, float *out, size_t stride);

// --- inside ----------------------------------------------------------------------------------------------------------

/// How a solver solves; the curves are the same but for rounding.
typedef enum wiggly_method {
    WIGGLY_CHAIN = 0, ///< fast: from knot to knot; loops, tracks, still knots and knots side by side by the band
    WIGGLY_BAND       ///< reference: always the band of all samples, as in the paper
} wiggly_method;

/// Sets the method of all later solves; a new solver, and a new group, has WIGGLY_CHAIN.
void wiggly_set_method(wiggly_solver *solver, wiggly_method method);
void wiggly_group_set_method(wiggly_group *group, wiggly_method method);

/// The two poles of the filter (sections 4 and 5 of the paper), each (re, im): continuous, 1/s, and discrete, exp(s ×
/// step).
typedef struct wiggly_poles {
    double s[2][2];
    double z[2][2];
} wiggly_poles;

/// The poles of a description at a sample; 0 where it is not valid.
wiggly_poles wiggly_poles_at(const wiggly_desc *desc, int sample);

#ifdef __cplusplus
}
#endif
#endif

/// What few programs need besides wiggly.h: points that are held (pins), sides that they stay on (bounds), the frequency that explains
/// some knots, the solver's other method, and the filter's poles.
///
/// A structure here that has no `size` never changes in version 1.
#ifndef WIGGLY_MORE_H
#define WIGGLY_MORE_H

#include <wiggly/wiggly.h>

#ifdef __cplusplus
extern "C" {
#endif

/// The way a solver goes: the same curves but for rounding.
typedef enum wiggly_method {
    WIGGLY_CHAIN = 0, ///< knot-free stretches condensed where the parameters are constant, else the band: the fastest
    WIGGLY_BAND       ///< always all samples' band, factored as complex block-pentadiagonal: the paper's way
} wiggly_method;

/// Sets the method of all later solves; a new solver has WIGGLY_CHAIN.
void wiggly_set_method(wiggly_solver *solver, wiggly_method method);

/// How a point moves with a spline of a group: by Re(c x), for each of x, y and z. c is (re, im).
typedef struct wiggly_pull {
    int spline;
    double c[3][2];
} wiggly_pull;

/// A point that is to be somewhere at a sample: Σ over its pulls of Re(c x) is `to`, its way from where it is without any x.
typedef struct wiggly_pin {
    int sample;
    const wiggly_pull *pulls; ///< each of another spline
    int pull_count;
    double to[3];
    double left[3]; ///< filled: what of it is not reached
} wiggly_pin;

/// A side that a point is to stay on: Σ over the group's splines of Re(c x) is at least `least` at a sample.
typedef struct wiggly_bound {
    int sample;
    const double (*c)[2]; ///< (re, im), one a spline
    double least;
    double push; ///< filled: how hard that is held, half of what the weighed energy rises by as `least` does; ≥ 0
    double left; ///< filled: what is missing; ≤ 0: nothing
} wiggly_bound;

/// Splines that are solved together because points hang on several of them.
typedef struct wiggly_group wiggly_group;

/// The most pins of a group.
#define WIGGLY_MOST_PINS 4096

/// For up to so many splines, of up to `samples` samples and `knots` knots each, and so many pins. WIGGLY_ERROR_ARGUMENT,
/// WIGGLY_ERROR_MEMORY.
wiggly_status wiggly_group_create(int samples, int knots, int splines, int pins, wiggly_group **group);

/// Solves all splines so that Σ weights[s] times the energy of spline s is least, through their knots and the pins; allocates nothing.
/// A pin counts as a knot for where each spline that moves it starts and ends. Places that the splines can hardly move to are met in
/// part, and `left` says what is missing. Weights are positive: they make the energies comparable (the mean of |c|² over what a spline
/// moves serves). The limits of a spline that a pin moves are passed over. Returns the largest status; WIGGLY_ERROR_PIN for a pin outside a spline's samples (a loop's last one is outside), or on
/// a spline that is cubic, of calm 0 or of frequency 0 from its first knot or pin to the last.
wiggly_status wiggly_group_solve(wiggly_group *group, const wiggly_desc *descs, const double *weights,
                                 wiggly_curve *curves, int spline_count, wiggly_pin *pins, int pin_count);

/// The same with room for bounds.
wiggly_status wiggly_group_create_bounded(int samples, int knots, int splines, int pins, int bounds,
                                          wiggly_group **group);

/// wiggly_group_solve() with bounds: Σ weights[s] times the energy of spline s is least among all motions that meet them, too. A bound
/// does not count as a knot: one that presses nothing changes nothing. Behind a complex spline's last knot it presses what moves by itself. Those that
/// knots and pins leave no way are met in part, as pins are.
wiggly_status wiggly_group_solve_bounded(wiggly_group *group, const wiggly_desc *descs, const double *weights,
                                         wiggly_curve *curves, int spline_count, wiggly_pin *pins, int pin_count,
                                         wiggly_bound *bounds, int bound_count);

/// What part of all that moves a bound's point its knots and the pins of the last solve leave free at its sample, 0 … 1.
double wiggly_group_reach(const wiggly_group *group, const wiggly_bound *bound);

/// Sets the method of all later solves; a new group has WIGGLY_CHAIN.
void wiggly_group_set_method(wiggly_group *group, wiggly_method method);

/// Frees; NULL is fine.
void wiggly_group_destroy(wiggly_group *group);

/// An oscillation that knots may be of.
typedef struct wiggly_explanation {
    double frequency, damping;
    double cost; ///< the lower the better; a difference of 1 is e times less likely
} wiggly_explanation;

/// Knots from which a frequency can be told.
#define WIGGLY_FEWEST_EXPLAINED 4

/// The frequency and damping that explain the description's knots best, and the runner-up: how many were found, 0 … 2 (0: too few
/// knots, or all of them at the equilibrium). Of real mode as such, of the others as complex mode without bandwidth. Frequencies
/// go from half a swing over all knots to a little above half a swing over the smallest gap; of more than 48 knots the first ones
/// count. Allocates nothing.
int wiggly_explain(const wiggly_desc *desc, wiggly_explanation best[2]);

/// Frequency, Hz, and damping ratio of a spring k, 1/s², and a friction gamma, 1/s (eq. 12), neither below 0: √k/2π and gamma/2√k. No
/// damping beyond 10⁸: a friction without a spring is that of one so weak that it never shows.
void wiggly_from_spring(double k, double gamma, double *frequency, double *damping);

/// wiggly_evaluate_at() by position: a time in samples. Without the arrays that it needs it must not be called.
wiggly_value wiggly_evaluate(const wiggly_curve *curve, double position);

/// Float view for graphics: total at `count` positions from `from` in steps of `by` samples, written `stride` floats apart.
void wiggly_evaluate_float(const wiggly_curve *curve, double from, double by, int count, float *out, size_t stride);

/// The two continuous poles of constant parameters, 1/s, and the discrete ones λ = exp(s·h), each (re, im).
typedef struct wiggly_poles {
    double s[2][2];
    double z[2][2];
} wiggly_poles;

/// Poles of the description at a sample (section 4 and 5 of the paper).
wiggly_poles wiggly_poles_at(const wiggly_desc *desc, int sample);

#ifdef __cplusplus
}
#endif
#endif

/// One complex coordinate of a motion: its time series R and normal coordinate Ñ with S ≈ Re(R Ñ) (eq. 28), and a wiggly spline that
/// repeats it.
#ifndef ANALYSIS_COMPONENT_H
#define ANALYSIS_COMPONENT_H

#include <complex.h>
#include <stdbool.h>
#include <wiggly/wiggly.h>

/// Gives Σ_t |s_t − Re(x_t Ñ)|² for any time series x. s_t is a frame of the component's own motion: the motion of all vertices
/// minus the other components'.
struct series_metric {
    double complex *pull;  ///< s_t·Ñ per frame
    double norm;           ///< |Ñ|²
    double complex square; ///< Ñ·Ñ
    double power;          ///< Σ |s_t|²
};

struct component {
    int frames, vertices;
    double complex *series;      ///< R per frame; max |R| = 1
    double complex (*shape)[3];  ///< Ñ per vertex, metres a unit of R; a positive argument leads
    double explained;            ///< share of the motion, 0 … 1: of the complex variance by CPCA, else of S
    double direction[3];         ///< d of the gauge, a unit vector
    double frequency, damping;   ///< of R: undamped, Hz; ratio, 0 … 1
    struct series_metric metric; ///< gives the error of another time series in R's place
    double first_lag, last_lag;  ///< degrees: 5 % of the motion along d leads by more, 5 % lags by more
    double reach;                ///< metres: the farthest a vertex moves from its mean at |R| = 1
};

/// The relative error of the component's own motion with `series` in R's place: √(Σ |s_t − Re(x_t Ñ)|² / Σ |s_t|²).
double component_error(const struct component *component, const double complex *series);

/// Scales R to max |R| = 1 and Ñ by the inverse, so that R Ñ stays.
void component_scale(struct component *component);

/// Turns Ñ, and R the other way, so that Σ (ñ·d)² is real and positive and Re Σ ñ·d ≥ 0. `direction` is d, of any length; NULL
/// means the direction with the most motion: the largest eigenvector of Re Σ ñ ñᴴ, its largest number positive.
void component_turn(struct component *component, const double direction[3]);

/// Fits R ≈ c exp((−ζω_n + jω_n √(1−ζ²)) t): the slopes of log |R| and of the unwrapped arg R, weighted by |R|².
void component_fit(struct component *component, double fps);

/// Finds `first_lag`, `last_lag` and `reach`.
void component_lags(struct component *component);

// A wiggly spline that repeats a coordinate's motion, with few knots, one frequency and one damping.

enum { KNOTS_MOST = 5 };

/// One sample per frame, start free, calm 1; its numbers are rounded as they are written.
struct knots {
    wiggly_mode mode;                     ///< complex or real
    double frequency, damping, bandwidth; ///< Hz; ratio; fraction of the frequency
    int count;
    bool sloped;                                 ///< every knot has a slope
    int frame[KNOTS_MOST];                       ///< ascending; the first is 0
    double value[KNOTS_MOST], slope[KNOTS_MOST]; ///< value per second
    double complex *series;                      ///< x per frame
    double error;                                ///< component_error() of x
};

/// Finds the fewest knots, at most KNOTS_MOST, that bring the error near the component's own. Always gives the same knots.
void knots_create(struct knots *knots, const struct component *component, double fps);
void knots_free(struct knots *knots);

#endif

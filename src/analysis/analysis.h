/// The complex normal coordinates of a motion (the paper's section 7.2; src/analysis/README.md has the mathematics).
#ifndef ANALYSIS_ANALYSIS_H
#define ANALYSIS_ANALYSIS_H

#include "analysis/spectrum.h"
#include "base/lapack.h"
#include "base/need.h"
#include "model/motion.h"
#include "model/surface.h"
#include <complex.h>
#include <wiggly/wiggly.h>

// One complex coordinate of a motion: its time series R and normal coordinate Ñ with S ≈ Re(R Ñ) (eq. 28), or where points swing far, on
// curves, S ≈ Re(R Ñ) + |R|² A + Re(R² B).

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
    double (*lift)[3];           ///< A per vertex, metres; NULL: the shape is straight
    double complex (*bend)[3];   ///< B likewise
    double explained;            ///< share of the motion, 0 … 1: of the complex variance by CPCA, else of S
    double direction[3];         ///< d of the gauge, a unit vector
    double frequency, damping;   ///< of R: undamped, Hz; ratio, 0 … 1
    struct series_metric metric; ///< gives the error of another time series in R's place
    double first_lag, last_lag;  ///< degrees: 5 % of the motion along d leads by more, 5 % lags by more
    double reach;                ///< metres: the farthest a vertex moves from its mean at |R| = 1
};

/// The relative error of the component's own motion with `series` in R's place: √(Σ |s_t − Re(x_t Ñ)|² / Σ |s_t|²).
double component_error(const struct component *component, const double complex *series);

/// Fits R ≈ c exp((−ζω_n + jω_n √(1−ζ²)) t): the slopes of log |R| and of the unwrapped arg R, weighted by |R|².
void component_fit(struct component *component, double fps);

/// Finds `first_lag`, `last_lag` and `reach`.
void component_lags(struct component *component);

// The analysis.

enum {
    ANALYSIS_FRAMES_MIN = 8,
    ANALYSIS_FRAMES_MAX = 4096, ///< n frames need 100 n² bytes by CPCA, 40 n² by poles
    ANALYSIS_MODES_MAX = TIME_SERIES_MAX,
};

enum analysis_method {
    ANALYSIS_POLES, ///< one coordinate per pole, with its own frequency and damping, whatever the frame rate
    ANALYSIS_CPCA,  ///< the paper's: complex principal components of the analytic signal
};

struct analysis_plan {
    enum analysis_method method;
    double fps;               ///< frames per second
    int modes;                ///< at most this many components, 1 … ANALYSIS_MODES_MAX
    const double *direction;  ///< three numbers that fix the gauge, or NULL
    const struct rigid *base; ///< what the motion is seen from; NULL: as it is
    int first;                ///< first frame without a drive, from which poles are found; 0 by CPCA
    bool straight;            ///< no A and B: eq. 28 alone
};

struct analysis {
    struct pool pool;
    double pca1, pca2;   ///< shares of the real variance that real PCA's first and first two explain, 0 … 1
    double (*middle)[3]; ///< the position that each vertex swings about, metres; by CPCA its mean
    struct component *components;
    int count;
    int cancelled;     ///< poles left out because others nearly cancel them
    double power;      ///< Σ |s_t|² of the motion about its middle, m²
    double left;       ///< relative error of that with all components, 0 … 1
    double straight;   ///< the same without their A and B
    double real_left;  ///< the same with as many real principal components
    double fast_share; ///< of the motion's power above four fifths of half the frame rate, 0 … 1
};

/// Finds the components, most important first; fewer than asked for if the motion has fewer poles. Reads the motion twice; needs
/// memory for frames² numbers, a slab of 8 MiB and the result. Errors: too few or too many frames, nothing moves or oscillates, a
/// number that is not finite, not enough memory.
bool analysis_create(struct analysis *analysis, const struct lapack *lapack, const struct motion *motion,
                     const struct analysis_plan *plan, struct error *error);

// A wiggly spline that repeats a coordinate's motion, with few knots, one frequency and one damping.

enum { KNOTS_MOST = 5 };

/// One sample per frame, start free, calm 1; its numbers are rounded as they are written.
struct knots {
    wiggly_mode mode;                     ///< complex or real
    double frequency, damping, bandwidth; ///< Hz; ratio; fraction of the frequency
    double
        last_frequency; ///< Hz, at the last frame: from `frequency` at the first it changes evenly; mostly the same
    int count;
    bool sloped;                                 ///< every knot has a slope
    int frame[KNOTS_MOST];                       ///< ascending; the first is 0
    double value[KNOTS_MOST], slope[KNOTS_MOST]; ///< value per second
    double complex *series;                      ///< x per frame, which the caller frees
    double error;                                ///< component_error() of x
};

/// Finds the fewest knots, at most KNOTS_MOST, that bring the error near the component's own. Always gives the same knots.
void knots_create(struct knots *knots, const struct component *component, double fps);

// The rigid motion of a body's base, and passes over a motion from which it is removed.

/// In every frame the base's point that rests at r is at R r + p, with R and p of the least sum of squares (Horn 1987).
struct rigid {
    struct pool pool;     ///< has all below
    int frames;           ///< 0: the base rests, and the motion stays as it is
    double (*turn)[3][3]; ///< R of every frame
    double (*place)[3];   ///< p of every frame, metres
    bool whole;           ///< the base is the whole mesh
    bool base_unknown;    ///< the base is not known: a coordinate may have rigid motions of the mesh
    double travel, angle; ///< at most, from the first frame on: metres of the base's centre, degrees
};

/// Finds the motion of the vertices in `base`, one flag per vertex of `rest`. If it is NULL, resting vertices are the base, unless they lie
/// on a line. Without any, the base is the whole mesh, and only the slow part of its motion counts. Reads the motion once.
/// Errors: a number that is not finite, a file that shrinks.
bool rigid_find(struct rigid *rigid, const struct lapack *lapack, const struct motion *motion,
                const struct surface *rest, const bool *base, struct error *error);

/// The share of a shape that small rigid motions of the whole mesh explain, 0 … 1.
double rigid_share(const double complex (*shape)[3], const struct surface *rest);

// Passes over a motion, a slab of columns at a time: seen from the base, if that is not NULL, and without each column's mean over time:

/// G = S Sᵀ, frames × frames, row after row, both halves filled; and the means.
bool slabs_gram(const struct lapack *lapack, const struct motion *motion, const struct rigid *base, double *gram,
                double *means, struct error *error);

/// W S: `rows` weightings of the frames (rows × frames) give rows × columns.
bool slabs_combine(const struct lapack *lapack, const struct motion *motion, const struct rigid *base,
                   const double *weights, int rows, double *combined, struct error *error);

#endif

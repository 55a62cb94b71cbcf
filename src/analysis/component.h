/// One complex principal component: its time course R and its complex normal coordinate Ñ, with S ≈ Re(R Ñ).
#ifndef ANALYSIS_COMPONENT_H
#define ANALYSIS_COMPONENT_H

#include <complex.h>
#include <stdbool.h>

struct component {
    int frames, vertices;
    double complex *course;     ///< R per frame; max |R| = 1
    double complex (*shape)[3]; ///< Ñ per vertex, metres a unit of R; a positive argument leads
    double explained;           ///< share of the complex variance, 0 … 1
    double direction[3];        ///< d of the gauge, a unit vector
    double frequency, damping;  ///< of R: undamped, Hz; ratio, 0 … 1
    double first_lag,
        last_lag; ///< degrees: 5 % of the motion along d leads by more than the one, 5 % lags by more than the other
    double reach; ///< metres: the farthest any vertex moves from its mean while |R| = 1
};

/// Scales R to max |R| = 1 and Ñ inversely, so that R Ñ stays.
void component_scale(struct component *component);

/// Turns Ñ, and R against it, so that Σ (ñ·d)² is real and positive with Re Σ ñ·d ≥ 0. `direction` is d, of any length; NULL
/// means the direction that moves most: the largest eigenvector of Re Σ ñ ñᴴ, its largest number positive.
void component_turn(struct component *component, const double direction[3]);

/// Fits R ≈ c exp((−ζω_n + jω_n √(1−ζ²)) t): the slopes of log |R| and of the unwrapped arg R, weighted by |R|².
void component_fit(struct component *component, double fps);

/// Finds `first_lag`, `last_lag` and `reach`. False where memory is short.
bool component_lags(struct component *component);

#endif

/// The complex normal coordinates of a motion (the paper's section 7.2; src/analysis/README.md has the mathematics).
#ifndef ANALYSIS_ANALYSIS_H
#define ANALYSIS_ANALYSIS_H

#include "analysis/component.h"
#include "analysis/poles.h"
#include "analysis/rigid.h"
#include "base/pool.h"

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
    const double *direction;  ///< three numbers that fix the gauge (see component_turn()), or NULL
    const struct rigid *base; ///< what the motion is seen from; NULL: as it is
    int first;                ///< first frame without a drive, from which poles are found; 0 by CPCA
};

struct analysis {
    struct pool pool;
    double pca1, pca2; ///< shares of the real variance that real PCA's first and first two explain, 0 … 1
    double (*mean)[3]; ///< each vertex's mean position, metres
    struct component *components;
    int count;
    int cancelled;     ///< poles left out because others nearly cancel them
    double left;       ///< relative error of the motion with all components, 0 … 1
    double real_left;  ///< the same with as many real principal components
    double fast_share; ///< of the motion's power above four fifths of half the frame rate, 0 … 1
};

/// Finds the components, most important first; fewer than asked for if the motion has fewer poles. Reads the motion twice; needs
/// memory for frames² numbers, a slab of 8 MiB and the result. Errors: too few or too many frames, nothing moves or oscillates, a
/// number that is not finite, not enough memory.
bool analysis_create(struct analysis *analysis, const struct lapack *lapack, const struct motion *motion,
                     const struct analysis_plan *plan, struct error *error);
void analysis_free(struct analysis *analysis);

#endif

/// Complex principal component analysis of a motion (the paper's section 7.2; src/analysis/README.md has the mathematics).
#ifndef ANALYSIS_ANALYSIS_H
#define ANALYSIS_ANALYSIS_H

#include "analysis/component.h"
#include "base/lapack.h"
#include "model/motion.h"

enum {
    ANALYSIS_FRAMES_MIN = 8,
    ANALYSIS_FRAMES_MAX = 4096, ///< the memory grows with the square of the frames: 100 n² bytes
};

struct analysis {
    double pca1, pca2; ///< shares of the real variance that real PCA's first and first two explain, 0 … 1
    double (*mean)[3]; ///< each vertex's mean position, metres
    struct component *components;
    int count;
};

/// Finds the `modes` largest components, at most as many as there are frames. `fps` is in frames per second; `direction` fixes
/// the gauge (see component_turn()), or is NULL. Reads the motion twice; needs memory for frames² numbers, a slab of 8 MiB and
/// the result. Errors: too few or too many frames, nothing moves, a number that is not finite, out of memory.
bool analysis_create(struct analysis *analysis, const struct lapack *lapack, const struct motion *motion, double fps,
                     int modes, const double direction[3], struct error *error);
void analysis_free(struct analysis *analysis);

#endif

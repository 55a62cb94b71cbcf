/// The rigid motion of what carries a body, its base: a motion is analysed as seen from there.
#ifndef ANALYSIS_RIGID_H
#define ANALYSIS_RIGID_H

#include "base/lapack.h"
#include "model/motion.h"
#include "model/surface.h"
#include <complex.h>

/// In every frame the base's point that rests at r is at R r + p, with R and p of the least sum of squares (Horn 1987).
struct rigid {
    int frames;           ///< 0: the base rests, and the motion stays as it is
    double (*turn)[3][3]; ///< R of every frame
    double (*place)[3];   ///< p of every frame, metres
    bool whole;           ///< the base is the whole mesh
    bool loose;           ///< the base is not known: a coordinate may have rigid motions of the mesh
    double travel, angle; ///< at most, from the first frame on: metres of the base's centre, degrees
};

/// Finds the motion of the vertices in `base`, one flag per vertex of `rest`. NULL: the base rests if vertices do that are more than a
/// point or a line; else it is the whole mesh, of whose motion only the slow part counts: the rest may be the swing. Reads the motion once.
/// Errors: a number that is not finite, a file that shrinks.
bool rigid_find(struct rigid *rigid, const struct lapack *lapack, const struct motion *motion,
                const struct surface *rest, const bool *base, struct error *error);
void rigid_free(struct rigid *rigid);

/// Takes vertices back into the frame of the mesh at rest: y = Rᵀ (x − p). `columns` is 3 per vertex, for each frame.
void rigid_undo(const struct rigid *rigid, double *numbers, int columns);

/// The share of a shape that small rigid motions of the whole mesh explain, 0 … 1.
double rigid_share(const double complex (*shape)[3], const struct surface *rest);

#endif

/// A motion as a sum of damped oscillations that nothing disturbs: which poles matter.
#ifndef ANALYSIS_EXPONENTIALS_H
#define ANALYSIS_EXPONENTIALS_H

#include "analysis/basis.h"
#include "analysis/subspace.h"

/// Re z^t and −Im z^t over the frames, largest |z^t| = 1: two rows of `frames` numbers each.
void exponentials_fill(double complex z, int frames, double *rows);

/// Moves those of the poles to the front that explain the motion best, each beside those before it, and appends them to
/// `basis`, which has drift_append()'s two sequences and room for two a pole. Steady poles come before those that wander. At
/// most `most`, at least one where there is any; those that explain less than `least` of the motion's power, or only by cancelling
/// each other, stay behind. Returns their number.
int exponentials_choose(struct pole *poles, int count, int most, double least, const double *gram,
                        struct basis *basis);

#endif

/// Another motion of the same material: the noise that a spline's knots are solved over (docs/mathematics.md, Variations).
#ifndef SPLINE_VARIATION_H
#define SPLINE_VARIATION_H

#include "spline/problem.h"

/// Whether a description has one: some amount, an oscillator of constant poles that has a frequency.
bool variation_is_set(const wiggly_desc *desc);

/// Adds the noise of every sample to u of a problem whose domain is known, and its value before `first` to what is held there.
void variation_add(problem *p);

#endif

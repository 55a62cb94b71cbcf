/// A spline of the document with constant parameters.
#ifndef TESTS_SPLINE_OF_H
#define TESTS_SPLINE_OF_H

#include "scene/document.h"

/// Frequency in Hz, ratios of damping and bandwidth, otherwise defaults.
static inline struct spline spline_of(enum wiggly_mode mode, double frequency, double damping, double bandwidth)
{
    struct spline spline = {.color = -1};
    for (int i = 0; i < PARAMETER_COUNT; i++) spline.parameter[i] = param_number(parameter_rows[i].standard);
    spline.parameter[PARAMETER_MODE].value = mode;
    spline.parameter[PARAMETER_FREQUENCY].value = frequency;
    spline.parameter[PARAMETER_DAMPING].value = damping;
    spline.parameter[PARAMETER_BANDWIDTH].value = bandwidth;
    return spline;
}

#endif

/// The wiggly spline that does what a coordinate did: few knots, a frequency, a damping.
#ifndef ANALYSIS_KNOTS_H
#define ANALYSIS_KNOTS_H

#include "analysis/component.h"
#include <wiggly/wiggly.h>

enum { KNOTS_MOST = 5 };

/// A spline of one sample a frame, start free and calm 1; its numbers are as short as they are written.
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

/// Finds as few knots as bring the error of the motion near the component's own, at most KNOTS_MOST. The same component gives the same
/// knots.
void knots_create(struct knots *knots, const struct component *component, double fps);
void knots_free(struct knots *knots);

#endif

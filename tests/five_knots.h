/// A scene for the curves panel: a spline with five knots, one with a slope, and a spline with two.
#ifndef TESTS_FIVE_KNOTS_H
#define TESTS_FIVE_KNOTS_H

#include "session.h"

static const char FIVE[] = "{'wiggly': 1, 'frames': [0, 96], 'splines': [{'name': 'sway', 'frequency': 1,'damping': "
                           "0.1, 'knots': [<10 0>, {'frame': 20, 'value': 1, 'slope': 2},<30 -1>, <40 0.5>, <60 "
                           "0>]},{'name': 'up', 'mode': 'cubic', 'knots': [<5 1.3>,<70 0.75>]}]}";

static inline const struct spline *spline(const struct session *s, int i) { return s->document->splines[i]; }

#endif

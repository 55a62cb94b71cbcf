/// A scene for the curves panel: a spline with five knots, one with a slope, and a spline with two.
#ifndef TESTS_FIVE_KNOTS_H
#define TESTS_FIVE_KNOTS_H

#include "session.h"

static const char FIVE[] =
    "{\"wiggly\": 1, \"frames\": [0, 96], \"splines\": [{\"name\": \"sway\", \"frequency\": 1,"
    "\"damping\": 0.1, \"knots\": [{\"frame\": 10, \"value\": 0}, {\"frame\": 20, \"value\": 1, \"slope\": 2},"
    "{\"frame\": 30, \"value\": -1}, {\"frame\": 40, \"value\": 0.5}, {\"frame\": 60, \"value\": 0}]},"
    "{\"name\": \"up\", \"mode\": \"cubic\", \"knots\": [{\"frame\": 5, \"value\": 1.3},"
    "{\"frame\": 70, \"value\": 0.75}]}]}";

static inline const struct spline *spline(const struct session *s, int i) { return s->document->splines[i]; }

#endif

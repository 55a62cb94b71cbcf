/// What is wrong with splines though they load and solve.
#ifndef SCENE_WARNINGS_H
#define SCENE_WARNINGS_H

#include "scene/document.h"

/// Why the slope of a knot of a spline has no effect, to stand behind "the slope has no effect: "; NULL where it has one, or where a track decides.
const char *knot_idle_slope(const struct document *document, int of, int knot);

/// Index of the first pose of a spline whose mode has no phase, or -1.
int spline_idle_pose(const struct spline *spline);

#endif

/// How the same knots are shown.
#ifndef RIG_LOOK_H
#define RIG_LOOK_H

/// The paper's method, without lag, or as classical cubics (the splines are then solved so).
enum look { LOOK_WIGGLY, LOOK_STIFF, LOOK_CUBIC };

#endif

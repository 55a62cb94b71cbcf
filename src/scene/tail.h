/// A tail in a scene (paper, section 7.1): joints that splines bend, each later than the one before.
#ifndef SCENE_TAIL_H
#define SCENE_TAIL_H

#include "scene/param.h"
#include <stdbool.h>

enum {
    SCENE_MAX_CHANNELS = 64, ///< of one tail
    TAIL_MAX_JOINTS = 256,
};

/// One angle for all joints, or one for each (degrees).
struct angles {
    bool each;
    double value[TAIL_MAX_JOINTS]; ///< value[0] alone unless `each`
};

enum axis { AXIS_SIDE, AXIS_UP };

/// Which part of its spline a channel bends by: the total y + Re(e^{−j·n·lag} x), or without the equilibrium y. The latter is for a tail
/// on something that moves: y is the base's motion, and x is relative to it.
enum channel_part { PART_TOTAL, PART_DISPLACEMENT };

struct channel {
    int spline; ///< index
    enum axis axis;
    enum channel_part of;
    struct angles lag;  ///< n·lag at joint n, or one for each joint
    struct angles gain; ///< degrees per unit of the spline
    struct json_t *extra;
};

struct tail {
    int joints; ///< 1 … TAIL_MAX_JOINTS
    double length;
    struct param position[3]; ///< metres; a track is the spline's total
    struct angles rest;
    struct channel *channels;
    int channel_count;
};

#define TAIL_DEFAULT_JOINTS 24
#define TAIL_DEFAULT_LENGTH 1.6  /* m */
#define CHANNEL_DEFAULT_LAG 6.5  /* degrees a joint */
#define CHANNEL_DEFAULT_GAIN 5.0 /* degrees a unit of the spline */

#endif

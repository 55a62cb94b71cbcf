/// A channel: a spline that bends the joints of a tail or chain, each later than the one before.
#ifndef SCENE_CHANNEL_H
#define SCENE_CHANNEL_H

#include "scene/angles.h"

enum { SCENE_MAX_CHANNELS = 64 }; ///< of one rig

/// About what a joint bends. Tails do not twist.
enum axis { AXIS_SIDE, AXIS_UP, AXIS_TWIST };

/// Which part of its spline a channel bends by: the total y + Re(e^{−j·n·lag} x), or without the equilibrium y. The latter is for a rig
/// on something that moves: y is the base's motion, and x is relative to it.
enum channel_part { PART_TOTAL, PART_DISPLACEMENT };

struct channel {
    int spline; ///< index
    enum axis axis;
    enum channel_part of;
    struct angles lag;  ///< see angles_lag()
    struct angles gain; ///< degrees per unit of the spline
    struct json_t *extra;
};

#define CHANNEL_DEFAULT_LAG 6.5  /* degrees a joint */
#define CHANNEL_DEFAULT_GAIN 5.0 /* degrees a unit of the spline */

#endif

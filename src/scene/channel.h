/// A channel: a spline that bends the joints of a tail or chain, each later than the one before, or moves a part of the tail's fox.
#ifndef SCENE_CHANNEL_H
#define SCENE_CHANNEL_H

#include "scene/angles.h"

enum { SCENE_MAX_CHANNELS = 64 }; ///< of one rig

/// About what a joint bends. Tails do not twist; but the rest, which move the body, are theirs alone.
enum axis {
    AXIS_SIDE,
    AXIS_UP,
    AXIS_TWIST,
    AXIS_LOOK,    ///< turns the head sideways, degrees
    AXIS_NOD,     ///< lifts it, degrees
    AXIS_EARS,    ///< lays the ears back, degrees; their tips by as much again, and later
    AXIS_BREATH,  ///< widens the chest, percent
    AXIS_STRETCH, ///< makes the body taller at the same volume, percent
    AXIS_BLINK,   ///< closes the lids, percent
    AXES
};

/// Whether it bends joints; else it moves the body.
bool axis_bends(enum axis axis);

/// Its word in files, and the unit of its gain.
const char *axis_word(enum axis axis);
const char *axis_unit(enum axis axis);

/// The gain that a new channel has: one that shows.
double axis_gain(enum axis axis);

/// Which part of its spline a channel bends by: the total y + Re(e^{−j·n·lag} x), or without the equilibrium y. The latter is for a rig
/// on something that moves: y is the base's motion, and x is relative to it.
enum channel_part { PART_TOTAL, PART_DISPLACEMENT };

struct channel {
    int spline; ///< index
    enum axis axis;
    enum channel_part of;
    struct angles lag;  ///< see angles_lag()
    struct angles gain; ///< degrees (or percent) per unit of the spline; of what moves the body the first counts
    struct json_t *extra;
};

#define CHANNEL_DEFAULT_LAG 6.5  /* degrees a joint */
#define CHANNEL_DEFAULT_GAIN 5.0 /* degrees (or percent) a unit of the spline, where a file names none */

#endif

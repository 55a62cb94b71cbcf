/// A channel: a spline that bends the joints of a tail or chain, each later than the one before, or moves a part of the tail's fox;
/// and angles along joints: one number, one a joint, or a ramp.
#ifndef SCENE_CHANNEL_H
#define SCENE_CHANNEL_H

#include <stdbool.h>

enum {
    ANGLES_MAX_JOINTS = 256,
    RAMP_MAX_POINTS = 32, ///< and at least 2
};

/// How they are written in the file.
enum angle_form { ANGLES_ONE, ANGLES_EACH, ANGLES_RAMP };

/// The angle at a place from 0 (the first joint) to 1 (the last); straight between points, constant before the first and behind the last.
struct ramp_point {
    double at, angle;
};

/// Degrees.
struct angles {
    enum angle_form form;
    int count; ///< of joints of ANGLES_EACH, of points of ANGLES_RAMP
    union {
        double value[ANGLES_MAX_JOINTS]; ///< value[0] alone of ANGLES_ONE
        struct ramp_point ramp[RAMP_MAX_POINTS];
    };
};

/// The angle of a joint, of `joints` in all. Behind the last number of ANGLES_EACH it stays the last.
double angles_at(const struct angles *angles, int joint, int joints);

/// How far a joint lags behind the first: of one number, that times `joint`; else the joint's own.
double angles_lag(const struct angles *lag, int joint, int joints);

/// How many angles it is made of: 1, one a joint or one a point of the ramp. And each of them.
int angles_count(const struct angles *angles);
double angles_number(const struct angles *angles, int index);
void angles_set_number(struct angles *angles, int index, double degrees);

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

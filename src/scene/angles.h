/// Angles along the joints of a tail or chain: one number, one a joint, or a ramp.
#ifndef SCENE_ANGLES_H
#define SCENE_ANGLES_H

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

#endif

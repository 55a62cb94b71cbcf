/// A tail in a scene (paper, section 7.1): joints that splines bend, each later than the one before.
#ifndef SCENE_TAIL_H
#define SCENE_TAIL_H

#include "scene/channel.h"
#include "scene/parameter.h"

enum { TAIL_MAX_JOINTS = ANGLES_MAX_JOINTS };

struct tail {
    struct channel *channels; ///< first, as in every kind of rig that has some (rig.h)
    int channel_count;
    int joints; ///< 1 … TAIL_MAX_JOINTS
    double length;
    struct param position[3]; ///< metres; a track is the spline's total
    struct angles rest;
};

#define TAIL_DEFAULT_JOINTS 24
#define TAIL_DEFAULT_LENGTH 1.6 /* m */

#endif

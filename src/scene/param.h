/// A parameter's value: a number, a choice, another spline or the motion of a joint.
#ifndef SCENE_PARAM_H
#define SCENE_PARAM_H

#include <stdbool.h>

struct joint_motion;

/// A number, the index of a word, the total of another spline, or what a joint does in a clip.
struct param {
    double value;                ///< used if it follows nothing
    int track;                   ///< index of the spline that is followed, or -1
    struct joint_motion *motion; ///< of the joint that is followed (joint_motion.h), or NULL; a spline holds it
    double gain;                 ///< times that motion
};

/// A constant, and the track of a spline.
static inline struct param param_number(double value) { return (struct param){.value = value, .track = -1}; }
static inline struct param param_track(int spline) { return (struct param){.track = spline}; }

static inline bool param_follows(const struct param *param) { return param->track >= 0 || param->motion; }

#endif

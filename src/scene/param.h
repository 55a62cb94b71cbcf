/// A number that may be another spline's instead.
#ifndef SCENE_PARAM_H
#define SCENE_PARAM_H

/// A number, the total of another spline, or one of several words.
struct param {
    double value; ///< used where track < 0; of words: which
    int track;    ///< index of the spline that is followed, or -1
};

#endif

/// A parameter's value: a number, a choice or another spline.
#ifndef SCENE_PARAM_H
#define SCENE_PARAM_H

/// A number, the index of a word, or the total of another spline.
struct param {
    double value; ///< used if track < 0
    int track;    ///< index of the spline that is followed, or -1
};

#endif

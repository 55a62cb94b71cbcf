/// A chain in a scene: joints of an imported character that splines bend on top of its clip.
#ifndef SCENE_CHAIN_H
#define SCENE_CHAIN_H

#include "scene/channel.h"

struct chain {
    struct channel *channels; ///< first, as in every kind of rig that has some (rig.h)
    int channel_count;
    char *model;     ///< the name of a model rig, or its file
    bool by_file;    ///< `model` is the file
    char *from, *to; ///< names of the first joint and the last; not looked up here
    double turn;     ///< degrees by which its axes are turned about its own direction
    bool mirror;     ///< side and twist change sign
};

#endif

/// A chain in a scene: joints of an imported character that splines bend on top of its clip.
#ifndef SCENE_CHAIN_H
#define SCENE_CHAIN_H

#include "scene/channel.h"

struct chain {
    char *model;     ///< the name of a model rig, or its file
    bool by_file;    ///< `model` is the file
    char *from, *to; ///< names of the first joint and the last; not looked up here
    double turn;     ///< degrees by which its axes are turned about its own direction
    bool mirror;     ///< side and twist change sign
    struct channel *channels;
    int channel_count;
};

#endif

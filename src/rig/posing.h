/// A document at a position in time → its rigs posed. Pure: the only way to pose, for the stage, figures, tests and export alike.
#ifndef RIG_POSING_H
#define RIG_POSING_H

#include "rig/cast.h"
#include "rig/morph.h"
#include "rig/pose.h"
#include "scene/evaluate.h"

/// What rigs are posed from.
struct posing {
    const struct document *document;
    const struct evaluation *evaluation; ///< NULL: all splines are 0
    const struct cast *cast;             ///< the characters' models; NULL: none
    enum look look;
};

/// What moves a tail besides the document.
struct by_hand {
    wiggly_value channel[SCENE_MAX_CHANNELS]; ///< added to each channel's value
    double base[3];                           ///< metres
};

/// Poses a tail at a position in samples; `by_hand` may be NULL. Allocates nothing.
void posing_tail(const struct posing *posing, int tail, double position, const struct by_hand *by_hand,
                 struct pose *pose);

/// The same of a character; false where its model could not be read.
bool posing_character(const struct posing *posing, int character, double position, struct morph *morph);

#endif

/// Every place where a document names a spline by its index: tracks, positions, channels and drives.
#ifndef SCENE_REFERENCE_H
#define SCENE_REFERENCE_H

#include "scene/document.h"

enum reference_kind {
    REFERENCE_TRACK,    ///< a spline's parameter that follows
    REFERENCE_POSITION, ///< a coordinate of a tail's position that follows
    REFERENCE_CHANNEL,  ///< a tail's or chain's channel
    REFERENCE_DRIVE,    ///< what moves a coordinate of a character
    REFERENCE_MEADOW,   ///< what a meadow swings by
};

/// Zero before the first.
struct reference {
    enum reference_kind kind;
    int owner;  ///< index of the spline or rig
    int which;  ///< enum parameter, coordinate 0 … 2, channel, or drive
    int spline; ///< index of the spline that it names
    int number; ///< the next one's of this owner
};

/// Goes on to the next reference; false after the last.
bool reference_next(const struct document *document, struct reference *reference);

/// Makes a reference name another spline.
void reference_set(struct document *document, const struct reference *reference, int spline);

/// How many references there are to a spline.
int reference_count(const struct document *document, int spline);

#endif

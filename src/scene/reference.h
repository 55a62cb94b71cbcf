/// Every place of a document that names a spline by its index: tracks, positions, channels and drives.
#ifndef SCENE_REFERENCE_H
#define SCENE_REFERENCE_H

#include "scene/document.h"

enum reference_kind {
    REFERENCE_TRACK,    ///< a spline's parameter that follows
    REFERENCE_POSITION, ///< a coordinate of a tail's position that follows
    REFERENCE_CHANNEL,  ///< a tail's channel
    REFERENCE_DRIVE,    ///< what moves a coordinate of a character
};

struct reference {
    enum reference_kind kind;
    int owner;   ///< index of the spline or rig
    int which;   ///< enum parameter, coordinate 0 … 2, channel, or drive
    int *spline; ///< the index itself, which a visitor may change
};

typedef void reference_visitor(const struct reference *reference, void *context);

/// Visits all references; numbers that follow no spline are none.
void reference_each(struct document *document, reference_visitor *visit, void *context);

/// The same of one rig, at `index` in the list.
void rig_references(struct rig *rig, int index, reference_visitor *visit, void *context);

/// How many references there are to a spline.
int reference_count(const struct document *document, int spline);

#endif

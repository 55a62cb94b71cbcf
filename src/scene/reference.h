/// Every place where a document names a spline by its index: tracks, positions, channels and drives.
#ifndef SCENE_REFERENCE_H
#define SCENE_REFERENCE_H

#include "scene/document.h"

enum reference_kind {
    REFERENCE_TRACK,    ///< a spline's parameter that follows
    REFERENCE_POSITION, ///< a coordinate of a tail's position that follows
    REFERENCE_CHANNEL,  ///< a tail's channel
    REFERENCE_DRIVE,    ///< what moves a coordinate of a character
    REFERENCE_MEADOW,   ///< what a meadow swings by
};

struct reference {
    enum reference_kind kind;
    int owner;  ///< index of the spline or rig
    int which;  ///< enum parameter, coordinate 0 … 2, channel, or drive
    int spline; ///< index of the spline that it names
};

typedef void reference_visitor(const struct reference *reference, void *context);

/// Visits all references. A visitor may set the one that it is shown.
void reference_each(const struct document *document, reference_visitor *visit, void *context);

/// Makes a reference name another spline.
void reference_set(struct document *document, const struct reference *reference, int spline);

/// The same for one rig, the one at `index` in the list.
void rig_references(const struct rig *rig, int index, reference_visitor *visit, void *context);
void rig_set_reference(struct rig *rig, const struct reference *reference, int spline);

/// How many references there are to a spline.
int reference_count(const struct document *document, int spline);

#endif

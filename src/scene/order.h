/// References to splines, and the order in which to solve them: each after those that it follows by tracks.
#ifndef SCENE_ORDER_H
#define SCENE_ORDER_H

#include "scene/document.h"

/// Memory for a search: one element of each for every spline.
struct order_space {
    int *stack;
    unsigned char *next;
};

/// A cycle of tracks: this parameter of this spline leads back to the spline.
struct order_cycle {
    int spline;
    enum parameter parameter;
};

/// Writes all splines into `order`, leaders first and otherwise in file order. Tracks that the mode ignores count too, so that a change
/// of mode cannot close a cycle. false with the cycle if there is one.
bool scene_order(const struct document *document, struct order_space space, int *order, struct order_cycle *cycle);

/// Whether there is such an order; allocates what it needs.
bool scene_has_order(const struct document *document, struct order_cycle *cycle);

/// Whether a spline's solution depends on that parameter, in its own mode or as a cubic.
bool spline_uses(const struct spline *spline, enum parameter parameter, bool cubic);

/// Marks, of the first `count` splines, this one and all that follow it, directly or not: those that it cannot follow itself.
/// Allocates nothing; takes up to count² steps.
void scene_followers(const struct document *document, int spline, bool *followers, int count);

enum reference_kind {
    REFERENCE_TRACK,    ///< a spline's parameter that follows
    REFERENCE_POSITION, ///< a coordinate of a rig's position that follows
    REFERENCE_CHANNEL,  ///< an input of a rig that has channels
    REFERENCE_DRIVE,    ///< an input of another rig: a coordinate of a character
};

/// All zero before the first reference.
struct reference {
    enum reference_kind kind;
    int owner;  ///< index of the spline or rig
    int which;  ///< enum parameter, coordinate 0 … 2, channel, or drive
    int spline; ///< index of the spline
    int number; ///< number of this owner's next reference
};

/// Goes on to the next reference; false after the last.
bool reference_next(const struct document *document, struct reference *reference);

/// Makes a reference refer to another spline.
void reference_set(struct document *document, const struct reference *reference, int spline);

/// How many references there are to a spline.
int reference_count(const struct document *document, int spline);

#endif

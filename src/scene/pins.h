/// The pins of a document's rigs (pin.h): looked up, put in order and checked.
#ifndef SCENE_PINS_H
#define SCENE_PINS_H

#include "scene/document.h"

/// Pins over all rigs.
int pins_count(const struct document *document);
/// Whether a rig's splines are solved together: it has pins or a floor. And whether any rig's are.
bool pins_hold_rig(const struct rig *rig);
bool pins_hold_any(const struct document *document);
/// Whether pins or a floor move a spline: one of a rig that has some.
bool pins_move_spline(const struct document *document, int spline);

/// Index of a rig's pin with that id, or -1.
int pins_find_id(const struct rig *rig, unsigned id);

/// Index of the pin of that point on that sample, or -1.
int pins_find(const struct document *document, const struct rig *rig, int point, int sample);

/// The last sample that may have a pin of the rig: where a loop drives it, the very last repeats the first.
int pins_last_sample(const struct document *document, const struct rig *rig);

/// Puts a pin into its place, by frame and then by point. And takes one out, by its id.
void pins_insert(struct rig *rig, const struct pin *pin);
struct pin pins_remove(struct rig *rig, unsigned id);

/// What is wrong with pins: "expected …, got …", about a member of a pin, or of all of a rig's, or of its floor (pin is -1).
struct pin_trouble {
    int rig, pin;
    const char *member; ///< of the pin, else of the rig
    char sentence[512];
};

/// Whether all pins are inside the frames, each alone on its sample, and on splines that have a motion of their own.
bool pins_check(const struct document *document, struct pin_trouble *trouble);

/// Whether no spline of a pinned rig follows another that is solved together with it. Allocates.
bool pins_check_order(const struct document *document, struct pin_trouble *trouble);

#endif

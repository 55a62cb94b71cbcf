/// The pins of a document's rigs (rig.h): looked up, put in order and checked; and the groups of splines that they join.
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
    struct error error;
};

/// Whether all pins are inside the frames, each alone on its sample, and on splines that have a motion of their own.
bool pins_check(const struct document *document, struct pin_trouble *trouble);

/// Whether no spline of a pinned rig follows another that is solved together with it. Allocates.
bool pins_check_order(const struct document *document, struct pin_trouble *trouble);

/// Writes for each spline the first one of its group; -1: no pin moves it.
void pin_groups_find(const struct document *document, int *group);

/// Splines that cannot be in one group, or in groups that wait for each other: `spline` follows `leader`.
struct pin_cycle {
    int spline, leader;
};

/// Writes all splines into `order`, each after those that it follows, a group's in a row: `tracked` is scene_order()'s. A group also comes
/// after what else moves its rigs, as what they stand on does, where that does not follow it in turn. `placed` and `bases` have room
/// for one a spline. false with the cycle if there is none.
bool pin_groups_order(const struct document *document, const int *group, const int *tracked, bool *placed,
                      bool *bases, int *order, struct pin_cycle *cycle);

/// Marks the splines that move a group's pinned rigs without being of the group.
void pin_groups_find_bases(const struct document *document, const int *group, int which, bool *bases);

#endif

/// The pins of a document's rigs (rig.h): looked up, sorted and checked; and the groups of splines that they join.
#ifndef SCENE_PINS_H
#define SCENE_PINS_H

#include "scene/document.h"

/// Pins over all rigs.
int pins_count(const struct document *document);
/// Whether any rig's splines are solved together, because it has pins or a floor.
bool pins_hold_any(const struct document *document);
/// Whether a spline moves a rig that has pins or a floor.
bool pins_move_spline(const struct document *document, int spline);

/// Index of a rig's pin with that id, or -1.
int pins_find_id(const struct rig *rig, unsigned id);

/// Index of the pin of that point on that sample, or -1.
int pins_find(const struct document *document, const struct rig *rig, int point, int sample);

/// The last sample that may have a pin of the rig: if a loop drives it, the very last repeats the first.
int pins_last_sample(const struct document *document, const struct rig *rig);

/// Inserts a pin in order of frame and point. And removes one by its id.
void pins_insert(struct rig *rig, const struct pin *pin);
struct pin pins_remove(struct rig *rig, unsigned id);

/// A problem of pins: "expected …, got …", about a member of a pin; if `pin` is -1, about all of a rig's pins or its floor.
struct pin_trouble {
    int rig, pin;
    const char *member; ///< of the pin, else of the rig
    struct error error;
};

/// Whether all pins are inside the frames, alone on their samples, and on splines that can move; no spline of a pinned rig follows another that
/// is solved together with it; and all together take no more than SCENE_MAX_PINNED. Allocates if there are pins.
bool pins_check(const struct document *document, struct pin_trouble *trouble);

/// Writes the first spline of its group for each spline; -1: no pin moves it.
void pin_groups_find(const struct document *document, int *group);

/// A conflict: `spline` follows `leader`, but they are in one group or in groups that wait for each other.
struct pin_cycle {
    int spline, leader;
};

/// Writes all splines to `order`, each after those that it follows, groups in a row; `tracked` is scene_order()'s. A group also comes after
/// the other splines that move its rigs, for example what they stand on, unless these follow it in turn. `placed` has two
/// elements per spline. false with the cycle if there is one.
bool pin_groups_order(const struct document *document, const int *group, const int *tracked, bool *placed, int *order,
                      struct pin_cycle *cycle);

/// Marks the splines outside a group that move its pinned rigs.
void pin_groups_find_bases(const struct document *document, const int *group, int which, bool *bases);

#endif

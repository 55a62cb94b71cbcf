/// How the pins of a rig are read and printed, for every kind that has some. Private to src/scene.
#ifndef SCENE_RIG_PINS_H
#define SCENE_RIG_PINS_H

#include "scene/members.h"
#include "scene/reader.h"

/// Reads the member "pins"; `key` is what a point is called.
void load_pins(struct reader *reader, const struct value *object, const char *key, struct rig *rig);
void print_pins(struct members *members, const struct rig *rig, const char *key);

/// Checks the pins of all rigs, all of which are read.
void validate_pins(struct reader *reader, const struct where *scene_at);

#endif

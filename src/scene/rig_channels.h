/// How channels and their angles are read and printed, for every kind of rig that has some. Private to src/scene.
#ifndef SCENE_RIG_CHANNELS_H
#define SCENE_RIG_CHANNELS_H

#include "scene/members.h"
#include "scene/reader.h"
#include "scene/reference.h"

/// `joints` of the functions below: how many the rig has, or JOINTS_UNKNOWN where only its model says.
enum { JOINTS_UNKNOWN = 0 };

/// A number for all joints, an array of one for each or a ramp, whose unknown keys go into the object `*extra` under the value's key. A
/// missing value leaves `angles` alone.
void load_angles(struct reader *reader, struct value value, int joints, struct angles *angles, json_t **extra);
void print_angles(struct members *members, const char *key, const struct angles *angles, json_t *extra);

/// Reads one from its object, or from that of its rig, with its unknown keys. `axes` are the words for its axis.
void load_channel(struct reader *reader, const struct value *object, const char *const *axes, int joints,
                  struct channel *channel, json_t *extra);

/// Reads an array of them; `*count` is 0 after an error.
struct channel *load_channels(struct reader *reader, struct value value, const char *const *axes, int joints,
                              int *count);

/// The member "channels".
void print_channels(struct members *members, const struct document *document, const struct channel *channels,
                    int count);

/// Keys of a channel's object, and the words for axes: of a tail, and of a chain.
extern const char *const channel_keys[], *const tail_axes[], *const chain_axes[];

#endif

#include "scene/reader.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char *const tail_keys[] = {"type",   "name", "joints", "length", "position", "rest", "channels",
                                        "spline", "axis", "of",     "lag",    "gain",     NULL};
static const char *const channel_keys[] = {"spline", "axis", "of", "lag", "gain", NULL};
static const char *const axes[] = {"side", "up", NULL};
static const char *const parts[] = {"total", "displacement", NULL};

/// A number for all joints, or an array of one for each.
static void load_angles(struct reader *reader, const struct where *at, const json_t *value, int joints,
                        struct angles *angles)
{
    if (!value) return;
    if (!json_is_array(value)) {
        if (!json_is_number(value)) {
            reader_unexpected(reader, at, "a number or an array of one per joint", value);
        } else {
            reader_number(reader, at, value, true, range_any, &angles->value[0]);
        }
        return;
    }
    if (json_array_size(value) != (size_t)joints) {
        reader_fail(reader, at, "expected one number for each of the %d joints, got %zu", joints,
                    json_array_size(value));
        return;
    }
    angles->each = true;
    for (int i = 0; i < joints; i++) {
        struct where element_at = {.parent = at, .index = (size_t)i};
        reader_number(reader, &element_at, json_array_get(value, (size_t)i), true, range_any, &angles->value[i]);
    }
}

/// Metres, or a spline to follow, for each coordinate. Unknown keys of the tracks are kept under "position" among the tail's.
static void load_position(struct reader *reader, const struct where *at, const json_t *value,
                          struct param position[3], json_t **extra)
{
    json_t *tracks = NULL;
    if (!value || !reader_array(reader, at, value, 3, "[x, y, z]")) return;
    for (size_t i = 0; i < 3; i++) {
        struct where element_at = {.parent = at, .index = i};
        reader_param(reader, &element_at, json_array_get(value, i), range_any, coordinate_name((int)i), &position[i],
                     &tracks);
    }
    if (!tracks) return;
    if (!*extra) *extra = json_object();
    if (!*extra || json_object_set_new(*extra, at->key, tracks) != 0) reader_no_memory(reader);
}

/// From a channel's object, or from a tail's own in the short form.
static void load_channel(struct reader *reader, const struct where *at, const json_t *object, int joints,
                         struct channel *channel)
{
    struct where spline_at, axis_at, of_at, lag_at, gain_at;
    const json_t *spline = reader_member(at, object, "spline", &spline_at);
    const json_t *axis = reader_member(at, object, "axis", &axis_at);
    const json_t *of = reader_member(at, object, "of", &of_at);
    const json_t *lag = reader_member(at, object, "lag", &lag_at);
    const json_t *gain = reader_member(at, object, "gain", &gain_at);
    channel->spline = reader_spline_name(reader, &spline_at, spline);
    int word = reader_word(reader, &axis_at, axis, axes, AXIS_SIDE);
    channel->axis = word < 0 ? AXIS_SIDE : (enum axis)word;
    word = reader_word(reader, &of_at, of, parts, PART_TOTAL);
    channel->of = word < 0 ? PART_TOTAL : (enum channel_part)word;
    channel->lag.value[0] = CHANNEL_DEFAULT_LAG;
    channel->gain.value[0] = CHANNEL_DEFAULT_GAIN;
    load_angles(reader, &lag_at, lag, joints, &channel->lag);
    load_angles(reader, &gain_at, gain, joints, &channel->gain);
}

static void load_channels(struct reader *reader, const struct where *tail_at, const json_t *object, struct tail *tail)
{
    struct where at;
    const json_t *channels = reader_member(tail_at, object, "channels", &at);
    bool is_short = false;
    for (int i = 0; channel_keys[i]; i++) is_short |= json_object_get(object, channel_keys[i]) != NULL;
    if (is_short && channels) {
        reader_fail(reader, &at, "expected either channels or one channel's keys, got both");
        return;
    }
    int count = is_short ? 1 : reader_objects(reader, &at, channels, SCENE_MAX_CHANNELS);
    if (count <= 0) return;
    tail->channels = calloc((size_t)count, sizeof *tail->channels);
    if (!tail->channels) {
        reader_no_memory(reader);
        return;
    }
    tail->channel_count = count;
    if (is_short) load_channel(reader, tail_at, object, tail->joints, &tail->channels[0]);
    for (int i = 0; i < count && !is_short; i++) {
        struct where channel_at = {.parent = &at, .index = (size_t)i};
        json_t *channel = json_array_get(channels, (size_t)i);
        load_channel(reader, &channel_at, channel, tail->joints, &tail->channels[i]);
        tail->channels[i].extra = reader_keep(reader, reader_extra(reader, &channel_at, channel, channel_keys));
    }
}

void load_tail(struct reader *reader, const struct where *at, json_t *object, struct tail *tail)
{
    struct where name_at, joints_at, length_at, position_at, rest_at;
    const json_t *name = reader_member(at, object, "name", &name_at);
    const json_t *joints = reader_member(at, object, "joints", &joints_at);
    const json_t *length = reader_member(at, object, "length", &length_at);
    const json_t *position = reader_member(at, object, "position", &position_at);
    const json_t *rest = reader_member(at, object, "rest", &rest_at);
    struct range positive = {0, INFINITY, true};
    json_t *unknown = reader_extra(reader, at, object, tail_keys);
    tail->joints = TAIL_DEFAULT_JOINTS;
    tail->length = TAIL_DEFAULT_LENGTH;
    for (int i = 0; i < 3; i++) tail->position[i].track = -1;
    tail->name = reader_name(reader, &name_at, name);
    reader_number(reader, &length_at, length, false, positive, &tail->length);
    load_position(reader, &position_at, position, tail->position, &unknown);
    if (reader_integer(reader, &joints_at, joints, 1, TAIL_MAX_JOINTS, &tail->joints)) {
        load_angles(reader, &rest_at, rest, tail->joints, &tail->rest);
        load_channels(reader, at, object, tail);
    }
    tail->extra = reader_keep(reader, unknown);
}

/// Tails in the file, in memory and among the references to splines.
#include "scene/rig_kind.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

_Static_assert((int)SCENE_MAX_CHANNELS <= (int)RIG_MAX_INPUTS, "a channel is an input");

static const char *const tail_keys[] = {"type",   "name", "joints", "length", "position", "rest", "channels",
                                        "spline", "axis", "of",     "lag",    "gain",     NULL};
static const char *const channel_keys[] = {"spline", "axis", "of", "lag", "gain", NULL};
static const char *const axes[] = {[AXIS_SIDE] = "side", [AXIS_UP] = "up", NULL};
static const char *const parts[] = {[PART_TOTAL] = "total", [PART_DISPLACEMENT] = "displacement", NULL};

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

static void load(struct reader *reader, const struct where *at, json_t *object, struct rig *rig)
{
    struct tail *tail = &rig->tail;
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
    rig->name = reader_name(reader, &name_at, name);
    reader_number(reader, &length_at, length, false, positive, &tail->length);
    load_position(reader, &position_at, position, tail->position, &unknown);
    if (reader_integer(reader, &joints_at, joints, 1, TAIL_MAX_JOINTS, &tail->joints)) {
        load_angles(reader, &rest_at, rest, tail->joints, &tail->rest);
        load_channels(reader, at, object, tail);
    }
    rig->extra = reader_keep(reader, unknown);
}

static void print_angles(struct members *members, const char *key, const struct angles *angles, int joints)
{
    member(members, key);
    if (angles->each) {
        text_numbers(members->text, angles->value, joints);
    } else {
        text_number(members->text, angles->value[0]);
    }
}

static void print_channel(struct text *text, const struct document *document, const struct tail *tail,
                          const struct channel *channel)
{
    struct members members = {text, "{ ", ", ", false};
    member_string(&members, "spline", document->splines[channel->spline].name);
    member_string(&members, "axis", axes[channel->axis]);
    if (channel->of != PART_TOTAL) member_string(&members, "of", parts[channel->of]);
    print_angles(&members, "lag", &channel->lag, tail->joints);
    print_angles(&members, "gain", &channel->gain, tail->joints);
    members_extra(&members, channel->extra, NULL);
    text_string(text, " }");
}

static void print_position(struct text *text, const struct document *document, const struct rig *rig)
{
    json_t *extras = json_object_get(rig->extra, "position");
    for (int i = 0; i < 3; i++) {
        text_string(text, i > 0 ? ", " : "[");
        print_param(text, document, &rig->tail.position[i], extras, coordinate_name(i));
    }
    text_string(text, "]");
}

static void print(struct members *members, const struct document *document, const struct rig *rig, const char *folder)
{
    const struct tail *tail = &rig->tail;
    struct text *text = members->text;
    (void)folder;
    member_number(members, "joints", tail->joints);
    member_number(members, "length", tail->length);
    member(members, "position");
    print_position(text, document, rig);
    print_angles(members, "rest", &tail->rest, tail->joints);
    member(members, "channels");
    for (int i = 0; i < tail->channel_count; i++) {
        text_string(text, i > 0 ? ",\n        " : "[\n        ");
        print_channel(text, document, tail, &tail->channels[i]);
    }
    text_string(text, tail->channel_count > 0 ? "\n      ]" : "[]");
}

static bool is_position(const char *key) { return strcmp(key, "position") == 0; }

static int input_count(const struct rig *rig) { return rig->tail.channel_count; }

static int input(const struct rig *rig, int input) { return rig->tail.channels[input].spline; }

static void references(const struct rig *rig, int index, reference_visitor *visit, void *context)
{
    for (int i = 0; i < 3; i++) {
        struct reference reference = {REFERENCE_POSITION, index, i, rig->tail.position[i].track};
        if (reference.spline >= 0) visit(&reference, context);
    }
    for (int i = 0; i < rig->tail.channel_count; i++) {
        visit(&(struct reference){REFERENCE_CHANNEL, index, i, rig->tail.channels[i].spline}, context);
    }
}

static void set_reference(struct rig *rig, const struct reference *reference, int spline)
{
    if (reference->kind == REFERENCE_POSITION) {
        rig->tail.position[reference->which].track = spline;
    } else {
        rig->tail.channels[reference->which].spline = spline;
    }
}

static bool copy(struct rig *copy)
{
    const struct channel *channels = copy->tail.channels;
    size_t count = (size_t)copy->tail.channel_count;
    copy->tail.channels = malloc((count > 0 ? count : 1) * sizeof *channels);
    if (!copy->tail.channels) return false;
    if (count > 0) memcpy(copy->tail.channels, channels, count * sizeof *channels);
    return true;
}

static void release(struct rig *rig) { free(rig->tail.channels); }

static size_t bytes(const struct rig *rig) { return (size_t)rig->tail.channel_count * sizeof *rig->tail.channels; }

const struct rig_functions tail_functions = {.word = "tail",
                                             .load = load,
                                             .print = print,
                                             .has_tracks = is_position,
                                             .input_count = input_count,
                                             .input = input,
                                             .references = references,
                                             .set_reference = set_reference,
                                             .copy = copy,
                                             .release = release,
                                             .bytes = bytes};

/// Tails as a kind of rig: loading, printing, references and memory.
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
static void load_angles(struct reader *reader, struct value value, int joints, struct angles *angles)
{
    if (!value.json) return;
    if (json_is_number(value.json)) {
        reader_number(reader, value, true, range_any, &angles->value[0]);
    } else if (!json_is_array(value.json)) {
        reader_unexpected(reader, value, "a number or an array of one per joint");
    } else if (json_array_size(value.json) != (size_t)joints) {
        reader_fail(reader, &value.at, "expected one number for each of the %d joints, got %zu", joints,
                    json_array_size(value.json));
    } else {
        angles->each = true;
        for (int i = 0; i < joints; i++) {
            reader_number(reader, reader_element(&value, i), true, range_any, &angles->value[i]);
        }
    }
}

/// Each coordinate is in metres or follows a spline. Unknown keys of tracks are kept under the tail's extra key "position".
static void load_position(struct reader *reader, struct value value, struct param position[3], json_t **extra)
{
    json_t *tracks = NULL;
    if (!value.json || !reader_array(reader, value, 3, "[x, y, z]")) return;
    for (int i = 0; i < 3; i++) {
        reader_param(reader, reader_element(&value, i), range_any, coordinate_name(i), &position[i], &tracks);
    }
    if (!tracks) return;
    if (!*extra) *extra = json_object();
    if (!*extra || json_object_set_new(*extra, value.at.key, tracks) != 0) reader_no_memory(reader);
}

/// From a channel's object, or from a tail's own in the short form.
static void load_channel(struct reader *reader, const struct value *object, int joints, struct channel *channel)
{
    channel->spline = reader_spline_name(reader, reader_member(object, "spline"));
    int word = reader_word(reader, reader_member(object, "axis"), axes, AXIS_SIDE);
    channel->axis = word < 0 ? AXIS_SIDE : (enum axis)word;
    word = reader_word(reader, reader_member(object, "of"), parts, PART_TOTAL);
    channel->of = word < 0 ? PART_TOTAL : (enum channel_part)word;
    channel->lag.value[0] = CHANNEL_DEFAULT_LAG;
    channel->gain.value[0] = CHANNEL_DEFAULT_GAIN;
    load_angles(reader, reader_member(object, "lag"), joints, &channel->lag);
    load_angles(reader, reader_member(object, "gain"), joints, &channel->gain);
}

static void load_channels(struct reader *reader, const struct value *object, struct tail *tail)
{
    const struct value channels = reader_member(object, "channels");
    bool is_short = false;
    for (int i = 0; channel_keys[i]; i++) is_short |= json_object_get(object->json, channel_keys[i]) != NULL;
    if (is_short && channels.json) {
        reader_fail(reader, &channels.at, "expected either channels or one channel's keys, got both");
        return;
    }
    int count = is_short ? 1 : reader_objects(reader, channels, SCENE_MAX_CHANNELS);
    if (count <= 0) return;
    tail->channels = calloc((size_t)count, sizeof *tail->channels);
    if (!tail->channels) {
        reader_no_memory(reader);
        return;
    }
    tail->channel_count = count;
    if (is_short) load_channel(reader, object, tail->joints, &tail->channels[0]);
    for (int i = 0; i < count && !is_short; i++) {
        const struct value channel = reader_element(&channels, i);
        load_channel(reader, &channel, tail->joints, &tail->channels[i]);
        tail->channels[i].extra = reader_keep(reader, reader_extra(reader, &channel, channel_keys));
    }
}

static void load(struct reader *reader, const struct value *object, struct rig *rig)
{
    struct tail *tail = &rig->tail;
    struct range positive = {0, INFINITY, true};
    json_t *unknown = reader_extra(reader, object, tail_keys);
    tail->joints = TAIL_DEFAULT_JOINTS;
    tail->length = TAIL_DEFAULT_LENGTH;
    for (int i = 0; i < 3; i++) tail->position[i].track = -1;
    rig->name = reader_name(reader, reader_member(object, "name"));
    reader_number(reader, reader_member(object, "length"), false, positive, &tail->length);
    load_position(reader, reader_member(object, "position"), tail->position, &unknown);
    if (reader_integer(reader, reader_member(object, "joints"), 1, TAIL_MAX_JOINTS, &tail->joints)) {
        load_angles(reader, reader_member(object, "rest"), tail->joints, &tail->rest);
        load_channels(reader, object, tail);
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

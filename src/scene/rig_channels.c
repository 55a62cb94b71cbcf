/// Channels and their angles: looked up along the joints, read and printed.
#include "base/need.h"
#include "scene/rig_kind.h"
#include <stdlib.h>
#include <string.h>

_Static_assert((int)SCENE_MAX_CHANNELS <= (int)RIG_MAX_INPUTS, "a channel is an input");

const char *const channel_keys[] = {"spline", "axis", "of", "lag", "gain", NULL};
static const char *const axis_words[AXES] = {
    [AXIS_SIDE] = "side",     [AXIS_UP] = "up",           [AXIS_TWIST] = "twist",
    [AXIS_LOOK] = "look",     [AXIS_NOD] = "nod",         [AXIS_EARS] = "ears",
    [AXIS_BREATH] = "breath", [AXIS_STRETCH] = "stretch", [AXIS_BLINK] = "blink"};
static const char *const parts[] = {[PART_TOTAL] = "total", [PART_DISPLACEMENT] = "displacement", NULL};

bool axis_bends(enum axis axis) { return axis <= AXIS_TWIST; }

const char *axis_word(enum axis axis) { return axis_words[axis]; }

const char *axis_unit(enum axis axis) { return axis >= AXIS_BREATH ? "%" : "°"; }

double axis_gain(enum axis axis)
{
    static const double gain[AXES] = {
        [AXIS_LOOK] = 20, [AXIS_NOD] = 10, [AXIS_EARS] = 20, [AXIS_BREATH] = 2, [AXIS_BLINK] = 100};
    return gain[axis] > 0 ? gain[axis] : CHANNEL_DEFAULT_GAIN;
}

static enum axis axis_called(const char *word)
{
    int axis = AXIS_SIDE;
    while (axis + 1 < AXES && strcmp(axis_words[axis], word) != 0) axis++;
    return (enum axis)axis;
}

static double ramp_at(const struct angles *angles, double place)
{
    const struct ramp_point *ramp = angles->ramp;
    int next = 0;
    while (next < angles->count && ramp[next].at < place) next++;
    if (next == 0) return ramp[0].angle;
    if (next == angles->count) return ramp[next - 1].angle;
    const struct ramp_point *before = &ramp[next - 1], *after = &ramp[next];
    return before->angle + (after->angle - before->angle) * ((place - before->at) / (after->at - before->at));
}

double angles_at(const struct angles *angles, int joint, int joints)
{
    switch (angles->form) {
    case ANGLES_EACH:
        return angles->value[joint < angles->count ? joint : angles->count - 1];
    case ANGLES_RAMP:
        return ramp_at(angles, joints > 1 ? (double)joint / (joints - 1) : 0);
    default:
        return angles->value[0];
    }
}

double angles_lag(const struct angles *lag, int joint, int joints)
{
    return lag->form == ANGLES_ONE ? joint * lag->value[0] : angles_at(lag, joint, joints);
}

int angles_count(const struct angles *angles) { return angles->form == ANGLES_ONE ? 1 : angles->count; }

double angles_number(const struct angles *angles, int index)
{
    return angles->form == ANGLES_RAMP ? angles->ramp[index].angle : angles->value[index];
}

void angles_set_number(struct angles *angles, int index, double degrees)
{
    if (angles->form == ANGLES_RAMP) {
        angles->ramp[index].angle = degrees;
    } else {
        angles->value[index] = degrees;
    }
}

/// An array of one number a joint.
static void load_each(struct reader *reader, struct value value, int joints, struct angles *angles)
{
    const size_t count = json_array_size(value.json);
    if (joints != JOINTS_UNKNOWN && count != (size_t)joints) {
        reader_fail(reader, &value.at, "expected one number for each of the %d joints, got %zu", joints, count);
    } else if (count < 1 || count > ANGLES_MAX_JOINTS) {
        reader_fail(reader, &value.at, "expected from 1 to %d numbers, one per joint, got %zu", ANGLES_MAX_JOINTS,
                    count);
    } else {
        angles->form = ANGLES_EACH;
        angles->count = (int)count;
        for (int i = 0; i < angles->count; i++) {
            reader_number(reader, reader_element(&value, i), true, range_any, &angles->value[i]);
        }
    }
}

/// A point behind `before`, which is NULL for the first.
static void load_ramp_point(struct reader *reader, struct value value, const struct ramp_point *before,
                            struct ramp_point *point)
{
    const struct range range = {before ? before->at : 0, 1, before != NULL};
    if (!reader_array(reader, value, 2, "[place, degrees]")) return;
    reader_number(reader, reader_element(&value, 0), true, range, &point->at);
    reader_number(reader, reader_element(&value, 1), true, range_any, &point->angle);
}

/// { "ramp": [[0, 0], [1, 120]] }
static void load_ramp(struct reader *reader, const struct value *object, struct angles *angles, json_t **extra)
{
    static const char *const known[] = {"ramp", NULL};
    const struct value ramp = reader_member(object, "ramp");
    const size_t count = json_array_size(ramp.json);
    reader_put(extra, object->at.key, reader_extra(reader, object, known));
    if (!json_is_array(ramp.json)) {
        reader_unexpected(reader, ramp, "an array of points [place, degrees]");
    } else if (count < 2 || count > RAMP_MAX_POINTS) {
        reader_fail(reader, &ramp.at, "expected from 2 to %d points, got %zu", RAMP_MAX_POINTS, count);
    } else {
        angles->form = ANGLES_RAMP;
        angles->count = (int)count;
        for (int i = 0; i < angles->count; i++) {
            struct ramp_point *point = &angles->ramp[i];
            *point = (struct ramp_point){0};
            load_ramp_point(reader, reader_element(&ramp, i), i > 0 ? point - 1 : NULL, point);
        }
    }
}

void load_angles(struct reader *reader, struct value value, int joints, struct angles *angles, json_t **extra)
{
    if (!value.json) return;
    if (json_is_number(value.json)) {
        reader_number(reader, value, true, range_any, &angles->value[0]);
    } else if (json_is_array(value.json)) {
        load_each(reader, value, joints, angles);
    } else if (json_is_object(value.json)) {
        load_ramp(reader, &value, angles, extra);
    } else {
        reader_unexpected(reader, value, "a number, an array of one per joint or {\"ramp\": points}");
    }
}

void load_channel(struct reader *reader, const struct value *object, const char *const *axes, int joints,
                  struct channel *channel, json_t *extra)
{
    channel->spline = reader_spline_name(reader, reader_member(object, "spline"));
    int word = reader_word(reader, reader_member(object, "axis"), axes, AXIS_SIDE);
    channel->axis = word < 0 ? AXIS_SIDE : axis_called(axes[word]);
    word = reader_word(reader, reader_member(object, "of"), parts, PART_TOTAL);
    channel->of = word < 0 ? PART_TOTAL : (enum channel_part)word;
    channel->lag.value[0] = CHANNEL_DEFAULT_LAG;
    channel->gain.value[0] = CHANNEL_DEFAULT_GAIN;
    load_angles(reader, reader_member(object, "lag"), joints, &channel->lag, &extra);
    load_angles(reader, reader_member(object, "gain"), joints, &channel->gain, &extra);
    channel->extra = reader_keep(reader, extra);
}

void load_channels(struct reader *reader, const struct value *object, const char *const *axes, int joints,
                   struct rig *rig)
{
    const struct value value = reader_member(object, "channels");
    const int count = reader_objects(reader, value, SCENE_MAX_CHANNELS);
    if (count <= 0) return;
    rig->bent.channels = need_zeroed((size_t)count, sizeof *rig->bent.channels);
    rig->bent.channel_count = count;
    for (int i = 0; i < count; i++) {
        const struct value one = reader_element(&value, i);
        load_channel(reader, &one, axes, joints, &rig->bent.channels[i], reader_extra(reader, &one, channel_keys));
    }
}

static void print_ramp(struct text *text, const struct angles *angles, json_t *extra)
{
    struct members members = {text, "{ ", ", ", false};
    member(&members, "ramp");
    for (int i = 0; i < angles->count; i++) {
        const double point[] = {angles->ramp[i].at, angles->ramp[i].angle};
        text_string(text, i > 0 ? ", " : "[");
        text_numbers(text, point, 2);
    }
    text_string(text, "]");
    members_extra(&members, extra, NULL);
    text_string(text, " }");
}

void print_angles(struct members *members, const char *key, const struct angles *angles, json_t *extra)
{
    member(members, key);
    if (angles->form == ANGLES_EACH) {
        text_numbers(members->text, angles->value, angles->count);
    } else if (angles->form == ANGLES_RAMP) {
        print_ramp(members->text, angles, json_object_get(extra, key));
    } else {
        text_number(members->text, angles->value[0]);
    }
}

static bool holds_ramp(const char *key) { return strcmp(key, "lag") == 0 || strcmp(key, "gain") == 0; }

static void print_channel(struct text *text, const struct document *document, const struct channel *channel)
{
    struct members members = {text, "{ ", ", ", false};
    member_string(&members, "spline", document->splines[channel->spline]->name);
    member_string(&members, "axis", axis_word(channel->axis));
    if (channel->of != PART_TOTAL) member_string(&members, "of", parts[channel->of]);
    print_angles(&members, "lag", &channel->lag, channel->extra);
    print_angles(&members, "gain", &channel->gain, channel->extra);
    members_extra(&members, channel->extra, holds_ramp);
    text_string(text, " }");
}

void print_channels(struct members *members, const struct document *document, const struct rig *rig,
                    const char *folder)
{
    const int count = rig->bent.channel_count;
    struct text *text = members->text;
    (void)folder;
    member(members, "channels");
    for (int i = 0; i < count; i++) {
        text_string(text, i > 0 ? ",\n        " : "[\n        ");
        print_channel(text, document, &rig->bent.channels[i]);
    }
    text_string(text, count > 0 ? "\n      ]" : "[]");
}

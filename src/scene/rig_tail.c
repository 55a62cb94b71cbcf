/// Tails as a kind of rig: loading, printing, references and memory.
#include "base/need.h"
#include "scene/rig_channels.h"
#include "scene/rig_kind.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char *const tail_keys[] = {"type",   "name", "joints", "length", "position", "rest", "channels",
                                        "spline", "axis", "of",     "lag",    "gain",     "pins", NULL};

/// Each coordinate is in metres or follows a spline. Unknown keys of tracks are kept under the tail's extra key "position".
static void load_position(struct reader *reader, struct value value, struct param position[3], json_t **extra)
{
    json_t *tracks = NULL;
    if (!value.json || !reader_array(reader, value, 3, "[x, y, z]")) return;
    for (int i = 0; i < 3; i++) {
        reader_param(reader, reader_element(&value, i), range_any, coordinate_name(i), false, &position[i], &tracks);
    }
    reader_put(extra, value.at.key, tracks);
}

/// From an array, or a single one from the tail's own object.
static void load_tail_channels(struct reader *reader, const struct value *object, struct tail *tail)
{
    const struct value channels = reader_member(object, "channels");
    bool is_short = false;
    for (int i = 0; channel_keys[i]; i++) is_short |= json_object_get(object->json, channel_keys[i]) != NULL;
    if (is_short && channels.json) {
        reader_fail(reader, &channels.at, "expected either channels or one channel's keys, got both");
    } else if (!is_short) {
        tail->channels = load_channels(reader, channels, tail_axes, tail->joints, &tail->channel_count);
    } else {
        tail->channels = need_zeroed(1, sizeof *tail->channels);
        tail->channel_count = 1;
        load_channel(reader, object, tail_axes, tail->joints, &tail->channels[0], NULL);
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
        load_angles(reader, reader_member(object, "rest"), tail->joints, &tail->rest, &unknown);
        load_tail_channels(reader, object, tail);
    }
    rig->extra = reader_keep(reader, unknown);
}

static void print_position(struct text *text, const struct document *document, const struct rig *rig,
                           const char *folder)
{
    json_t *extras = json_object_get(rig->extra, "position");
    for (int i = 0; i < 3; i++) {
        text_string(text, i > 0 ? ", " : "[");
        print_param(text, document, &rig->tail.position[i], extras, coordinate_name(i), folder);
    }
    text_string(text, "]");
}

static void print(struct members *members, const struct document *document, const struct rig *rig, const char *folder)
{
    const struct tail *tail = &rig->tail;
    struct text *text = members->text;
    member_number(members, "joints", tail->joints);
    member_number(members, "length", tail->length);
    member(members, "position");
    print_position(text, document, rig, folder);
    print_angles(members, "rest", &tail->rest, rig->extra);
    print_channels(members, document, tail->channels, tail->channel_count);
}

/// Of tracks, and of a ramp.
static bool holds_keys(const char *key) { return strcmp(key, "position") == 0 || strcmp(key, "rest") == 0; }

static void references(const struct rig *rig, int index, reference_visitor *visit, void *context)
{
    for (int i = 0; i < 3; i++) {
        struct reference reference = {REFERENCE_POSITION, index, i, rig->tail.position[i].track};
        if (reference.spline >= 0) visit(&reference, context);
    }
}

static void set_reference(struct rig *rig, const struct reference *reference, int spline)
{
    rig->tail.position[reference->which].track = spline;
}

const struct rig_functions tail_functions = {.word = "tail",
                                             .load = load,
                                             .print = print,
                                             .pin_key = "joint",
                                             .has_tracks = holds_keys,
                                             .is_bent = true,
                                             .references = references,
                                             .set_reference = set_reference};

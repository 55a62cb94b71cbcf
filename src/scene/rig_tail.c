/// Tails as a kind of rig.
#include "base/need.h"
#include "scene/rig_kind.h"
#include <math.h>
#include <string.h>

static const char *const axes[] = {"side", "up", "look", "nod", "ears", "breath", "stretch", "blink", NULL};

/// Each coordinate is in metres or follows a spline. Unknown keys of tracks are kept under the tail's extra key "position".
static void load_position(struct reader *reader, const struct value *object, struct rig *rig)
{
    const struct value value = reader_member(object, "position");
    json_t *tracks = NULL;
    if (!value.json || !reader_array(reader, value, 3, "[x, y, z]")) return;
    for (int i = 0; i < 3; i++) {
        reader_param(reader, reader_element(&value, i), range_any, coordinate_name(i), false, &rig->tail.position[i],
                     &tracks);
    }
    reader_put(&rig->extra, "position", tracks);
}

static void print_position(struct members *members, const struct document *document, const struct rig *rig,
                           const char *folder)
{
    json_t *extras = json_object_get(rig->extra, "position");
    member(members, "position");
    for (int i = 0; i < 3; i++) {
        text_string(members->text, i > 0 ? ", " : "[");
        print_param(members->text, document, &rig->tail.position[i], extras, coordinate_name(i), folder);
    }
    text_string(members->text, "]");
}

static void load_rest(struct reader *reader, const struct value *object, struct rig *rig)
{
    load_angles(reader, reader_member(object, "rest"), rig->tail.joints, &rig->tail.rest, &rig->extra);
}

static void print_rest(struct members *members, const struct document *document, const struct rig *rig,
                       const char *folder)
{
    (void)document, (void)folder;
    print_angles(members, "rest", &rig->tail.rest, rig->extra);
}

/// From an array, or a single one from the tail's own object.
static void load_tail_channels(struct reader *reader, const struct value *object, struct rig *rig)
{
    struct tail *tail = &rig->tail;
    const struct value channels = reader_member(object, "channels");
    bool is_short = false;
    for (int i = 0; channel_keys[i]; i++) is_short |= json_object_get(object->json, channel_keys[i]) != NULL;
    if (is_short && channels.json) {
        reader_fail(reader, &channels.at, "expected either channels or one channel's keys, got both");
    } else if (!is_short) {
        load_channels(reader, object, axes, tail->joints, rig);
    } else {
        tail->channels = need_zeroed(1, sizeof *tail->channels);
        tail->channel_count = 1;
        load_channel(reader, object, axes, tail->joints, &tail->channels[0], NULL);
    }
}

static const struct field fields[] = {
    {FIELD("joints", FIELD_WHOLE, tail.joints), .range = {1, TAIL_MAX_JOINTS, false}},
    {FIELD("length", FIELD_NUMBER, tail.length), .range = FIELD_POSITIVE},
    {FIELD("position", FIELD_OWN, tail.position), .load = load_position, .print = print_position},
    {FIELD("rest", FIELD_OWN, tail.rest), .load = load_rest, .print = print_rest},
    {"channels", .load = load_tail_channels, .print = print_channels},
    {.key = "spline"}, // these of the only channel
    {.key = "axis"},
    {.key = "of"},
    {.key = "lag"},
    {.key = "gain"},
    {.key = NULL},
};

static void reset(struct rig *rig)
{
    rig->tail.joints = TAIL_DEFAULT_JOINTS;
    rig->tail.length = TAIL_DEFAULT_LENGTH;
    for (int i = 0; i < 3; i++) rig->tail.position[i].track = -1;
}

/// Of tracks, and of a ramp.
static bool holds_keys(const char *key) { return strcmp(key, "position") == 0 || strcmp(key, "rest") == 0; }

const struct rig_functions tail_functions = {.word = "tail",
                                             .fields = fields,
                                             .is_named = true,
                                             .pin_key = "joint",
                                             .is_bent = true,
                                             .has_tracks = holds_keys,
                                             .reset = reset};

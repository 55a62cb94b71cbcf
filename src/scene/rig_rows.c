/// The kinds of rig, row by row.
#include "base/need.h"
#include "scene/rig_kind.h"
#include <limits.h>
#include <math.h>

_Static_assert((int)SCENE_MAX_CHANNELS <= (int)RIG_MAX_INPUTS && (int)CHARACTER_MAX_DRIVES <= (int)RIG_MAX_INPUTS,
               "a channel or drive is an input");

#define PIN_ROWS(point_key)                                                                                          \
    {FIELD("frame", FIELD_NUMBER, struct pin, frame), .range = FIELD_ANY, .is_required = true},                      \
        {FIELD(point_key, FIELD_WHOLE, struct pin, point), .range = {0, INT_MAX, false}, .is_required = true},       \
        {FIELD("to", FIELD_NUMBERS, struct pin, to), .range = FIELD_ANY, .is_required = true}, FIELD_END(struct pin)

static const struct field joint_pins[] = {PIN_ROWS("joint")};
static const struct field vertex_pins[] = {PIN_ROWS("vertex")};

static const char *const parts[] = {[PART_TOTAL] = "total", [PART_DISPLACEMENT] = "displacement", NULL};

#define CHANNEL_ROWS(axes)                                                                                           \
    {FIELD("spline", FIELD_SPLINE, struct channel, spline)},                                                         \
        {FIELD("axis", FIELD_WORD, struct channel, axis), .words = axes},                                            \
        {FIELD("of", FIELD_WORD, struct channel, of), .words = parts, .is_quiet = true},                             \
        {FIELD("lag", FIELD_ANGLES, struct channel, lag), .usual = {CHANNEL_DEFAULT_LAG}},                           \
        {FIELD("gain", FIELD_ANGLES, struct channel, gain), .usual = {CHANNEL_DEFAULT_GAIN}},                        \
        FIELD_END(struct channel)

static const char *const chain_axes[] = {
    [AXIS_SIDE] = "side", [AXIS_UP] = "up", [AXIS_TWIST] = "twist", [AXIS_TWIST + 1] = NULL};
static const char *const tail_axes[] = {
    [AXIS_TWIST] = "",      [AXIS_SIDE] = "side", [AXIS_UP] = "up",         [AXIS_LOOK] = "look",
    [AXIS_NOD] = "nod",     [AXIS_EARS] = "ears", [AXIS_BREATH] = "breath", [AXIS_STRETCH] = "stretch",
    [AXIS_BLINK] = "blink", [AXES] = NULL};
static const struct field chain_channels[] = {CHANNEL_ROWS(chain_axes)};
static const struct field tail_channels[] = {CHANNEL_ROWS(tail_axes)};

const char *axis_word(enum axis axis) { return axis == AXIS_TWIST ? chain_axes[axis] : tail_axes[axis]; }

// --- tails

/// From an array, or a single channel written in the tail itself.
static void load_tail_channels(struct reader *reader, const struct value *object, void *at)
{
    struct rig *rig = at;
    const struct value channels = reader_member(object, "channels");
    bool is_short = false;
    for (int i = 0; tail_channels[i].key; i++)
        is_short |= json_object_get(object->json, tail_channels[i].key) != NULL;
    if (!is_short) {
        list_load(reader, object, fields_find(tail_functions.fields, "channels"), rig);
    } else if (channels.json) {
        reader_fail(reader, &channels.at, "expected either channels or one channel's keys, got both");
    } else {
        json_t *extra = NULL;
        rig->tail.channels = need_zeroed(1, sizeof *rig->tail.channels);
        rig->tail.channel_count = 1;
        fields_reset(tail_channels, rig->tail.channels);
        fields_load(reader, object, tail_channels, rig->tail.channels, &extra);
        rig->tail.channels->extra = reader_keep(reader, extra);
    }
}

static const struct field tail_fields[] = {
    RIG_FIRST(true),
    {FIELD("joints", FIELD_WHOLE, struct rig, tail.joints), .range = {1, TAIL_MAX_JOINTS, false},
     .usual = {TAIL_DEFAULT_JOINTS}},
    {FIELD("length", FIELD_NUMBER, struct rig, tail.length), .range = FIELD_POSITIVE, .usual = {TAIL_DEFAULT_LENGTH}},
    {FIELD("position", FIELD_PLACE, struct rig, tail.position)},
    {FIELD("rest", FIELD_ANGLES, struct rig, tail.rest)},
    {FIELD_LIST_OF("channels", struct rig, tail.channels, tail.channel_count, tail_channels, SCENE_MAX_CHANNELS),
     .load = load_tail_channels},
    {.key = "spline"}, // keys of a single channel
    {.key = "axis"},
    {.key = "of"},
    {.key = "lag"},
    {.key = "gain"},
    RIG_PINS(joint_pins),
    FIELD_END(struct rig),
};

const struct rig_functions tail_functions = {
    .word = "tail", .fields = tail_fields, .title = offsetof(struct rig, name), .pins = joint_pins, .is_bent = true};

// --- soft characters

static const struct field drive_fields[] = {
    {FIELD("name", FIELD_TEXT, struct drive, name), .is_required = true},
    {FIELD("spline", FIELD_SPLINE, struct drive, spline)},
    {FIELD("amplitude", FIELD_NUMBER, struct drive, amplitude), .range = FIELD_ANY,
     .usual = {DRIVE_DEFAULT_AMPLITUDE}},
    {FIELD("lag", FIELD_NUMBER, struct drive, lag), .range = FIELD_ANY},
    FIELD_END(struct drive),
};

static const char *const phase_axes[] = {"x", "y", "z", NULL};

static const struct field character_fields[] = {
    RIG_FIRST(false),
    {FIELD("model", FIELD_PATH, struct rig, character.model), .is_required = true},
    {FIELD("position", FIELD_NUMBERS, struct rig, character.position), .range = FIELD_ANY},
    {FIELD_LIST_OF("coordinates", struct rig, character.drives, character.drive_count, drive_fields,
                   CHARACTER_MAX_DRIVES)},
    {FIELD("phases", FIELD_WORD, struct rig, character.phases), .words = phase_axes, .usual = {-1}, .is_quiet = true},
    {FIELD("floor", FIELD_NUMBER, struct rig, character.floor), .range = FIELD_ANY,
     .flag = offsetof(struct rig, character.has_floor)},
    {FIELD("paint", FIELD_PATH, struct rig, character.paint_file), .load = paint_load, .print = paint_print},
    {FIELD("vertices", FIELD_PAINT, struct rig, character.painted)},
    RIG_PINS(vertex_pins),
    FIELD_END(struct rig),
};

const struct rig_functions character_functions = {.word = "character",
                                                  .fields = character_fields,
                                                  .title = offsetof(struct rig, character.model),
                                                  .pins = vertex_pins};

// --- imported characters, and chains on them

static const char *const repeats[] = {[REPEAT_BY_CLIP] = "", [REPEAT_ONCE] = "once", [REPEAT_LOOP] = "loop", NULL};

static const struct field model_fields[] = {
    RIG_FIRST(false),
    {FIELD("model", FIELD_PATH, struct rig, model.model), .is_required = true},
    {FIELD("clip", FIELD_TEXT, struct rig, model.clip)},
    {FIELD("repeat", FIELD_WORD, struct rig, model.repeat), .words = repeats, .is_quiet = true},
    {FIELD("position", FIELD_NUMBERS, struct rig, model.position), .range = FIELD_ANY},
    {FIELD("scale", FIELD_NUMBER, struct rig, model.scale), .range = FIELD_POSITIVE, .usual = {1}},
    {FIELD("turn", FIELD_NUMBER, struct rig, model.turn), .range = FIELD_ANY},
    FIELD_END(struct rig),
};

const struct rig_functions model_functions = {
    .word = "model", .fields = model_fields, .title = offsetof(struct rig, model.model)};

static const struct field chain_fields[] = {
    RIG_FIRST(false),
    {FIELD("model", FIELD_MODEL, struct rig, chain.model), .is_required = true,
     .flag = offsetof(struct rig, chain.by_file)},
    {FIELD("from", FIELD_TEXT, struct rig, chain.from), .is_required = true},
    {FIELD("to", FIELD_TEXT, struct rig, chain.to), .is_required = true},
    {FIELD("turn", FIELD_NUMBER, struct rig, chain.turn), .range = FIELD_ANY},
    {FIELD("mirror", FIELD_FLAG, struct rig, chain.mirror)},
    {FIELD_LIST_OF("channels", struct rig, chain.channels, chain.channel_count, chain_channels, SCENE_MAX_CHANNELS)},
    RIG_PINS(joint_pins),
    FIELD_END(struct rig),
};

const struct rig_functions chain_functions = {.word = "chain",
                                              .fields = chain_fields,
                                              .title = offsetof(struct rig, chain.from),
                                              .pins = joint_pins,
                                              .is_bent = true};

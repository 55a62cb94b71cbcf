/// Rigs (rig.h): their angles and paint, the members of each kind in the file, and how they are made, copied, read and printed.
#include "base/json.h"
#include "base/need.h"
#include "scene/fields.h"
#include "scene/pins.h"
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_VALUES = 1 << 27 }; ///< pairs of paint in a file of the largest size

// --- channels

bool axis_bends(enum axis axis) { return axis <= AXIS_TWIST; }

const char *axis_unit(enum axis axis) { return axis >= AXIS_BREATH ? "%" : "°"; }

double axis_gain(enum axis axis)
{
    static const double gain[AXES] = {
        [AXIS_LOOK] = 20, [AXIS_NOD] = 10, [AXIS_EARS] = 20, [AXIS_BREATH] = 2, [AXIS_BLINK] = 100};
    return gain[axis] > 0 ? gain[axis] : CHANNEL_DEFAULT_GAIN;
}

double angles_at(const struct angles *angles, int joint, int joints)
{
    switch (angles->form) {
    case ANGLES_EACH:
        return angles->value[joint < angles->count ? joint : angles->count - 1];
    case ANGLES_RAMP: {
        const double place = joints > 1 ? (double)joint / (joints - 1) : 0;
        const struct ramp_point *ramp = angles->ramp;
        int next = 0;
        while (next < angles->count && ramp[next].at < place) next++;
        if (next == 0) return ramp[0].angle;
        if (next == angles->count) return ramp[next - 1].angle;
        const struct ramp_point *before = &ramp[next - 1], *after = &ramp[next];
        return before->angle + (after->angle - before->angle) * ((place - before->at) / (after->at - before->at));
    }
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

/// Index of the angle farthest from 0.
static int peak(const struct angles *angles)
{
    int found = 0;
    for (int i = 1; i < angles_count(angles); i++) {
        if (fabs(angles_number(angles, i)) > fabs(angles_number(angles, found))) found = i;
    }
    return found;
}

double angles_largest(const struct angles *angles) { return angles_number(angles, peak(angles)); }

void angles_scale(struct angles *angles, double degrees)
{
    const int largest = peak(angles);
    const double before = angles_number(angles, largest);
    for (int i = 0; i < angles_count(angles); i++) {
        const double scaled = before == 0 ? degrees : angles_number(angles, i) * (degrees / before);
        angles_set_number(angles, i, i == largest ? degrees : scaled);
    }
}

void load_angles(struct reader *reader, struct value value, struct angles *angles, json_t **extra)
{
    if (!value.json) return;
    if (json_is_number(value.json)) {
        reader_number(reader, value, true, range_any, &angles->value[0]);
    } else if (json_is_array(value.json)) { // one number per joint
        const size_t count = json_array_size(value.json);
        const int joints = reader->rig->kind == RIG_TAIL ? reader->rig->tail.joints : JOINTS_UNKNOWN;
        if (joints != JOINTS_UNKNOWN && count != (size_t)joints) {
            reader_fail(reader, &value.at, "expected one number for each of the %d joints, got %zu", joints, count);
            return;
        }
        if (count < 1 || count > ANGLES_MAX_JOINTS) {
            reader_fail(reader, &value.at, "expected from 1 to %d numbers, one per joint, got %zu", ANGLES_MAX_JOINTS,
                        count);
            return;
        }
        angles->form = ANGLES_EACH;
        angles->count = (int)count;
        for (int i = 0; i < angles->count; i++)
            reader_number(reader, reader_element(&value, i), true, range_any, &angles->value[i]);
    } else if (json_is_object(value.json)) { // { "ramp": [[0, 0], [1, 120]] }
        static const char *const known[] = {"ramp", NULL};
        const struct value ramp = reader_member(&value, "ramp");
        const size_t count = json_array_size(ramp.json);
        reader_put(extra, value.at.key, reader_extra(reader, &value, known));
        if (!json_is_array(ramp.json)) {
            reader_unexpected(reader, ramp, "an array of points [place, degrees]");
            return;
        }
        if (count < 2 || count > RAMP_MAX_POINTS) {
            reader_fail(reader, &ramp.at, "expected from 2 to %d points, got %zu", RAMP_MAX_POINTS, count);
            return;
        }
        angles->form = ANGLES_RAMP;
        angles->count = (int)count;
        for (int i = 0; i < angles->count; i++) {
            struct ramp_point *point = &angles->ramp[i];
            const struct value pair = reader_element(&ramp, i);
            const struct range range = {i > 0 ? point[-1].at : 0, 1, i > 0};
            *point = (struct ramp_point){0};
            if (!reader_array(reader, pair, 2, "[place, degrees]")) continue;
            reader_number(reader, reader_element(&pair, 0), true, range, &point->at);
            reader_number(reader, reader_element(&pair, 1), true, range_any, &point->angle);
        }
    } else {
        reader_unexpected(reader, value, "a number, an array of one per joint or {\"ramp\": points}");
    }
}

_Static_assert(sizeof(struct ramp_point) == 2 * sizeof(double), "a ramp is places and angles in turn");

static int numbers_of(const struct angles *angles)
{
    return angles_count(angles) * (angles->form == ANGLES_RAMP ? 2 : 1);
}

bool angles_equal(const struct angles *a, const struct angles *b)
{
    bool same = a->form == b->form && angles_count(a) == angles_count(b);
    for (int i = 0; same && i < numbers_of(a); i++) same = a->value[i] == b->value[i];
    return same;
}

bool check_angles(int joints, struct angles *angles, struct error *error)
{
    if ((unsigned)angles->form > ANGLES_RAMP) return fail(error, ERROR_INPUT, "there is no such form of angles");
    if (angles->form == ANGLES_RAMP && (angles->count < 2 || angles->count > RAMP_MAX_POINTS))
        return fail(error, ERROR_INPUT, "a ramp has from 2 to %d points", RAMP_MAX_POINTS);
    for (int i = 0; angles->form == ANGLES_RAMP && i < angles->count; i++) {
        const double at = angles->ramp[i].at;
        if (!(at >= 0 && at <= 1)) return fail(error, ERROR_INPUT, "the places of a ramp are from 0 to 1");
        if (i > 0 && at <= angles->ramp[i - 1].at)
            return fail(error, ERROR_INPUT, "the places of a ramp must ascend");
    }
    if (angles->form == ANGLES_EACH && joints != JOINTS_UNKNOWN && angles->count != joints)
        return fail(error, ERROR_INPUT, "there must be one angle for each of the %d joints", joints);
    if (angles->form == ANGLES_EACH && (angles->count < 1 || angles->count > ANGLES_MAX_JOINTS)) {
        return fail(error, ERROR_INPUT, "there must be from 1 to %d angles", ANGLES_MAX_JOINTS);
    }
    for (int i = 0; i < angles_count(angles); i++) {
        if (!isfinite(angles_number(angles, i))) return fail(error, ERROR_INPUT, "angles must be finite");
    }
    for (int i = 0; i < numbers_of(angles); i++) angles->value[i] += 0.0;
    return true;
}

void print_angles(struct members *members, const char *key, const struct angles *angles, json_t *extra)
{
    struct text *text = members->text;
    member(members, key);
    if (angles->form == ANGLES_EACH) {
        text_numbers(text, angles->value, angles->count);
    } else if (angles->form == ANGLES_ONE) {
        text_number(text, angles->value[0]);
    } else {
        struct members ramp = {text, "{ ", ", ", false};
        member(&ramp, "ramp");
        for (int i = 0; i < angles->count; i++) {
            const double point[] = {angles->ramp[i].at, angles->ramp[i].angle};
            text_string(text, i > 0 ? ", " : "[");
            text_numbers(text, point, 2);
        }
        text_string(text, "]");
        members_extra(&ramp, json_object_get(extra, key), NULL);
        text_string(text, " }");
    }
}

// --- paint
//
// Paint in a scene's file: "vertices", and "paint", an array of a string for each coordinate, or null for one without paint: base64 of its
// vertices' a and ψ, little-endian float32; or the name of its .npy file, which alone is printed where that could not be read. Paint that
// changes nothing is not printed.

static void paint_load(struct reader *reader, const struct value *object, void *at)
{
    struct model_rig *model = &((struct rig *)at)->model;
    const struct value paint = reader_member(object, "paint"), vertices = reader_member(object, "vertices");
    const size_t coordinates = json_array_size(paint.json);
    int count = 0;
    if (!json_is_array(paint.json)) {
        if (paint.json) model->paint_file = reader_path(reader, paint);
        return;
    }
    if (!vertices.json) {
        reader_fail(reader, &paint.at, "expected \"vertices\", how many there are, beside it, got nothing");
        return;
    }
    if (coordinates == 0 || !reader_integer(reader, vertices, 1, MOST_VALUES, &count)) {
        if (coordinates == 0) reader_fail(reader, &paint.at, "expected a string for each coordinate, got none");
        return;
    }
    if (coordinates > (size_t)(MOST_VALUES / count) ||
        !need_has_room(coordinates * (size_t)count * sizeof *model->painted->values)) {
        reader_fail(reader, &vertices.at, "expected at most %d vertices over all coordinates, and memory for them",
                    MOST_VALUES);
        return;
    }
    model->painted = paint_create((int)coordinates, count);
    for (int i = 0; i < (int)coordinates; i++) {
        const struct value value = reader_element(&paint, i);
        const char *text = json_string_value(value.json);
        const size_t expected = (size_t)count * sizeof *model->painted->values;
        size_t size = 0;
        if (json_is_null(value.json)) continue;
        if (!text) {
            reader_unexpected(reader, value, "a string in base64 or null");
            continue;
        }
        char *bytes = need(base64_capacity(json_string_length(value.json)), 1);
        if (!base64_decode(text, bytes, &size)) {
            reader_fail(reader, &value.at, "expected base64, got something else");
        } else if (size != expected) {
            reader_fail(reader, &value.at, "expected the %zu bytes of %d vertices, got %zu", expected, count, size);
        } else {
            struct error error;
            memcpy(model->painted->values + (size_t)i * (size_t)count, bytes, size);
            if (!paint_check(model->painted, i, &error)) reader_fail(reader, &value.at, "%s", error.text);
        }
        free(bytes);
    }
}

static void paint_print(struct members *members, const struct document *document, const void *at, const char *folder)
{
    const struct model_rig *model = &((const struct rig *)at)->model;
    const struct paint *paint = model->painted;
    if (!paint && model->paint_file) member_path(members, "paint", document, model->paint_file, folder);
    if (!paint || paint_is_plain(paint)) return;
    member_number(members, "vertices", paint->vertices);
    member(members, "paint");
    for (int i = 0; i < paint->coordinates; i++) {
        text_string(members->text, i > 0 ? ",\n        " : "[\n        ");
        if (paint_is_plain_at(paint, i)) {
            text_string(members->text, "null");
            continue;
        }
        const size_t size = (size_t)paint->vertices * sizeof *paint->values;
        char *base64 = need(base64_length(size) + 1, 1);
        base64_encode(paint->values + (size_t)i * (size_t)paint->vertices, size, base64);
        text_quoted(members->text, base64);
        free(base64);
    }
    text_string(members->text, "\n      ]");
}

// --- the kinds, row by row

_Static_assert(offsetof(struct tail, channels) == 0 && offsetof(struct chain, channels) == 0,
               "rig.bent is their beginning");

/// The members that every kind of rig begins with, and its pins, which are its last.
#define RIG_FIRST(needs_name)                                                                                        \
    {.key = "type", .print = print_type},                                                                            \
    {                                                                                                                \
        FIELD("name", FIELD_TEXT, struct rig, name), .is_required = needs_name, .is_apart = true                     \
    }
#define RIG_OFFSET                                                                                                   \
    {                                                                                                                \
        FIELD("offset", FIELD_NUMBER, struct rig, offset), .range = {-SCENE_MAX_FRAME, SCENE_MAX_FRAME, false},      \
                                                           .is_quiet = true                                          \
    }
#define RIG_PINS(rows_of)                                                                                            \
    {                                                                                                                \
        FIELD_LIST_OF("pins", struct rig, pins, pin_count, rows_of, SCENE_MAX_PINS),                                 \
            .load = load_pins, .is_quiet = true, .is_apart = true                                                    \
    }

static void print_type(struct members *members, const struct document *document, const void *at, const char *folder)
{
    (void)document, (void)folder;
    member_string(members, "type", rig_word(((const struct rig *)at)->kind));
}

static void load_pins(struct reader *reader, const struct value *object, void *at)
{
    struct rig *rig = at;
    const struct where pins_at = {.parent = &object->at, .key = "pins"};
    list_load(reader, object, fields_find(rig_fields(rig), "pins"), rig);
    struct pin *loaded = rig->pins;
    const int count = rig->pin_count;
    if (pins_count(reader->document) > SCENE_MAX_PINS)
        reader_fail(reader, &pins_at, "expected at most %d pins over all rigs, got more", SCENE_MAX_PINS);
    rig->pins = NULL;
    rig->pin_count = 0;
    for (int i = 0; i < count; i++) {
        loaded[i].id = reader->document->next_id++;
        pins_insert(rig, &loaded[i]);
    }
    free(loaded);
}

_Static_assert((int)SCENE_MAX_CHANNELS <= (int)RIG_MAX_INPUTS && (int)MODEL_MAX_DRIVES <= (int)RIG_MAX_INPUTS,
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
        list_load(reader, object, fields_find(rig_fields(rig), "channels"), rig);
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
    RIG_OFFSET,
    RIG_PINS(joint_pins),
    FIELD_END(struct rig),
};

// --- characters, and chains on them

static const struct field drive_fields[] = {
    {FIELD("name", FIELD_TEXT, struct drive, name), .is_required = true},
    {FIELD("spline", FIELD_SPLINE, struct drive, spline)},
    {FIELD("amplitude", FIELD_NUMBER, struct drive, amplitude), .range = FIELD_ANY,
     .usual = {DRIVE_DEFAULT_AMPLITUDE}},
    {FIELD("lag", FIELD_NUMBER, struct drive, lag), .range = FIELD_ANY},
    FIELD_END(struct drive),
};

static const char *const phase_axes[] = {"x", "y", "z", NULL};

static const char *const repeats[] = {[REPEAT_BY_CLIP] = "", [REPEAT_ONCE] = "once", [REPEAT_LOOP] = "loop", NULL};

static const struct field model_fields[] = {
    RIG_FIRST(false),
    {FIELD("model", FIELD_PATH, struct rig, model.model), .is_required = true},
    {FIELD("clip", FIELD_TEXT, struct rig, model.clip)},
    {FIELD("repeat", FIELD_WORD, struct rig, model.repeat), .words = repeats, .is_quiet = true},
    {FIELD("position", FIELD_NUMBERS, struct rig, model.position), .range = FIELD_ANY},
    {FIELD("scale", FIELD_NUMBER, struct rig, model.scale), .range = FIELD_POSITIVE, .usual = {1}},
    {FIELD("turn", FIELD_NUMBER, struct rig, model.turn), .range = FIELD_ANY},
    {FIELD_LIST_OF("coordinates", struct rig, model.drives, model.drive_count, drive_fields, MODEL_MAX_DRIVES),
     .is_quiet = true},
    {FIELD("phases", FIELD_WORD, struct rig, model.phases), .words = phase_axes, .usual = {-1}, .is_quiet = true},
    {FIELD("floor", FIELD_NUMBER, struct rig, model.floor), .range = FIELD_ANY,
     .flag = offsetof(struct rig, model.has_floor)},
    {FIELD("paint", FIELD_PATH, struct rig, model.paint_file), .load = paint_load, .print = paint_print},
    {FIELD("vertices", FIELD_PAINT, struct rig, model.painted)},
    RIG_OFFSET,
    RIG_PINS(vertex_pins),
    FIELD_END(struct rig),
};

static const struct field chain_fields[] = {
    RIG_FIRST(false),
    {FIELD("model", FIELD_MODEL, struct rig, chain.model), .is_required = true},
    {FIELD("from", FIELD_TEXT, struct rig, chain.from), .is_required = true},
    {FIELD("to", FIELD_TEXT, struct rig, chain.to), .is_required = true},
    {FIELD("turn", FIELD_NUMBER, struct rig, chain.turn), .range = FIELD_ANY},
    {FIELD("mirror", FIELD_FLAG, struct rig, chain.mirror)},
    {FIELD_LIST_OF("channels", struct rig, chain.channels, chain.channel_count, chain_channels, SCENE_MAX_CHANNELS)},
    RIG_OFFSET,
    RIG_PINS(joint_pins),
    FIELD_END(struct rig),
};

// --- all kinds

static const struct {
    const char *word;           ///< in the file
    const struct field *fields; ///< in the order of the file
    size_t title;               ///< place of the text that names it if it has no name
} kinds[RIG_KINDS] = {
    [RIG_TAIL] = {"tail", tail_fields, offsetof(struct rig, name)},
    [RIG_MODEL] = {"model", model_fields, offsetof(struct rig, model.model)},
    [RIG_CHAIN] = {"chain", chain_fields, offsetof(struct rig, chain.from)},
};

const char *rig_word(enum rig_kind kind) { return kinds[kind].word; }

const char *rig_title(const struct rig *rig)
{
    const char *title = *(char *const *)((const char *)rig + kinds[rig->kind].title);
    if (rig->name && rig->name[0]) return rig->name;
    return title && title[0] ? title : rig_word(rig->kind);
}

const struct field *rig_fields(const struct rig *rig) { return kinds[rig->kind].fields; }

/// Whether channels bend it; if not, it has drives.
static bool is_bent(const struct rig *rig) { return rig->kind != RIG_MODEL; }

int rig_input_count(const struct rig *rig) { return is_bent(rig) ? rig->bent.channel_count : rig->model.drive_count; }

int rig_input(const struct rig *rig, int input)
{
    return is_bent(rig) ? rig->bent.channels[input].spline : rig->model.drives[input].spline;
}

int *rig_spline(struct rig *rig, int n)
{
    const int inputs = rig_input_count(rig);
    if (n < inputs) return is_bent(rig) ? &rig->bent.channels[n].spline : &rig->model.drives[n].spline;
    return rig->kind == RIG_TAIL && n < inputs + 3 ? &rig->tail.position[n - inputs].track : NULL;
}

int rig_point_input(const struct rig *rig, int input)
{
    const bool is_point = !is_bent(rig) || axis_bends(rig->bent.channels[input].axis);
    return is_point ? rig_input(rig, input) : -1;
}

int rig_point_spline(const struct rig *rig)
{
    const int count = rig_input_count(rig);
    for (int i = 0; i < count; i++) {
        if (rig_point_input(rig, i) >= 0) return rig_point_input(rig, i);
    }
    return -1;
}

bool rig_is_moved(const struct rig *rig, int spline)
{
    const int count = rig_input_count(rig);
    int i = 0;
    while (i < count && rig_point_input(rig, i) != spline) i++;
    return i < count;
}

struct channel *rig_channels(const struct rig *rig, int *count)
{
    *count = is_bent(rig) ? rig->bent.channel_count : 0;
    return is_bent(rig) ? rig->bent.channels : NULL;
}

const struct field *rig_pin_fields(const struct rig *rig)
{
    return rig->kind == RIG_MODEL ? vertex_pins : joint_pins;
}

const char *rig_pin_key(const struct rig *rig) { return rig_pin_fields(rig)[1].key; }

struct rig *rig_create(enum rig_kind kind)
{
    struct rig *rig = need_zeroed(1, sizeof *rig);
    atomic_init(&rig->holders, 1);
    rig->kind = kind;
    fields_reset(kinds[kind].fields, rig);
    return rig;
}

struct rig *rig_clone(const struct rig *rig)
{
    struct rig *copy = need(1, sizeof *copy);
    *copy = *rig;
    atomic_init(&copy->holders, 1);
    fields_copy(rig_fields(rig), copy);
    return copy;
}

struct rig *rig_hold(struct rig *rig)
{
    atomic_fetch_add(&rig->holders, 1);
    return rig;
}

void rig_drop(struct rig *rig)
{
    if (!rig || atomic_fetch_sub(&rig->holders, 1) > 1) return;
    fields_free(rig_fields(rig), rig);
    free(rig);
}

bool rig_check(const struct document *document, struct rig *rig, struct error *error)
{
    const int joints = rig->kind == RIG_TAIL ? rig->tail.joints : JOINTS_UNKNOWN;
    struct error why;
    return fields_check(document, joints, rig_fields(rig), rig, &why) ||
           fail(error, ERROR_INPUT, "%s: %s", rig_title(rig), why.text);
}

bool rig_equals(const struct rig *a, const struct rig *b)
{
    return a == b || (a->kind == b->kind && fields_equal(rig_fields(a), a, b));
}

size_t rig_bytes(const struct rig *rig, const struct rig *other)
{
    return sizeof *rig + fields_bytes(rig_fields(rig), rig, other);
}

void load_rigs(struct reader *reader, const struct value *scene)
{
    const struct value rigs = reader_member(scene, "rigs");
    int count = reader_objects(reader, rigs, SCENE_MAX_RIGS);
    struct document *document = reader->document;
    const char *words[RIG_KINDS + 1] = {NULL};
    for (int k = 0; k < RIG_KINDS; k++) words[k] = kinds[k].word;
    for (int i = 0; i < count; i++) {
        const struct value object = reader_element(&rigs, i);
        const struct value type = reader_member(&object, "type");
        const char *word = json_string_value(type.json);
        if (word && strcmp(word, "meadow") == 0) {
            // Of an old file: it is kept as unknown keys are kept.
            if (!reader->meadows) {
                reader_warn(reader, &object.at, "meadows are no longer shown; the file keeps them");
                reader->meadows = reader_keep(reader, json_array());
            }
            if (json_array_append(reader->meadows, object.json) != 0) need_failed();
            continue;
        }
        const bool is_old = word && strcmp(word, "character") == 0; // a model with coordinates
        const int kind = is_old ? RIG_MODEL : reader_word(reader, type, words);
        // an unknown kind is an error already, so any kind will do
        struct rig *rig = rig_create(kind < 0 ? RIG_TAIL : (enum rig_kind)kind);
        rig->id = document->next_id++;
        reader->places[document->rig_count] = i;
        document_add_rig(document, rig);
        reader->rig = rig;
        if (kind >= 0) object_load(reader, &object, kinds[kind].fields, rig);
        for (int other = 0; other + 1 < document->rig_count && rig->name; other++) {
            const struct where name_at = {.parent = &object.at, .key = "name"};
            const char *name = document->rigs[other]->name;
            if (!name || strcmp(name, rig->name) != 0) continue;
            reader_fail(reader, &name_at, "expected a unique name, got \"%s\", the name of rigs[%d]", name,
                        reader->places[other]);
            break;
        }
    }
    for (int i = 0; i < document->rig_count; i++) {
        const struct value object = reader_element(&rigs, reader->places[i]);
        const struct where at = {.parent = &object.at, .key = "model"};
        const struct rig *rig = document->rigs[i];
        struct error error;
        if (rig->kind == RIG_CHAIN && rig->chain.model && !has_model(document, rig->chain.model, &error))
            reader_fail(reader, &at, "%s", error.text);
    }
}

bool scene_has_meadow(const struct document *document) { return json_object_get(document->extra, "rigs") != NULL; }

void print_rigs(struct text *text, const struct document *document, const char *folder)
{
    const char *before = "[\n";
    for (int r = 0; r < document->rig_count; r++, before = ",\n") {
        const struct rig *rig = document->rigs[r];
        struct members members = {text, "    {\n      ", ",\n      ", false};
        text_string(text, before);
        fields_print(&members, document, rig_fields(rig), rig, folder);
        text_string(text, "\n    }");
    }
    const json_t *meadows = json_object_get(document->extra, "rigs");
    for (size_t m = 0; m < json_array_size(meadows); m++, before = ",\n") {
        text_string(text, before);
        text_string(text, "    ");
        text_json(text, json_array_get(meadows, m));
    }
    text_string(text, before[0] == ',' ? "\n  ]" : "[]");
}

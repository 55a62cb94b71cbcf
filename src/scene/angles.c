/// The angles of channels: looked up along the joints, read, checked and printed.
#include "scene/fields.h"
#include <math.h>

bool axis_bends(enum axis axis) { return axis <= AXIS_TWIST; }

const char *axis_unit(enum axis axis) { return axis >= AXIS_BREATH ? "%" : "°"; }

double axis_gain(enum axis axis)
{
    static const double gain[AXES] = {
        [AXIS_LOOK] = 20, [AXIS_NOD] = 10, [AXIS_EARS] = 20, [AXIS_BREATH] = 2, [AXIS_BLINK] = 100};
    return gain[axis] > 0 ? gain[axis] : CHANNEL_DEFAULT_GAIN;
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

/// An array with one number per joint.
static void load_each(struct reader *reader, struct value value, struct angles *angles)
{
    const size_t count = json_array_size(value.json);
    const int joints = reader->rig->kind == RIG_TAIL ? reader->rig->tail.joints : JOINTS_UNKNOWN;
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

/// A ramp's point after `before`, which is NULL for the first.
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

void load_angles(struct reader *reader, struct value value, struct angles *angles, json_t **extra)
{
    if (!value.json) return;
    if (json_is_number(value.json)) {
        reader_number(reader, value, true, range_any, &angles->value[0]);
    } else if (json_is_array(value.json)) {
        load_each(reader, value, angles);
    } else if (json_is_object(value.json)) {
        load_ramp(reader, &value, angles, extra);
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

static bool check_ramp(const struct angles *ramp, struct error *error)
{
    if (ramp->count < 2 || ramp->count > RAMP_MAX_POINTS) {
        return fail(error, ERROR_INPUT, "a ramp has from 2 to %d points", RAMP_MAX_POINTS);
    }
    for (int i = 0; i < ramp->count; i++) {
        const double at = ramp->ramp[i].at;
        if (!(at >= 0 && at <= 1)) return fail(error, ERROR_INPUT, "the places of a ramp are from 0 to 1");
        if (i > 0 && at <= ramp->ramp[i - 1].at) return fail(error, ERROR_INPUT, "the places of a ramp must ascend");
    }
    return true;
}

bool check_angles(int joints, struct angles *angles, struct error *error)
{
    if ((unsigned)angles->form > ANGLES_RAMP) return fail(error, ERROR_INPUT, "there is no such form of angles");
    if (angles->form == ANGLES_RAMP && !check_ramp(angles, error)) return false;
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

/// Swaps a change with the document's state, which both does and undoes it.
#include "scene/change.h"
#include "scene/pins.h"
#include "scene/reference.h"
#include "scene/snapshot.h"
#include <assert.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>

enum { FIRST_CAPACITY = 4096 };

bool change_list_reserve(struct change_list *list, size_t count)
{
    size_t capacity = list->capacity > 0 ? list->capacity : FIRST_CAPACITY;
    while (capacity < list->count + count) capacity *= 2;
    if (capacity == list->capacity) return true;
    struct change *items = realloc(list->items, capacity * sizeof *items);
    if (!items) return false;
    list->items = items;
    list->capacity = capacity;
    return true;
}

/// Knots and pins.
static size_t frames_of(const struct document *document)
{
    size_t count = (size_t)pins_count(document);
    for (int s = 0; s < document->spline_count; s++) count += (size_t)document->splines[s].knot_count;
    return count;
}

size_t change_bytes(const struct change *change, const struct document *document)
{
    const size_t own = sizeof *change;
    switch (change->kind) {
    case CHANGE_SPLINE_IN:
        return own + sizeof *change->held;
    case CHANGE_SPLINE_OUT:
        return own + sizeof *change->held + (size_t)change->held->knot_capacity * sizeof *change->held->knots;
    case CHANGE_NAME:
        return own + strlen(change->name) + 1;
    case CHANGE_DOCUMENT:
        return own + document_bytes(change->document);
    case CHANGE_RIG_IN:
        return own + sizeof *change->rig.held;
    case CHANGE_RIG:
    case CHANGE_RIG_OUT:
        return own + rig_bytes(change->rig.held);
    case CHANGE_SHEET:
        return own + paint_bytes(change->sheet.paint);
    case CHANGE_PAINT:
        return own + touched_bytes(change->stroke.touched);
    case CHANGE_TIMING:
        return own + (change->timing.frames ? frames_of(document) * sizeof *change->timing.frames : 0);
    default:
        return own;
    }
}

static void insert_knot(const struct document *document, int index, const struct knot *knot)
{
    struct spline *spline = &document->splines[index];
    assert(spline->knot_count < spline->knot_capacity);
    int at = spline_lower_bound(document, spline, document_sample(document, knot->frame));
    memmove(&spline->knots[at + 1], &spline->knots[at], (size_t)(spline->knot_count - at) * sizeof *knot);
    spline->knots[at] = *knot;
    spline->knot_count++;
    snapshot_knot_came(document, index, at);
}

static struct knot remove_knot(const struct document *document, int index, unsigned id)
{
    struct spline *spline = &document->splines[index];
    int at = spline_find_id(spline, id);
    assert(at >= 0);
    snapshot_knot_goes(document, index, at);
    struct knot knot = spline->knots[at];
    spline->knot_count--;
    memmove(&spline->knots[at], &spline->knots[at + 1], (size_t)(spline->knot_count - at) * sizeof knot);
    return knot;
}

/// The knot as `knot` says it is, at its new place: those between the two places move, not all behind it. Returns the old one.
static struct knot replace_knot(const struct document *document, int index, const struct knot *knot)
{
    const struct spline *spline = &document->splines[index];
    struct knot *knots = spline->knots;
    const int from = spline_find_id(spline, knot->id);
    assert(from >= 0);
    snapshot_knot_goes(document, index, from);
    const struct knot old = knots[from];
    int to = spline_lower_bound(document, spline, document_sample(document, knot->frame));
    if (to > from) to--; // where it is once the old one is gone
    if (to > from) memmove(&knots[from], &knots[from + 1], (size_t)(to - from) * sizeof *knots);
    if (to < from) memmove(&knots[to + 1], &knots[to], (size_t)(from - to) * sizeof *knots);
    knots[to] = *knot;
    snapshot_knot_came(document, index, to);
    return old;
}

static void swap_knot(struct change *change, const struct document *document)
{
    struct knot other = change->knot;
    if (change->kind == CHANGE_KNOT) {
        change->knot = replace_knot(document, change->spline, &other);
        return;
    }
    if (change->kind == CHANGE_KNOT_IN) {
        change->knot = remove_knot(document, change->spline, other.id);
        change->kind = CHANGE_KNOT_OUT;
    } else {
        insert_knot(document, change->spline, &other);
        change->kind = CHANGE_KNOT_IN;
    }
}

struct settings settings_of(const struct spline *spline)
{
    struct settings settings;
    memcpy(settings.parameter, spline->parameter, sizeof settings.parameter);
    return settings;
}

static void swap_settings(struct spline *spline, struct settings *settings)
{
    struct settings old = settings_of(spline);
    memcpy(spline->parameter, settings->parameter, sizeof spline->parameter);
    *settings = old;
}

struct timing timing_of(const struct document *document)
{
    return (struct timing){document->fps, document->substeps, document->first_frame, document->last_frame, NULL};
}

static void swap_frames(struct document *document, double *frames)
{
    for (int s = 0; s < document->spline_count; s++) {
        struct spline *spline = &document->splines[s];
        for (int k = 0; k < spline->knot_count; k++) {
            double frame = spline->knots[k].frame;
            spline->knots[k].frame = *frames;
            *frames++ = frame;
        }
    }
    for (int r = 0; r < document->rig_count; r++) {
        for (int i = 0; i < document->rigs[r].pin_count; i++) {
            double frame = document->rigs[r].pins[i].frame;
            document->rigs[r].pins[i].frame = *frames;
            *frames++ = frame;
        }
    }
}

static void swap_timing(struct document *document, struct timing *timing)
{
    struct timing old = timing_of(document);
    old.frames = timing->frames;
    document->fps = timing->fps;
    document->substeps = timing->substeps;
    document->first_frame = timing->first;
    document->last_frame = timing->last;
    if (timing->frames) swap_frames(document, timing->frames);
    *timing = old;
}

/// Where the spline at `index` ends up when the one at `from` moves to `to`.
static int moved_index(int index, int from, int to)
{
    if (index == from) return to;
    if (from < index && index <= to) return index - 1;
    return to <= index && index < from ? index + 1 : index;
}

struct moving {
    struct document *document;
    int from, to;
};

static void move_reference(const struct reference *reference, void *context)
{
    const struct moving *moving = context;
    reference_set(moving->document, reference, moved_index(reference->spline, moving->from, moving->to));
}

/// Gives every reference its spline's new index. INT_MAX as `from` or `to` means outside the list.
static void move_references(struct document *document, int from, int to)
{
    struct moving moving = {document, from, to};
    reference_each(document, move_reference, &moving);
}

/// Nothing refers to the spline; its own tracks are numbered as if it were not in the list.
static void swap_spline(struct change *change, struct document *document)
{
    int at = change->spline;
    struct spline *place = &document->splines[at];
    if (change->kind == CHANGE_SPLINE_IN) {
        size_t after = (size_t)(document->spline_count - at - 1);
        move_references(document, at, INT_MAX);
        *change->held = *place;
        memmove(place, place + 1, after * sizeof *place);
        document->spline_count--;
        change->kind = CHANGE_SPLINE_OUT;
    } else {
        assert(document->spline_count < document->spline_capacity);
        size_t after = (size_t)(document->spline_count - at);
        memmove(place + 1, place, after * sizeof *place);
        *place = *change->held;
        document->spline_count++;
        move_references(document, INT_MAX, at);
        change->kind = CHANGE_SPLINE_IN;
    }
}

static void swap_rig(struct change *change, struct document *document)
{
    struct rig *place = &document->rigs[change->rig.at];
    size_t after = (size_t)(document->rig_count - change->rig.at);
    if (change->kind == CHANGE_RIG_IN) {
        *change->rig.held = *place;
        memmove(place, place + 1, (after - 1) * sizeof *place);
        document->rig_count--;
        change->kind = CHANGE_RIG_OUT;
    } else {
        assert(document->rig_count < document->rig_capacity);
        memmove(place + 1, place, after * sizeof *place);
        *place = *change->rig.held;
        document->rig_count++;
        change->kind = CHANGE_RIG_IN;
    }
}

static void swap_place(struct change *change, struct document *document)
{
    int from = change->spline, to = change->to;
    struct spline *low = &document->splines[from < to ? from : to];
    size_t between = (size_t)(from < to ? to - from : from - to);
    move_references(document, from, to);
    struct spline moved = document->splines[from];
    memmove(from < to ? low : low + 1, from < to ? low + 1 : low, between * sizeof *low);
    document->splines[to] = moved;
    change->spline = to;
    change->to = from;
}

bool change_rebase(struct change *change, const char *from, const char *to)
{
    const bool holds_rig = change->kind == CHANGE_RIG || change->kind == CHANGE_RIG_OUT;
    return !holds_rig || rig_rebase(change->rig.held, from, to);
}

size_t change_settle(struct change *change)
{
    if (change->kind != CHANGE_PAINT) return 0;
    const size_t before = touched_bytes(change->stroke.touched);
    touched_settle(change->stroke.touched);
    return before - touched_bytes(change->stroke.touched);
}

void change_release(struct change *change)
{
    if (change->kind == CHANGE_SPLINE_OUT) {
        free(change->held->name);
        free(change->held->knots);
    }
    if (change->kind == CHANGE_SPLINE_OUT || change->kind == CHANGE_SPLINE_IN) free(change->held);
    if (change->kind == CHANGE_NAME) free(change->name);
    if (change->kind == CHANGE_DOCUMENT) document_destroy(change->document);
    if (change->kind == CHANGE_RIG || change->kind == CHANGE_RIG_OUT) rig_release(change->rig.held);
    if (change->kind == CHANGE_RIG || change->kind == CHANGE_RIG_OUT || change->kind == CHANGE_RIG_IN)
        free(change->rig.held);
    if (change->kind == CHANGE_SHEET) paint_destroy(change->sheet.paint);
    if (change->kind == CHANGE_PAINT) touched_destroy(change->stroke.touched);
    if (change->kind == CHANGE_TIMING) free(change->timing.frames);
}

bool change_concerns_all(const struct change *change)
{
    return change->kind == CHANGE_TIMING || change->kind == CHANGE_SPLINE_IN || change->kind == CHANGE_SPLINE_OUT ||
           change->kind == CHANGE_SPLINE_MOVE || change->kind == CHANGE_DOCUMENT;
}

#define SWAP(type, a, b)                                                                                             \
    do {                                                                                                             \
        type swapped = (a);                                                                                          \
        (a) = (b);                                                                                                   \
        (b) = swapped;                                                                                               \
    } while (0)

_Static_assert(sizeof(struct ramp_point) == 2 * sizeof(double), "a ramp is places and angles in turn");

struct angles *change_angles(struct document *document, struct angles_place at)
{
    struct rig *rig = &document->rigs[at.rig];
    int count;
    if (at.kind == ANGLE_REST) return &rig->tail.rest;
    struct channel *channel = &rig_channels(rig, &count)[at.channel];
    return at.kind == ANGLE_LAG ? &channel->lag : &channel->gain;
}

static void swap_channel(struct change *change, struct document *document)
{
    int count;
    struct channel *channel = &rig_channels(&document->rigs[change->channel.rig], &count)[change->channel.channel];
    SWAP(int, channel->spline, change->channel.spline);
    SWAP(enum axis, channel->axis, change->channel.axis);
    SWAP(enum channel_part, channel->of, change->channel.of);
}

static void swap_tail_place(struct change *change, struct document *document)
{
    struct tail *tail = &document->rigs[change->place.rig].tail;
    SWAP(double, tail->length, change->place.length);
    for (int i = 0; i < 3; i++) SWAP(struct param, tail->position[i], change->place.position[i]);
}

static void swap_drives(struct change *change, struct document *document)
{
    struct character_rig *rig = &document->rigs[change->drives.rig].character;
    SWAP(int, rig->drive_count, change->drives.count);
    for (int i = 0; i < CHARACTER_MAX_DRIVES; i++) SWAP(struct drive, rig->drives[i], change->drives.drives[i]);
}

static void swap_floor(struct change *change, struct document *document)
{
    struct character_rig *rig = &document->rigs[change->floor.rig].character;
    SWAP(bool, rig->has_floor, change->floor.is_on);
    SWAP(double, rig->floor, change->floor.height);
}

static void swap_pin(struct change *change, struct document *document)
{
    struct rig *rig = &document->rigs[change->pin.rig];
    const struct pin other = change->pin.pin;
    if (change->kind != CHANGE_PIN_OUT) change->pin.pin = pins_remove(rig, other.id);
    if (change->kind != CHANGE_PIN_IN) pins_insert(rig, &other);
    if (change->kind != CHANGE_PIN) change->kind = change->kind == CHANGE_PIN_IN ? CHANGE_PIN_OUT : CHANGE_PIN_IN;
}

void change_swap(struct change *change, struct document *document)
{
    struct spline *spline = change->spline >= 0 ? &document->splines[change->spline] : NULL;
    const uint64_t edits = document->edits + 1;
    if (document->snapshot && change_concerns_all(change)) snapshot_finish(document->snapshot);
    switch (change->kind) {
    case CHANGE_KNOT_IN:
    case CHANGE_KNOT_OUT:
    case CHANGE_KNOT:
        swap_knot(change, document);
        break;
    case CHANGE_SETTINGS:
        swap_settings(spline, &change->settings);
        break;
    case CHANGE_NAME:
        SWAP(char *, spline->name, change->name);
        break;
    case CHANGE_COLOR:
        SWAP(int, spline->color, change->color);
        break;
    case CHANGE_DOCUMENT:
        SWAP(struct document, *document, *change->document);
        break;
    case CHANGE_SPLINE_IN:
    case CHANGE_SPLINE_OUT:
        swap_spline(change, document);
        break;
    case CHANGE_SPLINE_MOVE:
        swap_place(change, document);
        break;
    case CHANGE_TIMING:
        swap_timing(document, &change->timing);
        break;
    case CHANGE_CHANNEL:
        swap_channel(change, document);
        break;
    case CHANGE_PLACE:
        swap_tail_place(change, document);
        break;
    case CHANGE_RIG:
        SWAP(struct rig, document->rigs[change->rig.at], *change->rig.held);
        break;
    case CHANGE_RIG_IN:
    case CHANGE_RIG_OUT:
        swap_rig(change, document);
        break;
    case CHANGE_FORM:
        SWAP(enum angle_form, change_angles(document, change->form.at)->form, change->form.form);
        SWAP(int, change_angles(document, change->form.at)->count, change->form.count);
        break;
    case CHANGE_ANGLE:
        SWAP(double, change_angles(document, change->angle.at)->value[change->angle.index], change->angle.value);
        break;
    case CHANGE_DRIVES:
        swap_drives(change, document);
        break;
    case CHANGE_FLOOR:
        swap_floor(change, document);
        break;
    case CHANGE_SHEET:
        SWAP(struct paint *, document->rigs[change->sheet.rig].character.painted, change->sheet.paint);
        break;
    case CHANGE_PAINT:
        touched_swap(change->stroke.touched, document->rigs[change->stroke.rig].character.painted);
        break;
    case CHANGE_PIN_IN:
    case CHANGE_PIN_OUT:
    case CHANGE_PIN:
        swap_pin(change, document);
        break;
    }
    document->edits = edits; // also where it is another one now
}

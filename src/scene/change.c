#include "scene/change.h"
#include <assert.h>
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

static void insert_knot(const struct document *document, struct spline *spline, const struct knot *knot)
{
    assert(spline->knot_count < spline->knot_capacity);
    int at = spline_lower_bound(document, spline, document_sample(document, knot->frame));
    memmove(&spline->knots[at + 1], &spline->knots[at], (size_t)(spline->knot_count - at) * sizeof *knot);
    spline->knots[at] = *knot;
    spline->knot_count++;
}

static struct knot remove_knot(struct spline *spline, unsigned id)
{
    int at = spline_find_id(spline, id);
    assert(at >= 0);
    struct knot knot = spline->knots[at];
    spline->knot_count--;
    memmove(&spline->knots[at], &spline->knots[at + 1], (size_t)(spline->knot_count - at) * sizeof knot);
    return knot;
}

static void swap_knot(struct change *change, const struct document *document, struct spline *spline)
{
    struct knot other = change->knot;
    if (change->kind != CHANGE_KNOT_OUT) change->knot = remove_knot(spline, other.id);
    if (change->kind != CHANGE_KNOT_IN) insert_knot(document, spline, &other);
    if (change->kind != CHANGE_KNOT) {
        change->kind = change->kind == CHANGE_KNOT_IN ? CHANGE_KNOT_OUT : CHANGE_KNOT_IN;
    }
}

struct settings settings_of(const struct spline *spline)
{
    struct settings settings = {spline->mode, spline->start, spline->spring_friction, {{0, 0}}};
    memcpy(settings.parameter, spline->parameter, sizeof settings.parameter);
    return settings;
}

static void swap_settings(struct spline *spline, struct settings *settings)
{
    struct settings old = settings_of(spline);
    spline->mode = settings->mode;
    spline->start = settings->start;
    spline->spring_friction = settings->spring_friction;
    memcpy(spline->parameter, settings->parameter, sizeof spline->parameter);
    *settings = old;
}

#define SWAP(type, a, b)                                                                                             \
    do {                                                                                                             \
        type swapped = (a);                                                                                          \
        (a) = (b);                                                                                                   \
        (b) = swapped;                                                                                               \
    } while (0)

struct angles *angles_at(struct document *document, struct angles_place at)
{
    struct tail *tail = &document->tails[at.tail];
    if (at.kind == ANGLE_REST) return &tail->rest;
    struct channel *channel = &tail->channels[at.channel];
    return at.kind == ANGLE_LAG ? &channel->lag : &channel->gain;
}

static void swap_channel(struct change *change, struct document *document)
{
    struct channel *channel = &document->tails[change->channel.tail].channels[change->channel.channel];
    SWAP(int, channel->spline, change->channel.spline);
    SWAP(enum axis, channel->axis, change->channel.axis);
    SWAP(enum channel_part, channel->of, change->channel.of);
}

static void swap_tail_place(struct change *change, struct document *document)
{
    struct tail *tail = &document->tails[change->place.tail];
    SWAP(double, tail->length, change->place.length);
    for (int i = 0; i < 3; i++) SWAP(struct param, tail->position[i], change->place.position[i]);
}

void change_swap(struct change *change, struct document *document)
{
    struct spline *spline = change->spline >= 0 ? &document->splines[change->spline] : NULL;
    switch (change->kind) {
    case CHANGE_KNOT_IN:
    case CHANGE_KNOT_OUT:
    case CHANGE_KNOT:
        swap_knot(change, document, spline);
        break;
    case CHANGE_SETTINGS:
        swap_settings(spline, &change->settings);
        break;
    case CHANGE_RANGE:
        SWAP(int, document->first_frame, change->range.first);
        SWAP(int, document->last_frame, change->range.last);
        break;
    case CHANGE_CHANNEL:
        swap_channel(change, document);
        break;
    case CHANGE_PLACE:
        swap_tail_place(change, document);
        break;
    case CHANGE_EACH:
        SWAP(bool, angles_at(document, change->each.at)->each, change->each.each);
        break;
    case CHANGE_ANGLE:
        SWAP(double, angles_at(document, change->angle.at)->value[change->angle.joint], change->angle.value);
        break;
    }
}

/// Edits of a tail and its channels.
#include "scene/edit_plan.h"
#include <math.h>

static struct channel *find_channel(struct document *document, const struct edit *edit)
{
    struct tail *tail = &document->tails[edit->tail];
    return edit->channel >= 0 && edit->channel < tail->channel_count ? &tail->channels[edit->channel] : NULL;
}

static struct angles *find_angles(struct document *document, const struct edit *edit)
{
    struct channel *channel = find_channel(document, edit);
    if (edit->angle == ANGLE_REST) return &document->tails[edit->tail].rest;
    if (!channel) return NULL;
    return edit->angle == ANGLE_LAG ? &channel->lag : &channel->gain;
}

bool plan_angles(struct document *document, const struct edit *edit, struct change_list *list, struct error *error)
{
    struct angles *target = find_angles(document, edit);
    if (!target) return fail(error, ERROR_INPUT, "there is no such channel");
    int count = edit->angles->each ? document->tails[edit->tail].joints : 1;
    for (int i = 0; i < count; i++) {
        if (!isfinite(edit->angles->value[i])) return fail(error, ERROR_INPUT, "angles must be finite");
    }
    if (!change_list_reserve(list, 1 + TAIL_MAX_JOINTS)) {
        return fail(error, ERROR_ENVIRONMENT, "not enough memory for this edit");
    }
    if (target->each != edit->angles->each) {
        list->items[list->count++] = (struct change){
            .kind = CHANGE_EACH, .spline = -1, .each = {.target = &target->each, .each = edit->angles->each}};
    }
    for (int i = 0; i < count; i++) {
        double value = edit->angles->value[i] + 0.0;
        if (target->value[i] == value) continue;
        list->items[list->count++] = (struct change){
            .kind = CHANGE_ANGLE, .spline = -1, .angle = {.target = &target->value[i], .value = value}};
    }
    return true;
}

bool plan_axis(struct document *document, const struct edit *edit, struct change_list *list, struct error *error)
{
    struct channel *channel = find_channel(document, edit);
    if (!channel) return fail(error, ERROR_INPUT, "there is no such channel");
    if ((unsigned)edit->axis > AXIS_UP) return fail(error, ERROR_INPUT, "there is no such axis");
    struct change change = {
        .kind = CHANGE_AXIS, .spline = -1, .axis = {.target = &channel->axis, .axis = edit->axis}};
    return channel->axis == edit->axis || plan_add(list, &change, error);
}

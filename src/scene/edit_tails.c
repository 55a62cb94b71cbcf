/// Edits of a tail and its channels.
#include "scene/edit_plan.h"
#include <math.h>

static struct channel *find_channel(struct document *document, const struct edit *edit)
{
    struct tail *tail = &document->rigs[edit->rig].tail;
    return edit->channel >= 0 && edit->channel < tail->channel_count ? &tail->channels[edit->channel] : NULL;
}

static bool no_channel(struct error *error) { return fail(error, ERROR_INPUT, "there is no such channel"); }

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

static bool check_angles(const struct rig *rig, const struct angles *angles, struct error *error)
{
    if ((unsigned)angles->form > ANGLES_RAMP) return fail(error, ERROR_INPUT, "there is no such form of angles");
    if (angles->form == ANGLES_RAMP && !check_ramp(angles, error)) return false;
    if (angles->form == ANGLES_EACH && rig->kind == RIG_TAIL && angles->count != rig->tail.joints) {
        return fail(error, ERROR_INPUT, "%s: there must be one angle for each of the %d joints", rig->name,
                    rig->tail.joints);
    }
    if (angles->form == ANGLES_EACH && (angles->count < 1 || angles->count > ANGLES_MAX_JOINTS)) {
        return fail(error, ERROR_INPUT, "there must be from 1 to %d angles", ANGLES_MAX_JOINTS);
    }
    for (int i = 0; i < angles_count(angles); i++) {
        if (!isfinite(angles_number(angles, i))) return fail(error, ERROR_INPUT, "angles must be finite");
    }
    return true;
}

bool plan_angles(struct document *document, const struct edit *edit, struct change_list *list, struct error *error)
{
    if (edit->angle != ANGLE_REST && !find_channel(document, edit)) return no_channel(error);
    if (!check_angles(&document->rigs[edit->rig], edit->angles, error)) return false;
    const struct angles_place at = {edit->rig, edit->channel, edit->angle};
    const struct angles *target = change_angles(document, at), *wanted = edit->angles;
    const int numbers = angles_count(wanted) * (wanted->form == ANGLES_RAMP ? 2 : 1);
    if (!change_list_reserve(list, 1 + ANGLES_MAX_JOINTS)) return plan_no_memory(error);
    if (target->form != wanted->form || angles_count(target) != angles_count(wanted)) {
        list->items[list->count++] =
            (struct change){.kind = CHANGE_FORM, .spline = -1, .form = {at, wanted->form, wanted->count}};
    }
    for (int i = 0; i < numbers; i++) {
        double value = wanted->value[i] + 0.0;
        if (target->value[i] == value) continue;
        list->items[list->count++] = (struct change){.kind = CHANGE_ANGLE, .spline = -1, .angle = {at, i, value}};
    }
    return true;
}

/// A change that leaves the channel as it is, for the caller to fill in.
static struct change channel_change(const struct edit *edit, const struct channel *channel)
{
    return (struct change){.kind = CHANGE_CHANNEL,
                           .spline = -1,
                           .channel = {edit->rig, edit->channel, channel->spline, channel->axis, channel->of}};
}

bool plan_axis(struct document *document, const struct edit *edit, struct change_list *list, struct error *error)
{
    const struct channel *channel = find_channel(document, edit);
    if (!channel) return no_channel(error);
    if ((unsigned)edit->axis > AXIS_UP) return fail(error, ERROR_INPUT, "there is no such axis");
    struct change change = channel_change(edit, channel);
    change.channel.axis = edit->axis;
    return channel->axis == edit->axis || plan_add(list, &change, error);
}

bool plan_part(struct document *document, const struct edit *edit, struct change_list *list, struct error *error)
{
    const struct channel *channel = find_channel(document, edit);
    if (!channel) return no_channel(error);
    if ((unsigned)edit->of > PART_DISPLACEMENT) return fail(error, ERROR_INPUT, "there is no such part of a spline");
    struct change change = channel_change(edit, channel);
    change.channel.of = edit->of;
    return channel->of == edit->of || plan_add(list, &change, error);
}

bool plan_feed(struct document *document, const struct edit *edit, struct change_list *list, struct error *error)
{
    const struct channel *channel = find_channel(document, edit);
    if (!channel) return no_channel(error);
    if (!plan_has_spline(document, edit->spline, error)) return false;
    struct change change = channel_change(edit, channel);
    change.channel.spline = edit->spline;
    return channel->spline == edit->spline || plan_add(list, &change, error);
}

/// A change that leaves the tail's place as it is, for the caller to fill in.
static struct change place_change(const struct edit *edit, const struct tail *tail)
{
    return (struct change){.kind = CHANGE_PLACE,
                           .spline = -1,
                           .place = {.rig = edit->rig,
                                     .length = tail->length,
                                     .position = {tail->position[0], tail->position[1], tail->position[2]}}};
}

bool plan_position(struct document *document, const struct edit *edit, struct change_list *list, struct error *error)
{
    const struct tail *tail = &document->rigs[edit->rig].tail;
    struct change change = place_change(edit, tail);
    if (edit->coordinate < 0 || edit->coordinate > 2) return fail(error, ERROR_INPUT, "there is no such coordinate");
    const struct param *old = &tail->position[edit->coordinate];
    struct param *param = &change.place.position[edit->coordinate];
    *param =
        edit->param.track >= 0 ? (struct param){0, edit->param.track} : (struct param){edit->param.value + 0.0, -1};
    if (param->track >= document->spline_count) {
        return fail(error, ERROR_INPUT, "%s: there is no spline to follow", document->rigs[edit->rig].name);
    }
    if (!isfinite(param->value))
        return fail(error, ERROR_INPUT, "%s: the position must be finite", document->rigs[edit->rig].name);
    bool same = old->track == param->track && old->value == param->value;
    return same || plan_add(list, &change, error);
}

bool plan_length(struct document *document, const struct edit *edit, struct change_list *list, struct error *error)
{
    const struct tail *tail = &document->rigs[edit->rig].tail;
    struct change change = place_change(edit, tail);
    if (!isfinite(edit->number) || edit->number <= 0) {
        return fail(error, ERROR_INPUT, "%s: the length must be above 0", document->rigs[edit->rig].name);
    }
    change.place.length = edit->number;
    return tail->length == edit->number || plan_add(list, &change, error);
}

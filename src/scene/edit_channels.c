/// Edits of the channels of a tail or chain.
#include "scene/edit_rig.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static struct channel *find_channel(struct document *document, const struct edit *edit)
{
    int count;
    struct channel *channels = rig_channels(&document->rigs[edit->rig], &count);
    return edit->channel >= 0 && edit->channel < count ? &channels[edit->channel] : NULL;
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

bool plan_check_angles(const struct rig *rig, const struct angles *angles, struct error *error)
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
    if (edit->angle == ANGLE_REST && document->rigs[edit->rig].kind != RIG_TAIL)
        return fail(error, ERROR_INPUT, "only a tail has angles at rest");
    if (edit->angle != ANGLE_REST && !find_channel(document, edit)) return no_channel(error);
    if (!plan_check_angles(&document->rigs[edit->rig], edit->angles, error)) return false;
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

bool plan_check_axis(enum rig_kind kind, enum axis axis, struct error *error)
{
    if ((unsigned)axis >= AXES) return fail(error, ERROR_INPUT, "there is no such axis");
    if (!axis_bends(axis) && kind != RIG_TAIL) return fail(error, ERROR_INPUT, "only a tail's body moves");
    return axis != AXIS_TWIST || kind != RIG_TAIL || fail(error, ERROR_INPUT, "a tail does not twist");
}

bool plan_check_part(enum channel_part part, struct error *error)
{
    return (unsigned)part <= PART_DISPLACEMENT || fail(error, ERROR_INPUT, "there is no such part of a spline");
}

bool plan_axis(struct document *document, const struct edit *edit, struct change_list *list, struct error *error)
{
    const struct channel *channel = find_channel(document, edit);
    if (!channel) return no_channel(error);
    if (!plan_check_axis(document->rigs[edit->rig].kind, edit->axis, error)) return false;
    struct change change = channel_change(edit, channel);
    change.channel.axis = edit->axis;
    return channel->axis == edit->axis || plan_add(list, &change, error);
}

bool plan_part(struct document *document, const struct edit *edit, struct change_list *list, struct error *error)
{
    const struct channel *channel = find_channel(document, edit);
    if (!channel) return no_channel(error);
    if (!plan_check_part(edit->of, error)) return false;
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

bool plan_append_channel(struct rig *rig, const struct edit *edit)
{
    const size_t count = (size_t)rig->bent.channel_count;
    struct channel *channels = realloc(rig->bent.channels, (count + 1) * sizeof *channels);
    if (!channels) return false;
    rig->bent.channels = channels;
    struct channel *channel = &channels[count];
    memset(channel, 0, sizeof *channel);
    channel->spline = edit->spline;
    channel->axis = edit->axis;
    channel->of = edit->of;
    channel->lag.value[0] = CHANNEL_DEFAULT_LAG;
    channel->gain.value[0] = axis_gain(edit->axis);
    rig->bent.channel_count++;
    return true;
}

bool plan_channel_add(struct document *document, const struct edit *edit, struct change_list *list,
                      struct error *error)
{
    const struct rig *old = &document->rigs[edit->rig];
    int count;
    rig_channels(old, &count);
    if (!plan_has_spline(document, edit->spline, error) || !plan_check_axis(old->kind, edit->axis, error) ||
        !plan_check_part(edit->of, error))
        return false;
    if (count >= SCENE_MAX_CHANNELS) {
        return fail(error, ERROR_INPUT, "%s: there are %d channels, and no more fit", rig_title(old),
                    SCENE_MAX_CHANNELS);
    }
    struct rig *rig = plan_rig_begin(document, edit->rig, error);
    if (!rig) return false;
    if (plan_append_channel(rig, edit)) return plan_rig_finish(edit->rig, rig, list, error);
    return plan_rig_abandon(rig, error);
}

bool plan_channel_remove(struct document *document, const struct edit *edit, struct change_list *list,
                         struct error *error)
{
    if (!find_channel(document, edit)) return no_channel(error);
    struct rig *rig = plan_rig_begin(document, edit->rig, error);
    if (!rig) return false;
    struct channel *gone = &rig->bent.channels[edit->channel];
    memmove(gone, gone + 1, (size_t)(--rig->bent.channel_count - edit->channel) * sizeof *gone);
    return plan_rig_finish(edit->rig, rig, list, error);
}

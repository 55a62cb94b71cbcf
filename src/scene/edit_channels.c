/// Edits of the channels of a tail or chain.
#include "base/need.h"
#include "scene/editing.h"
#include <math.h>
#include <string.h>

/// The channel at a place; NULL refuses the edit.
static const struct channel *find(const struct document *document, struct channel_place at, struct error *error)
{
    const struct rig *rig = edit_find_rig(document, at.rig, EDIT_BENT, error);
    if (!rig) return NULL;
    if (at.channel >= 0 && at.channel < rig->bent.channel_count) return &rig->bent.channels[at.channel];
    fail(error, ERROR_INPUT, "there is no such channel");
    return NULL;
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

bool edit_check_angles(const struct rig *rig, const struct angles *angles, struct error *error)
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

_Static_assert(sizeof(struct ramp_point) == 2 * sizeof(double), "a ramp is places and angles in turn");

static int numbers_of(const struct angles *angles)
{
    return angles_count(angles) * (angles->form == ANGLES_RAMP ? 2 : 1);
}

static bool same_angles(const struct angles *a, const struct angles *b)
{
    bool same = a->form == b->form && angles_count(a) == angles_count(b);
    for (int i = 0; same && i < numbers_of(a); i++) same = a->value[i] == b->value[i];
    return same;
}

static struct angles *channel_angles(struct rig *rig, int channel, enum angle_kind kind)
{
    if (kind == ANGLE_REST) return &rig->tail.rest;
    return kind == ANGLE_LAG ? &rig->bent.channels[channel].lag : &rig->bent.channels[channel].gain;
}

bool edit_angles(struct document *document, struct channel_place at, enum angle_kind kind,
                 const struct angles *angles, struct error *error)
{
    const struct rig *rig = edit_find_rig(document, at.rig, EDIT_BENT, error);
    if (!rig) return false;
    if (kind == ANGLE_REST && rig->kind != RIG_TAIL)
        return fail(error, ERROR_INPUT, "only a tail has angles at rest");
    if (kind != ANGLE_REST && !find(document, at, error)) return false;
    if (!edit_check_angles(rig, angles, error)) return false;
    struct angles wanted = *angles;
    for (int i = 0; i < numbers_of(&wanted); i++) wanted.value[i] += 0.0;
    if (same_angles(channel_angles(document->rigs[at.rig], at.channel, kind), &wanted)) return true;
    *channel_angles(document_own_rig(document, at.rig), at.channel, kind) = wanted;
    return true;
}

bool edit_check_axis(enum rig_kind kind, enum axis axis, struct error *error)
{
    if ((unsigned)axis >= AXES) return fail(error, ERROR_INPUT, "there is no such axis");
    if (!axis_bends(axis) && kind != RIG_TAIL) return fail(error, ERROR_INPUT, "only a tail's body moves");
    return axis != AXIS_TWIST || kind != RIG_TAIL || fail(error, ERROR_INPUT, "a tail does not twist");
}

bool edit_check_part(enum channel_part part, struct error *error)
{
    return (unsigned)part <= PART_DISPLACEMENT || fail(error, ERROR_INPUT, "there is no such part of a spline");
}

bool edit_axis(struct document *document, struct channel_place at, enum axis axis, struct error *error)
{
    if (!find(document, at, error) || !edit_check_axis(document->rigs[at.rig]->kind, axis, error)) return false;
    struct rig *changed = rig_clone(document->rigs[at.rig]);
    changed->bent.channels[at.channel].axis = axis;
    return edit_replace_rig(document, at.rig, changed, error);
}

bool edit_part(struct document *document, struct channel_place at, enum channel_part of, struct error *error)
{
    if (!find(document, at, error) || !edit_check_part(of, error)) return false;
    struct rig *changed = rig_clone(document->rigs[at.rig]);
    changed->bent.channels[at.channel].of = of;
    return edit_replace_rig(document, at.rig, changed, error);
}

bool edit_feed(struct document *document, struct channel_place at, int spline, struct error *error)
{
    if (!find(document, at, error) || !edit_has_spline(document, spline, error)) return false;
    struct rig *changed = rig_clone(document->rigs[at.rig]);
    changed->bent.channels[at.channel].spline = spline;
    return edit_replace_rig(document, at.rig, changed, error);
}

void edit_append_channel(struct rig *rig, int spline, enum axis axis, enum channel_part of)
{
    const size_t count = (size_t)rig->bent.channel_count;
    rig->bent.channels = need_more(rig->bent.channels, count + 1, sizeof *rig->bent.channels);
    struct channel *channel = &rig->bent.channels[count];
    *channel = (struct channel){.spline = spline, .axis = axis, .of = of};
    channel->lag.value[0] = CHANNEL_DEFAULT_LAG;
    channel->gain.value[0] = axis_gain(axis);
    rig->bent.channel_count++;
}

bool edit_channel_add(struct document *document, int rig, int spline, enum axis axis, enum channel_part of,
                      struct error *error)
{
    const struct rig *old = edit_find_rig(document, rig, EDIT_BENT, error);
    if (!old || !edit_has_spline(document, spline, error) || !edit_check_axis(old->kind, axis, error) ||
        !edit_check_part(of, error))
        return false;
    if (old->bent.channel_count >= SCENE_MAX_CHANNELS) {
        return fail(error, ERROR_INPUT, "%s: there are %d channels, and no more fit", rig_title(old),
                    SCENE_MAX_CHANNELS);
    }
    struct rig *changed = rig_clone(old);
    edit_append_channel(changed, spline, axis, of);
    return edit_replace_rig(document, rig, changed, error);
}

bool edit_channel_remove(struct document *document, struct channel_place at, struct error *error)
{
    if (!find(document, at, error)) return false;
    struct rig *changed = rig_clone(document->rigs[at.rig]);
    struct channel *gone = &changed->bent.channels[at.channel];
    memmove(gone, gone + 1, (size_t)(--changed->bent.channel_count - at.channel) * sizeof *gone);
    return edit_replace_rig(document, at.rig, changed, error);
}

/// Edits of a tail: where and how long it is, how many joints it has, and one more.
#include "scene/edit_rig.h"
#include <math.h>
#include <stdlib.h>

static const double NEW_REST = 1.5;         ///< degrees a joint, so that a new tail is no straight cone
static const double NEW_HEIGHT = 0.26;      ///< metres; the body of a tail of 1.6 m then sits on the ground
static const double ASIDE = 0.75;           ///< distance from a tail to its copy, in tail lengths
static const double ANGLE_RESOLUTION = 1e6; ///< resampled angles are rounded to 1/this degrees

/// A tail without channels, with the file format's defaults but slightly bent and on the ground.
static struct rig plain_tail(void)
{
    struct rig rig = {
        .kind = RIG_TAIL,
        .tail = {.joints = TAIL_DEFAULT_JOINTS, .length = TAIL_DEFAULT_LENGTH, .rest = {.value = {NEW_REST}}}};
    for (int k = 0; k < 3; k++) rig.tail.position[k] = param_number(k == 1 ? NEW_HEIGHT : 0);
    return rig;
}

static bool is_tail(const struct document *document, int rig)
{
    return rig >= 0 && rig < document->rig_count && document->rigs[rig].kind == RIG_TAIL;
}

/// Makes a copy of `edit->rig` beside it, or a plain tail if that is no tail. On failure the caller must release it.
static bool fill_new(const struct document *document, const struct edit *edit, struct rig *added)
{
    *added = plain_tail();
    if (is_tail(document, edit->rig)) {
        if (!rig_copy(&document->rigs[edit->rig], added)) {
            *added = plain_tail();
            return false;
        }
        free(added->name);
        added->name = NULL;
        added->extra = NULL;
        added->pin_count = 0; // what is pinned drives both
        struct tail *tail = &added->tail;
        if (tail->position[0].track < 0) tail->position[0].value += ASIDE * tail->length;
    } else if (plan_has_spline(document, edit->spline, NULL) && !plan_append_channel(added, edit)) {
        return false;
    }
    added->name = plan_rig_free_name(document, "tail");
    return added->name != NULL;
}

bool plan_tail_add(struct document *document, const struct edit *edit, struct change_list *list, struct error *error)
{
    if (!plan_rig_fits(document, error) || !plan_check_axis(RIG_TAIL, edit->axis, error) ||
        !plan_check_part(edit->of, error))
        return false;
    struct rig *rig = malloc(sizeof *rig);
    if (!rig) return plan_no_memory(error);
    if (!fill_new(document, edit, rig)) return plan_rig_abandon(rig, error);
    return plan_rig_append(document, rig, list, error);
}

static double rounded(double degrees) { return round(degrees * ANGLE_RESOLUTION) / ANGLE_RESOLUTION + 0.0; }

/// Resamples angles of a tail for `to` joints, times `factor`. A ramp goes along the tail already.
static void resample(struct angles *angles, int to, double factor)
{
    const struct angles old = *angles;
    if (old.form == ANGLES_EACH) angles->count = to;
    for (int n = 0; n < angles_count(angles); n++) {
        double value = angles_number(&old, old.form == ANGLES_EACH ? 0 : n);
        if (old.form == ANGLES_EACH && to > 1) {
            double at = (double)n * (old.count - 1) / (to - 1);
            int low = (int)at;
            double high = old.value[low + 1 < old.count ? low + 1 : low];
            value = old.value[low] + (high - old.value[low]) * (at - low);
        }
        angles_set_number(angles, n, rounded(value * factor));
    }
}

/// Pins stay where they are along the tail; of two that meet, the first stays.
static void move_pins(struct rig *rig, int from, int to)
{
    const int count = rig->pin_count;
    rig->pin_count = 0;
    for (int i = 0; i < count; i++) {
        struct pin pin = rig->pins[i];
        bool meets = false;
        pin.point = (2 * (pin.point + 1) * to + from) / (2 * from) - 1;
        if (pin.point < 0) pin.point = 0;
        for (int k = 0; k < rig->pin_count; k++)
            meets |= rig->pins[k].frame == pin.frame && rig->pins[k].point == pin.point;
        if (!meets) rig->pins[rig->pin_count++] = pin;
    }
}

/// The tail keeps its shape and swing: with twice the joints, each bends and lags half as much.
bool plan_joints(struct document *document, const struct edit *edit, struct change_list *list, struct error *error)
{
    const struct rig *old = &document->rigs[edit->rig];
    int from = old->tail.joints, to = edit->to;
    if (to < 1 || to > TAIL_MAX_JOINTS) {
        return fail(error, ERROR_INPUT, "%s: joints must be from 1 to %d", old->name, TAIL_MAX_JOINTS);
    }
    if (from == to) return true;
    struct rig *rig = plan_rig_begin(document, edit->rig, error);
    if (!rig) return false;
    struct tail *tail = &rig->tail;
    const double factor = (double)from / to;
    tail->joints = to;
    move_pins(rig, from, to);
    resample(&tail->rest, to, factor);
    for (int c = 0; c < tail->channel_count; c++) {
        struct channel *channel = &tail->channels[c];
        const bool bends = axis_bends(channel->axis);
        resample(&channel->gain, to, bends ? factor : 1);
        resample(&channel->lag, to, bends && channel->lag.form == ANGLES_ONE ? factor : 1);
    }
    return plan_rig_finish(edit->rig, rig, list, error);
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
    if (edit->param.motion) return fail(error, ERROR_INPUT, "only an equilibrium follows a joint");
    const struct param *old = &tail->position[edit->coordinate];
    struct param *param = &change.place.position[edit->coordinate];
    *param = edit->param.track >= 0 ? param_track(edit->param.track) : param_number(edit->param.value + 0.0);
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

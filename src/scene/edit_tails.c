/// Adds tails and changes their number of joints.
#include "scene/editing.h"
#include <math.h>
#include <stdlib.h>

static const double NEW_REST = 1.5;         ///< degrees per joint, so that a new tail is not a straight cone
static const double NEW_HEIGHT = 0.26;      ///< metres; puts the body of a tail of 1.6 m on the ground
static const double ASIDE = 0.75;           ///< distance from a tail to its copy, in tail lengths
static const double ANGLE_RESOLUTION = 1e6; ///< resampled angles are rounded to 1/this degrees

/// A tail without channels: the format's defaults, but slightly bent and on the ground.
static struct rig *plain_tail(void)
{
    struct rig *rig = rig_create(RIG_TAIL);
    rig->tail.rest.value[0] = NEW_REST;
    rig->tail.position[1].value = NEW_HEIGHT;
    return rig;
}

bool edit_tail_add(struct document *document, int rig, int spline, struct error *error)
{
    const bool is_tail = rig >= 0 && rig < document->rig_count && document->rigs[rig]->kind == RIG_TAIL;
    struct rig *added = is_tail ? rig_clone(document->rigs[rig]) : plain_tail();
    free(added->name);
    added->name = NULL;
    added->pin_count = 0; // both tails follow the same splines, so one set of pins is enough
    if (is_tail && added->tail.position[0].track < 0) added->tail.position[0].value += ASIDE * added->tail.length;
    if (!is_tail && edit_has_spline(document, spline, NULL))
        edit_append_channel(added, spline, AXIS_SIDE, PART_TOTAL);
    const bool good = edit_rig_add(document, added, error);
    rig_drop(added);
    return good;
}

static double rounded(double degrees) { return round(degrees * ANGLE_RESOLUTION) / ANGLE_RESOLUTION + 0.0; }

/// Resamples a tail's angles for `to` joints, times `factor`. A ramp already covers the whole tail.
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

/// Keeps pins at their places along the tail; if two meet, the first stays.
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
bool edit_joints(struct document *document, int rig, int count, struct error *error)
{
    const struct rig *old = edit_find_rig(document, rig, EDIT_KIND(RIG_TAIL), error);
    if (!old) return false;
    const int from = old->tail.joints;
    if (count < 1 || count > TAIL_MAX_JOINTS) {
        return fail(error, ERROR_INPUT, "%s: joints must be from 1 to %d", old->name, TAIL_MAX_JOINTS);
    }
    if (from == count) return true;
    struct document *before = document_copy(document);
    struct rig *own = document_own_rig(document, rig);
    struct tail *tail = &own->tail;
    const double factor = (double)from / count;
    tail->joints = count;
    move_pins(own, from, count);
    resample(&tail->rest, count, factor);
    for (int c = 0; c < tail->channel_count; c++) {
        struct channel *channel = &tail->channels[c];
        const bool bends = axis_bends(channel->axis);
        resample(&channel->gain, count, bends ? factor : 1);
        resample(&channel->lag, count, bends && channel->lag.form == ANGLES_ONE ? factor : 1);
    }
    return edit_end(document, before, true, error);
}

/// Edits that add, remove and rename tails, add and remove channels, and set the number of joints.
#include "scene/edit_plan.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { NAME_SIZE = 512 };

static const double NEW_REST = 1.5;         ///< degrees a joint, so that a new tail is no straight cone
static const double NEW_HEIGHT = 0.26;      ///< metres; the body of a tail of 1.6 m then sits on the ground
static const double ASIDE = 0.75;           ///< distance from a tail to its copy, in tail lengths
static const double ANGLE_RESOLUTION = 1e6; ///< resampled angles are rounded to 1/this degrees

/// A copy of the edit's rig for the caller to change; NULL with a sentence.
static struct rig *begin(const struct document *document, const struct edit *edit, struct error *error)
{
    struct rig *rig = malloc(sizeof *rig);
    if (rig && rig_copy(&document->rigs[edit->rig], rig)) return rig;
    free(rig);
    plan_no_memory(error);
    return NULL;
}

/// Adds the swap with a copy, which the change now owns.
static bool finish(const struct edit *edit, struct rig *rig, struct change_list *list, struct error *error)
{
    return plan_add(list, &(struct change){.kind = CHANGE_RIG, .spline = -1, .rig = {edit->rig, rig}}, error);
}

static bool abandon(struct rig *rig, struct error *error)
{
    rig_release(rig);
    free(rig);
    return plan_no_memory(error);
}

static bool is_taken(const struct document *document, const char *name, int own)
{
    for (int r = 0; r < document->rig_count; r++) {
        const char *other = document->rigs[r].name;
        if (r != own && other && strcmp(other, name) == 0) return true;
    }
    return false;
}

static char *free_name(const struct document *document)
{
    char name[NAME_SIZE] = "tail";
    for (int n = 2; is_taken(document, name, -1); n++) snprintf(name, sizeof name, "tail %d", n);
    return strdup(name);
}

/// A tail without channels, with the file format's defaults but slightly bent and on the ground.
static struct rig plain_tail(void)
{
    struct rig rig = {
        .kind = RIG_TAIL,
        .tail = {.joints = TAIL_DEFAULT_JOINTS, .length = TAIL_DEFAULT_LENGTH, .rest = {.value = {NEW_REST}}}};
    for (int k = 0; k < 3; k++) rig.tail.position[k] = (struct param){k == 1 ? NEW_HEIGHT : 0, -1};
    return rig;
}

/// Appends a channel with the file format's defaults.
static bool append_channel(struct tail *tail, const struct edit *edit)
{
    size_t count = (size_t)tail->channel_count + 1;
    struct channel *channels = realloc(tail->channels, count * sizeof *channels);
    if (!channels) return false;
    struct channel *channel = &channels[tail->channel_count++];
    memset(channel, 0, sizeof *channel);
    channel->spline = edit->spline;
    channel->axis = edit->axis;
    channel->of = edit->of;
    channel->lag.value[0] = CHANNEL_DEFAULT_LAG;
    channel->gain.value[0] = CHANNEL_DEFAULT_GAIN;
    tail->channels = channels;
    return true;
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
        struct tail *tail = &added->tail;
        if (tail->position[0].track < 0) tail->position[0].value += ASIDE * tail->length;
    } else if (plan_has_spline(document, edit->spline, NULL) && !append_channel(&added->tail, edit)) {
        return false;
    }
    added->name = free_name(document);
    return added->name != NULL;
}

bool plan_tail_add(struct document *document, const struct edit *edit, struct change_list *list, struct error *error)
{
    const int count = document->rig_count;
    if (count >= SCENE_MAX_RIGS) {
        return fail(error, ERROR_INPUT, "there are %d rigs, and no more fit", SCENE_MAX_RIGS);
    }
    struct rig *rig = malloc(sizeof *rig);
    if (!rig) return plan_no_memory(error);
    if (!fill_new(document, edit, rig) || !document_reserve_rigs(document, count + 1)) return abandon(rig, error);
    return plan_add(list, &(struct change){.kind = CHANGE_RIG_OUT, .spline = -1, .rig = {count, rig}}, error);
}

bool plan_tail_remove(struct document *document, const struct edit *edit, struct change_list *list,
                      struct error *error)
{
    (void)document;
    struct rig *room = malloc(sizeof *room);
    if (!room) return plan_no_memory(error);
    return plan_add(list, &(struct change){.kind = CHANGE_RIG_IN, .spline = -1, .rig = {edit->rig, room}}, error);
}

bool plan_tail_name(struct document *document, const struct edit *edit, struct change_list *list, struct error *error)
{
    const char *name = edit->text ? edit->text : "";
    if (!name[0]) return fail(error, ERROR_INPUT, "a tail needs a name");
    if (is_taken(document, name, edit->rig)) {
        return fail(error, ERROR_INPUT, "there is a rig called %s already", name);
    }
    if (strcmp(document->rigs[edit->rig].name, name) == 0) return true;
    struct rig *rig = begin(document, edit, error);
    if (!rig) return false;
    free(rig->name);
    rig->name = strdup(name);
    return rig->name ? finish(edit, rig, list, error) : abandon(rig, error);
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

/// The tail keeps its shape and swing: with twice the joints, each bends and lags half as much.
bool plan_joints(struct document *document, const struct edit *edit, struct change_list *list, struct error *error)
{
    const struct rig *old = &document->rigs[edit->rig];
    int from = old->tail.joints, to = edit->to;
    if (to < 1 || to > TAIL_MAX_JOINTS) {
        return fail(error, ERROR_INPUT, "%s: joints must be from 1 to %d", old->name, TAIL_MAX_JOINTS);
    }
    if (from == to) return true;
    struct rig *rig = begin(document, edit, error);
    if (!rig) return false;
    struct tail *tail = &rig->tail;
    const double factor = (double)from / to;
    tail->joints = to;
    resample(&tail->rest, to, factor);
    for (int c = 0; c < tail->channel_count; c++) {
        struct channel *channel = &tail->channels[c];
        resample(&channel->gain, to, factor);
        resample(&channel->lag, to, channel->lag.form == ANGLES_ONE ? factor : 1);
    }
    return finish(edit, rig, list, error);
}

bool plan_channel_add(struct document *document, const struct edit *edit, struct change_list *list,
                      struct error *error)
{
    const struct rig *old = &document->rigs[edit->rig];
    if (!plan_has_spline(document, edit->spline, error)) return false;
    if (old->tail.channel_count >= SCENE_MAX_CHANNELS) {
        return fail(error, ERROR_INPUT, "%s: there are %d channels, and no more fit", old->name, SCENE_MAX_CHANNELS);
    }
    struct rig *rig = begin(document, edit, error);
    if (!rig) return false;
    if (append_channel(&rig->tail, edit)) return finish(edit, rig, list, error);
    return abandon(rig, error);
}

bool plan_channel_remove(struct document *document, const struct edit *edit, struct change_list *list,
                         struct error *error)
{
    const struct tail *old = &document->rigs[edit->rig].tail;
    if (edit->channel < 0 || edit->channel >= old->channel_count) {
        return fail(error, ERROR_INPUT, "there is no such channel");
    }
    struct rig *rig = begin(document, edit, error);
    if (!rig) return false;
    struct tail *tail = &rig->tail;
    struct channel *channel = &tail->channels[edit->channel];
    tail->channel_count--;
    memmove(channel, channel + 1, (size_t)(tail->channel_count - edit->channel) * sizeof *channel);
    return finish(edit, rig, list, error);
}

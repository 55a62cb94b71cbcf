/// Edits of which tails and channels there are, and of how many joints: each makes another list of tails, which is swapped.
#include "scene/edit_plan.h"
#include "scene/tail_list.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { NAME_SIZE = 512 };

static const double NEW_REST = 1.5;         ///< degrees a joint: a tail alone is no straight cone
static const double NEW_HEIGHT = 0.26;      ///< metres at which the body of a tail of 1.6 m sits on the ground
static const double ASIDE = 0.75;           ///< of its length, from one tail to the next
static const double ANGLE_RESOLUTION = 1e6; ///< a degree's parts that resampled angles are rounded to

/// The document's list to be changed; NULL with a sentence.
static struct tail_list *begin(const struct document *document, struct error *error)
{
    struct tail_list *tails = tail_list_copy(document, 1);
    if (!tails) plan_no_memory(error);
    return tails;
}

/// Adds the swap with a list; the list is the change's from here on.
static bool finish(struct tail_list *tails, struct change_list *list, struct error *error)
{
    return plan_add(list, &(struct change){.kind = CHANGE_TAILS, .spline = -1, .tails = tails}, error);
}

static bool is_taken(const struct document *document, const char *name, int own)
{
    for (int t = 0; t < document->tail_count; t++) {
        if (t != own && strcmp(document->tails[t].name, name) == 0) return true;
    }
    for (int c = 0; c < document->character_count; c++) {
        if (document->characters[c].name && strcmp(document->characters[c].name, name) == 0) return true;
    }
    return false;
}

static char *free_name(const struct document *document)
{
    char name[NAME_SIZE] = "tail";
    for (int n = 2; is_taken(document, name, -1); n++) snprintf(name, sizeof name, "tail %d", n);
    return strdup(name);
}

/// A tail without channels, as the file format has it, but bent a little and on the ground.
static struct tail plain_tail(void)
{
    struct tail tail = {.joints = TAIL_DEFAULT_JOINTS, .length = TAIL_DEFAULT_LENGTH, .rest = {.value = {NEW_REST}}};
    for (int k = 0; k < 3; k++) tail.position[k] = (struct param){k == 1 ? NEW_HEIGHT : 0, -1};
    return tail;
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

static bool has_spline(const struct document *document, const struct edit *edit)
{
    return edit->spline >= 0 && edit->spline < document->spline_count;
}

/// The last tail of a list, made a copy of `edit->tail` that stands beside it, or a plain one where there is none.
static bool fill_new(const struct document *document, const struct edit *edit, struct tail_list *tails)
{
    struct tail *added = &tails->tails[tails->count];
    if (edit->tail >= 0 && edit->tail < document->tail_count) {
        const struct tail *model = &document->tails[edit->tail];
        if (!tail_copy(model, added)) return false;
        free(added->name);
        added->name = NULL;
        added->extra = NULL;
        if (added->position[0].track < 0) added->position[0].value += ASIDE * added->length;
    } else {
        *added = plain_tail();
        if (has_spline(document, edit) && !append_channel(added, edit)) return false;
    }
    tails->count++;
    added->name = free_name(document);
    return added->name != NULL;
}

bool plan_tail_add(struct document *document, const struct edit *edit, struct change_list *list, struct error *error)
{
    if (document->tail_count + document->character_count >= SCENE_MAX_RIGS) {
        return fail(error, ERROR_INPUT, "there are %d rigs, and no more fit", SCENE_MAX_RIGS);
    }
    struct tail_list *tails = begin(document, error);
    if (!tails) return false;
    if (fill_new(document, edit, tails)) return finish(tails, list, error);
    tail_list_free(tails);
    return plan_no_memory(error);
}

bool plan_tail_remove(struct document *document, const struct edit *edit, struct change_list *list,
                      struct error *error)
{
    struct tail_list *tails = begin(document, error);
    if (!tails) return false;
    tail_list_remove(tails, edit->tail);
    return finish(tails, list, error);
}

bool plan_tail_name(struct document *document, const struct edit *edit, struct change_list *list, struct error *error)
{
    const char *name = edit->text ? edit->text : "";
    if (!name[0]) return fail(error, ERROR_INPUT, "a tail needs a name");
    if (is_taken(document, name, edit->tail)) {
        return fail(error, ERROR_INPUT, "there is a rig called %s already", name);
    }
    if (strcmp(document->tails[edit->tail].name, name) == 0) return true;
    struct tail_list *tails = begin(document, error);
    if (!tails) return false;
    char *copy = strdup(name);
    if (!copy) {
        tail_list_free(tails);
        return plan_no_memory(error);
    }
    free(tails->tails[edit->tail].name);
    tails->tails[edit->tail].name = copy;
    return finish(tails, list, error);
}

/// Angles of `from` joints as those of `to`, read at the same shares of the length and multiplied by `factor`.
static void resample(struct angles *angles, int from, int to, double factor)
{
    const struct angles old = *angles;
    for (int n = 0; n < (old.each ? to : 1); n++) {
        double at = to > 1 ? (double)n * (from - 1) / (to - 1) : 0;
        int low = (int)at;
        double high = old.value[low + 1 < from ? low + 1 : low];
        double value = old.each ? old.value[low] + (high - old.value[low]) * (at - low) : old.value[0];
        angles->value[n] = round(value * factor * ANGLE_RESOLUTION) / ANGLE_RESOLUTION + 0.0;
    }
}

/// The tail keeps its shape and its swing: as many more joints bend as much less each and lag as much less behind one another.
bool plan_joints(struct document *document, const struct edit *edit, struct change_list *list, struct error *error)
{
    int from = document->tails[edit->tail].joints, to = edit->to;
    if (to < 1 || to > TAIL_MAX_JOINTS) {
        return fail(error, ERROR_INPUT, "%s: joints must be from 1 to %d", document->tails[edit->tail].name,
                    TAIL_MAX_JOINTS);
    }
    if (from == to) return true;
    struct tail_list *tails = begin(document, error);
    if (!tails) return false;
    struct tail *tail = &tails->tails[edit->tail];
    const double factor = (double)from / to;
    tail->joints = to;
    resample(&tail->rest, from, to, factor);
    for (int c = 0; c < tail->channel_count; c++) {
        struct channel *channel = &tail->channels[c];
        resample(&channel->gain, from, to, factor);
        resample(&channel->lag, from, to, channel->lag.each ? 1 : factor);
    }
    return finish(tails, list, error);
}

bool plan_channel_add(struct document *document, const struct edit *edit, struct change_list *list,
                      struct error *error)
{
    const struct tail *tail = &document->tails[edit->tail];
    if (!has_spline(document, edit)) return fail(error, ERROR_INPUT, "there is no such spline");
    if (tail->channel_count >= SCENE_MAX_CHANNELS) {
        return fail(error, ERROR_INPUT, "%s: there are %d channels, and no more fit", tail->name, SCENE_MAX_CHANNELS);
    }
    struct tail_list *tails = begin(document, error);
    if (!tails) return false;
    if (append_channel(&tails->tails[edit->tail], edit)) return finish(tails, list, error);
    tail_list_free(tails);
    return plan_no_memory(error);
}

bool plan_channel_remove(struct document *document, const struct edit *edit, struct change_list *list,
                         struct error *error)
{
    const struct tail *old = &document->tails[edit->tail];
    if (edit->channel < 0 || edit->channel >= old->channel_count) {
        return fail(error, ERROR_INPUT, "there is no such channel");
    }
    struct tail_list *tails = begin(document, error);
    if (!tails) return false;
    struct tail *tail = &tails->tails[edit->tail];
    struct channel *channel = &tail->channels[edit->channel];
    tail->channel_count--;
    memmove(channel, channel + 1, (size_t)(tail->channel_count - edit->channel) * sizeof *channel);
    return finish(tails, list, error);
}

/// Puts the keys of chains into a clip of a parsed file. The clip's other channels stay as they are in the file, bit for bit. If the scene shows
/// another part of the clip, or several rounds of it, their keys are copied to that, with the file's own values between the same keys.
#include "base/need.h"
#include "export/gltf.h"
#include "maths/maths.h"
#include "model/glb.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double EARLIER = 4e-6; ///< of a time and its clip's length: before a step, more than posing rounds
static const double NEAR = 1e-3;    ///< frames of the grid between keys that count as one

/// What is exported, in seconds of the clip as the scene repeats it: round r begins at first + r · length.
struct part {
    struct clip_play play;
    double end;      ///< of the clip's last key
    double from, to; ///< of the first and last exported key
    double shift;    ///< from there to the exported file's times
    int rounds[2];   ///< the first and last round that it touches
    bool is_clip;    ///< the part is the clip in the file
};

/// The part that a range's keys cover. It is the clip itself where they begin and end within a frame of it; one that plays once, or is a single
/// pose, may end before.
static struct part part_of(const struct export_range *range, const struct model_rig *model,
                           const struct gltf_clip *clip)
{
    const double fps = range->posing->document->fps;
    const double from = range_frame(range, 0) / fps, to = range_frame(range, range->key_count - 1) / fps;
    if (!clip) return (struct part){.from = from, .to = to, .shift = -from};
    struct part part = {.play = clip_play(model, clip), .end = clip->last, .from = from, .to = to};
    const double frame = fmax(1, range->spacing) / fps;
    const bool ends = to > clip->last - frame && (!part.play.loops || to < clip->first + part.play.length + frame);
    part.is_clip = !(part.play.length > 0) || (fabs(from - clip->first) < frame && ends);
    if (part.is_clip && part.play.length > 0) {
        part.from = clip->first;
        part.to = part.play.loops || to < clip->last + frame ? clip->last : to;
    }
    part.shift = clip->first - part.from;
    if (!part.play.loops || !(part.play.length > 0)) return part;
    const double begin = floor((part.from - clip->first) / part.play.length + 1e-6),
                 end = ceil((part.to - clip->first) / part.play.length - 1e-6) - 1;
    part.rounds[0] = (int)fmin(fmax(begin, -1e9), 1e9);
    part.rounds[1] = part.rounds[0] + (int)fmin(fmax(end - begin, 0), range->key_count); // no shorter than a key
    return part;
}

// --- the times of the chains' keys

struct key_time {
    double at;   ///< seconds in the scene
    float time;  ///< in the file
    bool is_own; ///< the clip has a key of the bones there, or begins or ends there
};

struct key_times {
    struct key_time *list;
    size_t count;
};

static void add_time(struct key_times *times, const struct part *part, double at, bool is_own)
{
    if (at < part->from || at > part->to) return;
    times->list = need_more(times->list, times->count + 1, sizeof *times->list);
    times->list[times->count++] = (struct key_time){at, (float)(at + part->shift), is_own};
}

static int compare_times(const void *a, const void *b)
{
    const struct key_time *one = a, *other = b;
    return (one->at > other->at) - (one->at < other->at);
}

/// The bone's own keys, so that none between two frames is lost. A step has a key just before it.
static void add_channel(struct key_times *times, const struct part *part, const struct gltf_channel *channel)
{
    for (int round = part->rounds[0]; round <= part->rounds[1]; round++) {
        for (int k = 0; k < channel->key_count; k++) {
            const double at = (double)channel->times[k] + round * part->play.length;
            const size_t before = times->count;
            if (channel->interpolation == GLTF_STEP && k > 0)
                add_time(times, part, at - EARLIER * (fabs(at) + part->play.length), true);
            if (times->count > before) times->list[before].time = nextafterf((float)(at + part->shift), -INFINITY);
            add_time(times, part, at, true);
        }
    }
}

static bool is_bone(const struct form *form, json_int_t node)
{
    const struct model_body *body = form->owned;
    for (int j = 0; j < form->joint_count; j++) {
        if (body->node[j] == node) return true;
    }
    return false;
}

/// The keys of the range and of the bones in the clip, in ascending order; those of the range go where two are almost at one time.
static struct key_times list_times(const struct export_range *range, const struct form *form, const struct part *part)
{
    const struct model_body *body = form->owned;
    const double fps = range->posing->document->fps;
    struct key_times times = {0};
    add_time(&times, part, part->from, true);
    if (part->to > part->from) add_time(&times, part, part->to, true);
    for (int k = 0; k < range->key_count; k++) add_time(&times, part, range_frame(range, k) / fps, false);
    for (int c = 0; body->clip && c < body->clip->channel_count; c++) {
        const struct gltf_channel *channel = &body->clip->channels[c];
        if (channel->path == GLTF_ROTATION && is_bone(form, channel->node)) add_channel(&times, part, channel);
    }
    qsort(times.list, times.count, sizeof *times.list, compare_times);
    size_t count = 0;
    for (size_t i = 0; i < times.count; i++) {
        const struct key_time *next = &times.list[i], *last = count > 0 ? &times.list[count - 1] : NULL;
        if (last && next->at - last->at < NEAR * range->spacing / fps && !(next->is_own && last->is_own)) {
            if (next->is_own) times.list[count - 1] = *next;
        } else if (!last || next->time > last->time) {
            times.list[count++] = *next;
        }
    }
    times.count = count;
    return times;
}

// --- other channels, where the part is not the clip

/// A sampler's numbers, as a channel without a node; false if they are none.
static bool read_sampler(const struct glb *stored, const json_t *sampler, bool turns, struct gltf_channel *channel,
                         int *element)
{
    const char *interpolation = json_string_value(json_object_get(sampler, "interpolation"));
    struct glb_numbers times = {0}, values = {0};
    struct error error;
    bool good = glb_numbers(stored, glb_integer(sampler, "input", -1), &times, &error) &&
                glb_numbers(stored, glb_integer(sampler, "output", -1), &values, &error) && times.components == 1 &&
                times.count > 0;
    *channel = (struct gltf_channel){.path = turns ? GLTF_ROTATION : GLTF_TRANSLATION, .interpolation = GLTF_LINEAR};
    if (interpolation && strcmp(interpolation, "STEP") == 0) channel->interpolation = GLTF_STEP;
    if (interpolation && strcmp(interpolation, "CUBICSPLINE") == 0) channel->interpolation = GLTF_CUBIC;
    const size_t total = good ? (size_t)values.count * (size_t)values.components : 0,
                 keys = (size_t)times.count * (channel->interpolation == GLTF_CUBIC ? 3 : 1);
    good = good && total > 0 && total % keys == 0 && (!turns || total == 4 * keys);
    if (good) {
        channel->key_count = times.count;
        channel->components = (int)(total / keys);
        channel->times = need((size_t)times.count, sizeof *channel->times);
        channel->values = need(total, sizeof *channel->values);
        for (int k = 0; k < times.count; k++) channel->times[k] = (float)times.values[k];
        for (size_t i = 0; i < total; i++) channel->values[i] = (float)values.values[i];
        *element = values.components;
    }
    free(times.values);
    free(values.values);
    return good;
}

static int stride_of(const struct gltf_channel *channel)
{
    return channel->components * (channel->interpolation == GLTF_CUBIC ? 3 : 1);
}

/// Appends a key, whose tangents are 0 where only a value is given. Where a round ends with another value than the next begins with, it ends just
/// before that.
static void push(struct gltf_channel *to, double time, const float *key, bool is_whole)
{
    const int n = to->components, stride = stride_of(to), middle = stride > n ? n : 0;
    const size_t size = (size_t)stride;
    const int last = to->key_count - 1;
    float *const end = to->values + (size_t)to->key_count * size;
    if (last >= 0 && (float)time <= to->times[last]) {
        float *const before = end - size;
        const float *value = is_whole ? key + middle : key;
        const bool same = memcmp(before + middle, value, (size_t)n * sizeof *value) == 0;
        if (same && is_whole && middle) memcpy(before + 2 * n, key + 2 * n, (size_t)n * sizeof *key);
        if (same) return;
        to->times[last] = nextafterf((float)time, -INFINITY);
        if (last > 0 && to->times[last] <= to->times[last - 1]) return;
    }
    to->times[to->key_count++] = (float)time;
    memset(end, 0, size * sizeof *end);
    if (is_whole) {
        memcpy(end, key, size * sizeof *key);
    } else {
        memcpy(end + middle, key, (size_t)n * sizeof *key);
    }
}

static void reserve(struct gltf_channel *channel, size_t keys, const struct gltf_channel *like)
{
    *channel = *like;
    channel->key_count = 0;
    channel->times = need(keys, sizeof *channel->times);
    channel->values = need(keys * (size_t)stride_of(like), sizeof *channel->values);
}

/// The keys of all rounds, in the exported file's times. A channel that begins after its clip, or ends before, stands still there.
static void unroll(const struct gltf_channel *from, const struct part *part, struct gltf_channel *to)
{
    const int stride = stride_of(from), middle = stride > from->components ? from->components : 0;
    const int count = from->key_count;
    reserve(to, (size_t)(count + 2) * (size_t)(part->rounds[1] - part->rounds[0] + 1), from);
    for (int round = part->rounds[0]; round <= part->rounds[1]; round++) {
        const double later = part->shift + round * part->play.length;
        if ((double)from->times[0] > part->play.first)
            push(to, part->play.first + later, from->values + middle, false);
        for (int k = 0; k < count; k++)
            push(to, (double)from->times[k] + later, from->values + (size_t)k * (size_t)stride, true);
        if ((double)from->times[count - 1] < part->end && part->rounds[1] > part->rounds[0])
            push(to, part->end + later, from->values + (size_t)(count - 1) * (size_t)stride + middle, false);
    }
}

/// Adds the curve's value and slope at a time between its keys.
static void push_between(struct gltf_channel *to, const struct gltf_channel *from, double time)
{
    const int n = from->components, stride = stride_of(from);
    float *key = need_zeroed(3 * (size_t)n, sizeof *key);
    int k = 0;
    while (k + 1 < from->key_count && (double)from->times[k + 1] <= time) k++;
    gltf_channel_at(from, time, key + n);
    if (from->interpolation != GLTF_CUBIC) {
        push(to, time, key + n, true);
    } else {
        const double T = k + 1 < from->key_count ? (double)(from->times[k + 1] - from->times[k]) : 0;
        const double s = T > 0 ? (time - (double)from->times[k]) / T : 0;
        const float *at = from->values + (size_t)k * (size_t)stride;
        for (int i = 0; i < n && T > 0 && s >= 0; i++) {
            const double slope = (6 * s * s - 6 * s) / T * (double)(at[n + i] - at[4 * n + i]) +
                                 (3 * s * s - 4 * s + 1) * (double)at[2 * n + i] +
                                 (3 * s * s - 2 * s) * (double)at[3 * n + i];
            key[i] = key[2 * n + i] = (float)slope;
        }
        push(to, time, key, true);
    }
    free(key);
}

/// The part of a channel that is exported.
static void cut(const struct gltf_channel *from, const struct part *part, struct gltf_channel *to)
{
    const double first = part->from + part->shift, last = part->to + part->shift;
    const int stride = stride_of(from);
    reserve(to, (size_t)from->key_count + 2, from);
    push_between(to, from, first);
    for (int k = 0; k < from->key_count; k++) {
        const double time = (double)from->times[k];
        if (time > (double)(float)first && time < (double)(float)last)
            push(to, time, from->values + (size_t)k * (size_t)stride, true);
    }
    if (last > first) push_between(to, from, last);
}

/// Lets a sampler have the part's keys. One whose numbers cannot be read stays as it is.
static void cut_sampler(struct gltf_file *file, const struct glb *stored, json_t *sampler, bool turns,
                        const struct part *part)
{
    static const enum gltf_elements kinds[17] = {[1] = ELEMENTS_KEYS,
                                                 [2] = ELEMENTS_UVS,
                                                 [3] = ELEMENTS_KEY_VECTORS,
                                                 [4] = ELEMENTS_TURNS,
                                                 [16] = ELEMENTS_MATRICES};
    struct gltf_channel own, unrolled, result;
    int element = 0;
    if (!read_sampler(stored, sampler, turns, &own, &element)) return;
    unroll(&own, part, &unrolled);
    cut(&unrolled, part, &result);
    const size_t keys = (size_t)result.key_count, total = keys * (size_t)stride_of(&result);
    if (element < 17 && (kinds[element] || element == 0)) {
        gltf_set(file, sampler, "input", json_integer(gltf_file_add(file, ELEMENTS_KEYS, result.times, keys, true)));
        gltf_set(file, sampler, "output",
                 json_integer(gltf_file_add(file, kinds[element], result.values, total / (size_t)element, false)));
    }
    struct gltf_channel *const all[] = {&own, &unrolled, &result};
    for (int i = 0; i < 3; i++) {
        free(all[i]->times);
        free(all[i]->values);
    }
}

/// The node and path that a channel moves are those of a chain's bone.
static bool is_chains(const struct form *form, const json_t *channel)
{
    const json_t *target = json_object_get(channel, "target");
    const char *path = json_string_value(json_object_get(target, "path"));
    return path && strcmp(path, "rotation") == 0 && is_bone(form, glb_integer(target, "node", -1));
}

/// Lets all samplers but those of chains have the part's keys.
static bool cut_clip(struct gltf_file *file, const struct form *form, json_t *clip, const struct part *part,
                     struct error *error)
{
    const struct model_body *body = form->owned;
    json_t *samplers = json_object_get(clip, "samplers");
    const json_t *channel;
    size_t i;
    struct glb stored;
    if (!glb_open(&stored, body->gltf->path, error)) return false;
    bool *done = need_zeroed(json_array_size(samplers) + 1, sizeof *done);
    const bool is_read = glb_read_buffers(&stored, error);
    json_array_foreach(json_object_get(clip, "channels"), i, channel)
    {
        const char *path = json_string_value(json_object_get(json_object_get(channel, "target"), "path"));
        const size_t sampler = (size_t)glb_integer(channel, "sampler", -1);
        if (!is_read || sampler >= json_array_size(samplers) || done[sampler] || is_chains(form, channel)) continue;
        done[sampler] = true;
        cut_sampler(file, &stored, json_array_get(samplers, sampler), path && strcmp(path, "rotation") == 0, part);
    }
    free(done);
    glb_close(&stored);
    return is_read;
}

// --- the clip

/// Lets the clip turn the bones of chains by their keys, in the channels that it has for them, or new ones.
static void put_keys(struct gltf_motion *motion, const struct form *form, const struct keys *keys)
{
    const struct model_body *body = form->owned;
    for (int j = 0; j < form->joint_count; j++) {
        struct keys own = *keys;
        for (int c = 0; body->clip && c < body->clip->channel_count; c++) {
            const struct gltf_channel *channel = &body->clip->channels[c];
            if (channel->node == body->node[j] && channel->interpolation == GLTF_STEP) own.slopes = NULL; // it jumps
        }
        const json_int_t sampler = gltf_motion_add_sampler(motion, GLTF_ROTATION, &own, keys_rotation(j), 4);
        json_t *channel;
        size_t i;
        bool found = false;
        json_array_foreach(motion->channels, i, channel)
        {
            if (!is_chains(form, channel)) continue;
            if (glb_integer(json_object_get(channel, "target"), "node", -1) != body->node[j]) continue;
            gltf_set(motion->file, channel, "sampler", json_integer(sampler));
            found = true;
        }
        if (!found) gltf_motion_add_channel(motion, body->node[j], GLTF_ROTATION, sampler);
    }
}

static json_t *reals(struct gltf_file *file, const float *numbers, int count)
{
    json_t *array = json_array();
    for (int k = 0; k < count; k++) gltf_append(file, array, json_real((double)numbers[k]));
    return array;
}

/// Splits the matrices of nodes that the clip moves, because glTF does not allow it to move a matrix.
static void split_matrices(struct gltf_file *file, const struct gltf *gltf, json_t *nodes, const json_t *channels)
{
    const json_t *channel;
    size_t i;
    json_array_foreach(channels, i, channel)
    {
        const json_t *target = json_object_get(channel, "target");
        const int64_t n = glb_integer(target, "node", -1);
        const char *path = json_string_value(json_object_get(target, "path"));
        json_t *node = n < 0 ? NULL : json_array_get(nodes, (size_t)n);
        if (!json_object_get(node, "matrix") || gltf->nodes[n].has_matrix) continue;
        if (!path || (strcmp(path, "translation") && strcmp(path, "rotation") && strcmp(path, "scale"))) continue;
        const struct gltf_place *place = &gltf->nodes[n].place;
        json_object_del(node, "matrix");
        gltf_set(file, node, "translation", reals(file, place->translation, 3));
        gltf_set(file, node, "rotation", reals(file, place->rotation, 4));
        gltf_set(file, node, "scale", reals(file, place->scale, 3));
    }
}

/// Makes the clip's accessor of times, and poses the rig at them.
static bool collect(struct export_range *range, struct form *form, const struct part *part,
                    struct gltf_motion *motion, struct keys *keys, struct error *error)
{
    struct key_times times = list_times(range, form, part);
    const double fps = range->posing->document->fps;
    const int on_grid = range->key_count, count = motion->key_count = (int)times.count;
    double *frames = need(times.count, sizeof *frames);
    float *seconds = need(times.count, sizeof *seconds);
    for (int k = 0; k < count; k++) {
        frames[k] = times.list[k].at * fps;
        seconds[k] = times.list[k].time;
    }
    free(times.list);
    range->frames = frames;
    range->key_count = count;
    range->total += count - on_grid;
    const bool done = keys_collect(range, range->rigs[0], form, keys, error);
    range->frames = NULL;
    range->key_count = on_grid;
    motion->times = gltf_file_add(motion->file, ELEMENTS_KEYS, seconds, (size_t)count, true);
    free(frames);
    free(seconds);
    return done;
}

/// A copy of the clip that plays, by the name that it is to have; the clip itself if it has that name.
static json_t *copy_clip(struct gltf_file *file, const struct model_body *body, json_t *clips, const char *name)
{
    const int plays = body->clip ? (int)(body->clip - body->gltf->clips) : -1;
    json_t *clip = plays < 0 ? json_object() : json_deep_copy(json_array_get(clips, (size_t)plays));
    static const char *const arrays[] = {"samplers", "channels"};
    if (plays < 0 || strcmp(body->clip->name, name) != 0) gltf_set(file, clip, "name", json_string(name));
    for (int i = 0; i < 2; i++)
        if (!json_object_get(clip, arrays[i])) gltf_set(file, clip, arrays[i], json_array());
    return clip;
}

bool gltf_clip_put(struct export_range *range, struct form *form, struct gltf_file *file, json_t *root,
                   struct error *error)
{
    const struct model_body *body = form->owned;
    const struct model_rig *model = &range->posing->document->rigs[range->rigs[0]]->model;
    const char *wanted = range->options->clip ? range->options->clip : model->clip ? model->clip : range->title;
    const struct part part = part_of(range, model, body->clip);
    struct gltf_motion motion = {.file = file};
    struct keys keys;
    if (!collect(range, form, &part, &motion, &keys, error)) return false;
    char *name = name_from(wanted, strlen(wanted)); // it may be an argument
    const int known = gltf_find_clip(body->gltf, name);
    json_t *clip = copy_clip(file, body, json_object_get(root, "animations"), name);
    free(name);
    motion.samplers = json_object_get(clip, "samplers");
    motion.channels = json_object_get(clip, "channels");
    if (body->clip && !part.is_clip && !cut_clip(file, form, clip, &part, error)) {
        json_decref(clip);
        return false;
    }
    put_keys(&motion, form, &keys);
    split_matrices(file, body->gltf, json_object_get(root, "nodes"), motion.channels);
    if (known < 0) {
        gltf_append_to(file, root, "animations", clip);
    } else if (json_array_set_new(json_object_get(root, "animations"), (size_t)known, clip) != 0) {
        file->without_memory = true;
    }
    return true;
}

/// What an imported character's own clip moves, in the clip that is exported: sampled, or with the clip's own keys, repeated as the scene
/// repeats it. Of these, each round begins and ends with a key, cut out of the curve where the export begins or ends between two. Where one
/// ends as the next begins, these are one key.
#include "export/gltf_motion.h"
#include "export/keys.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define NEAR_TIME 1e-6 /* seconds; keys nearer than that to an end are that end */
#define NEAR_VALUE 1e-5f

bool gltf_body_leaves_out(const struct gltf_body *body, const struct gltf_channel *channel)
{
    return channel->path == GLTF_ROTATION && body->is_bone[channel->node];
}

/// What the clip moves, and then the bones of chains, as channels without keys. NULL if memory is short.
static struct gltf_channel *list_tracks(const struct gltf_body *body, int *count)
{
    const int channels = body->clip ? body->clip->channel_count : 0;
    struct gltf_channel *tracks = malloc(((size_t)channels + (size_t)body->bone_count + 1) * sizeof *tracks);
    *count = 0;
    for (int c = 0; tracks && c < channels; c++) {
        if (!gltf_body_leaves_out(body, &body->clip->channels[c])) tracks[(*count)++] = body->clip->channels[c];
    }
    for (int b = 0; tracks && b < body->bone_count; b++)
        tracks[(*count)++] = (struct gltf_channel){.node = body->bones[b], .path = GLTF_ROTATION, .components = 4};
    return tracks;
}

static const float *values_of(const struct gltf *gltf, const struct gltf_pose *pose, const struct gltf_channel *track)
{
    const struct gltf_place *place = &pose->place[track->node];
    switch (track->path) {
    case GLTF_TRANSLATION:
        return place->translation;
    case GLTF_ROTATION:
        return place->rotation;
    case GLTF_SCALE:
        return place->scale;
    case GLTF_WEIGHTS:
        break;
    }
    return pose->weights + gltf->nodes[track->node].first_weight;
}

/// One track after the other, each with a key a sample.
static bool collect(const struct gltf_body *body, struct export_range *range, const struct gltf_channel *tracks,
                    int count, float *keys, struct error *error)
{
    for (int k = 0; k < range->key_count; k++) {
        struct rig_pose pose;
        float *track = keys;
        if (!range_pose(range, range->rigs[0], k, &pose, error) || !range_proceed(range, error)) return false;
        for (int t = 0; t < count; t++) {
            const int width = tracks[t].components;
            float *at = track + (size_t)k * (size_t)width;
            memcpy(at, values_of(body->gltf, pose.model.pose, &tracks[t]), (size_t)width * sizeof *at);
            if (tracks[t].path == GLTF_ROTATION && k > 0) keys_turn_short_way(at - width, at);
            track += (size_t)range->key_count * (size_t)width;
        }
    }
    return true;
}

bool gltf_body_sample(const struct gltf_body *body, struct export_range *range, struct gltf_motion *motion,
                      struct error *error)
{
    int count, width = 0;
    const size_t rows = (size_t)range->key_count;
    struct gltf_channel *tracks = list_tracks(body, &count);
    for (int t = 0; tracks && t < count; t++) width += tracks[t].components;
    float *keys = tracks ? malloc((rows * (size_t)width + 1) * sizeof *keys) : NULL, *track = keys;
    const bool done =
        keys ? collect(body, range, tracks, count, keys, error) : fail_no_memory(error, body->gltf->path);
    for (int t = 0; done && t < count; t++) {
        keys_close_loop(track, tracks[t].components, range->key_count);
        gltf_motion_add(motion, tracks[t].node, tracks[t].path, track, NULL, tracks[t].components);
        track += rows * (size_t)tracks[t].components;
    }
    free(keys);
    free(tracks);
    return done;
}

// --- its own keys

/// A channel's keys being put together.
struct track {
    const struct gltf_channel *channel;
    bool is_cubic; ///< a key is the tangent into it, its value and the tangent out of it
    float sign;    ///< of rotations: a quaternion and its negative are the same
    float *times, *keys;
    int count, capacity;
    bool failed;                  ///< memory was short
    float *value, *slope, *still; ///< as wide as a key: for use by cut(), and zeros
};

static size_t width_of(const struct track *track) { return (size_t)track->channel->components; }

static float *key_at(const struct track *track, int key)
{
    return track->keys + (size_t)key * width_of(track) * (track->is_cubic ? 3 : 1);
}

static float *value_at(const struct track *track, int key)
{
    return key_at(track, key) + (track->is_cubic ? width_of(track) : 0);
}

static bool make_room(struct track *track)
{
    if (track->count < track->capacity) return true;
    const int capacity = 2 * track->capacity + 16;
    const size_t stride = width_of(track) * (track->is_cubic ? 3 : 1);
    float *times = realloc(track->times, (size_t)capacity * sizeof *times);
    if (times) track->times = times;
    float *keys = times ? realloc(track->keys, (size_t)capacity * stride * sizeof *keys) : NULL;
    if (!keys) return false;
    track->keys = keys;
    track->capacity = capacity;
    return true;
}

/// Times ascend, if only by the least that a float can tell.
static void add_key(struct track *track, double time, const float *in, const float *value, const float *out)
{
    if (!make_room(track)) {
        track->failed = true;
        return;
    }
    const size_t width = width_of(track);
    const int key = track->count++;
    const float *parts[] = {in, value, out};
    float *at = key_at(track, key);
    track->times[key] = (float)time;
    if (key > 0 && track->times[key] <= track->times[key - 1])
        track->times[key] = nextafterf(track->times[key - 1], INFINITY);
    for (int p = track->is_cubic ? 0 : 1; p < (track->is_cubic ? 3 : 2); p++) {
        for (size_t i = 0; i < width; i++) *at++ = track->sign * parts[p][i];
    }
}

/// The value at a time of the clip and how fast it changes there, seen from a time between the same keys.
static void cut(const struct track *track, double time, double inside)
{
    const struct gltf_channel *channel = track->channel;
    const size_t width = width_of(track);
    float *value = track->value, *slope = track->slope;
    int key = 0;
    while (key + 1 < channel->key_count && (double)channel->times[key + 1] <= inside) key++;
    memset(slope, 0, width * sizeof *slope);
    gltf_channel_at(channel, time, value);
    if (!track->is_cubic) return;
    const float *from = channel->values + 3 * width * (size_t)key;
    if (inside < (double)channel->times[key] || key + 1 == channel->key_count) {
        memcpy(value, from + width, width * sizeof *value);
        return;
    }
    const float *to = from + 3 * width;
    const double T = (double)channel->times[key + 1] - (double)channel->times[key];
    const double s = fmin(fmax((time - (double)channel->times[key]) / T, 0), 1), s2 = s * s, s3 = s2 * s;
    for (size_t i = 0; i < width; i++) {
        const double v = (double)from[width + i], b = (double)from[2 * width + i], a = (double)to[i],
                     w = (double)to[width + i];
        value[i] = (float)((2 * s3 - 3 * s2 + 1) * v + T * (s3 - 2 * s2 + s) * b + (3 * s2 - 2 * s3) * w +
                           T * (s3 - s2) * a);
        slope[i] = (float)((6 * s2 - 6 * s) * (v - w) / T + (3 * s2 - 4 * s + 1) * b + (3 * s2 - 2 * s) * a);
    }
}

/// Begins a round; where that is as good as the key that ends the one before, with that.
static void begin_round(struct track *track, double time)
{
    const size_t width = width_of(track);
    float *before = track->count > 0 ? value_at(track, track->count - 1) : track->value;
    float apart = 0, product = 0;
    for (size_t i = 0; i < width; i++) product += before[i] * track->value[i];
    track->sign = track->channel->path == GLTF_ROTATION && product < 0 ? -1.0f : 1.0f;
    for (size_t i = 0; i < width; i++) apart = fmaxf(apart, fabsf(before[i] - track->sign * track->value[i]));
    if (track->count > 0 && apart <= NEAR_VALUE) {
        for (size_t i = 0; i < width; i++) before[i] = track->sign * track->value[i];
        for (size_t i = 0; i < width && track->is_cubic; i++) before[width + i] = track->sign * track->slope[i];
        return;
    }
    if (track->count > 0) track->times[track->count - 1] = nextafterf(track->times[track->count - 1], 0);
    add_key(track, time, track->slope, track->value, track->slope);
}

/// The keys from one time of the clip to another; `start`: seconds from the range's first key.
static void add_round(struct track *track, double from, double to, double start)
{
    const struct gltf_channel *channel = track->channel;
    const size_t width = width_of(track);
    cut(track, from, from + NEAR_TIME);
    begin_round(track, start);
    for (int k = 0; k < channel->key_count && !track->failed; k++) {
        const double time = (double)channel->times[k];
        const float *key = channel->values + (track->is_cubic ? 3 : 1) * width * (size_t)k;
        if (time < from + NEAR_TIME || time > to - NEAR_TIME) continue;
        if (track->is_cubic) { // nothing moves before the first key and behind the last
            add_key(track, start + time - from, k > 0 ? key : track->still, key + width,
                    k + 1 < channel->key_count ? key + 2 * width : track->still);
        } else {
            add_key(track, start + time - from, track->still, key, track->still);
        }
    }
    cut(track, to, to - NEAR_TIME);
    add_key(track, start + to - from, track->slope, track->value, track->slope);
}

static void add_rounds(struct track *track, const struct export_range *range, double duration)
{
    const double first = range_frame(range, 0) / range->posing->document->fps,
                 last = first + range_seconds(range, range->key_count - 1);
    const double length = duration > 0 ? duration : fmax(last - first, 1);
    for (double n = floor(first / length + 1e-9); n * length < last - NEAR_TIME && !track->failed; n++) {
        const double from = fmax(first - n * length, 0), to = fmin(last - n * length, length);
        add_round(track, from, to, fmax(n * length - first, 0));
    }
    const double rest = fmax(last - floor(last / length + 1e-9) * length, 0);
    if (track->failed || (rest > NEAR_TIME && track->count > 0)) return;
    cut(track, rest, rest + NEAR_TIME);
    begin_round(track, last - first); // the last key of a loop is its first
}

static bool add_track(const struct gltf_channel *channel, const struct export_range *range, double duration,
                      struct gltf_motion *motion)
{
    const size_t width = (size_t)channel->components;
    float *scratch = calloc(3 * width, sizeof *scratch);
    if (!scratch) return false;
    struct track track = {
        .channel = channel, .sign = 1, .value = scratch, .slope = scratch + width, .still = scratch + 2 * width};
    track.is_cubic = channel->interpolation == GLTF_CUBIC && range->key_count > 1;
    add_rounds(&track, range, duration);
    if (!track.failed)
        gltf_motion_add_own(motion, channel,
                            track.is_cubic || channel->interpolation != GLTF_CUBIC ? channel->interpolation
                                                                                   : GLTF_LINEAR,
                            track.times, track.keys, track.count);
    free(scratch);
    free(track.times);
    free(track.keys);
    return !track.failed;
}

bool gltf_body_keep(const struct gltf_body *body, const struct export_range *range, struct gltf_motion *motion,
                    struct error *error)
{
    for (int c = 0; c < body->clip->channel_count; c++) {
        const struct gltf_channel *channel = &body->clip->channels[c];
        if (gltf_body_leaves_out(body, channel)) continue;
        if (!add_track(channel, range, body->clip->duration, motion)) return fail_no_memory(error, body->gltf->path);
    }
    return true;
}

/// Reads animations.
#include "model/gltf_read.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/// The numbers of a sampler's accessor; the caller frees them. NULL with an error.
static float *read_floats(struct gltf_reader *r, const json_t *sampler, const char *key, int *count, int *components)
{
    struct glb_numbers numbers;
    int accessor;
    if (!gltf_index(r, sampler, key, (int)json_array_size(gltf_array(r, "accessors")), &accessor)) return NULL;
    if (accessor < 0) {
        gltf_bad(r, ".%s: expected an accessor, got none", key);
        return NULL;
    }
    if (!glb_numbers(&r->file, accessor, &numbers, r->error)) return NULL;
    const size_t total = (size_t)numbers.count * (size_t)numbers.components;
    float *values = gltf_make(r, total, sizeof *values);
    for (size_t i = 0; values && i < total; i++) values[i] = (float)numbers.values[i];
    free(numbers.values);
    *count = numbers.count;
    *components = numbers.components;
    return values;
}

static bool read_interpolation(struct gltf_reader *r, const json_t *sampler, struct gltf_channel *channel)
{
    static const char *const names[] = {"STEP", "LINEAR", "CUBICSPLINE"};
    const char *name = json_string_value(json_object_get(sampler, "interpolation"));
    channel->interpolation = GLTF_LINEAR;
    for (int i = 0; name && i < 3; i++) {
        if (strcmp(name, names[i]) != 0) continue;
        channel->interpolation = (enum gltf_interpolation)i;
        return true;
    }
    return !name || gltf_bad(r, ".interpolation: expected STEP, LINEAR or CUBICSPLINE, got %.40s", name);
}

static bool read_sampler(struct gltf_reader *r, const json_t *sampler, struct gltf_channel *channel)
{
    int count, of_time, components;
    channel->times = read_floats(r, sampler, "input", &channel->key_count, &of_time);
    channel->values = channel->times ? read_floats(r, sampler, "output", &count, &components) : NULL;
    if (!channel->values || !read_interpolation(r, sampler, channel)) return false;
    if (of_time != 1) return gltf_bad(r, ".input: expected times, got %d numbers a key", of_time);
    for (int i = 1; i < channel->key_count; i++) {
        if (channel->times[i] < channel->times[i - 1])
            return gltf_bad(r, ".input: expected ascending times, got %g after %g", (double)channel->times[i],
                            (double)channel->times[i - 1]);
    }
    int width = channel->path == GLTF_WEIGHTS ? 1 : channel->components;
    int64_t expected =
        (int64_t)channel->key_count * (channel->interpolation == GLTF_CUBIC ? 3 : 1) * channel->components / width;
    return (components == width && count == expected) ||
           gltf_bad(r, ".output: expected %lld elements of %d numbers, got %d of %d", (long long)expected, width,
                    count, components);
}

/// Where the channel goes; false for a place that is not there or that clips leave alone.
static bool find_target(const struct gltf *gltf, const char *path, struct gltf_channel *channel)
{
    static const char *const names[] = {"translation", "rotation", "scale", "weights"};
    static const int components[] = {3, 4, 3, 0};
    const struct gltf_node *node = &gltf->nodes[channel->node];
    for (int i = 0; path && i < 4; i++) {
        if (strcmp(path, names[i]) != 0) continue;
        channel->path = (enum gltf_path)i;
        channel->components = components[i];
        if (i != GLTF_WEIGHTS) return !node->has_matrix;
        channel->components = node->mesh >= 0 ? gltf->meshes[node->mesh].target_count : 0;
        return channel->components > 0;
    }
    return false;
}

static bool read_channel(struct gltf_reader *r, const json_t *json, const json_t *samplers, size_t clip,
                         struct gltf_clip *out)
{
    struct gltf_channel channel = {0};
    const json_t *target = json_object_get(json, "target");
    int sampler;
    if (!gltf_index(r, target, "node", r->gltf->node_count, &channel.node)) return false;
    if (channel.node < 0) return true;
    if (!find_target(r->gltf, json_string_value(json_object_get(target, "path")), &channel)) return true;
    if (!gltf_index(r, json, "sampler", (int)json_array_size(samplers), &sampler)) return false;
    if (sampler < 0) return gltf_bad(r, ".sampler: expected a sampler, got none");
    gltf_at(r, "animations[%zu].samplers[%d]", clip, sampler);
    struct gltf_channel *to = &out->channels[out->channel_count++];
    *to = channel;
    if (!read_sampler(r, json_array_get(samplers, (size_t)sampler), to)) return false;
    out->duration = fmax(out->duration, (double)to->times[to->key_count - 1]);
    return true;
}

static bool read_clip(struct gltf_reader *r, const json_t *json, size_t number, struct gltf_clip *clip)
{
    const json_t *channels = json_object_get(json, "channels"), *samplers = json_object_get(json, "samplers"),
                 *channel;
    size_t i;
    gltf_at(r, "animations[%zu]", number);
    clip->name = gltf_name(r, json, "clip", number);
    clip->channels = clip->name ? gltf_make(r, json_array_size(channels), sizeof *clip->channels) : NULL;
    if (!clip->channels) return false;
    json_array_foreach(channels, i, channel)
    {
        gltf_at(r, "animations[%zu].channels[%zu]", number, i);
        if (!read_channel(r, channel, samplers, number, clip)) return false;
    }
    return true;
}

bool gltf_read_clips(struct gltf_reader *r)
{
    const json_t *clips = gltf_array(r, "animations"), *clip;
    size_t i;
    gltf_at(r, "animations");
    r->gltf->clips = gltf_make(r, json_array_size(clips), sizeof *r->gltf->clips);
    if (!r->gltf->clips) return false;
    json_array_foreach(clips, i, clip)
    {
        r->gltf->clip_count++;
        if (!read_clip(r, clip, i, &r->gltf->clips[i])) return false;
    }
    return true;
}

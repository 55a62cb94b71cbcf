/// Puts keys into an animation.
#include "export/gltf_motion.h"
#include <stdlib.h>
#include <string.h>

void gltf_motion_begin(struct gltf_motion *motion, struct gltf_file *file, const struct export_range *range)
{
    const int count = range->key_count;
    *motion =
        (struct gltf_motion){.file = file, .samplers = json_array(), .channels = json_array(), .key_count = count};
    float *times = malloc((size_t)count * sizeof *times);
    for (int k = 0; times && k < count; k++) times[k] = (float)range_seconds(range, k);
    if (!times) file->without_memory = true;
    if (times) motion->times = gltf_file_add(file, ELEMENTS_KEYS, times, (size_t)count, true);
    free(times);
}

void gltf_motion_free(struct gltf_motion *motion)
{
    json_decref(motion->samplers);
    json_decref(motion->channels);
    free(motion->own);
}

static void put(struct gltf_motion *motion, json_int_t node, enum gltf_path path, json_int_t times, json_int_t values,
                enum gltf_interpolation interpolation)
{
    static const char *const paths[] = {"translation", "rotation", "scale", "weights"};
    static const char *const ways[] = {"STEP", "LINEAR", "CUBICSPLINE"};
    const json_int_t sampler = (json_int_t)json_array_size(motion->samplers);
    gltf_append(motion->file, motion->samplers,
                json_pack("{s:I, s:I, s:s}", "input", times, "output", values, "interpolation", ways[interpolation]));
    gltf_append(motion->file, motion->channels,
                json_pack("{s:I, s:{s:I, s:s}}", "sampler", sampler, "target", "node", node, "path", paths[path]));
}

/// The accessor of `count` keys, each of one row of numbers or, with tangents, of three.
static json_int_t add_keys(struct gltf_motion *motion, enum gltf_path path, const float *keys, int count, int width,
                           bool tangents)
{
    static const enum gltf_elements elements[] = {ELEMENTS_KEY_VECTORS, ELEMENTS_TURNS, ELEMENTS_KEY_VECTORS,
                                                  ELEMENTS_KEYS};
    const int each = (path == GLTF_WEIGHTS ? width : 1) * (tangents ? 3 : 1);
    return gltf_file_add(motion->file, elements[path], keys, (size_t)count * (size_t)each, false);
}

void gltf_motion_add(struct gltf_motion *motion, json_int_t node, enum gltf_path path, const float *values,
                     const float *slopes, int width)
{
    const size_t row = (size_t)width, count = (size_t)motion->key_count;
    if (!slopes) {
        put(motion, node, path, motion->times, add_keys(motion, path, values, motion->key_count, width, false),
            GLTF_LINEAR);
        return;
    }
    float *keys = malloc(3 * row * count * sizeof *keys);
    if (!keys) {
        motion->file->without_memory = true;
        return;
    }
    for (size_t k = 0; k < count; k++) { // tangent in, value and tangent out
        memcpy(keys + 3 * k * row, slopes + k * row, row * sizeof *keys);
        memcpy(keys + (3 * k + 1) * row, values + k * row, row * sizeof *keys);
        memcpy(keys + (3 * k + 2) * row, slopes + k * row, row * sizeof *keys);
    }
    put(motion, node, path, motion->times, add_keys(motion, path, keys, motion->key_count, width, true), GLTF_CUBIC);
    free(keys);
}

/// The accessor of the times, which most channels of a clip share.
static json_int_t find_times(struct gltf_motion *motion, const float *times, int count)
{
    const size_t size = (size_t)count * sizeof *times;
    if (motion->own_count == count && memcmp(motion->own, times, size) == 0) return motion->own_times;
    free(motion->own);
    motion->own = malloc(size);
    motion->own_count = motion->own ? count : 0;
    if (motion->own) memcpy(motion->own, times, size);
    return motion->own_times = gltf_file_add(motion->file, ELEMENTS_KEYS, times, (size_t)count, true);
}

void gltf_motion_add_own(struct gltf_motion *motion, const struct gltf_channel *like,
                         enum gltf_interpolation interpolation, const float *times, const float *keys, int count)
{
    const json_int_t input = find_times(motion, times, count);
    const bool tangents = interpolation == GLTF_CUBIC;
    put(motion, like->node, like->path, input, add_keys(motion, like->path, keys, count, like->components, tangents),
        interpolation);
}

json_t *gltf_motion_json(const struct gltf_motion *motion, const char *name)
{
    return json_pack("{s:s, s:O, s:O}", "name", name, "samplers", motion->samplers, "channels", motion->channels);
}

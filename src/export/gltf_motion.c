/// Puts keys into an animation.
#include "export/gltf_motion.h"
#include <stdlib.h>
#include <string.h>

void gltf_motion_begin(struct gltf_motion *motion, struct gltf_file *file, const struct shot *shot)
{
    const int count = shot->key_count;
    *motion =
        (struct gltf_motion){.file = file, .samplers = json_array(), .channels = json_array(), .key_count = count};
    float *times = malloc((size_t)count * sizeof *times);
    for (int k = 0; times && k < count; k++) times[k] = (float)shot_seconds(shot, k);
    if (!times) file->without_memory = true;
    if (times) motion->times = gltf_file_add(file, ELEMENTS_KEYS, times, (size_t)count, true);
    free(times);
}

void gltf_motion_free(struct gltf_motion *motion)
{
    json_decref(motion->samplers);
    json_decref(motion->channels);
}

/// With slopes: tangent in, value and tangent out.
static json_int_t add_keys(struct gltf_motion *motion, enum gltf_elements elements, const float *values,
                           const float *slopes, int width)
{
    const size_t row = (size_t)width, count = (size_t)motion->key_count;
    const size_t each = (size_t)(elements == ELEMENTS_KEYS ? width : 1) * (slopes ? 3 : 1);
    if (!slopes) return gltf_file_add(motion->file, elements, values, count * each, false);
    float *keys = malloc(3 * row * count * sizeof *keys);
    for (size_t k = 0; keys && k < count; k++) {
        memcpy(keys + 3 * k * row, slopes + k * row, row * sizeof *keys);
        memcpy(keys + (3 * k + 1) * row, values + k * row, row * sizeof *keys);
        memcpy(keys + (3 * k + 2) * row, slopes + k * row, row * sizeof *keys);
    }
    if (!keys) motion->file->without_memory = true;
    const json_int_t accessor = keys ? gltf_file_add(motion->file, elements, keys, count * each, false) : 0;
    free(keys);
    return accessor;
}

void gltf_motion_add(struct gltf_motion *motion, json_int_t node, const char *path, enum gltf_elements elements,
                     const float *values, const float *slopes, int width)
{
    const json_int_t sampler = (json_int_t)json_array_size(motion->samplers);
    const json_int_t output = add_keys(motion, elements, values, slopes, width);
    json_array_append_new(motion->samplers, json_pack("{s:I, s:I, s:s}", "input", motion->times, "output", output,
                                                      "interpolation", slopes ? "CUBICSPLINE" : "LINEAR"));
    json_array_append_new(motion->channels,
                          json_pack("{s:I, s:{s:I, s:s}}", "sampler", sampler, "target", "node", node, "path", path));
}

json_t *gltf_motion_json(const struct gltf_motion *motion, const char *name)
{
    return json_pack("{s:s, s:O, s:O}", "name", name, "samplers", motion->samplers, "channels", motion->channels);
}

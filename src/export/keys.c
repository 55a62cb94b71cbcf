/// Collects the keys of one rig, and the slopes of its curves by differences.
#include "export/keys.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define STEP (1.0 / 16) /* of differences, in keys */

/// All numbers of one time in one row: translation, rotations, scales, weights.
struct sampler {
    const struct export_range *range;
    const struct form *form;
    int rig, width;
};

static bool sample(const struct sampler *from, double key, float *row, struct error *error)
{
    struct rig_pose pose;
    const int joints = from->form->joint_count;
    struct form_key values = {.rotation = (float(*)[4])(row + 3),
                              .scale = (float(*)[3])(row + 3 + 4 * joints),
                              .weight = row + 3 + 7 * joints};
    for (int i = 0; i < 3 * joints; i++) row[3 + 4 * joints + i] = 1;
    if (!range_pose(from->range, from->rig, key, &pose, error)) return false;
    from->form->kind->key(from->form, &pose, &values);
    memcpy(row, values.translation, sizeof values.translation);
    return true;
}

void keys_turn_short_way(const float before[4], float q[4])
{
    if (before[0] * q[0] + before[1] * q[1] + before[2] * q[2] + before[3] * q[3] >= 0) return;
    for (int k = 0; k < 4; k++) q[k] = -q[k];
}

static void turn_short_way(const struct sampler *from, const float *before, float *row)
{
    for (int j = 0; j < from->form->joint_count; j++) keys_turn_short_way(before + 3 + 4 * j, row + 3 + 4 * j);
}

void keys_close_loop(float *rows, int width, int count)
{
    float *last = rows + (size_t)(count - 1) * (size_t)width;
    for (int i = 0; i < width && last > rows; i++) {
        if (!(fabsf(last[i] - rows[i]) <= 1e-5f)) return;
    }
    memmove(last, rows, (size_t)width * sizeof *rows);
}

/// slope = Σ factor · row(key + offset) / seconds
struct difference {
    double offset[3], factor[3];
};

/// About the key; or, at an end of the document, from its inside.
static struct difference choose_difference(const struct export_range *range, double key, bool loops)
{
    if (!loops && !range_is_inside(range, key - STEP))
        return (struct difference){{0, STEP, 2 * STEP}, {-1.5, 2, -0.5}};
    if (!loops && !range_is_inside(range, key + STEP))
        return (struct difference){{0, -STEP, -2 * STEP}, {1.5, -2, 0.5}};
    return (struct difference){{-STEP, 0, STEP}, {-0.5, 0, 0.5}};
}

static bool slope_at(const struct sampler *from, int key, bool loops, const float *at, float *slope, float *scratch,
                     struct error *error)
{
    const struct difference difference = choose_difference(from->range, key, loops);
    const double seconds = range_seconds(from->range, STEP);
    memset(slope, 0, (size_t)from->width * sizeof *slope);
    for (int d = 0; d < 3; d++) {
        if (difference.factor[d] == 0) continue;
        if (!sample(from, key + difference.offset[d], scratch, error)) return false;
        turn_short_way(from, at, scratch);
        for (int i = 0; i < from->width; i++)
            slope[i] += (float)(difference.factor[d] / seconds * (double)scratch[i]);
    }
    return true;
}

static bool reserve(struct key_values *values, const struct form *form, int count)
{
    const size_t keys = (size_t)count;
    values->translation = malloc((keys + 1) * sizeof *values->translation);
    values->rotation = malloc((keys * (size_t)form->joint_count + 1) * sizeof *values->rotation);
    values->scale = malloc((keys * (size_t)form->joint_count + 1) * sizeof *values->scale);
    values->weight = malloc((keys * (size_t)form->target_count + 1) * sizeof *values->weight);
    return values->translation && values->rotation && values->scale && values->weight;
}

/// Puts a row where formats look for it.
static void scatter(const struct form *form, int count, int key, const float *row, struct key_values *values)
{
    const float *scale = row + 3 + 4 * form->joint_count, *weight = scale + 3 * form->joint_count;
    memcpy(values->translation[key], row, sizeof *values->translation);
    for (int j = 0; j < form->joint_count; j++)
        memcpy(values->rotation[j * count + key], row + 3 + 4 * j, sizeof *values->rotation);
    for (int j = 0; j < form->joint_count; j++)
        memcpy(values->scale[j * count + key], scale + 3 * j, sizeof *values->scale);
    for (int t = 0; t < form->target_count; t++) values->weight[t * count + key] = weight[t];
}

static bool collect_slopes(const struct sampler *from, struct keys *keys, const float *rows, float *scratch,
                           struct error *error)
{
    const size_t width = (size_t)from->width;
    const float *last = rows + (size_t)(keys->count - 1) * width;
    const bool loops = memcmp(rows, last, width * sizeof *rows) == 0;
    if (!reserve(&keys->slope, from->form, keys->count)) return fail_no_memory(error, from->form->name);
    for (int k = 0; k < keys->count; k++) {
        if (!slope_at(from, k, loops, rows + (size_t)k * width, scratch, scratch + width, error)) return false;
        scatter(from->form, keys->count, k, scratch, &keys->slope);
    }
    return true;
}

static bool collect(struct export_range *range, const struct sampler *from, struct keys *keys, float *rows,
                    float *scratch, struct error *error)
{
    const size_t width = (size_t)from->width;
    if (!reserve(&keys->at, from->form, keys->count)) return fail_no_memory(error, from->form->name);
    for (int k = 0; k < keys->count; k++) {
        float *row = rows + (size_t)k * width;
        if (!sample(from, k, row, error) || !range_proceed(range, error)) return false;
        if (k > 0) turn_short_way(from, row - width, row);
        if (k > 0) keys->travels = keys->travels || memcmp(row, rows, 3 * sizeof *row) != 0;
    }
    keys_close_loop(rows, from->width, keys->count);
    for (int k = 0; k < keys->count; k++) scatter(from->form, keys->count, k, rows + (size_t)k * width, &keys->at);
    return !range->is_cubic || keys->count < 2 || collect_slopes(from, keys, rows, scratch, error);
}

bool keys_collect(struct export_range *range, int rig, const struct form *form, struct keys *keys,
                  struct error *error)
{
    const struct sampler from = {range, form, rig, 3 + 7 * form->joint_count + form->target_count};
    const size_t width = (size_t)from.width;
    float *rows = malloc(((size_t)range->key_count + 2) * width * sizeof *rows);
    *keys = (struct keys){.count = range->key_count};
    bool done = rows ? collect(range, &from, keys, rows, rows + (size_t)range->key_count * width, error)
                     : fail_no_memory(error, form->name);
    free(rows);
    if (!done) keys_free(keys);
    return done;
}

static void free_values(struct key_values *values)
{
    free(values->translation);
    free(values->rotation);
    free(values->scale);
    free(values->weight);
}

void keys_free(struct keys *keys)
{
    free_values(&keys->at);
    free_values(&keys->slope);
    *keys = (struct keys){0};
}

/// Splits morph targets by the sign of their weights.
#include "export/targets.h"
#include "base/need.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/// The largest |weight| of a group's targets over all keys, at least 1: what weights are divided by.
static float largest_of(const struct form *form, const struct keys *keys, int group)
{
    float largest = 1.0f;
    for (int t = 0; t < form->target_count; t++) {
        if (form->targets[t].group != group) continue;
        for (int k = 0; k < keys->count; k++) largest = fmaxf(largest, fabsf(keys->at.weight[t * keys->count + k]));
    }
    return largest;
}

static bool is_ever_negative(const struct keys *keys, int target)
{
    for (int k = 0; k < keys->count; k++) {
        if (keys->at.weight[target * keys->count + k] < 0) return true;
    }
    return false;
}

/// "up.re" → "up.-re", "smile" → "-smile"
static void name_negative(const char *name, char negative[FORM_NAME])
{
    const char *dot = strrchr(name, '.');
    const int before = dot ? (int)(dot - name) + 1 : 0;
    snprintf(negative, FORM_NAME, "%.*s-%s", before < FORM_NAME ? before : FORM_NAME, name, name + before);
}

void targets_create(const struct export_range *range, const struct form *form, const struct keys *keys,
                    struct file_targets *targets)
{
    const int count = form->target_count;
    *targets = (struct file_targets){.clamped = !range->is_signed, .count = count};
    targets->list = need_zeroed(2 * (size_t)count + 1, sizeof *targets->list);
    for (int t = 0; t < count; t++) {
        struct file_target *target = &targets->list[t];
        *target = (struct file_target){.source = t, .scale = 1.0f};
        if (targets->clamped) target->scale = largest_of(form, keys, form->targets[t].group);
        snprintf(target->name, FORM_NAME, "%s", form->targets[t].name);
    }
    for (int t = 0; targets->clamped && t < count; t++) {
        if (!is_ever_negative(keys, t)) continue;
        struct file_target *target = &targets->list[targets->count++];
        *target = (struct file_target){.source = t, .scale = -targets->list[t].scale};
        name_negative(form->targets[t].name, target->name);
    }
}

void targets_free(struct file_targets *targets)
{
    free(targets->list);
    *targets = (struct file_targets){0};
}

float targets_weight(const struct file_targets *targets, int target, const struct keys *keys, int key)
{
    const struct file_target *of = &targets->list[target];
    const float weight = keys->at.weight[of->source * keys->count + key] / of->scale;
    return targets->clamped ? fminf(fmaxf(weight, 0.0f), 1.0f) : weight;
}

float targets_slope(const struct file_targets *targets, int target, const struct keys *keys, int key)
{
    const struct file_target *of = &targets->list[target];
    const int at = of->source * keys->count + key;
    const bool at_rest = targets->clamped && keys->at.weight[at] / of->scale <= 0;
    return at_rest ? 0.0f : keys->slope.weight[at] / of->scale;
}

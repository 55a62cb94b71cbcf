/// Poses any rig at any time, by its kind; and provides what the scene needs for solving.
#include "rig/posing.h"
#include "maths/maths.h"
#include <string.h>

/// Motion of a rig by hand.
static void add_hands(const struct posing *posing, int rig, struct by_hand *sum)
{
    *sum = posing->by_hand && rig == posing->held ? *posing->by_hand : (struct by_hand){0};
    if (posing->move) posing->move(posing->context, rig, sum);
}

void posing_base(const struct posing *posing, int rig, double base[3])
{
    struct by_hand sum;
    add_hands(posing, rig, &sum);
    memcpy(base, sum.base, sizeof sum.base);
}

void posing_values(const struct posing *posing, int index, double position, wiggly_value values[RIG_MAX_INPUTS])
{
    const struct rig *rig = posing->document->rigs[index];
    struct by_hand sum;
    add_hands(posing, index, &sum);
    int count;
    const struct channel *channels = rig_channels(rig, &count);
    const int inputs = rig_input_count(rig);
    position -= document_delay(posing->document, index);
    for (int i = 0; i < inputs; i++) {
        const int spline = i < count ? channels[i].spline : rig_input(rig, i);
        values[i] = evaluation_at(posing->evaluation, spline, position);
        if (i < count && channels[i].of == PART_DISPLACEMENT)
            values[i].y = evaluation_offset(posing->evaluation, posing->document, spline, position);
        values[i].y += sum.input[i].y;
        values[i].re += sum.input[i].re;
        values[i].im += sum.input[i].im;
    }
}

bool rig_pose(const struct posing *posing, int index, double position, struct rig_pose *pose)
{
    if (index < 0 || index >= posing->document->rig_count) return false;
    pose->kind = posing->document->rigs[index]->kind;
    if (pose->kind == RIG_TAIL) return tail_pose(posing, index, position, pose, NULL);
    if (pose->kind == RIG_CHAIN) return chain_pose(posing, index, position, &pose->strand);
    struct gltf_pose *clip = posing_clip(posing, index, position, posing->memory);
    if (clip) posing_bend(posing, index, position, clip, pose);
    return clip;
}

bool rig_pose_body(const struct posing *posing, int rig, double position, struct rig_pose *pose)
{
    const bool is_tail = posing->document->rigs[rig]->kind == RIG_TAIL;
    return is_tail ? tail_pose(posing, rig, position, NULL, pose) : rig_pose(posing, rig, position, pose);
}

// --- for the scene

void pinning_add_channel(const struct channel *channel, int n, int joints, const double way[3], pin_pull c)
{
    const double to_radians = 3.14159265358979323846 / 180.0;
    const double lag = to_radians * angles_lag(&channel->lag, n, joints);
    const double gain = to_radians * angles_at(&channel->gain, n, joints);
    for (int k = 0; k < 3; k++) {
        c[k][0] += way[k] * gain * maths_cos(lag);
        c[k][1] -= way[k] * gain * maths_sin(lag);
    }
}

double pinning_square(const pin_pull c)
{
    double sum = 0;
    for (int k = 0; k < 3; k++) sum += c[k][0] * c[k][0] + c[k][1] * c[k][1];
    return sum;
}

static bool source_find(const void *context, const struct evaluation *evaluation, const struct document *document,
                        const struct pin_query *query, pin_pull *c, struct pin_point *point)
{
    const struct posing posing = {.document = document, .evaluation = evaluation, .models = context};
    if (query->count > 0) memset(c, 0, (size_t)query->count * sizeof *c);
    const bool is_character = document->rigs[query->rig]->kind == RIG_MODEL;
    return (is_character ? character_find_pin : strand_find_pin)(&posing, query, c, point);
}

static double source_weigh(const void *context, const struct document *document, int rig, int spline)
{
    const struct posing posing = {.document = document, .models = context, .at_rest = true};
    return (document->rigs[rig]->kind == RIG_MODEL ? character_weigh : strand_weigh)(&posing, rig, spline);
}

static bool source_lowest(const void *context, const struct evaluation *evaluation, const struct document *document,
                          int rig, double ceiling, double *room, struct low_point *low)
{
    const struct posing posing = {.document = document, .evaluation = evaluation, .models = context};
    return character_lowest(&posing, rig, ceiling, room, low);
}

struct model_source models_source(const struct models *models)
{
    return (struct model_source){.find = source_find,
                                 .weigh = source_weigh,
                                 .lowest = source_lowest,
                                 .follow = models ? clip_follow : NULL,
                                 .context = models,
                                 .version = models_version(models)};
}

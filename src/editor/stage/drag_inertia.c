/// Tails that follow through while their body is moved by hand, outside of the document's solve and on top of it.
#include "editor/stage/parts.h"
#include "editor/stage/stage.h"
#include <math.h>
#include <string.h>

/// The filter of a spline at the time shown: parameters that follow others are where those are now.
static bool filter_now(const struct core *core, const struct editor_world *world, int index,
                       struct swing_filter *filter)
{
    const struct spline *spline = world->document->splines[index];
    double parameter[PARAMETER_COUNT];
    for (int p = 0; p < PARAMETER_COUNT; p++) {
        const struct param *param = &spline->parameter[p];
        wiggly_value value = {.y = param->value};
        if (param->track >= 0) value = evaluation_at(world->evaluation, param->track, core->playback.position);
        parameter[p] = value.y + value.re;
    }
    return swing_filter(spline, parameter, filter);
}

/// Drives one tail's channels by a change of its base's velocity; whether any of them still swings.
static bool drive(struct stage *stage, const struct core *core, const struct editor_world *world, int tail,
                  const double kick[3], double dt)
{
    const struct tail *driven = document_tail(world->document, tail);
    struct drag_inertia *inertia = &stage->inertia[tail];
    bool swings = false;
    for (int c = 0; c < driven->channel_count; c++) {
        const struct channel *channel = &driven->channels[c];
        struct swing_filter filter;
        double direction[3];
        inertia->scale[c] = 0;
        if (!swing_hangs(driven, channel) || !filter_now(core, world, channel->spline, &filter)) {
            inertia->channel[c] = (struct swing){0};
            continue;
        }
        swing_direction(driven, channel->axis, direction);
        double along = kick[0] * direction[0] + kick[1] * direction[1] + kick[2] * direction[2];
        swing_step(&inertia->channel[c], &filter, along, dt);
        inertia->scale[c] = swing_scale(driven, channel, &filter);
        swings |= !swing_settled(&inertia->channel[c], &filter);
    }
    return swings;
}

static void advance_tail(struct stage *stage, const struct core *core, const struct editor_world *world, int tail,
                         double dt)
{
    struct drag_inertia *inertia = &stage->inertia[tail];
    double offset[3], kick[3];
    bool moves = false;
    body_drag_offset(stage, core, tail, offset);
    for (int k = 0; k < 3; k++) {
        double velocity = (offset[k] - inertia->offset[k]) / dt;
        kick[k] = velocity - inertia->velocity[k];
        moves |= velocity != 0 || kick[k] != 0;
        inertia->velocity[k] = velocity;
        inertia->offset[k] = offset[k];
    }
    if (!moves && !inertia->swings) return;
    inertia->swings = drive(stage, core, world, tail, kick, dt) || moves;
    if (!inertia->swings) memset(inertia->channel, 0, sizeof inertia->channel);
}

void drag_inertia_advance(struct stage *stage, const struct core *core, const struct editor_world *world, double dt)
{
    if (!(dt > 0)) return;
    const int count = document_count_rigs(world->document, RIG_TAIL);
    for (int t = 0; t < count && t < STAGE_MAX_TAILS; t++) {
        if (core->look == LOOK_CUBIC) {
            drag_inertia_stop(stage, t); // nothing pulls a cubic back
        } else {
            advance_tail(stage, core, world, t, dt);
        }
    }
}

void drag_inertia_land(struct stage *stage, int tail)
{
    memset(stage->inertia[tail].offset, 0, sizeof stage->inertia[tail].offset);
}

void drag_inertia_stop(struct stage *stage, int tail)
{
    if (tail < STAGE_MAX_TAILS) stage->inertia[tail] = (struct drag_inertia){0};
}

bool stage_is_moving(const struct stage *stage)
{
    for (int t = 0; t < STAGE_MAX_TAILS; t++) {
        if (stage->inertia[t].swings) return true;
    }
    return stage->meadow.swings;
}

wiggly_value drag_inertia_value(const struct stage *stage, int tail, int channel)
{
    if (tail >= STAGE_MAX_TAILS || !stage->inertia[tail].swings) return (wiggly_value){0};
    const struct drag_inertia *inertia = &stage->inertia[tail];
    const struct swing *swing = &inertia->channel[channel];
    return (wiggly_value){.re = inertia->scale[channel] * swing->x[0], .im = inertia->scale[channel] * swing->x[1]};
}

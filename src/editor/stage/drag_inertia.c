/// Follow-through of tails and chains while you move their body. It is not part of the document's solution but added to it.
#include "editor/stage/parts.h"
#include "editor/stage/stage.h"
#include <string.h>

/// A spline's filter at the playhead, with parameters that follow splines evaluated there.
static bool filter_now(const struct core *core, int index, struct swing_filter *filter)
{
    const struct spline *spline = core->document->splines[index];
    double parameter[PARAMETER_COUNT];
    for (int p = 0; p < PARAMETER_COUNT; p++) {
        const struct param *param = &spline->parameter[p];
        wiggly_value value = {.y = param->value};
        if (param->track >= 0) value = evaluation_at(core->evaluation, param->track, core->playback.position);
        parameter[p] = value.y + value.re;
    }
    return swing_filter(spline, parameter, filter);
}

/// Drives a rig's channels by a change of its base's velocity; returns whether any still swings.
static bool drive(struct drag_inertia *inertia, const struct core *core, int rig, const double kick[3], double dt)
{
    const struct posing posing = stage_posing(core);
    struct swing_arm arm;
    int count;
    const struct channel *channels = rig_channels(core->document->rigs[rig], &count);
    bool swings = false;
    if (!swing_arm(&posing, rig, &arm)) return false;
    for (int c = 0; c < count; c++) {
        const struct channel *channel = &channels[c];
        struct swing_filter filter;
        double direction[3];
        inertia->scale[c] = 0;
        if (!swing_hangs(channels, count, channel) || !filter_now(core, channel->spline, &filter)) {
            inertia->channel[c] = (struct swing){0};
            continue;
        }
        swing_direction(&arm, channel->axis, direction);
        double along = kick[0] * direction[0] + kick[1] * direction[1] + kick[2] * direction[2];
        swing_step(&inertia->channel[c], &filter, along, dt);
        inertia->scale[c] = swing_scale(&arm, channel, &filter);
        swings |= !swing_settled(&inertia->channel[c], &filter);
    }
    return swings;
}

/// Index of a rig's swing; id 0 finds a free one; −1: none.
static int find(const struct stage *stage, unsigned id)
{
    int i = STAGE_MAX_STRANDS;
    while (--i >= 0 && stage->inertia[i].rig != id) continue;
    return i;
}

/// Returns false at rest, when the entry can be dropped.
static bool advance(struct drag_inertia *inertia, const struct core *core, int rig, const double offset[3], double dt)
{
    double kick[3];
    bool moves = false;
    for (int k = 0; k < 3; k++) {
        double velocity = (offset[k] - inertia->offset[k]) / dt;
        kick[k] = velocity - inertia->velocity[k];
        moves |= velocity != 0 || kick[k] != 0 || offset[k] != 0;
        inertia->velocity[k] = velocity;
        inertia->offset[k] = offset[k];
    }
    if (!moves && !inertia->swings) return false;
    inertia->swings = drive(inertia, core, rig, kick, dt) || moves;
    return inertia->swings;
}

void drag_inertia_advance(struct stage *stage, const struct core *core, double dt)
{
    const struct document *document = core->document;
    if (!(dt > 0)) return;
    if (core->look == LOOK_CUBIC) memset(stage->inertia, 0, sizeof stage->inertia); // a cubic has no restoring force
    for (int r = 0; r < document->rig_count && core->look != LOOK_CUBIC; r++) {
        const unsigned id = document->rigs[r]->id;
        double offset[3];
        if (document->rigs[r]->kind != RIG_TAIL && document->rigs[r]->kind != RIG_CHAIN) continue;
        body_drag_offset(stage, core, r, offset);
        int at = find(stage, id);
        if (at < 0 && (offset[0] != 0 || offset[1] != 0 || offset[2] != 0)) at = find(stage, 0);
        if (at < 0) continue;
        stage->inertia[at].rig = id;
        if (!advance(&stage->inertia[at], core, r, offset, dt)) stage->inertia[at] = (struct drag_inertia){0};
    }
}

void drag_inertia_land(struct stage *stage)
{
    for (int i = 0; i < STAGE_MAX_STRANDS; i++) memset(stage->inertia[i].offset, 0, sizeof stage->inertia[i].offset);
}

void drag_inertia_stop(struct stage *stage, const struct document *document, int body)
{
    for (int r = 0; r < document->rig_count; r++) {
        const int at = rig_body(document, r) == body ? find(stage, document->rigs[r]->id) : -1;
        if (at >= 0) stage->inertia[at] = (struct drag_inertia){0};
    }
}

double drag_inertia_scale(const struct stage *stage, const struct document *document, int rig, int channel)
{
    const int at = find(stage, document->rigs[rig]->id);
    return at >= 0 ? stage->inertia[at].scale[channel] : 0;
}

bool stage_is_moving(const struct stage *stage)
{
    for (int i = 0; i < STAGE_MAX_STRANDS; i++) {
        if (stage->inertia[i].swings) return true;
    }
    return false;
}

void drag_inertia_add(const struct stage *stage, const struct document *document, int rig,
                      wiggly_value values[RIG_MAX_INPUTS])
{
    const int at = find(stage, document->rigs[rig]->id);
    const struct drag_inertia *inertia = &stage->inertia[at < 0 ? 0 : at];
    for (int c = 0; at >= 0 && inertia->swings && c < SCENE_MAX_CHANNELS; c++) {
        values[c].re += inertia->scale[c] * inertia->channel[c].x[0];
        values[c].im += inertia->scale[c] * inertia->channel[c].x[1];
    }
}

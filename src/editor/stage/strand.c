/// Tails and chains as rows of points: what is held, and what the overlays follow.
#include "editor/stage/strand.h"
#include "editor/stage/rigs.h"
#include "editor/stage/segment.h"
#include "editor/stage/stage.h"
#include "model/vector.h"
#include <assert.h>
#include <math.h>

static void take_points(const struct rig_pose *pose, int rig, struct strand *strand)
{
    const bool is_chain = pose->kind == RIG_CHAIN;
    strand->rig = rig;
    strand->is_chain = is_chain;
    strand->count = is_chain ? pose->chain.count : pose->tail.count;
    for (int n = 0; n < strand->count; n++) {
        const float *point = is_chain ? pose->chain.point[n] : pose->tail.matrix[n] + 12;
        memcpy(strand->point[n], point, sizeof strand->point[n]);
    }
}

void strand_add(struct stage *stage, int rig, const struct rig_pose *pose)
{
    if (stage->strand_count < STAGE_MAX_STRANDS) take_points(pose, rig, &stage->strands[stage->strand_count++]);
}

const struct strand *strand_of(const struct stage *stage, int rig)
{
    for (int s = 0; s < stage->strand_count; s++) {
        if (stage->strands[s].rig == rig) return &stage->strands[s];
    }
    return NULL;
}

/// A chain, its splines changed by `change` (may be NULL).
static bool pose_chain(const struct core *core, const struct editor_world *world, int rig, double position,
                       const struct what_if *change, struct rig_pose *pose)
{
    const struct posing posing = stage_posing(core, world);
    const struct chain *chain = &world->document->rigs[rig].chain;
    struct by_hand hand = {0};
    for (int c = 0; change && c < chain->channel_count; c++) {
        if (chain->channels[c].spline != change->spline) continue;
        hand.input[c] = (wiggly_value){.re = change->re, .im = change->im};
    }
    return rig_pose(&posing, rig, position, &hand, pose);
}

bool strand_pose(const struct stage *stage, const struct core *core, const struct editor_world *world, int rig,
                 double position, const struct what_if *change, struct strand *strand)
{
    const struct document *document = world->document;
    struct rig_pose pose;
    if (rig >= document->rig_count) return false;
    switch (document->rigs[rig].kind) {
    case RIG_TAIL:
        stage_pose_tail(stage, core, world, document_rig_number(document, rig), position, change, &pose);
        break;
    case RIG_CHAIN:
        if (!pose_chain(core, world, rig, position, change, &pose)) return false;
        break;
    default:
        return false;
    }
    take_points(&pose, rig, strand);
    return true;
}

bool strand_project(const struct stage *stage, const struct core *core, const struct strand *strand, int joint,
                    double fraction, float xy[2])
{
    assert(joint >= 0 && joint < strand->count);
    const int next = joint + 1 < strand->count ? joint + 1 : joint;
    const vec3s from = vec3_from(strand->point[joint]), to = vec3_from(strand->point[next]);
    const vec3s world = glms_vec3_lerp(from, to, (float)fraction);
    return stage_project_point(stage, core->layout.stage, world.raw, xy);
}

bool stage_project(const struct stage *stage, const struct core *core, int rig, int joint, double fraction,
                   float xy[2])
{
    const struct strand *strand = strand_of(stage, rig);
    return strand && joint < strand->count && strand_project(stage, core, strand, joint, fraction, xy);
}

void strand_nearer(const struct stage *stage, const struct core *core, const struct strand *strand, const float p[2],
                   float *nearest, struct hover *hover)
{
    for (int n = 0; n + 1 < strand->count; n++) {
        float a[2], b[2];
        if (!strand_project(stage, core, strand, n, 0, a) || !strand_project(stage, core, strand, n, 1, b)) continue;
        float fraction = segment_nearest(a, b, p);
        float at[2] = {a[0] + (b[0] - a[0]) * fraction, a[1] + (b[1] - a[1]) * fraction};
        float distance = hypotf(p[0] - at[0], p[1] - at[1]);
        if (distance >= *nearest) continue;
        *nearest = distance;
        *hover = (struct hover){
            .kind = HOVER_JOINT, .rig = strand->rig, .joint = n, .fraction = fraction, .x = at[0], .y = at[1]};
    }
}

struct hover strand_hover(const struct stage *stage, const struct core *core, float x, float y)
{
    struct hover hover = {.kind = HOVER_NONE};
    float nearest = STRAND_REACH;
    for (int s = 0; s < stage->strand_count; s++) {
        const struct strand *strand = &stage->strands[s];
        if (!strand->is_chain) strand_nearer(stage, core, strand, (const float[2]){x, y}, &nearest, &hover);
    }
    return hover;
}

struct hover strand_end(const struct stage *stage, const struct core *core, const struct hover *between)
{
    struct hover hover = {.kind = HOVER_POINT, .rig = between->rig};
    const struct strand *strand = strand_of(stage, hover.rig);
    float xy[2];
    hover.joint = (int)round(between->joint + between->fraction) - 1;
    if (hover.joint < 0) hover.joint = 0;
    if (!strand || hover.joint + 1 >= strand->count || !strand_project(stage, core, strand, hover.joint + 1, 0, xy))
        return (struct hover){.kind = HOVER_NONE};
    hover.x = xy[0];
    hover.y = xy[1];
    return hover;
}

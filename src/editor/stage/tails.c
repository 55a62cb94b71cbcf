/// Tails and chains on the stage: posing, and projecting their joints.
#include "editor/core/bones.h"
#include "editor/core/core.h"
#include "editor/stage/parts.h"
#include "editor/stage/stage.h"
#include "maths/maths.h"
#include "model/vector.h"
#include <assert.h>
#include <math.h>

enum { BOUND_STEPS = 120, BLOBS_OF_ONE_TAIL = 20 };

static const float DUSK = 0.35f; ///< for a fox of bind size

static void move_by_hand(const void *context, int rig, struct by_hand *hand)
{
    const struct stage *stage = context;
    double offset[3];
    body_drag_offset(stage, stage->core, rig, offset);
    for (int k = 0; k < 3; k++) hand->base[k] += offset[k];
    drag_inertia_add(stage, stage->core->document, rig, hand->input);
}

struct posing stage_posing_by_hand(const struct stage *stage)
{
    const struct take *take = &stage->core->take;
    struct posing posing = stage_posing(stage->core);
    if (take_is_posed(stage->core)) {
        posing.document = take->document;
        posing.evaluation = &take->evaluation;
        posing.look = take->look;
    }
    posing.move = move_by_hand;
    posing.context = stage;
    return posing;
}

bool strand_pose(const struct stage *stage, const struct core *core, int rig, double position,
                 const struct what_if *change, struct rig_pose *pose)
{
    const struct posing posing = stage_posing_by_hand(stage);
    struct by_hand hand = {0};
    int count;
    if (!tail_drag_holds(core->document, rig, 0)) return false;
    const struct channel *channels = rig_channels(core->document->rigs[rig], &count);
    for (int c = 0; change && c < count; c++) {
        if (channels[c].spline == change->spline) hand.input[c] = (wiggly_value){.re = change->re, .im = change->im};
    }
    return rig_pose(&posing, rig, position, &hand, pose);
}

static void add_blobs(struct stage_view *view, const struct pose *pose)
{
    const int room = STAGE_MAX_BLOBS - view->blob_count;
    view->blob_count += pose_blobs(pose, view->key_from, view->blobs + view->blob_count,
                                   room < BLOBS_OF_ONE_TAIL ? room : BLOBS_OF_ONE_TAIL);
}

static void pose(struct stage *stage, const struct core *core, int rig, int n)
{
    struct stage_view *view = &stage->view;
    struct rig_pose posed, body;
    (void)n;
    if (stage->tail_count == STAGE_MAX_TAILS) return;
    strand_pose(stage, core, rig, core->playback.position, NULL, &posed);
    add_blobs(view, &posed.strand);
    struct stage_model *fox = models_show(stage, core, rig, &body);
    if (fox) fox->dusk = DUSK * posed.strand.scale;
    stage->strands[stage->strand_count++] =
        (struct shown_strand){rig, fox ? view->model_count - 1 : -1, posed.strand};
    stage->tail_count++;
}

const struct stage_kind tail_stage = {.pose = pose, .bound_steps = BOUND_STEPS};

static void chain_pose(struct stage *stage, const struct core *core, int rig, int n)
{
    const struct chain *chain = &core->document->rigs[rig]->chain;
    const int model = rig_body(core->document, rig);
    const struct imported *shown = model >= 0 ? bones_character(core, model) : NULL;
    struct chain_bones bones;
    struct rig_pose posed;
    (void)n;
    if (!shown || !chain_find(&shown->gltf, chain->from, chain->to, &bones, NULL)) return;
    bones_mark(stage, core, rig, model, &bones);
    if (stage->strand_count < STAGE_MAX_STRANDS &&
        strand_pose(stage, core, rig, core->playback.position, NULL, &posed))
        stage->strands[stage->strand_count++] = (struct shown_strand){rig, -1, posed.strand};
}

const struct stage_kind chain_stage = {.pose = chain_pose};

const struct shown_strand *strand_of(const struct stage *stage, int rig)
{
    for (int s = 0; s < stage->strand_count; s++) {
        if (stage->strands[s].rig == rig) return &stage->strands[s];
    }
    return NULL;
}

bool strand_project(const struct stage *stage, const struct core *core, const struct pose *strand, int joint,
                    double fraction, float xy[2])
{
    assert(joint >= 0 && joint < strand->count);
    const int next = joint + 1 < strand->count ? joint + 1 : joint;
    const vec3s from = vec3_from(strand->matrix[joint] + 12), to = vec3_from(strand->matrix[next] + 12);
    const vec3s world = glms_vec3_lerp(from, to, (float)fraction);
    return stage_project_point(stage, core->layout.stage, world.raw, xy);
}

bool stage_project(const struct stage *stage, const struct core *core, int rig, int joint, double fraction,
                   float xy[2])
{
    const struct shown_strand *strand = strand_of(stage, rig);
    return strand && joint < strand->pose.count && strand_project(stage, core, &strand->pose, joint, fraction, xy);
}

void strand_nearer(const struct stage *stage, const struct core *core, int rig, const struct pose *strand,
                   const float p[2], float *nearest, struct hover *hover)
{
    for (int n = 0; n + 1 < strand->count; n++) {
        float a[2], b[2];
        if (!strand_project(stage, core, strand, n, 0, a) || !strand_project(stage, core, strand, n, 1, b)) continue;
        float fraction = segment_nearest(a, b, p);
        float at[2] = {a[0] + (b[0] - a[0]) * fraction, a[1] + (b[1] - a[1]) * fraction};
        float distance = maths_hypotf(p[0] - at[0], p[1] - at[1]);
        if (distance >= *nearest) continue;
        *nearest = distance;
        *hover = (struct hover){
            .thing = &thing_tail, .rig = rig, .joint = n, .fraction = fraction, .x = at[0], .y = at[1]};
    }
}

struct hover strand_hover(const struct stage *stage, const struct core *core, float x, float y)
{
    struct hover hover = {.thing = NULL};
    float nearest = STRAND_REACH;
    for (int s = 0; s < stage->tail_count; s++) {
        const struct shown_strand *tail = &stage->strands[s];
        strand_nearer(stage, core, tail->rig, &tail->pose, (const float[2]){x, y}, &nearest, &hover);
    }
    // An edit in the same frame may have removed it.
    if (!tail_drag_holds(core->document, hover.rig, hover.joint)) hover.thing = NULL;
    return hover;
}

struct hover strand_end(const struct stage *stage, const struct core *core, const struct hover *between)
{
    struct hover hover = {.thing = &thing_point, .rig = between->rig};
    const struct shown_strand *strand = strand_of(stage, hover.rig);
    float xy[2];
    hover.joint = (int)round(between->joint + between->fraction) - 1;
    if (hover.joint < 0) hover.joint = 0;
    if (!strand || hover.joint + 1 >= strand->pose.count ||
        !strand_project(stage, core, &strand->pose, hover.joint + 1, 0, xy))
        return (struct hover){.thing = NULL};
    hover.x = xy[0];
    hover.y = xy[1];
    return hover;
}

/// Tails on the stage, with what moves them by hand.
#include "base/hash.h"
#include "editor/stage/hold.h"
#include "editor/stage/rigs.h"
#include "editor/stage/strand.h"
#include "model/vector.h"
#include "rig/shadow.h"
#include <math.h>

enum { BOUND_STEPS = 120, BLOBS_OF_ONE_TAIL = 20 };

/// Its body in the hand, what swings after it, and `change` (may be NULL).
static struct by_hand by_hand(const struct stage *stage, const struct core *core, const struct tail *shown, int tail,
                              const struct what_if *change)
{
    struct by_hand hand = {0};
    for (int c = 0; c < shown->channel_count; c++) {
        hand.input[c] = sway_value(stage, tail, c);
        if (!change || change->spline != shown->channels[c].spline) continue;
        hand.input[c].re += change->re;
        hand.input[c].im += change->im;
    }
    hold_offset(stage, core, tail, hand.base);
    return hand;
}

void stage_pose_tail(const struct stage *stage, const struct core *core, const struct editor_world *world, int tail,
                     double position, const struct what_if *change, struct rig_pose *pose)
{
    const struct posing posing = stage_posing(core, world);
    const int rig = document_find_rig(world->document, RIG_TAIL, tail);
    const struct by_hand hand = by_hand(stage, core, &world->document->rigs[rig].tail, tail, change);
    rig_pose(&posing, rig, position, &hand, pose);
}

static void add_blobs(struct stage_view *view, const struct pose *pose)
{
    struct shadow_blob blobs[BLOBS_OF_ONE_TAIL];
    int room = STAGE_MAX_BLOBS - view->blob_count;
    int count = pose_blobs(pose, view->key_from, blobs, room < BLOBS_OF_ONE_TAIL ? room : BLOBS_OF_ONE_TAIL);
    for (int i = 0; i < count; i++) {
        view->blobs[view->blob_count++] =
            (struct stage_blob){blobs[i].x, blobs[i].z, blobs[i].radius, blobs[i].strength};
    }
}

static void pose(struct stage *stage, const struct core *core, const struct editor_world *world, int rig, int n)
{
    struct stage_view *view = &stage->view;
    const struct tail *tail = &world->document->rigs[rig].tail;
    struct rig_pose posed;
    if (view->tail_count == STAGE_MAX_TAILS) return;
    struct stage_tail *shown = &view->tails[view->tail_count++];
    stage_pose_tail(stage, core, world, n, core->playback.position, NULL, &posed);
    strand_add(stage, rig, &posed);
    *shown = (struct stage_tail){.joints = tail->joints, .length = (float)tail->length, .pose = posed.tail};
    add_blobs(view, &shown->pose);
}

static bool bounds(const struct stage *stage, const struct core *core, const struct editor_world *world, int rig,
                   int n, float lo[3], float hi[3])
{
    const double last = document_samples(world->document) - 1;
    (void)rig;
    for (int step = 0; step <= BOUND_STEPS && n < STAGE_MAX_TAILS; step++) {
        struct rig_pose posed;
        float low[3], high[3];
        stage_pose_tail(stage, core, world, n, last * step / BOUND_STEPS, NULL, &posed);
        rig_bounds(&posed, low, high);
        glm_vec3_minv(low, lo, lo);
        glm_vec3_maxv(high, hi, hi);
    }
    return true;
}

static uint64_t hash(uint64_t sum, const struct stage_view *view)
{
    for (int t = 0; t < view->tail_count; t++) {
        const struct stage_tail *tail = &view->tails[t];
        sum = hash_bytes(sum, &tail->joints, sizeof tail->joints);
        sum = hash_bytes(sum, &tail->length, sizeof tail->length);
        sum = hash_bytes(sum, &tail->pose.ground, sizeof tail->pose.ground);
        sum = hash_bytes(sum, &tail->pose.limbs, sizeof tail->pose.limbs);
        sum = hash_bytes(sum, tail->pose.matrix, (size_t)tail->pose.count * sizeof tail->pose.matrix[0]);
    }
    return sum;
}

const struct stage_kind stage_tails = {pose, bounds, hash};

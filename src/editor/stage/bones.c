/// Which bone is pointed at.
#include "editor/stage/bones.h"
#include "editor/core/arrange.h"
#include "editor/core/bones.h"
#include "editor/stage/rigs.h"
#include "editor/stage/segment.h"
#include "editor/stage/stage.h"
#include "editor/stage/strand.h"
#include "model/vector.h"
#include <math.h>

static const float REACH = 12; ///< pixels from a bone
static const float OVERLAP =
    4; ///< pixels within which bones lie over each other: the one nearest to the eye is meant
static const float AS_DEEP = 0.02f; ///< of the depth: bones this close in depth are at the same one
static const float AS_FAR = 0.5f;   ///< pixels: bones this close in distance are as near

void bones_add(struct stage *stage, int model, const struct rig_pose *pose)
{
    const struct skeleton *skeleton = &pose->model.imported->skeleton;
    const mat4s to_world = mat4_from(pose->model.root);
    for (int b = 0; b < skeleton->count && stage->bone_count < STAGE_MAX_BONES; b++) {
        const struct bone *bone = &skeleton->bones[b];
        struct shown_bone *shown = &stage->bones[stage->bone_count++];
        float ends[2][3];
        *shown = (struct shown_bone){.model = model, .node = bone->node, .chain = -1};
        skeleton_ends(bone, pose->model.pose, ends);
        for (int e = 0; e < 2; e++) {
            const vec3s at = glms_mat4_mulv3(to_world, vec3_from(ends[e]), 1.0f);
            memcpy(shown->ends[e], at.raw, sizeof at.raw);
        }
    }
}

/// The spline whose colour a chain has: the active one where it bends it.
static int spline_of(const struct core *core, const struct chain *chain)
{
    for (int c = 0; c < chain->channel_count; c++) {
        if (chain->channels[c].spline == core->active) return core->active;
    }
    return chain->channel_count > 0 ? chain->channels[0].spline : -1;
}

void bones_mark(struct stage *stage, const struct core *core, const struct document *document, int rig, int model,
                const struct chain_bones *bones)
{
    const int spline = spline_of(core, &document->rigs[rig].chain);
    for (int b = 0; b < stage->bone_count; b++) {
        struct shown_bone *bone = &stage->bones[b];
        if (bone->model != model || (bone->chain >= 0 && spline != core->active)) continue;
        for (int n = 0; n < bones->count; n++) {
            if (bones->node[n] != bone->node) continue;
            bone->chain = rig;
            bone->joint = n;
            bone->color = spline >= 0 ? arrange_color(document, spline) : 0;
        }
    }
}

/// A bone near the pointer.
struct candidate {
    int bone;
    float xy[2], fraction, distance, depth;
};

static bool measure(const struct stage *stage, const struct core *core, int bone, const float p[2],
                    struct candidate *found)
{
    const struct shown_bone *shown = &stage->bones[bone];
    float a[2], b[2];
    if (!stage_project_point(stage, core->layout.stage, shown->ends[0], a) ||
        !stage_project_point(stage, core->layout.stage, shown->ends[1], b))
        return false;
    found->bone = bone;
    found->fraction = segment_nearest(a, b, p);
    for (int k = 0; k < 2; k++) found->xy[k] = a[k] + (b[k] - a[k]) * found->fraction;
    found->distance = hypotf(p[0] - found->xy[0], p[1] - found->xy[1]);
    const vec3s at = glms_vec3_lerp(vec3_from(shown->ends[0]), vec3_from(shown->ends[1]), found->fraction);
    found->depth = camera_depth(stage->view.view, stage->view.eye, at.raw);
    return found->distance < REACH;
}

/// Whether a bone is meant rather than the best so far, both being about as near to the pointer. At a joint two are as near and as deep:
/// the one that begins there is meant.
static bool is_better(const struct candidate *a, const struct candidate *best)
{
    if (best->bone < 0) return true;
    if (fabsf(a->depth - best->depth) > AS_DEEP * best->depth) return a->depth < best->depth;
    if (fabsf(a->distance - best->distance) > AS_FAR) return a->distance < best->distance;
    return a->fraction < best->fraction;
}

struct hover bone_hover(const struct stage *stage, const struct core *core, float x, float y)
{
    const float p[2] = {x, y};
    struct candidate best = {.bone = -1}, candidate;
    float nearest = REACH;
    for (int b = 0; b < stage->bone_count; b++) {
        if (measure(stage, core, b, p, &candidate)) nearest = fminf(nearest, candidate.distance);
    }
    for (int b = 0; b < stage->bone_count && !core->brush.on; b++) {
        if (measure(stage, core, b, p, &candidate) && candidate.distance < nearest + OVERLAP &&
            is_better(&candidate, &best))
            best = candidate;
    }
    if (best.bone < 0) return (struct hover){.kind = HOVER_NONE};
    const struct shown_bone *bone = &stage->bones[best.bone];
    return (struct hover){.kind = bone->chain >= 0 ? HOVER_JOINT : HOVER_BONE,
                          .rig = bone->chain,
                          .joint = bone->joint,
                          .fraction = (double)best.fraction,
                          .model = bone->model,
                          .node = bone->node,
                          .x = best.xy[0],
                          .y = best.xy[1]};
}

bool bone_exists(const struct document *document, int model)
{
    return model < document->rig_count && document->rigs[model].kind == RIG_MODEL;
}

void bone_click(const struct stage *stage, struct core *core, const struct editor_world *world)
{
    const struct hover *pressed = &stage->pressed;
    const struct document *document = world->document;
    const bool on_chain = pressed->kind == HOVER_JOINT && pressed->rig < document->rig_count &&
                          document->rigs[pressed->rig].kind == RIG_CHAIN;
    if ((pressed->kind == HOVER_BONE || on_chain) && bone_exists(document, pressed->model)) {
        bones_clicked(core, world, pressed->model, pressed->node);
    } else if (core->pick.use == BONE_SELECTED) {
        bones_clear(core);
    }
}

bool stage_bone_point(const struct stage *stage, const struct core *core, int model, int node, float xy[2])
{
    for (int b = 0; b < stage->bone_count; b++) {
        const struct shown_bone *bone = &stage->bones[b];
        const vec3s middle = glms_vec3_lerp(vec3_from(bone->ends[0]), vec3_from(bone->ends[1]), 0.5f);
        if (bone->model == model && bone->node == node)
            return stage_project_point(stage, core->layout.stage, middle.raw, xy);
    }
    return false;
}

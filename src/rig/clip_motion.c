/// Follows joints through clips.
#include "maths/maths.h"
#include "model/vector.h"
#include "rig/posing_kind.h"
#include "rig/strand.h"
#include <math.h>
#include <stdlib.h>

enum { MEAN_STEPS = 120 }; ///< over a clip

static const double DEGREES = 57.29577951308232;

struct followed {
    const struct imported *imported;
    struct gltf_pose *pose;
    int node;
    int clip; ///< −1: it rests
    struct clip_play play;
    enum motion_of of;
    struct chain_axes axes;
    double scale; ///< metres in the world per unit of the file
    double seen;  ///< last angle in degrees, so that turns continue past half a turn
    double
        drift; ///< what a round adds, per second: a steady travel bends nothing, and must not jump back after each round
};

/// The axes of the named chain, else those of a chain that points to the front.
static struct chain_axes axes_of(const struct document *document, const struct imported *imported, const char *name)
{
    for (int r = 0; name && r < document->rig_count; r++) {
        const struct rig *rig = document->rigs[r];
        struct chain_bones bones;
        if (rig->kind != RIG_CHAIN || !rig->name || strcmp(rig->name, name) != 0) continue;
        if (!chain_find(&imported->gltf, rig->chain.from, rig->chain.to, &bones, NULL)) continue;
        return chain_axes_at_rest(imported, &rig->chain, &bones);
    }
    return (struct chain_axes){.side = {0, 1, 0}, .up = {-1, 0, 0}, .along = {0, 0, 1}};
}

static bool find(const struct models *models, const struct document *document, const struct joint_motion *motion,
                 struct followed *followed)
{
    const int rig = document_find_model(document, motion->model, motion->by_file);
    const struct imported *imported = models_imported(models, document, rig);
    if (!imported) return false;
    const struct model_rig *model = &document->rigs[rig]->model;
    const int clip = gltf_find_clip(&imported->gltf, model->clip);
    *followed = (struct followed){.imported = imported,
                                  .pose = models_pose(models, document, rig, POSE_UNSEEN),
                                  .node = gltf_find_node(&imported->gltf, motion->joint),
                                  .clip = clip,
                                  .of = motion->of,
                                  .axes = axes_of(document, imported, motion->chain),
                                  .scale = model->scale};
    if (clip >= 0) followed->play = clip_play(model, &imported->gltf.clips[clip]);
    return followed->node >= 0;
}

/// Degrees about the chain's side axis by which the joint has turned from rest.
static double turn_of(struct followed *followed)
{
    const mat3s rest = glms_mat4_pick3(mat4_from(followed->imported->rest.world[followed->node]));
    const mat3s now = glms_mat4_pick3(mat4_from(followed->pose->world[followed->node]));
    const vec3s axis = vec3_from(followed->axes.side), before = vec3_from(followed->axes.along);
    const vec3s after = glms_mat3_mulv(now, glms_mat3_mulv(mat3_inverse(rest), before));
    const vec3s across = glms_vec3_cross(axis, before);
    double turn = DEGREES * maths_atan2((double)glms_vec3_dot(after, across), (double)glms_vec3_dot(after, before));
    turn += 360 * round((followed->seen - turn) / 360);
    return followed->seen = turn;
}

static double look(struct followed *followed, double time)
{
    const double travelled = followed->drift * (time - followed->play.first);
    const struct gltf *gltf = &followed->imported->gltf;
    if (followed->clip < 0) {
        gltf_pose_clip(gltf, -1, 0, followed->pose);
    } else {
        gltf_pose_loop(gltf, followed->clip, time, followed->pose);
    }
    gltf_pose_world(gltf, followed->pose);
    if (followed->of == MOTION_TURN) return turn_of(followed) - travelled;
    const vec3s side = vec3_from(followed->axes.side), along = vec3_from(followed->axes.along);
    const vec3s direction = followed->of == MOTION_UP ? side : glms_vec3_cross(side, along);
    return followed->scale * (double)glms_vec3_dot(direction, vec3_from(followed->pose->world[followed->node] + 12)) -
           travelled;
}

static void find_drift(struct followed *followed)
{
    const struct clip_play *play = &followed->play;
    if (!play->loops || !(play->length > 0)) return;
    const double first = look(followed, play->first);
    followed->drift = (look(followed, play->first + play->length) - first) / play->length;
    followed->seen = 0;
}

static double mean_of(struct followed *followed)
{
    const struct clip_play *play = &followed->play;
    double sum = 0;
    for (int n = 0; n < MEAN_STEPS; n++) sum += look(followed, play->first + play->length * n / MEAN_STEPS);
    return sum / MEAN_STEPS;
}

/// Number of samples after which the clip repeats exactly, or 0. The scene may begin before the clip.
static int period_of(const struct document *document, const struct clip_play *play)
{
    const double samples = play->length / document_step(document);
    const bool waits =
        document->first_frame / document->fps < play->first - 1e-6 && !posing_clip_loops(document, play);
    return play->loops && !waits && samples >= 1 && samples < 1e6 && fabs(samples - round(samples)) < 1e-4
               ? (int)round(samples)
               : 0;
}

/// Samples a joint, averaged over a frame on either side: clips have keys on frames with straight lines between, and each corner would kick
/// the spline. The result is the cubic B-spline of the keys. A clip that does not loop is held at the scene's ends.
struct smoothing {
    int substeps;
    double ring[2 * SCENE_MAX_SUBSTEPS]; ///< samples around the next one
};

static double *raw(struct smoothing *smoothing, int sample)
{
    const int size = 2 * smoothing->substeps;
    return &smoothing->ring[((sample % size) + size) % size];
}

static void look_at(struct smoothing *smoothing, const struct document *document, struct followed *followed,
                    int sample)
{
    const int end = document_samples(document) - 1;
    const int held = followed->play.loops ? sample : sample < 0 ? 0 : sample > end ? end : sample;
    *raw(smoothing, sample) = look(followed, posing_clip_time(document, held, &followed->play));
}

static double smoothed(struct smoothing *smoothing, int sample)
{
    const int s = smoothing->substeps;
    double sum = 0;
    for (int k = 1 - s; k < s; k++) sum += (s - abs(k)) * *raw(smoothing, sample + k);
    return sum / s / s;
}

bool clip_follow(void *context, const struct document *document, const struct joint_motion *motion, double *samples)
{
    struct followed followed;
    struct smoothing smoothing = {.substeps = document->substeps};
    if (!find(context, document, motion, &followed)) return false;
    const int count = document_samples(document), period = period_of(document, &followed.play);
    find_drift(&followed);
    const double mean = mean_of(&followed);
    for (int s = 1 - document->substeps; s < document->substeps - 1; s++) look_at(&smoothing, document, &followed, s);
    for (int s = 0; s < count; s++) {
        if (period && s >= period) {
            samples[s] = samples[s - period];
            continue;
        }
        look_at(&smoothing, document, &followed, s + document->substeps - 1);
        samples[s] = smoothed(&smoothing, s) - mean;
    }
    return true;
}

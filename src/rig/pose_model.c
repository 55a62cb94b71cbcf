/// Characters and a tail's fox: posed by the clip and the bends on top; and joints followed through clips.
#include "maths/maths.h"
#include "model/fox.h"
#include "model/vector.h"
#include "rig/strand.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double ROUNDING = 1e-6; ///< of a clip's length: times of keys are single precision

bool posing_clip_loops(const struct document *document, const struct clip_play *play)
{
    const double times = (document->last_frame - document->first_frame) / document->fps / play->length;
    return play->loops && times > 0.5 && fabs(times - round(times)) < 1e-3;
}

struct clip_play clip_play(const struct model_rig *model, const struct gltf_clip *clip)
{
    const bool loops = model->repeat == REPEAT_BY_CLIP ? clip->loops : model->repeat == REPEAT_LOOP;
    return (struct clip_play){clip->first, clip->last - clip->first + (loops ? clip->gap : 0), loops};
}

double posing_clip_time(const struct document *document, double position, const struct clip_play *play)
{
    const double frame = document->first_frame + position / document->substeps;
    const double into = frame / document->fps - play->first;
    if (!(play->length > 0) || (into < 0 && !posing_clip_loops(document, play))) return play->first;
    const double rounds = play->loops ? floor(into / play->length + ROUNDING) : 0,
                 left = into - rounds * play->length;
    return play->first + (!play->loops && left > (1 - ROUNDING) * play->length ? play->length : left);
}

struct gltf_pose *posing_clip(const struct posing *posing, int rig, double position, enum pose_memory memory)
{
    const struct document *document = posing->document;
    const struct imported *imported = models_imported(posing->models, document, rig);
    if (!imported) return NULL;
    struct gltf_pose *pose = models_pose(posing->models, document, rig, memory);
    const struct gltf *gltf = &imported->gltf;
    const char *name = document->rigs[rig]->kind == RIG_MODEL ? document->rigs[rig]->model.clip : NULL;
    const int clip = posing->at_rest ? -1 : gltf_find_clip(gltf, name);
    struct clip_play play = {0};
    if (clip >= 0) play = clip_play(&document->rigs[rig]->model, &gltf->clips[clip]);
    gltf_pose_loop(gltf, clip, posing_clip_time(document, position, &play), pose);
    return pose;
}

/// The lowest point at rest is at the rig's position.
void posing_root(const struct posing *posing, int rig, double root[12])
{
    const struct document *document = posing->document;
    const struct model_rig *model = &document->rigs[rig]->model;
    const struct imported *imported = models_imported(posing->models, document, rig);
    const double turn = radians(model->turn);
    const double c = model->scale * maths_cos(turn), s = model->scale * maths_sin(turn);
    const double columns[9] = {c, 0, -s, 0, model->scale, 0, s, 0, c};
    memcpy(root, columns, sizeof columns);
    posing_base(posing, rig, root + 9);
    for (int k = 0; k < 3; k++) root[9 + k] += model->position[k];
    root[10] -= model->scale * (double)imported->gltf.lo[1];
}

void posing_bend(const struct posing *posing, int rig, double position, struct gltf_pose *pose,
                 struct rig_pose *posed)
{
    const struct document *document = posing->document;
    wiggly_value values[RIG_MAX_INPUTS];
    struct strand strand;
    double root[12];
    for (int r = 0; r < document->rig_count; r++) {
        if (!strand_find(posing, rig, r, &strand)) continue;
        posing_values(posing, r, position, values);
        strand_bend(&strand, values, posing->look, pose);
    }
    posed->kind = RIG_MODEL;
    posed->imported = models_imported(posing->models, document, rig);
    posed->model = (struct model_pose){.gltf = &posed->imported->gltf,
                                       .pose = pose,
                                       .ground = (float)document->rigs[rig]->model.position[1],
                                       .figure = models_figure(posing->models, document, rig)};
    posing_root(posing, rig, root);
    gltf_pose_world(posed->model.gltf, pose);
    const struct figure *figure = posed->model.figure;
    if (figure) {
        float *weights = pose->weights + posed->model.gltf->nodes[figure->character.node].first_weight;
        posing_values(posing, rig, position, values);
        pose_character(&document->rigs[rig]->model, figure, values, posing->look, weights);
        posed->model.morph = figure_morph(figure, weights);
    }
    for (int k = 0; k < 16; k++) posed->model.root[k] = k % 4 == 3 ? k == 15 : (float)root[3 * (k / 4) + k % 4];
}

void rig_bounds(const struct rig_pose *posed, float lo[3], float hi[3])
{
    const struct model_pose *model = &posed->model;
    vec3 box[2];
    if (posed->kind == RIG_TAIL) {
        pose_bounds(&posed->strand, lo, hi);
        return;
    }
    gltf_bounds_at(&posed->imported->bounds, model->gltf, model->pose,
                   model->figure ? model->figure->character.node : -1, box[0], box[1]);
    mat4s root = mat4_from(model->root);
    if (box[0][0] <= box[1][0]) glm_aabb_transform(box, root.raw, box);
    memcpy(lo, box[0], sizeof box[0]);
    memcpy(hi, box[1], sizeof box[1]);
    if (model->figure) figure_vertices(model, NULL, NULL, lo, hi);
    for (int k = 0; k < 3 && !(lo[0] <= hi[0]); k++) lo[k] = hi[k] = 0.0f;
}

// --- joints followed through clips

enum { MEAN_STEPS = 120 }; ///< over a clip

static const double DEGREES = 57.29577951308232;

/// How far a steady acceleration may pull a coordinate of flesh: 1 is as far as its shapes were seen. Clips jump between takes, and whatever a
/// linear oscillator is thrown by there would tear the mesh.
static const double FARTHEST = 3;

struct followed {
    const struct imported *imported;
    struct gltf_pose *pose;
    int node;
    int clip; ///< −1: it rests
    struct clip_play play;
    enum motion_of of;
    struct chain_axes axes;
    double scale;      ///< metres in the world per unit of the file
    double base[3];    ///< of MOTION_BASE: the coordinate's numbers g,
    vec3s at;          ///< the point of the joint that counts,
    double most;       ///< the largest second difference,
    double carried[3]; ///< and by how much a round carries the joint on, metres per second
    double seen;       ///< last angle in degrees, so that turns continue past half a turn
    double
        drift; ///< what a round adds, per second: a steady travel bends nothing, and must not jump back after each round
};

static double followed_at(struct followed *followed, double time)
{
    const double travelled = followed->drift * (time - followed->play.first);
    const struct gltf *gltf = &followed->imported->gltf;
    gltf_pose_loop(gltf, followed->clip, time, followed->pose);
    gltf_pose_world(gltf, followed->pose);
    const vec3s side = vec3_from(followed->axes.side), along = vec3_from(followed->axes.along);
    if (followed->of == MOTION_TURN) { // degrees about the side axis by which the joint has turned from rest
        const mat3s rest = glms_mat4_pick3(mat4_from(followed->imported->rest.world[followed->node]));
        const mat3s now = glms_mat4_pick3(mat4_from(followed->pose->world[followed->node]));
        const vec3s after = glms_mat3_mulv(now, glms_mat3_mulv(mat3_inverse(rest), along));
        const vec3s across = glms_vec3_cross(side, along);
        const double turn =
            DEGREES * maths_atan2((double)glms_vec3_dot(after, across), (double)glms_vec3_dot(after, along));
        followed->seen = turn + 360 * round((followed->seen - turn) / 360);
        return followed->seen - travelled;
    }
    const vec3s direction = followed->of == MOTION_UP ? side : glms_vec3_cross(side, along);
    return followed->scale * (double)glms_vec3_dot(direction, vec3_from(followed->pose->world[followed->node] + 12)) -
           travelled;
}

/// Where the joint's point is in the clip, in the model's space without its travel, after `time`.
static vec3s joint_at(struct followed *followed, double time)
{
    const struct gltf *gltf = &followed->imported->gltf;
    const double into = time - followed->play.first;
    gltf_pose_loop(gltf, followed->clip, time, followed->pose);
    gltf_pose_world(gltf, followed->pose);
    vec3s at = glms_mat4_mulv3(mat4_from(followed->pose->world[followed->node]), followed->at, 1);
    for (int k = 0; k < 3; k++) at.raw[k] -= (float)(followed->carried[k] * into);
    return at;
}

/// Samples a joint, averaged over a frame on either side: clips have keys on frames with straight lines between, and each corner would kick
/// the spline. The result is the cubic B-spline of the keys. A clip that does not loop is held at the scene's ends.
struct smoothing {
    int substeps;
    double ring[2 * SCENE_MAX_SUBSTEPS]; ///< samples around the next one
};

static double *smoothing_at(struct smoothing *smoothing, int sample)
{
    const int size = 2 * smoothing->substeps;
    return &smoothing->ring[((sample % size) + size) % size];
}

static void sample_raw(struct smoothing *smoothing, const struct document *document, struct followed *followed,
                       int sample)
{
    const int end = document_samples(document) - 1;
    const int held = followed->play.loops ? sample : sample < 0 ? 0 : sample > end ? end : sample;
    if (followed->of != MOTION_BASE) {
        *smoothing_at(smoothing, sample) = followed_at(followed, posing_clip_time(document, held, &followed->play));
        return;
    }
    // The second difference of the joint's places, turned back by its turn from rest, times g.
    vec3s place[3];
    for (int k = 0; k < 3; k++) { // the middle one last, which leaves its pose
        const int at = held + (k == 2 ? 0 : 2 * k - 1);
        const int kept = followed->play.loops ? at : at < 0 ? 0 : at > end ? end : at;
        place[k] = joint_at(followed, posing_clip_time(document, kept, &followed->play));
    }
    const mat3s rest = glms_mat4_pick3(mat4_from(followed->imported->rest.world[followed->node]));
    const mat3s now = glms_mat4_pick3(mat4_from(followed->pose->world[followed->node]));
    vec3s way = glms_vec3_sub(glms_vec3_add(place[0], place[1]), glms_vec3_scale(place[2], 2));
    way = glms_mat3_mulv(rest, glms_mat3_mulv(mat3_inverse(now), way));
    double sum = 0;
    for (int k = 0; k < 3; k++) sum += followed->base[k] * (double)way.raw[k];
    *smoothing_at(smoothing, sample) = held == sample ? fmax(-followed->most, fmin(sum, followed->most)) : 0;
}

/// Sums second differences up twice, so that the solver, which takes them again, has them: y₍ₛ₊₁₎ − 2y₍ₛ₎ + y₍ₛ₋₁₎ = dₛ, from rest. In a `loop` without
/// their mean and the drift, so that it closes. Constant and linear parts move nothing.
static void sum_twice(double *samples, int count, bool loop)
{
    for (int round = 0; round < 2; round++) {
        double mean = 0, sum = 0;
        for (int s = 0; s < count && loop; s++) mean += samples[s] / count;
        for (int s = 0; s < count; s++) {
            const double next = samples[s] - mean;
            if (round == 0) sum += next; // the slope behind the sample
            samples[s] = sum;
            if (round == 1) sum += next; // the value before it
        }
    }
}

bool clip_follow(const void *context, const struct document *document, const struct joint_motion *motion,
                 const char *coordinate, double *samples)
{
    const struct models *models = context;
    const int rig = document_find_model(document, motion->model);
    const struct imported *imported = models_imported(models, document, rig);
    if (!imported) return false;
    const struct model_rig *model = &document->rigs[rig]->model;
    const int clip = gltf_find_clip(&imported->gltf, model->clip);
    struct chain_axes axes = {
        .side = {0, 1, 0}, .up = {-1, 0, 0}, .along = {0, 0, 1}}; // of a chain that points to the front
    const int found = motion->chain ? document_find_chain(document, motion->chain) : -1;
    const struct chain *chain = found >= 0 ? &document->rigs[found]->chain : NULL;
    struct chain_bones bones;
    if (chain && chain_find(&imported->gltf, chain->from, chain->to, &bones, NULL))
        axes = chain_axes_at_rest(imported, chain, &bones);
    struct followed followed = {.imported = imported,
                                .pose = models_pose(models, document, rig, POSE_UNSEEN),
                                .node = gltf_find_node(&imported->gltf, motion->joint),
                                .clip = clip,
                                .of = motion->of,
                                .axes = axes,
                                .scale = model->scale};
    if (clip >= 0) followed.play = clip_play(model, &imported->gltf.clips[clip]);
    if (followed.node < 0) return false;
    const int soft = coordinate ? figure_find(&imported->figure, coordinate) : -1;
    if (motion->of == MOTION_BASE && (soft < 0 || clip < 0)) { // nothing moves it
        memset(samples, 0, (size_t)document_samples(document) * sizeof *samples);
        return true;
    }
    if (motion->of == MOTION_BASE) {
        const struct coordinate *c = &imported->figure.character.coordinates[soft];
        memcpy(followed.base, c->base, sizeof followed.base);
        for (int k = 0; k < 3; k++) followed.at.raw[k] = (float)c->at[k];
        followed.most = FARTHEST * pow(2 * M_PI * c->frequency * document_step(document), 2);
    }
    const int substeps = document->substeps;
    struct smoothing smoothing = {.substeps = substeps};
    const struct clip_play *play = &followed.play;
    const int count = document_samples(document);

    // The number of samples after which the clip repeats exactly, or 0. The scene may begin before the clip.
    const double length = play->length / document_step(document);
    const bool waits =
        document->first_frame / document->fps < play->first - 1e-6 && !posing_clip_loops(document, play);
    const bool repeats = play->loops && !waits && length >= 1 && length < 1e6 && fabs(length - round(length)) < 1e-4;
    const int period = repeats ? (int)round(length) : 0;

    if (motion->of == MOTION_BASE && play->loops && play->length > 0) {
        const vec3s first = joint_at(&followed, play->first), last = joint_at(&followed, play->first + play->length);
        for (int k = 0; k < 3; k++) followed.carried[k] = (double)(last.raw[k] - first.raw[k]) / play->length;
    } else if (play->loops && play->length > 0) {
        const double first = followed_at(&followed, play->first);
        followed.drift = (followed_at(&followed, play->first + play->length) - first) / play->length;
        followed.seen = 0;
    }
    double mean = 0;
    for (int n = 0; n < MEAN_STEPS && motion->of != MOTION_BASE; n++)
        mean += followed_at(&followed, play->first + play->length * n / MEAN_STEPS);
    mean /= MEAN_STEPS;
    for (int s = 1 - substeps; s < substeps - 1; s++) sample_raw(&smoothing, document, &followed, s);
    for (int s = 0; s < count; s++) {
        if (period && s >= period) {
            samples[s] = samples[s - period];
            continue;
        }
        sample_raw(&smoothing, document, &followed, s + substeps - 1);
        double sum = 0;
        for (int k = 1 - substeps; k < substeps; k++) sum += (substeps - abs(k)) * *smoothing_at(&smoothing, s + k);
        samples[s] = sum / substeps / substeps - mean;
    }
    if (motion->of != MOTION_BASE) return true;
    const bool closes = period > 0 && period < count;
    sum_twice(samples, closes ? period : count, closes);
    for (int s = closes ? period : count; s < count; s++) samples[s] = samples[s - period];
    return true;
}

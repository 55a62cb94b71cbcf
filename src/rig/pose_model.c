/// Poses an imported character, or a tail's fox: its clip, and the bends on top.
#include "maths/maths.h"
#include "model/fox.h"
#include "model/vector.h"
#include "rig/posing_kind.h"
#include "rig/strand.h"
#include <math.h>

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
    if (clip < 0) {
        gltf_pose_clip(gltf, clip, 0, pose);
        return pose;
    }
    const struct clip_play play = clip_play(&document->rigs[rig]->model, &gltf->clips[clip]);
    gltf_pose_loop(gltf, clip, posing_clip_time(document, position, &play), pose);
    return pose;
}

/// The lowest point at rest is at the rig's position.
void posing_root(const struct posing *posing, int rig, const struct by_hand *by_hand, double root[12])
{
    const struct document *document = posing->document;
    const struct model_rig *model = &document->rigs[rig]->model;
    const struct imported *imported = models_imported(posing->models, document, rig);
    const double turn = radians(model->turn);
    const double c = model->scale * maths_cos(turn), s = model->scale * maths_sin(turn);
    const double columns[9] = {c, 0, -s, 0, model->scale, 0, s, 0, c};
    memcpy(root, columns, sizeof columns);
    posing_base(posing, rig, by_hand, root + 9);
    for (int k = 0; k < 3; k++) root[9 + k] += model->position[k];
    root[10] -= model->scale * (double)imported->gltf.lo[1];
}

/// Moves the fox's body, and finds its place, as posing_root() does.
static float place_fox(const struct posing *posing, int rig, double position, const struct by_hand *by_hand,
                       struct gltf_pose *pose, double root[12])
{
    const struct tail *tail = &posing->document->rigs[rig]->tail;
    const double scale = tail->length / (double)FOX_TAIL_LENGTH;
    const double columns[9] = {scale, 0, 0, 0, scale, 0, 0, 0, scale};
    wiggly_value values[RIG_MAX_INPUTS];
    posing_values(posing, rig, position, by_hand, values);
    memcpy(root, columns, sizeof columns);
    const struct limbs limbs = tail_base(posing, rig, position, values, by_hand, root + 9);
    fox_move(&limbs, pose);
    return tail_ground(tail);
}

bool rig_pose_body(const struct posing *posing, int rig, double position, const struct by_hand *by_hand,
                   struct rig_pose *posed)
{
    const struct document *document = posing->document;
    const bool is_tail = document->rigs[rig]->kind == RIG_TAIL;
    if (!is_tail && document->rigs[rig]->kind != RIG_MODEL) return rig_pose(posing, rig, position, by_hand, posed);
    struct gltf_pose *pose = posing_clip(posing, rig, position, posing->memory);
    wiggly_value values[RIG_MAX_INPUTS];
    struct strand strand;
    double root[12];
    if (!pose) return false;
    for (int r = 0; r < document->rig_count; r++) {
        if (!strand_find(posing, rig, r, &strand)) continue;
        posing_values(posing, r, position, r == rig ? by_hand : NULL, values);
        strand_bend(&strand, values, posing->look, pose);
    }
    posed->kind = RIG_MODEL;
    posed->model.imported = models_imported(posing->models, document, rig);
    posed->model.pose = pose;
    if (is_tail) {
        posed->model.ground = place_fox(posing, rig, position, by_hand, pose, root);
    } else {
        posed->model.ground = (float)document->rigs[rig]->model.position[1];
        posing_root(posing, rig, by_hand, root);
    }
    gltf_pose_world(&posed->model.imported->gltf, pose);
    for (int k = 0; k < 16; k++) posed->model.root[k] = k % 4 == 3 ? k == 15 : (float)root[3 * (k / 4) + k % 4];
    return true;
}

static void bounds(const struct rig_pose *posed, float lo[3], float hi[3])
{
    const struct imported *imported = posed->model.imported;
    vec3 box[2];
    gltf_bounds_at(&imported->bounds, &imported->gltf, posed->model.pose, box[0], box[1]);
    mat4s root = mat4_from(posed->model.root);
    glm_aabb_transform(box, root.raw, box);
    memcpy(lo, box[0], sizeof box[0]);
    memcpy(hi, box[1], sizeof box[1]);
}

const struct posing_functions model_posing = {rig_pose_body, bounds, NULL};

/// Poses an imported character: its clip, and its chains on top.
#include "model/vector.h"
#include "rig/posing_kind.h"
#include "rig/strand.h"
#include <math.h>

double posing_clip_time(const struct document *document, double position, double duration)
{
    const double frame = document->first_frame + position / document->substeps;
    const double time = duration > 0 ? fmod(frame / document->fps, duration) : 0;
    return time < 0 ? time + duration : time;
}

/// The pose of a model's clip, in the memory for what is shown or that for all else; NULL: there is no such model.
static struct gltf_pose *pose_clip(const struct posing *posing, int rig, double position, bool shown)
{
    const struct document *document = posing->document;
    const int number = rig < 0 ? 0 : document_rig_number(document, rig);
    const struct imported *imported = rig < 0 ? NULL : models_imported(posing->models, number);
    if (!imported) return NULL;
    struct gltf_pose *pose = models_pose(posing->models, number, shown);
    const struct gltf *gltf = &imported->gltf;
    const char *name = document->rigs[rig]->model.clip;
    const int clip = name && !posing->at_rest ? gltf_find_clip(gltf, name) : -1;
    gltf_pose_clip(gltf, clip, clip < 0 ? 0 : posing_clip_time(document, position, gltf->clips[clip].duration), pose);
    return pose;
}

struct gltf_pose *posing_clip(const struct posing *posing, int rig, double position)
{
    return pose_clip(posing, rig, position, false);
}

/// Its lowest point at rest stands on the rig's position.
void posing_root(const struct posing *posing, int rig, const struct by_hand *by_hand, double root[12])
{
    const struct document *document = posing->document;
    const struct model_rig *model = &document->rigs[rig]->model;
    const struct imported *imported = models_imported(posing->models, document_rig_number(document, rig));
    const double turn = model->turn * 3.14159265358979323846 / 180.0;
    const double c = model->scale * cos(turn), s = model->scale * sin(turn);
    const double columns[9] = {c, 0, -s, 0, model->scale, 0, s, 0, c};
    memcpy(root, columns, sizeof columns);
    posing_base(posing, rig, by_hand, root + 9);
    for (int k = 0; k < 3; k++) root[9 + k] += model->position[k];
    root[10] -= model->scale * (double)imported->gltf.lo[1];
}

bool posing_model(const struct posing *posing, int rig, double position, int hand, const struct by_hand *by_hand,
                  struct rig_pose *posed)
{
    const struct document *document = posing->document;
    struct gltf_pose *pose = pose_clip(posing, rig, position, posing->shown);
    wiggly_value values[RIG_MAX_INPUTS];
    struct strand strand;
    double root[12];
    if (!pose) return false;
    const struct imported *imported = models_imported(posing->models, document_rig_number(document, rig));
    for (int r = 0; r < document->rig_count; r++) {
        if (!strand_find(posing, rig, r, &strand)) continue;
        posing_values(posing, r, position, r == hand ? by_hand : NULL, values);
        strand_bend(&strand, values, posing->look, pose);
    }
    gltf_pose_world(&imported->gltf, pose);
    posed->kind = RIG_MODEL;
    posed->model.imported = imported;
    posed->model.pose = pose;
    posed->model.ground = (float)document->rigs[rig]->model.position[1];
    posing_root(posing, rig, rig == hand ? by_hand : NULL, root);
    for (int k = 0; k < 16; k++) posed->model.root[k] = k % 4 == 3 ? k == 15 : (float)root[3 * (k / 4) + k % 4];
    return true;
}

static bool pose(const struct posing *posing, int rig, double position, const wiggly_value *values,
                 const struct by_hand *by_hand, struct rig_pose *posed)
{
    (void)values;
    return posing_model(posing, rig, position, rig, by_hand, posed);
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

const struct posing_functions model_posing = {pose, bounds};

/// Poses an imported character: its clip, and its chains on top.
#include "model/vector.h"
#include "rig/chain_bones.h"
#include "rig/posing_kind.h"
#include <math.h>

double posing_clip_time(const struct document *document, double position, double duration)
{
    const double frame = document->first_frame + position / document->substeps;
    const double time = duration > 0 ? fmod(frame / document->fps, duration) : 0;
    return time < 0 ? time + duration : time;
}

static bool is_of(const struct document *document, const struct rig *chain, int model)
{
    return chain->kind == RIG_CHAIN &&
           document_find_model(document, chain->chain.model, chain->chain.by_file) == model;
}

/// Bends a chain; one that its model lacks is left out.
static void add_chain(const struct posing *posing, const struct imported *imported, int rig, double position,
                      const struct by_hand *by_hand, struct gltf_pose *pose)
{
    const struct chain *chain = &posing->document->rigs[rig]->chain;
    struct chain_bones bones;
    wiggly_value values[RIG_MAX_INPUTS];
    if (!chain_find(&imported->gltf, chain->from, chain->to, &bones, NULL)) return;
    posing_values(posing, rig, position, by_hand, values);
    chain_bend(imported, chain, &bones, values, posing->look, pose);
}

/// Where it stands: its lowest point at rest on the rig's position.
static void place(const struct model_rig *rig, const struct imported *imported, const double moved[3], float root[16])
{
    const float scale = (float)rig->scale;
    vec3s at = {.raw = {0, -scale * imported->gltf.lo[1], 0}};
    for (int k = 0; k < 3; k++) at.raw[k] += (float)(rig->position[k] + moved[k]);
    const mat4s turned = glms_rotate_y(glms_translate_make(at), (float)(rig->turn * 3.14159265358979323846 / 180.0));
    const mat4s scaled = glms_scale_uni(turned, scale);
    memcpy(root, scaled.raw, sizeof scaled.raw);
}

bool posing_model(const struct posing *posing, int rig, double position, int hand, const struct by_hand *by_hand,
                  struct rig_pose *posed)
{
    const struct document *document = posing->document;
    const struct model_rig *model = &document->rigs[rig]->model;
    const int number = document_rig_number(document, rig);
    const struct imported *imported = models_imported(posing->models, number);
    struct gltf_pose *pose = models_pose(posing->models, number, posing->shown);
    if (!imported || !pose) return false;
    const struct gltf *gltf = &imported->gltf;
    const int clip = model->clip ? gltf_find_clip(gltf, model->clip) : -1;
    gltf_pose_clip(gltf, clip, clip < 0 ? 0 : posing_clip_time(document, position, gltf->clips[clip].duration), pose);
    for (int r = 0; r < document->rig_count; r++) {
        if (is_of(document, document->rigs[r], rig))
            add_chain(posing, imported, r, position, r == hand ? by_hand : NULL, pose);
    }
    gltf_pose_world(gltf, pose);
    posed->kind = RIG_MODEL;
    posed->model.imported = imported;
    posed->model.pose = pose;
    posed->model.ground = (float)model->position[1];
    double moved[3];
    posing_base(posing, rig, rig == hand ? by_hand : NULL, moved);
    place(model, imported, moved, posed->model.root);
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

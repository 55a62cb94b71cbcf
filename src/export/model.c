/// An imported character as a form in its file's space: its vertices, and its moving nodes as joints.
#include "export/form.h"
#include "rig/imported.h"
#include <string.h>

static void add_joint(struct form *form, int node)
{
    struct model_body *body = form->owned;
    if (body->joint_of[node] >= 0) return;
    body->joint_of[node] = form->joint_count;
    body->node[form->joint_count++] = node;
}

/// Adds the bones of all chains on the rig.
static bool add_bones(struct form *form, const struct document *document, int rig, struct error *error)
{
    struct model_body *body = form->owned;
    for (int r = -1; (r = document_next_chain(document, rig, r)) >= 0;) {
        const struct chain *chain = &document->rigs[r]->chain;
        struct chain_bones bones;
        if (!chain_find(body->gltf, chain->from, chain->to, &bones, error)) return false;
        for (int n = 0; n < bones.count; n++) add_joint(form, bones.node[n]);
    }
    body->bone_count = form->joint_count;
    return true;
}

static bool open(const struct posing *posing, int rig, const struct rig_pose *pose, struct form *form,
                 struct error *error)
{
    const struct model_rig *model = &posing->document->rigs[rig]->model;
    const struct gltf *gltf = &pose->model.imported->gltf;
    const int clip = gltf_find_clip(gltf, model->clip);
    const size_t nodes = (size_t)gltf->node_count;
    struct model_body *body = form->owned = pool_take(&form->pool, 1, sizeof *body);
    body->gltf = gltf;
    body->clip = clip >= 0 ? &gltf->clips[clip] : NULL;
    body->node = pool_take(&form->pool, nodes, sizeof *body->node);
    body->joint_of = pool_take(&form->pool, nodes, sizeof *body->joint_of);
    form->joints = pool_take(&form->pool, nodes, sizeof *form->joints);
    for (size_t n = 0; n < nodes; n++) body->joint_of[n] = -1;
    if (!add_bones(form, posing->document, rig, error)) return false;
    for (int c = 0; body->clip && c < body->clip->channel_count; c++) {
        if (body->clip->channels[c].path != GLTF_WEIGHTS) add_joint(form, body->clip->channels[c].node);
    }
    form->target_count = gltf->weight_count;
    for (int n = 0; n < gltf->node_count; n++) {
        const int count = gltf_vertex_count(gltf, n);
        if (count > 0) form->holder = form->vertex_count == 0 ? n : -1;
        form->vertex_count += count;
    }
    return true;
}

static void key(const struct form *form, const struct rig_pose *pose, struct form_key *key)
{
    const struct model_body *body = form->owned;
    const struct gltf_pose *now = pose->model.pose;
    memset(key->translation, 0, sizeof key->translation);
    for (int j = 0; j < form->joint_count; j++) {
        const struct gltf_place *place = &now->place[body->node[j]];
        memcpy(key->offset[j], place->translation, sizeof place->translation);
        memcpy(key->rotation[j], place->rotation, sizeof place->rotation);
        memcpy(key->scale[j], place->scale, sizeof place->scale);
    }
    memcpy(key->weight, now->weights, (size_t)form->target_count * sizeof *key->weight);
}

/// Node by node.
static void vertices(const struct form *form, const struct rig_pose *pose, float (*positions)[3])
{
    const struct gltf *gltf = &pose->model.imported->gltf;
    (void)form;
    for (int n = 0; n < gltf->node_count; n++) {
        const int count = gltf_vertex_count(gltf, n);
        if (count > 0) gltf_pose_vertices(gltf, pose->model.pose, n, positions, NULL);
        positions += count;
    }
}

/// Its chains have the columns of a table; its own clip has none.
const struct form_kind model_form = {FORM_FILE | FORM_POINTS | FORM_JOINTS, open, key, vertices, NULL};

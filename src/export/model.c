/// An imported character as a form in its file's space: its vertices, and the bones of its chains as joints.
#include "export/form.h"
#include "rig/models.h"
#include <string.h>

/// Adds the bones of all chains on the rig.
static bool add_bones(struct form *form, const struct document *document, int rig, struct error *error)
{
    struct model_body *body = form->owned;
    for (int r = -1; (r = document_next_chain(document, rig, r)) >= 0;) {
        const struct chain *chain = &document->rigs[r]->chain;
        struct chain_bones bones;
        if (!chain_find(body->gltf, chain->from, chain->to, &bones, error)) return false;
        for (int n = 0; n < bones.count; n++) {
            bool is_new = true;
            for (int j = 0; j < form->joint_count; j++) is_new = is_new && body->node[j] != bones.node[n];
            if (is_new) body->node[form->joint_count++] = bones.node[n];
        }
    }
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
    form->joints = pool_take(&form->pool, nodes, sizeof *form->joints);
    if (!add_bones(form, posing->document, rig, error)) return false;
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
    for (int j = 0; j < form->joint_count; j++)
        memcpy(key->rotation[j], now->place[body->node[j]].rotation, sizeof key->rotation[j]);
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

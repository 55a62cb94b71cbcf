/// A chain as a form: its bones as joints, turned against their rest in the character's own space. The character that it moves is
/// exported as a whole (model.c).
#include "base/need.h"
#include "export/form.h"
#include "model/vector.h"
#include "rig/strand.h"
#include <stdio.h>
#include <stdlib.h>

/// What a chain needs of its model.
struct source {
    const struct imported *imported;
    struct chain_bones bones;
};

static bool open(const struct posing *posing, int rig, const struct rig_pose *pose, struct form *form,
                 struct error *error)
{
    const struct chain *chain = &posing->document->rigs[rig]->chain;
    const struct imported *imported = pose->model.imported;
    struct source *source = form->owned = need(1, sizeof *source);
    float rest[ANGLES_MAX_JOINTS + 1][3];
    source->imported = imported;
    if (!chain_find(&imported->gltf, chain->from, chain->to, &source->bones, error)) return false;
    chain_points_at_rest(imported, &source->bones, rest);
    form->joint_count = source->bones.count;
    form->joints = need_zeroed((size_t)form->joint_count, sizeof *form->joints);
    for (int n = 0; n < form->joint_count; n++) {
        form->joints[n].parent = n - 1;
        snprintf(form->joints[n].name, FORM_NAME, "%.60s", imported->gltf.nodes[source->bones.node[n]].name);
        for (int k = 0; k < 3; k++) form->joints[n].offset[k] = n > 0 ? rest[n][k] - rest[n - 1][k] : 0;
    }
    for (int k = 0; k < 3; k++) form->tip[k] = rest[form->joint_count][k] - rest[form->joint_count - 1][k];
    return true;
}

static void close(struct form *form)
{
    free(form->joints);
    free(form->owned);
}

/// How a bone is turned from its rest, in the character's space.
static versors turn_of(const struct imported *imported, const struct gltf_pose *pose, int node)
{
    const mat4s rest = mat4_from(imported->rest.world[node]), now = mat4_from(pose->world[node]);
    mat3s turned = glms_mat3_mul(glms_mat4_pick3(now), mat3_inverse(glms_mat4_pick3(rest)));
    for (int k = 0; k < 3; k++) glm_vec3_normalize(turned.raw[k]);
    return glms_mat3_quat(turned);
}

static void key(const struct form *form, const struct rig_pose *pose, struct form_key *key)
{
    const struct source *source = form->owned;
    const struct gltf_pose *now = pose->model.pose;
    versors before = glms_quat_identity();
    memcpy(key->translation, now->world[source->bones.node[0]] + 12, sizeof key->translation);
    for (int n = 0; n < form->joint_count; n++) {
        const versors turn = turn_of(source->imported, now, source->bones.node[n]);
        const versors own = glms_quat_mul(glms_quat_inv(before), turn);
        memcpy(key->rotation[n], own.raw, sizeof key->rotation[n]);
        before = turn;
    }
}

const struct form_kind chain_form = {
    .holds = FORM_JOINTS, .open = open, .close = close, .key = key, .columns = form_channels};

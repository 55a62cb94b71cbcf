/// The skeleton of an imported character as a form: every bone with its clip and its chains, turned against its rest in the
/// character's own space, so that bones at rest are not turned.
#include "base/need.h"
#include "export/form.h"
#include "model/vector.h"
#include "rig/imported.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const float STILL = 1e-6f; ///< of the character's size: rounding

/// All zero but what it is made of.
struct source {
    const struct imported *imported;
    int *node;     ///< of each joint; −1: it holds several skeletons together, and stands at the origin
    versors *turn; ///< of each joint, at the key that is being made
    float still;
};

static const float *rest_place(const struct source *source, int joint)
{
    static const float origin[3];
    const int node = source->node[joint];
    return node < 0 ? origin : source->imported->rest.world[node] + 12;
}

static void name_joint(struct form *form, int joint, const char *name)
{
    char *own = form->joints[joint].name;
    snprintf(own, FORM_NAME, "%.48s", name);
    for (int j = 0, number = joint; j < joint; j++) {
        if (strcmp(form->joints[j].name, own) != 0) continue;
        snprintf(own, FORM_NAME, "%.48s_%d", name, number++);
        j = -1;
    }
}

static void add_joint(struct form *form, int node, int parent)
{
    struct source *source = form->owned;
    const int j = form->joint_count++;
    struct form_joint *joint = &form->joints[j];
    source->node[j] = node;
    joint->parent = parent;
    name_joint(form, j, node < 0 ? form->name : source->imported->gltf.nodes[node].name);
    for (int k = 0; k < 3 && parent >= 0; k++)
        joint->offset[k] = rest_place(source, j)[k] - rest_place(source, parent)[k];
}

/// The node after this one in the order in which a file of joints nests them; −1: it is the last.
static int next_node(const struct gltf *gltf, int node)
{
    if (gltf->nodes[node].child >= 0) return gltf->nodes[node].child;
    while (node >= 0 && gltf->nodes[node].next < 0) node = gltf->nodes[node].parent;
    return node < 0 ? -1 : gltf->nodes[node].next;
}

/// The joint of the nearest bone above a node; −1: there is none.
static int joint_above(const struct gltf *gltf, int node, const int *joint_of)
{
    do node = gltf->nodes[node].parent;
    while (node >= 0 && joint_of[node] < 0);
    return node < 0 ? -1 : joint_of[node];
}

/// Marks bones by 0, all other nodes by −1. How many bones have none above them?
static int mark_bones(const struct imported *imported, int *joint_of)
{
    const struct gltf *gltf = &imported->gltf;
    int tops = 0;
    for (int n = 0; n < gltf->node_count; n++) joint_of[n] = -1;
    for (int b = 0; b < imported->skeleton.count; b++) {
        const struct bone *bone = &imported->skeleton.bones[b];
        joint_of[bone->node] = 0;
        if (bone->child >= 0) joint_of[bone->child] = 0;
    }
    for (int n = 0; n < gltf->node_count; n++) tops += joint_of[n] == 0 && joint_above(gltf, n, joint_of) < 0;
    return tops;
}

static void add_joints(struct form *form, int *joint_of)
{
    const struct imported *imported = ((struct source *)form->owned)->imported;
    const struct gltf *gltf = &imported->gltf;
    if (mark_bones(imported, joint_of) > 1) add_joint(form, -1, -1);
    const int top = form->joint_count - 1;
    for (int root = 0; root < gltf->node_count; root++) {
        if (gltf->nodes[root].parent >= 0) continue;
        for (int n = root; n >= 0; n = next_node(gltf, n)) {
            if (joint_of[n] < 0) continue;
            const int above = joint_above(gltf, n, joint_of);
            joint_of[n] = form->joint_count;
            add_joint(form, n, above < 0 ? top : above);
        }
    }
    for (int b = 0; b < imported->skeleton.count; b++) {
        const struct bone *bone = &imported->skeleton.bones[b];
        float ends[2][3];
        if (bone->child >= 0) continue;
        skeleton_ends(bone, &imported->rest, ends);
        for (int k = 0; k < 3; k++) form->joints[joint_of[bone->node]].tip[k] = ends[1][k] - ends[0][k];
    }
}

static bool open(const struct posing *posing, int rig, const struct rig_pose *pose, struct form *form,
                 struct error *error)
{
    const struct imported *imported = pose->model.imported;
    const size_t most = (size_t)imported->gltf.node_count + 1;
    struct source *source = form->owned = need_zeroed(1, sizeof *source);
    int *joint_of = need(most, sizeof *joint_of);
    source->imported = imported;
    source->node = need(most, sizeof *source->node);
    source->turn = need(most, sizeof *source->turn);
    for (int k = 0; k < 3; k++)
        source->still = fmaxf(source->still, STILL * (imported->gltf.hi[k] - imported->gltf.lo[k]));
    form->joints = need_zeroed(most, sizeof *form->joints);
    add_joints(form, joint_of);
    free(joint_of);
    return form->joint_count > 0 ||
           fail(error, ERROR_INPUT, "\"%s\" has no bones", rig_title(posing->document->rigs[rig]));
}

static void close(struct form *form)
{
    struct source *source = form->owned;
    if (source) {
        free(source->node);
        free(source->turn);
    }
    free(source);
    free(form->joints);
}

/// How a bone is turned from its rest, in the character's space.
static versors turn_of(const struct imported *imported, const struct gltf_pose *pose, int node)
{
    if (node < 0) return glms_quat_identity();
    const mat4s rest = mat4_from(imported->rest.world[node]), now = mat4_from(pose->world[node]);
    mat3s turned = glms_mat3_mul(glms_mat4_pick3(now), mat3_inverse(glms_mat4_pick3(rest)));
    for (int k = 0; k < 3; k++) glm_vec3_normalize(turned.raw[k]);
    return glms_quat_normalize(glms_mat3_quat(turned)); // uneven scales shear it
}

static void key(const struct form *form, const struct rig_pose *pose, struct form_key *key)
{
    const struct source *source = form->owned;
    const struct gltf_pose *now = pose->model.pose;
    const float origin[3] = {0};
    for (int j = 0; j < form->joint_count; j++) {
        const int node = source->node[j], parent = form->joints[j].parent;
        const int above = parent < 0 ? -1 : source->node[parent];
        const versors back = parent < 0 ? glms_quat_identity() : glms_quat_inv(source->turn[parent]);
        source->turn[j] = turn_of(source->imported, now, node);
        const versors own = glms_quat_mul(back, source->turn[j]);
        const vec3s from = vec3_from(above < 0 ? origin : now->world[above] + 12);
        const vec3s place = vec3_from(node < 0 ? origin : now->world[node] + 12);
        const vec3s offset = glms_quat_rotatev(back, glms_vec3_sub(place, from));
        memcpy(key->rotation[j], own.raw, sizeof key->rotation[j]);
        if (parent < 0) {
            memcpy(key->translation, place.raw, sizeof key->translation);
        } else if (glms_vec3_distance(offset, vec3_from(form->joints[j].offset)) > source->still) {
            memcpy(key->offset[j], offset.raw, sizeof key->offset[j]);
        }
    }
}

const struct form_kind skeleton_form = {.holds = FORM_JOINTS, .open = open, .close = close, .key = key};

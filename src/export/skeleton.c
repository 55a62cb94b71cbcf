/// The skeleton of an imported character as a form: every bone with its clip and its chains, relative to its rest in the character's space,
/// so that bones at rest are not turned. The first joint is the character's origin, and holds the bones that have none above them.
#include "export/form.h"
#include "model/vector.h"
#include "rig/models.h"
#include <stdio.h>
#include <string.h>

enum { ORIGIN = 0, NO_JOINT = -1, TO_ADD = -2 };

static const float STILL = 1e-6f; ///< rounding, as a share of the character's size

struct source {
    const struct imported *imported;
    int *joint_of; ///< of each node, or NO_JOINT
    int *node;     ///< of each joint but the origin
    versors *turn; ///< of each joint, at the key being made
    float still;   ///< bones that move less do not move
};

static vec3s place_of(const struct source *source, const struct gltf_pose *pose, int joint)
{
    return joint == ORIGIN ? glms_vec3_zero() : vec3_from(pose->world[source->node[joint]] + 12);
}

static int add_joint(struct form *form, int node, int parent)
{
    struct source *source = form->owned;
    const struct gltf_pose *rest = &source->imported->rest;
    const char *name = source->imported->gltf.nodes[node].name;
    const int j = form->joint_count;
    struct form_joint *joint = &form->joints[j];
    joint->name = names_add(&form->names, form_word(&form->pool, name));
    source->node[j] = node;
    source->joint_of[node] = j;
    joint->parent = parent;
    const vec3s offset = glms_vec3_sub(place_of(source, rest, j), place_of(source, rest, parent));
    memcpy(joint->offset, offset.raw, sizeof joint->offset);
    return form->joint_count++;
}

/// Adds the bones among a node, those beside it, and all below.
static void add_joints(struct form *form, int node, int above)
{
    const struct source *source = form->owned;
    for (; node >= 0; node = source->imported->gltf.nodes[node].next) {
        const int joint = source->joint_of[node] == TO_ADD ? add_joint(form, node, above) : above;
        add_joints(form, source->imported->gltf.nodes[node].child, joint);
    }
}

static void add_skeleton(struct form *form)
{
    const struct source *source = form->owned;
    const struct gltf *gltf = &source->imported->gltf;
    const struct skeleton *skeleton = &source->imported->skeleton;
    float ends[2][3];
    int tops = 0;
    for (int n = 0; n < gltf->node_count; n++) source->joint_of[n] = NO_JOINT;
    for (int b = 0; b < skeleton->count; b++) {
        source->joint_of[skeleton->bones[b].node] = TO_ADD;
        if (skeleton->bones[b].child >= 0) source->joint_of[skeleton->bones[b].child] = TO_ADD;
    }
    form->joints[ORIGIN].parent = -1;
    form->joint_count = 1;
    for (int n = 0; n < gltf->node_count; n++)
        if (gltf->nodes[n].parent < 0) add_joints(form, n, ORIGIN);
    form->joints[ORIGIN].name = names_add(&form->names, form_word(&form->pool, form->name));
    for (int j = 1; j < form->joint_count; j++) tops += form->joints[j].parent == ORIGIN;
    form->first_bone = tops == 1 ? 1 : ORIGIN; // a single one needs none to hold it
    for (int b = 0; b < skeleton->count; b++) {
        if (skeleton->bones[b].child >= 0) continue;
        skeleton_ends(&skeleton->bones[b], &source->imported->rest, ends);
        glm_vec3_sub(ends[1], ends[0], form->joints[source->joint_of[skeleton->bones[b].node]].tip);
    }
}

static bool open(const struct posing *posing, int rig, const struct rig_pose *pose, struct form *form,
                 struct error *error)
{
    const struct gltf *gltf = &pose->model.imported->gltf;
    const size_t most = (size_t)gltf->node_count + 1;
    struct source *source = form->owned = pool_take(&form->pool, 1, sizeof *source);
    *source = (struct source){.imported = pose->model.imported,
                              .joint_of = pool_take(&form->pool, most, sizeof *source->joint_of),
                              .node = pool_take(&form->pool, most, sizeof *source->node),
                              .turn = pool_take(&form->pool, most, sizeof *source->turn)};
    for (int k = 0; k < 3; k++) source->still = fmaxf(source->still, STILL * (gltf->hi[k] - gltf->lo[k]));
    form->joints = pool_take(&form->pool, most, sizeof *form->joints);
    form->names.between = "_";
    add_skeleton(form);
    return form->joint_count > 1 ||
           fail(error, ERROR_INPUT, "\"%s\" has no bones", rig_title(posing->document->rigs[rig]));
}

/// How a bone is turned from its rest, in the character's space.
static versors turn_of(const struct imported *imported, const struct gltf_pose *pose, int node)
{
    const mat4s rest = mat4_from(imported->rest.world[node]), now = mat4_from(pose->world[node]);
    mat3s turned = glms_mat3_mul(glms_mat4_pick3(now), mat3_inverse(glms_mat4_pick3(rest)));
    for (int k = 0; k < 3; k++) glm_vec3_normalize(turned.raw[k]);
    return glms_quat_normalize(glms_mat3_quat(turned)); // uneven scales shear it
}

static void key(const struct form *form, const struct rig_pose *pose, struct form_key *key)
{
    const struct source *source = form->owned;
    const struct gltf_pose *now = pose->model.pose;
    source->turn[ORIGIN] = glms_quat_identity();
    for (int j = ORIGIN; j < form->joint_count; j++) {
        const int parent = j == ORIGIN ? ORIGIN : form->joints[j].parent;
        const versors back = glms_quat_inv(source->turn[parent]);
        if (j != ORIGIN) source->turn[j] = turn_of(source->imported, now, source->node[j]);
        const versors own = glms_quat_mul(back, source->turn[j]);
        const vec3s place = place_of(source, now, j);
        const vec3s offset = glms_quat_rotatev(back, glms_vec3_sub(place, place_of(source, now, parent)));
        memcpy(key->rotation[j], own.raw, sizeof key->rotation[j]);
        if (j == form->first_bone) memcpy(key->translation, place.raw, sizeof key->translation);
        if (glms_vec3_distance(offset, vec3_from(form->joints[j].offset)) > source->still)
            memcpy(key->offset[j], offset.raw, sizeof key->offset[j]);
    }
}

const struct form_kind skeleton_form = {.holds = FORM_JOINTS, .open = open, .key = key};

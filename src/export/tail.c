/// A tail as a form: the fox, skinned to the tail's joints.
#include "base/need.h"
#include "export/form.h"
#include "model/creature.h"
#include "model/tail_skin.h"
#include "model/vector.h"
#include <stdio.h>
#include <stdlib.h>

_Static_assert((int)TAIL_INFLUENCES == (int)FORM_INFLUENCES, "a vertex of the fox fits");

/// The fox at the size of its tail.
struct fox {
    struct mesh mesh;
    float (*position)[3], (*normal)[3], (*color)[3];
};

enum {
    FIRST_LIMB = 1,
    FIRST_BONE = FIRST_LIMB + LIMBS
}; ///< of the joints: what carries all, the body's parts, the tail

static int joint_of_slot(int slot, int joints)
{
    if (slot == 0) return FIRST_LIMB;
    return slot <= joints ? FIRST_BONE + slot - 1 : FIRST_LIMB + slot - joints;
}

/// Copies what files want apart, scaled to the tail's length.
static void copy_vertices(struct form *form, struct fox *fox, int joints, float length)
{
    const float scale = length / CREATURE_TAIL_LENGTH;
    for (int i = 0; i < fox->mesh.vertex_count; i++) {
        const struct vertex *vertex = &fox->mesh.vertices[i];
        for (int k = 0; k < 3; k++) fox->position[i][k] = scale * vertex->position[k];
        const vec3s normal = glms_vec3_normalize(vec3_from(vertex->normal));
        memcpy(fox->normal[i], normal.raw, sizeof fox->normal[i]);
        memcpy(fox->color[i], vertex->color, sizeof fox->color[i]);
        tail_influences(vertex, joints, CREATURE_TAIL_LENGTH / (float)joints, form->slots[i], form->weights[i]);
        for (int n = 0; n < TAIL_INFLUENCES; n++) {
            const bool hangs = form->weights[i][n] > 0.0f;
            form->slots[i][n] = hangs ? (uint16_t)joint_of_slot(form->slots[i][n], joints) : 0;
        }
    }
}

/// The joint that carries the animal, those of its body's parts, and those of the tail.
static void name_joints(struct form *form, int joints, const struct rig_pose *pose)
{
    static const char *const names[LIMBS] = {"body", "chest", "head", "ear_l", "ear_r", "ear_tip_l", "ear_tip_r"};
    const float length = pose_length(&pose->tail), segment = length / (float)joints;
    float pivot[LIMBS][3];
    form->joints[0] = (struct form_joint){.parent = -1};
    snprintf(form->joints[0].name, FORM_NAME, "%.50s_base", form->name);
    form->tip[2] = segment;
    memcpy(form->joints[0].offset, pose->tail.matrix[0] + 12, 3 * sizeof(float));
    limbs_pivots(length / CREATURE_TAIL_LENGTH, pivot);
    for (int l = 0; l < LIMBS; l++) {
        struct form_joint *joint = &form->joints[FIRST_LIMB + l];
        const int parent = limb_parents[l];
        joint->parent = parent < 0 ? 0 : FIRST_LIMB + parent;
        for (int k = 0; k < 3; k++) {
            joint->bind[k] = pivot[l][k];
            joint->offset[k] = pivot[l][k] - (parent < 0 ? 0 : pivot[parent][k]);
        }
        snprintf(joint->name, FORM_NAME, "%.50s_%s", form->name, names[l]);
    }
    for (int n = 0; n < joints; n++) {
        struct form_joint *joint = &form->joints[FIRST_BONE + n];
        *joint = (struct form_joint){.parent = n > 0 ? FIRST_BONE + n - 1 : 0,
                                     .offset = {0, 0, n > 0 ? segment : 0},
                                     .bind = {0, 0, (float)n * segment}};
        snprintf(joint->name, FORM_NAME, "%.50s_%d", form->name, n);
    }
}

static bool open(const struct posing *posing, int rig, const struct rig_pose *pose, struct form *form,
                 struct error *error)
{
    const struct document *document = posing->document;
    const int joints = document->rigs[rig]->tail.joints;
    (void)error;
    struct fox *fox = form->owned = need_zeroed(1, sizeof *fox);
    mesh_creature(creature_level(document_count_rigs(document, RIG_TAIL)), &fox->mesh);
    const size_t count = (size_t)fox->mesh.vertex_count + 1;
    fox->position = need(count, sizeof *fox->position);
    fox->normal = need(count, sizeof *fox->normal);
    fox->color = need(count, sizeof *fox->color);
    form->slots = need(count, sizeof *form->slots);
    form->weights = need(count, sizeof *form->weights);
    form->joints = need_zeroed((size_t)(FIRST_BONE + joints), sizeof *form->joints);
    form->vertex_count = fox->mesh.vertex_count;
    form->position = (const float(*)[3])fox->position;
    form->normal = (const float(*)[3])fox->normal;
    form->color = (const float(*)[3])fox->color;
    form->indices = fox->mesh.indices;
    form->index_count = fox->mesh.index_count;
    form->joint_count = FIRST_BONE + joints;
    form->first_bone = FIRST_BONE;
    copy_vertices(form, fox, joints, pose_length(&pose->tail));
    name_joints(form, joints, pose);
    return true;
}

static void close(struct form *form)
{
    struct fox *fox = form->owned;
    if (fox) {
        mesh_free(&fox->mesh);
        free(fox->position);
        free(fox->normal);
        free(fox->color);
    }
    free(fox);
    free(form->slots);
    free(form->weights);
    free(form->joints);
}

/// The rotation that takes frame `from` to frame `to`: fromᵀ · to. What is bent by half a turn or more between two joints too.
static void rotation_between(const float from[16], const float to[16], float rotation[4])
{
    mat4s a = mat4_from(from), b = mat4_from(to);
    glm_vec3_zero(a.raw[3]);
    glm_vec3_zero(b.raw[3]);
    const versors q = glms_mat4_quat(glms_mat4_mul(glms_mat4_transpose(a), b));
    const versors unit = glms_quat_normalize(q);
    memcpy(rotation, unit.raw, 4 * sizeof *rotation);
}

static void key(const struct form *form, const struct rig_pose *pose, struct form_key *key)
{
    static const float upright[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    memcpy(key->translation, pose->tail.matrix[0] + 12, sizeof key->translation);
    memcpy(key->rotation[0], (const float[]){0, 0, 0, 1}, sizeof key->rotation[0]);
    limbs_motions(&pose->tail.limbs, key->rotation + FIRST_LIMB, key->scale + FIRST_LIMB);
    for (int n = 0; FIRST_BONE + n < form->joint_count; n++)
        rotation_between(n > 0 ? pose->tail.matrix[n - 1] : upright, pose->tail.matrix[n],
                         key->rotation[FIRST_BONE + n]);
}

static void vertices(const struct form *form, const struct rig_pose *pose, float (*positions)[3])
{
    const struct fox *fox = form->owned;
    tail_skin(&pose->tail, &fox->mesh, positions, NULL);
}

static void columns(const struct export_range *range, int rig, const struct rig_pose *pose, double key,
                    form_column *column, void *user)
{
    const struct tail *tail = &range->posing->document->rigs[rig]->tail;
    (void)pose;
    form_channels(range, rig, tail->channels, tail->channel_count, tail->joints, key, column, user);
}

const struct form_kind tail_form = {FORM_MESH | FORM_JOINTS | FORM_POINTS, open, close, key, vertices, columns};

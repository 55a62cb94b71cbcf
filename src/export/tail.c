/// A tail as a form: the fox, skinned to the tail's joints.
#include "base/need.h"
#include "export/form.h"
#include "model/fox.h"
#include "model/limbs.h"
#include "model/vector.h"
#include <stdio.h>
#include <stdlib.h>

/// The fox, and what is scaled to its tail's length.
struct scaled_fox {
    struct fox fox;
    float (*position)[3], (*normal)[3], (*color)[3];
    uint32_t *indices;
};

enum { FIRST_LIMB = FOX_FIRST_LIMB, FIRST_BONE = FOX_FIRST_JOINT };

/// Appends a part's vertices and triangles; a vertex of ours hangs on four joints at most.
static void add_part(struct form *form, struct scaled_fox *fox, const struct gltf_part *part, float scale)
{
    for (int i = 0; i < part->index_count; i++)
        fox->indices[form->index_count++] = (uint32_t)form->vertex_count + part->indices[i];
    for (int v = 0; v < part->vertex_count; v++) {
        const int at = form->vertex_count++;
        for (int k = 0; k < 3; k++) fox->position[at][k] = scale * part->position[v][k];
        memcpy(fox->normal[at], part->normal[v], sizeof fox->normal[at]);
        memcpy(fox->color[at], part->color[v], sizeof fox->color[at]);
        for (int n = 0; n < FORM_INFLUENCES; n++) {
            form->weights[at][n] = part->weights[v][n];
            form->slots[at][n] = part->weights[v][n] > 0.0f ? (uint16_t)(FIRST_LIMB + part->joints[v][n]) : 0;
        }
    }
}

static void add_mesh(struct form *form, struct scaled_fox *fox, float scale)
{
    const struct gltf_mesh *mesh = fox->fox.gltf.meshes;
    size_t vertices = 1, indices = 1;
    for (int p = 0; p < mesh->part_count; p++) {
        vertices += (size_t)mesh->parts[p].vertex_count;
        indices += (size_t)mesh->parts[p].index_count;
    }
    form->position = (const float(*)[3])(fox->position = need(vertices, sizeof *fox->position));
    form->normal = (const float(*)[3])(fox->normal = need(vertices, sizeof *fox->normal));
    form->color = (const float(*)[3])(fox->color = need(vertices, sizeof *fox->color));
    form->indices = fox->indices = need(indices, sizeof *fox->indices);
    form->slots = need(vertices, sizeof *form->slots);
    form->weights = need(vertices, sizeof *form->weights);
    for (int p = 0; p < mesh->part_count; p++) add_part(form, fox, &mesh->parts[p], scale);
}

/// The joint that carries the animal, those of its body's parts, and those of the tail.
static void name_joints(struct form *form, int joints, const struct rig_pose *pose)
{
    static const char *const names[LIMBS] = {"body", "chest", "head", "ear_l", "ear_r", "ear_tip_l", "ear_tip_r"};
    const float length = pose_length(&pose->strand), segment = length / (float)joints;
    float pivot[LIMBS][3];
    form->joints[0] = (struct form_joint){.parent = -1};
    snprintf(form->joints[0].name, FORM_NAME, "%.50s_base", form->name);
    form->tip[2] = segment;
    memcpy(form->joints[0].offset, pose->strand.matrix[0] + 12, 3 * sizeof(float));
    limbs_pivots(pose_scale(&pose->strand), pivot);
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
    struct scaled_fox *fox = form->owned = need_zeroed(1, sizeof *fox);
    fox_create(fox_level(document_count_rigs(document, RIG_TAIL)), joints, &fox->fox);
    add_mesh(form, fox, pose_scale(&pose->strand));
    form->joints = need_zeroed((size_t)(FIRST_BONE + joints), sizeof *form->joints);
    form->joint_count = FIRST_BONE + joints;
    form->first_bone = FIRST_BONE;
    name_joints(form, joints, pose);
    return true;
}

static void close(struct form *form)
{
    struct scaled_fox *fox = form->owned;
    if (fox) {
        fox_free(&fox->fox);
        free(fox->position);
        free(fox->normal);
        free(fox->color);
        free(fox->indices);
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
    memcpy(key->translation, pose->strand.matrix[0] + 12, sizeof key->translation);
    memcpy(key->rotation[0], (const float[]){0, 0, 0, 1}, sizeof key->rotation[0]);
    limbs_motions(&pose->strand.limbs, key->rotation + FIRST_LIMB, key->scale + FIRST_LIMB);
    for (int n = 0; FIRST_BONE + n < form->joint_count; n++)
        rotation_between(n > 0 ? pose->strand.matrix[n - 1] : upright, pose->strand.matrix[n],
                         key->rotation[FIRST_BONE + n]);
}

static void vertices(const struct form *form, const struct rig_pose *pose, float (*positions)[3])
{
    const struct scaled_fox *fox = form->owned;
    fox_pose(&fox->fox, &pose->strand);
    fox_places(&fox->fox, positions);
}

const struct form_kind tail_form = {FORM_MESH | FORM_JOINTS | FORM_POINTS, open, close, key, vertices, form_channels};

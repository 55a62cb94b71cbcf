/// Poses of glTF characters: the matrices of nodes and joints.
#include "model/gltf.h"
#include "model/vector.h"
#include <stdlib.h>

bool gltf_pose_create(const struct gltf *gltf, struct gltf_pose *pose)
{
    size_t nodes = (size_t)gltf->node_count + 1;
    *pose = (struct gltf_pose){
        .place = calloc(nodes, sizeof *pose->place),
        .world = calloc(nodes, sizeof *pose->world),
        .joints = calloc((size_t)gltf->joint_count + 1, sizeof *pose->joints),
        .weights = calloc((size_t)gltf->weight_count + 1, sizeof *pose->weights),
    };
    if (!pose->place || !pose->world || !pose->joints || !pose->weights) {
        gltf_pose_free(pose);
        return false;
    }
    gltf_pose_clip(gltf, -1, 0, pose);
    gltf_pose_world(gltf, pose);
    return true;
}

void gltf_pose_free(struct gltf_pose *pose)
{
    free(pose->place);
    free(pose->world);
    free(pose->joints);
    free(pose->weights);
    *pose = (struct gltf_pose){0};
}

/// Translation · rotation · scale.
static mat4s matrix_of(const struct gltf_place *place)
{
    versors q;
    memcpy(&q, place->rotation, sizeof q);
    mat4s m = glms_quat_mat4(q);
    for (int column = 0; column < 3; column++) glm_vec4_scale(m.raw[column], place->scale[column], m.raw[column]);
    memcpy(m.raw[3], place->translation, sizeof place->translation);
    return m;
}

void gltf_pose_world(const struct gltf *gltf, struct gltf_pose *pose)
{
    for (int i = 0; i < gltf->node_count; i++) {
        int n = gltf->order[i];
        const struct gltf_node *node = &gltf->nodes[n];
        mat4s m = node->has_matrix ? mat4_from(node->matrix) : matrix_of(&pose->place[n]);
        if (node->parent >= 0) m = glms_mat4_mul(mat4_from(pose->world[node->parent]), m);
        memcpy(pose->world[n], &m, sizeof m);
    }
    for (int s = 0; s < gltf->skin_count; s++) {
        for (int j = 0; j < gltf->skins[s].joint_count; j++)
            gltf_joint_matrix(gltf, pose, s, j, pose->joints[gltf->skins[s].first_joint + j]);
    }
}

void gltf_joint_matrix(const struct gltf *gltf, const struct gltf_pose *pose, int skin, int joint, float matrix[16])
{
    const struct gltf_skin *s = &gltf->skins[skin];
    mat4s m = glms_mat4_mul(mat4_from(pose->world[s->joints[joint]]), mat4_from(s->inverse_bind[joint]));
    memcpy(matrix, &m, sizeof m);
}

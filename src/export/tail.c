/// A tail as a form: the fox, skinned to the tail's joints.
#include "export/form.h"
#include "model/fox.h"
#include <string.h>

/// The fox's mesh, scaled to its tail's length.
struct scaled_fox {
    float (*position)[3], (*normal)[3], (*color)[3];
    uint32_t *indices;
};

/// Appends a part's vertices and triangles. A vertex has at most four joints.
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
            form->slots[at][n] = part->weights[v][n] > 0.0f ? (uint16_t)(FOX_FIRST_LIMB + part->joints[v][n]) : 0;
        }
    }
}

static void add_mesh(struct form *form, struct scaled_fox *fox, const struct gltf_mesh *mesh, float scale)
{
    size_t vertices = 1, indices = 1;
    for (int p = 0; p < mesh->part_count; p++) {
        vertices += (size_t)mesh->parts[p].vertex_count;
        indices += (size_t)mesh->parts[p].index_count;
    }
    form->position = (const float(*)[3])(fox->position = pool_take(&form->pool, vertices, sizeof *fox->position));
    form->normal = (const float(*)[3])(fox->normal = pool_take(&form->pool, vertices, sizeof *fox->normal));
    form->color = (const float(*)[3])(fox->color = pool_take(&form->pool, vertices, sizeof *fox->color));
    form->indices = fox->indices = pool_take(&form->pool, indices, sizeof *fox->indices);
    form->slots = pool_take(&form->pool, vertices, sizeof *form->slots);
    form->weights = pool_take(&form->pool, vertices, sizeof *form->weights);
    for (int p = 0; p < mesh->part_count; p++) add_part(form, fox, &mesh->parts[p], scale);
}

/// The animal's root node, the nodes of its body, and those of the tail.
static void add_joints(struct form *form, const struct gltf *gltf, const float root[16])
{
    form->joint_count = gltf->node_count - 1; // the last node shows the mesh
    form->first_bone = FOX_FIRST_JOINT;
    form->joints = pool_take(&form->pool, (size_t)form->joint_count, sizeof *form->joints);
    for (int j = 0; j < form->joint_count; j++) {
        const struct gltf_node *node = &gltf->nodes[j];
        struct form_joint *joint = &form->joints[j];
        const char *name = j == 0 ? "base" : node->name + (j < FOX_FIRST_JOINT ? 0 : strlen("tail_"));
        joint->name = form_text(&form->pool, form->name, "_", name);
        joint->parent = node->parent;
        for (int k = 0; k < 3; k++) {
            joint->offset[k] = j == 0 ? root[12 + k] : root[0] * node->place.translation[k];
            if (j > 0) joint->bind[k] = -root[0] * gltf->skins->inverse_bind[j - FOX_FIRST_LIMB][12 + k];
        }
    }
    form->joints[form->joint_count - 1].tip[2] =
        root[0] * FOX_TAIL_LENGTH / (float)(form->joint_count - form->first_bone);
}

static bool open(const struct posing *posing, int rig, const struct rig_pose *pose, struct form *form,
                 struct error *error)
{
    const struct gltf *gltf = &pose->model.imported->gltf;
    (void)posing, (void)rig, (void)error;
    struct scaled_fox *fox = form->owned = pool_take(&form->pool, 1, sizeof *fox);
    add_mesh(form, fox, gltf->meshes, pose->model.root[0]);
    add_joints(form, gltf, pose->model.root);
    return true;
}

static void key(const struct form *form, const struct rig_pose *pose, struct form_key *key)
{
    memcpy(key->translation, pose->model.root + 12, sizeof key->translation);
    for (int j = 0; j < form->joint_count; j++) {
        const struct gltf_place *place = &pose->model.pose->place[j];
        memcpy(key->rotation[j], place->rotation, sizeof place->rotation);
        memcpy(key->scale[j], place->scale, sizeof place->scale);
    }
}

static void vertices(const struct form *form, const struct rig_pose *pose, float (*positions)[3])
{
    const float *root = pose->model.root;
    const struct gltf *gltf = &pose->model.imported->gltf;
    gltf_pose_vertices(gltf, pose->model.pose, gltf->node_count - 1, positions, NULL);
    for (int v = 0; v < form->vertex_count; v++)
        for (int k = 0; k < 3; k++) positions[v][k] = root[0] * positions[v][k] + root[12 + k];
}

const struct form_kind tail_form = {FORM_MESH | FORM_JOINTS | FORM_POINTS, open, key, vertices, form_channels};

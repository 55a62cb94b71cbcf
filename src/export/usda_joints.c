/// The joints of a rig in a .usda file: which there are, and where they rest and were bound.
#include "base/need.h"
#include "export/usda.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

const struct gltf_place *usda_place(const struct usda_model *model, int key, int node)
{
    return &model->places[(size_t)key * (size_t)model->gltf->node_count + (size_t)node];
}

/// Whether half precision, with 11 bits, has the number.
static bool is_half(float number)
{
    int exponent;
    const float mantissa = 2048 * frexpf(number, &exponent);
    return number == 0 || (exponent > -13 && exponent <= 16 && fabsf(mantissa - roundf(mantissa)) < 1e-3f);
}

static bool moves(const struct usda_model *model, int node)
{
    for (int k = 0; k < model->range->key_count; k++) {
        if (memcmp(usda_place(model, k, node), &model->gltf->nodes[node].place, sizeof *model->places) != 0)
            return !model->gltf->nodes[node].has_matrix;
    }
    return false;
}

static bool needs_two_joints(const struct usda_model *model, int node)
{
    const float *scale = usda_place(model, 0, node)->scale;
    for (int k = 1; k < model->range->key_count; k++) {
        if (memcmp(usda_place(model, k, node)->scale, scale, 3 * sizeof *scale) != 0) return false;
    }
    return !is_half(scale[0]) || !is_half(scale[1]) || !is_half(scale[2]);
}

static void add_joint(struct usda_model *model, struct usda_names *names, int node, int parent,
                      enum usda_joint_part part)
{
    const int j = model->joint_count++;
    struct usda_joint *joint = &model->joints[j];
    char wanted[FORM_NAME];
    double local[16];
    *joint = (struct usda_joint){
        .node = node, .parent = parent, .part = part, .moves = part != JOINT_SCALE && moves(model, node)};
    snprintf(wanted, sizeof wanted, "%.40s%s", model->gltf->nodes[node].name, part == JOINT_SCALE ? "_scale" : "");
    usda_unique(names, wanted, joint->name);
    usda_rest(model, j, parent >= 0 ? local : joint->world);
    if (parent >= 0) gltf_multiply(model->joints[parent].world, local, joint->world);
    model->joint_of[node] = j;
}

/// Whether the node moves a mesh, or some of it, as a whole.
static bool carries(const struct gltf *gltf, int node)
{
    const struct gltf_node *n = &gltf->nodes[node];
    for (int p = 0; n->mesh >= 0 && p < gltf->meshes[n->mesh].part_count; p++) {
        if (n->skin < 0 || !gltf->meshes[n->mesh].parts[p].joints) return true;
    }
    return false;
}

/// Marks what must be a joint: those of skins, what meshes hang at, and what is above them.
static void mark(const struct gltf *gltf, bool *needed)
{
    for (int s = 0; s < gltf->skin_count; s++)
        for (int j = 0; j < gltf->skins[s].joint_count; j++) needed[gltf->skins[s].joints[j]] = true;
    for (int i = gltf->node_count - 1; i >= 0; i--) {
        const int n = gltf->order[i], parent = gltf->nodes[n].parent;
        needed[n] = needed[n] || carries(gltf, n);
        if (parent >= 0 && needed[n]) needed[parent] = true;
    }
}

void usda_make_joints(struct usda_model *model)
{
    const struct gltf *gltf = model->gltf;
    struct usda_names names = {0};
    bool *needed = need_zeroed((size_t)gltf->node_count + 1, sizeof *needed);
    mark(gltf, needed);
    for (int i = 0; i < gltf->node_count; i++) {
        const int n = gltf->order[i], above = gltf->nodes[n].parent;
        model->joint_of[n] = -1;
        if (!needed[n]) continue;
        const bool two = moves(model, n) && needs_two_joints(model, n);
        add_joint(model, &names, n, above >= 0 ? model->joint_of[above] : -1, two ? JOINT_UNSCALED : JOINT_WHOLE);
        if (two) add_joint(model, &names, n, model->joint_of[n], JOINT_SCALE);
    }
    free(needed);
    usda_names_free(&names);
}

// --- matrices

/// The inverse of an affine matrix; false where it has none.
static bool invert(const float m[16], double inverse[16])
{
    double a[3][3];
    for (int i = 0; i < 9; i++) a[i / 3][i % 3] = (double)m[i / 3 * 4 + i % 3];
    double det = 0;
    for (int c = 0; c < 3; c++) {
        const double *p = a[(c + 1) % 3], *q = a[(c + 2) % 3];
        for (int r = 0; r < 3; r++)
            inverse[4 * r + c] = p[(r + 1) % 3] * q[(r + 2) % 3] - p[(r + 2) % 3] * q[(r + 1) % 3];
    }
    for (int r = 0; r < 3; r++) det += a[0][r] * inverse[4 * r];
    if (!(fabs(det) > 1e-300)) return false;
    for (int c = 0; c < 3; c++) {
        for (int r = 0; r < 3; r++) inverse[4 * c + r] /= det;
        inverse[4 * c + 3] = 0;
    }
    for (int r = 0; r < 3; r++)
        inverse[12 + r] =
            -(inverse[r] * (double)m[12] + inverse[4 + r] * (double)m[13] + inverse[8 + r] * (double)m[14]);
    inverse[15] = 1;
    return true;
}

void usda_rest(const struct usda_model *model, int number, double m[16])
{
    const struct usda_joint *joint = &model->joints[number];
    struct gltf_node node = model->gltf->nodes[joint->node];
    if (joint->part == JOINT_UNSCALED) {
        for (int k = 0; k < 3; k++) node.place.scale[k] = 1;
    } else if (joint->part == JOINT_SCALE) {
        node.place = (struct gltf_place){.rotation = {0, 0, 0, 1}};
        memcpy(node.place.scale, usda_place(model, 0, joint->node)->scale, sizeof node.place.scale);
    }
    gltf_node_matrix(&node, m);
}

/// Finds the nodes of a skin among its joints.
static void find_slots(const struct usda_model *model, int skin, bool joints)
{
    for (int j = skin >= 0 ? model->gltf->skins[skin].joint_count - 1 : -1; j >= 0; j--)
        model->slot_of[model->gltf->skins[skin].joints[j]] = joints ? j : -1;
}

void usda_bind(struct usda_model *model, int skeleton, int joint, double matrix[16])
{
    const struct gltf *gltf = model->gltf;
    const int node = model->joints[joint].node, skin = skeleton < gltf->skin_count ? skeleton : -1;
    if (skin != model->slots) {
        find_slots(model, model->slots, false);
        find_slots(model, skin, true);
        model->slots = skin;
    }
    const int slot = model->joint_of[node] == joint ? model->slot_of[node] : -1;
    if (slot < 0 || !invert(gltf->skins[skin].inverse_bind[slot], matrix))
        memcpy(matrix, model->joints[joint].world, sizeof model->joints[joint].world);
}

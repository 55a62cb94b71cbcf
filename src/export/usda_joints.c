/// The joints of an imported character in a .usda file: which there are, and where they rest and were bound.
#include "export/usda_model.h"
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
    for (int k = 0; k < model->shot->key_count; k++) {
        if (memcmp(usda_place(model, k, node), &model->gltf->nodes[node].place, sizeof *model->places) != 0)
            return !model->gltf->nodes[node].has_matrix;
    }
    return false;
}

static bool needs_two_joints(const struct usda_model *model, int node)
{
    const float *scale = usda_place(model, 0, node)->scale;
    for (int k = 1; k < model->shot->key_count; k++) {
        if (memcmp(usda_place(model, k, node)->scale, scale, 3 * sizeof *scale) != 0) return false;
    }
    return !is_half(scale[0]) || !is_half(scale[1]) || !is_half(scale[2]);
}

static void add_joint(struct usda_model *model, int node, int parent, enum usda_joint_part part)
{
    const int j = model->joint_count++;
    char wanted[FORM_NAME];
    snprintf(wanted, sizeof wanted, "%.40s%s", model->gltf->nodes[node].name, part == JOINT_SCALE ? "_scale" : "");
    usda_unique(model->joint_names, j, wanted, model->joint_names[j]);
    model->joints[j] = (struct usda_joint){
        .node = node, .parent = parent, .part = part, .moves = part != JOINT_SCALE && moves(model, node)};
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

bool usda_make_joints(struct usda_model *model, struct error *error)
{
    const struct gltf *gltf = model->gltf;
    bool *needed = calloc((size_t)gltf->node_count + 1, sizeof *needed);
    if (!needed) return fail_no_memory(error, gltf->path);
    mark(gltf, needed);
    for (int i = 0; i < gltf->node_count; i++) {
        const int n = gltf->order[i], above = gltf->nodes[n].parent;
        model->joint_of[n] = -1;
        if (!needed[n]) continue;
        const bool two = moves(model, n) && needs_two_joints(model, n);
        add_joint(model, n, above >= 0 ? model->joint_of[above] : -1, two ? JOINT_UNSCALED : JOINT_WHOLE);
        if (two) add_joint(model, n, model->joint_of[n], JOINT_SCALE);
    }
    free(needed);
    return true;
}

// --- matrices

/// Columns first, as glTF has them.
static void matrix_of(const struct gltf_place *place, double m[16])
{
    const double x = (double)place->rotation[0], y = (double)place->rotation[1], z = (double)place->rotation[2],
                 w = (double)place->rotation[3];
    const double turned[3][3] = {{1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)},
                                 {2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)},
                                 {2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)}};
    for (int c = 0; c < 3; c++) {
        for (int r = 0; r < 3; r++) m[4 * c + r] = (double)place->scale[c] * turned[c][r];
        m[4 * c + 3] = 0;
        m[12 + c] = (double)place->translation[c];
    }
    m[15] = 1;
}

static void multiply(const double a[16], const double b[16], double product[16])
{
    for (int i = 0; i < 16; i++) {
        product[i] = 0;
        for (int k = 0; k < 4; k++) product[i] += a[4 * k + i % 4] * b[i / 4 * 4 + k];
    }
}

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
    const struct gltf_node *node = &model->gltf->nodes[joint->node];
    struct gltf_place place = node->place;
    if (joint->part == JOINT_UNSCALED) {
        for (int k = 0; k < 3; k++) place.scale[k] = 1;
    } else if (joint->part == JOINT_SCALE) {
        place = (struct gltf_place){.rotation = {0, 0, 0, 1}};
        memcpy(place.scale, usda_place(model, 0, joint->node)->scale, sizeof place.scale);
    }
    matrix_of(&place, m);
    for (int i = 0; i < 16 && node->has_matrix; i++) m[i] = (double)node->matrix[i];
}

static void world_of(const struct usda_model *model, int joint, double world[16])
{
    usda_rest(model, joint, world);
    for (int j = model->joints[joint].parent; j >= 0; j = model->joints[j].parent) {
        double above[16], below[16];
        memcpy(below, world, sizeof below);
        usda_rest(model, j, above);
        multiply(above, below, world);
    }
}

void usda_bind(const struct usda_model *model, int skeleton, int joint, double matrix[16])
{
    const struct gltf *gltf = model->gltf;
    const struct gltf_skin *skin = skeleton < gltf->skin_count ? &gltf->skins[skeleton] : NULL;
    const int node = model->joints[joint].node;
    for (int j = 0; skin && j < skin->joint_count && model->joint_of[node] == joint; j++) {
        if (skin->joints[j] == node && invert(skin->inverse_bind[j], matrix)) return;
    }
    world_of(model, joint, matrix);
}

void usda_matrix(FILE *out, const double m[16])
{
    for (int c = 0; c < 4; c++) {
        fprintf(out, "%s(%.17g, %.17g, %.17g, %.17g)", c > 0 ? ", " : "(", m[4 * c], m[4 * c + 1], m[4 * c + 2],
                m[4 * c + 3]);
    }
    fputs(")", out);
}

/// The skeletons of a rig in a .usda file, and what moves them.
#include "base/need.h"
#include "export/usda.h"
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

// --- matrices in double precision, columns first

/// Of a node against its parent at rest.
static void node_matrix(const struct gltf_node *node, double m[16])
{
    const struct gltf_place *place = &node->place;
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
    for (int i = 0; i < 16 && node->has_matrix; i++) m[i] = (double)node->matrix[i];
}

/// a · b
static void multiply(const double a[16], const double b[16], double product[16])
{
    for (int i = 0; i < 16; i++) {
        product[i] = 0;
        for (int k = 0; k < 4; k++) product[i] += a[4 * k + i % 4] * b[i / 4 * 4 + k];
    }
}

// --- the joints: which there are, and where they rest

/// Where a node is at a key, against its parent.
static const struct gltf_place *place_at(const struct usda_model *model, int key, int node)
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
        if (memcmp(place_at(model, k, node), &model->gltf->nodes[node].place, sizeof *model->places) != 0)
            return !model->gltf->nodes[node].has_matrix;
    }
    return false;
}

static bool needs_two_joints(const struct usda_model *model, int node)
{
    const float *scale = place_at(model, 0, node)->scale;
    for (int k = 1; k < model->range->key_count; k++) {
        if (memcmp(place_at(model, k, node)->scale, scale, 3 * sizeof *scale) != 0) return false;
    }
    return !is_half(scale[0]) || !is_half(scale[1]) || !is_half(scale[2]);
}

/// Of a joint against its parent, at rest.
static void rest_of(const struct usda_model *model, int number, double m[16])
{
    const struct usda_joint *joint = &model->joints[number];
    struct gltf_node node = model->gltf->nodes[joint->node];
    if (joint->part == JOINT_UNSCALED) {
        for (int k = 0; k < 3; k++) node.place.scale[k] = 1;
    } else if (joint->part == JOINT_SCALE) {
        node.place = (struct gltf_place){.rotation = {0, 0, 0, 1}};
        memcpy(node.place.scale, place_at(model, 0, joint->node)->scale, sizeof node.place.scale);
    }
    node_matrix(&node, m);
}

static void add_joint(struct usda_model *model, int node, int parent, enum usda_joint_part part)
{
    const int j = model->joint_count++;
    struct usda_joint *joint = &model->joints[j];
    double local[16];
    *joint = (struct usda_joint){
        .node = node, .parent = parent, .part = part, .moves = part != JOINT_SCALE && moves(model, node)};
    joint->title = form_text(&model->pool, model->gltf->nodes[node].name, part == JOINT_SCALE ? "_scale" : "", "");
    joint->name = usda_name(&model->joint_names, joint->title, true);
    rest_of(model, j, parent >= 0 ? local : joint->world);
    if (parent >= 0) multiply(model->joints[parent].world, local, joint->world);
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

static void make_joints(struct usda_model *model)
{
    const struct gltf *gltf = model->gltf;
    bool *needed = need_zeroed((size_t)gltf->node_count + 1, sizeof *needed);
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
}

// --- where it was bound

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

// --- keys

/// Poses the model at a key: as the scene has it, or as its clip says.
static bool pose_at(struct usda_model *model, int key, struct gltf_pose *own, const struct gltf_pose **pose,
                    struct error *error)
{
    struct rig_pose posed;
    *pose = own;
    if (model->is_own) {
        gltf_pose_clip(model->gltf, model->gltf->clip_count > 0 ? 0 : -1, (float)range_seconds(model->range, key),
                       own);
        return true;
    }
    if (!range_pose(model->range, model->rig, key, &posed, error) || !range_proceed(model->range, error))
        return false;
    *pose = posed.model.pose;
    return true;
}

static bool collect_keys(struct usda_model *model, struct gltf_pose *own, struct error *error)
{
    const struct gltf *gltf = model->gltf;
    const size_t nodes = (size_t)gltf->node_count, weights = (size_t)gltf->weight_count;
    for (int k = 0; k < model->range->key_count; k++) {
        const struct gltf_pose *pose;
        struct gltf_place *at = model->places + (size_t)k * nodes;
        if (!pose_at(model, k, own, &pose, error)) return false;
        memcpy(at, pose->place, nodes * sizeof *at);
        memcpy(model->weights + (size_t)k * weights, pose->weights, weights * sizeof *model->weights);
        for (size_t n = 0; n < nodes; n++)
            keys_turn_short_way(k > 0 ? (at + n - nodes)->rotation : gltf->nodes[n].place.rotation, at[n].rotation);
    }
    keys_close_loop((float *)model->places, gltf->node_count * (int)(sizeof *model->places / sizeof(float)),
                    model->range->key_count);
    keys_close_loop(model->weights, gltf->weight_count, model->range->key_count);
    return true;
}

// --- the skeletons

static void write_path(const struct usda_model *model, int joint)
{
    if (model->joints[joint].parent >= 0) {
        write_path(model, model->joints[joint].parent);
        fputc('/', model->out);
    }
    fputs(model->joints[joint].name, model->out);
}

static void write_joints(const struct usda_model *model, bool moving)
{
    const char *before = "";
    fputs("            uniform token[] joints = [", model->out);
    for (int j = 0; j < model->joint_count; j++) {
        if (moving && !model->joints[j].moves) continue;
        fprintf(model->out, "%s\"", before);
        write_path(model, j);
        fputc('"', model->out);
        before = ", ";
    }
    fputs("]\n", model->out);
}

/// The names that the file has, where they cannot be those of joints.
static void write_titles(const struct usda_model *model)
{
    const char *before = "            uniform token[] jointNames = [";
    bool any = false;
    for (int j = 0; j < model->joint_count; j++) any |= strcmp(model->joints[j].name, model->joints[j].title) != 0;
    for (int j = 0; any && j < model->joint_count; j++, before = ", ") {
        fputs(before, model->out);
        usda_string(model->out, model->joints[j].title);
    }
    if (any) fputs("]\n", model->out);
}

static bool is_animated(const struct usda_model *model)
{
    for (int j = 0; j < model->joint_count; j++) {
        if (model->joints[j].moves) return true;
    }
    return model->gltf->weight_count > 0;
}

static void write_skeleton(struct usda_model *model, int skeleton)
{
    double m[16];
    usda_begin(model->out, 8, "Skeleton", model->skeletons[skeleton], model->skeletons[skeleton], "SkelBindingAPI");
    write_joints(model, false);
    write_titles(model);
    fputs("            uniform matrix4d[] bindTransforms = [", model->out);
    for (int j = 0; j < model->joint_count; j++) {
        if (j > 0) fputs(", ", model->out);
        usda_bind(model, skeleton, j, m);
        usda_matrix(model->out, m);
    }
    fputs("]\n            uniform matrix4d[] restTransforms = [", model->out);
    for (int j = 0; j < model->joint_count; j++) {
        if (j > 0) fputs(", ", model->out);
        rest_of(model, j, m);
        usda_matrix(model->out, m);
    }
    fputs("]\n", model->out);
    if (is_animated(model))
        fprintf(model->out, "            rel skel:animationSource = </scene/%s/animation>\n", model->name);
    fputs("        }\n\n", model->out);
}

// --- what moves them

typedef void write_joint(const struct usda_model *model, int key, const struct usda_joint *joint, const char *before);

static void write_translation(const struct usda_model *model, int key, const struct usda_joint *joint,
                              const char *before)
{
    usda_vector(model->out, before, place_at(model, key, joint->node)->translation);
}

static void write_rotation(const struct usda_model *model, int key, const struct usda_joint *joint,
                           const char *before)
{
    const float *q = place_at(model, key, joint->node)->rotation;
    fprintf(model->out, "%s(%.9g, %.9g, %.9g, %.9g)", before, (double)q[3], (double)q[0], (double)q[1], (double)q[2]);
}

static void write_scale(const struct usda_model *model, int key, const struct usda_joint *joint, const char *before)
{
    static const float one[3] = {1, 1, 1};
    usda_vector(model->out, before, joint->part == JOINT_UNSCALED ? one : place_at(model, key, joint->node)->scale);
}

/// A key for all joints that move; of the weights where `write` is NULL.
static void write_samples(const struct usda_model *model, const char *declaration, write_joint *write, int count)
{
    const int weights = model->gltf->weight_count;
    fprintf(model->out, "            %s.timeSamples = {\n", declaration);
    for (int k = 0; k < count; k++) {
        const char *before = "[";
        fprintf(model->out, "                %.9g: ", range_frame(model->range, k));
        for (int j = 0; write && j < model->joint_count; j++) {
            if (!model->joints[j].moves) continue;
            write(model, k, &model->joints[j], before);
            before = ", ";
        }
        for (int i = 0; !write && i < weights; i++)
            fprintf(model->out, "%s%.9g", i > 0 ? ", " : "[",
                    (double)model->weights[(size_t)k * (size_t)weights + (size_t)i]);
        fputs("],\n", model->out);
    }
    fputs("            }\n", model->out);
}

/// The keys of a member of all places: one, if it never changes.
static int count_keys(const struct usda_model *model, size_t member, size_t size)
{
    for (int k = 1; k < model->range->key_count; k++) {
        for (int n = 0; n < model->gltf->node_count; n++) {
            const char *first = (const char *)place_at(model, 0, n), *now = (const char *)place_at(model, k, n);
            if (memcmp(first + member, now + member, size) != 0) return model->range->key_count;
        }
    }
    return 1;
}

static void write_animation(const struct usda_model *model)
{
    bool any = false;
    for (int j = 0; j < model->joint_count; j++) any = any || model->joints[j].moves;
    fputs("        def SkelAnimation \"animation\"\n        {\n", model->out);
    if (any) {
        write_joints(model, true);
        write_samples(model, "float3[] translations", write_translation,
                      count_keys(model, offsetof(struct gltf_place, translation), 3 * sizeof(float)));
        write_samples(model, "quatf[] rotations", write_rotation,
                      count_keys(model, offsetof(struct gltf_place, rotation), 4 * sizeof(float)));
        write_samples(model, "half3[] scales", write_scale,
                      count_keys(model, offsetof(struct gltf_place, scale), 3 * sizeof(float)));
    }
    if (model->gltf->weight_count > 0) {
        fputs("            uniform token[] blendShapes = [", model->out);
        for (int i = 0; i < model->gltf->weight_count; i++) {
            if (i > 0) fputs(", ", model->out);
            usda_string(model->out, model->shapes[i].token);
        }
        fputs("]\n", model->out);
        write_samples(model, "float[] blendShapeWeights", NULL, model->range->key_count);
    }
    fputs("        }\n\n", model->out);
}

// --- all of it

/// As the file calls them (a custom of many exporters), else by number; those of all nodes together differ.
static void name_shapes(struct usda_model *model)
{
    const struct gltf *gltf = model->gltf;
    for (int n = 0; n < gltf->node_count; n++) {
        const int mesh = gltf->nodes[n].mesh, first = gltf->nodes[n].first_weight;
        for (int t = 0; mesh >= 0 && t < gltf->meshes[mesh].target_count; t++) {
            char numbered[32];
            const char *name = gltf_target_name(&gltf->meshes[mesh], t);
            snprintf(numbered, sizeof numbered, "target_%d", t);
            struct usda_shape *shape = &model->shapes[first + t];
            shape->token = names_add(&model->shape_tokens, name ? name : numbered);
            shape->prim = usda_name(&model->shape_prims, shape->token, false);
        }
    }
}

/// False where so many keys have no room.
static bool reserve(struct usda_model *model)
{
    const struct gltf *gltf = model->gltf;
    const size_t keys = (size_t)model->range->key_count, nodes = (size_t)gltf->node_count,
                 weights = (size_t)gltf->weight_count;
    struct pool *pool = &model->pool;
    if (!need_has_room(keys * (nodes * sizeof *model->places + weights * sizeof *model->weights))) return false;
    model->places = pool_take(pool, keys * nodes, sizeof *model->places);
    model->weights = pool_take(pool, keys * weights, sizeof *model->weights);
    model->shapes = pool_take(pool, weights, sizeof *model->shapes);
    model->joints = pool_take(pool, 2 * nodes, sizeof *model->joints);
    model->joint_of = pool_take(pool, nodes, sizeof *model->joint_of);
    model->slot_of = pool_take(pool, nodes, sizeof *model->slot_of);
    model->materials = pool_take(pool, (size_t)gltf->material_count, sizeof *model->materials);
    model->skeletons = pool_take(pool, (size_t)gltf->skin_count + 1, sizeof *model->skeletons);
    for (size_t n = 0; n < nodes; n++) model->slot_of[n] = -1;
    model->slots = -1;
    return true;
}

static bool write_all(struct usda_model *model, struct error *error)
{
    const int skeletons = model->gltf->skin_count > 1 ? model->gltf->skin_count : 1;
    for (int s = 0; s < skeletons; s++) model->skeletons[s] = usda_name(&model->prims, "skeleton", false);
    usda_name(&model->prims, "animation", false);
    usda_name(&model->prims, "materials", false);
    for (int s = 0; s < skeletons; s++) write_skeleton(model, s);
    if (is_animated(model)) write_animation(model);
    if (!usda_write_materials(model, error)) return false;
    usda_write_meshes(model);
    return true;
}

/// Where it stands, which does not move.
static bool write_root(const struct usda_model *model, struct error *error)
{
    struct rig_pose pose;
    double matrix[16];
    fputc('\n', model->out);
    usda_begin(model->out, 4, "SkelRoot", model->name, form_name(model->range->posing->document->rigs[model->rig]),
               NULL);
    if (!range_pose(model->range, model->rig, 0, &pose, error)) return false;
    const float *root = range_root(model->range, model->rig, &pose);
    if (!root) return true;
    for (int i = 0; i < 16; i++) matrix[i] = (double)root[i];
    fputs("        matrix4d xformOp:transform = ", model->out);
    usda_matrix(model->out, matrix);
    fputs("\n        uniform token[] xformOpOrder = [\"xformOp:transform\"]\n\n", model->out);
    return true;
}

bool usda_model_write(struct usda_model *model, struct error *error)
{
    struct gltf_pose pose = {0};
    struct names *const sets[] = {&model->prims, &model->joint_names, &model->shape_tokens, &model->shape_prims,
                                  &model->material_prims};
    for (size_t i = 0; i < sizeof sets / sizeof *sets; i++) *sets[i] = usda_names();
    const bool room = reserve(model) && gltf_pose_create(model->gltf, &pose);
    bool done = (room || fail_no_memory(error, model->gltf->path)) && collect_keys(model, &pose, error);
    if (done) {
        make_joints(model);
        name_shapes(model);
    }
    done = done && write_root(model, error) && write_all(model, error);
    fputs("    }\n", model->out);
    gltf_pose_free(&pose);
    for (size_t i = 0; i < sizeof sets / sizeof *sets; i++) names_free(sets[i]);
    pool_free(&model->pool);
    return done;
}

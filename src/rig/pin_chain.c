/// Points of chains: where their bones end.
///
/// A bone turns by q · exp(side · a_s) · exp(up · a_u) · exp(twist · a_t), in the space of its parent. With L that space's matrix times the
/// rotation, a turn about one of the axes moves a point that is r away from the bone by L (a' × L⁻¹ r), where a' is the axis as the
/// turns behind it leave it.
#include "model/vector.h"
#include "rig/chain_bones.h"
#include "rig/pinning_kind.h"
#include "rig/posing_kind.h"
#include <math.h>

static const float SLACK = 1e-6f; ///< of the chain's length, and of how far a float is off
static const float FLOATS = 4e-7f;

/// A posed character.
struct posed {
    const struct imported *imported;
    const struct gltf_pose *pose;
    const float *root; ///< its space → world
};

static const struct imported *imported_of(const struct posing *posing, int chain, int *model)
{
    const struct chain *of = &posing->document->rigs[chain]->chain;
    *model = document_find_model(posing->document, of->model, of->by_file);
    return *model < 0 ? NULL : models_imported(posing->models, document_rig_number(posing->document, *model));
}

static bool is_at_or_above(const struct gltf *gltf, int node, int below)
{
    while (below >= 0 && below != node) below = gltf->nodes[below].parent;
    return below >= 0;
}

/// The bone's axes as the turns behind each leave them, in its own frame.
static void turned_axes(const struct imported *imported, const struct chain_axes *axes, int node,
                        const double angle[3], vec3s turned[3])
{
    const float *const about[] = {[AXIS_SIDE] = axes->side, [AXIS_UP] = axes->up, [AXIS_TWIST] = axes->along};
    for (int axis = AXIS_SIDE; axis <= AXIS_TWIST; axis++) {
        chain_own_axis(imported, node, about[axis], turned[axis].raw);
        for (int before = AXIS_SIDE; before < axis; before++)
            turned[before] = glms_vec3_rotate(turned[before], -(float)angle[axis], turned[axis]);
    }
}

/// Where a turn of a bone about each axis takes a point of the character, metres of the world a radian.
static void find_ways(const struct posed *posed, int node, const vec3s axes[3], const float point[3],
                      double way[3][3])
{
    const struct gltf *gltf = &posed->imported->gltf;
    const int parent = gltf->nodes[node].parent;
    versors rotation;
    memcpy(rotation.raw, posed->pose->place[node].rotation, sizeof rotation.raw);
    mat3s on = glms_mat4_pick3(glms_quat_mat4(rotation));
    if (parent >= 0) on = glms_mat3_mul(glms_mat4_pick3(mat4_from(posed->pose->world[parent])), on);
    const vec3s arm = glms_vec3_sub(vec3_from(point), vec3_from(posed->pose->world[node] + 12));
    const vec3s own = glms_mat3_mulv(mat3_inverse(on), arm);
    const mat3s out = glms_mat3_mul(glms_mat4_pick3(mat4_from(posed->root)), on);
    for (int axis = AXIS_SIDE; axis <= AXIS_TWIST; axis++) {
        const vec3s moved = glms_mat3_mulv(out, glms_vec3_cross(axes[axis], own));
        for (int k = 0; k < 3; k++) way[axis][k] = (double)moved.raw[k];
    }
}

/// How splines move a point below `node` by bending a chain.
static void add_chain(const struct posed *posed, const struct chain *chain, const wiggly_value *values, int node,
                      const float point[3], const int *splines, int count, pin_pull *c)
{
    struct chain_bones bones;
    const struct gltf *gltf = &posed->imported->gltf;
    if (!chain_find(gltf, chain->from, chain->to, &bones, NULL)) return;
    const struct chain_axes axes = chain_axes_at_rest(posed->imported, &bones, chain->turn);
    for (int n = 0; n < bones.count && is_at_or_above(gltf, bones.node[n], node); n++) {
        double angle[3], way[3][3];
        vec3s turned[3];
        chain_angles(chain, values, LOOK_WIGGLY, n, bones.count, angle);
        turned_axes(posed->imported, &axes, bones.node[n], angle, turned);
        find_ways(posed, bones.node[n], turned, point, way);
        for (int i = 0; i < chain->channel_count; i++) {
            const struct channel *channel = &chain->channels[i];
            double signed_way[3];
            for (int k = 0; k < 3; k++) signed_way[k] = chain_sign(chain, channel->axis) * way[channel->axis][k];
            for (int s = 0; s < count; s++) {
                if (splines[s] == channel->spline) pinning_add_channel(channel, n, bones.count, signed_way, c[s]);
            }
        }
    }
}

/// Where bone n ends, in the character's space.
static vec3s end_of(const struct posed *posed, const struct chain_bones *bones, int n)
{
    static const float still[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    struct chain_pose points;
    chain_points(posed->imported, bones, posed->pose, still, &points);
    return vec3_from(points.point[n + 1]);
}

/// Metres along the first `count` bones at rest.
static float length_of(const struct imported *imported, const struct chain_bones *bones, int count,
                       const float root[16])
{
    struct chain_pose points;
    float sum = 0;
    chain_points(imported, bones, &imported->rest, root, &points);
    for (int n = 1; n <= count; n++)
        sum += glms_vec3_distance(vec3_from(points.point[n - 1]), vec3_from(points.point[n]));
    return sum;
}

static bool find(const struct posing *posing, int rig, double sample, int which, const int *splines, int count,
                 pin_pull *c, struct pin_point *point)
{
    const struct document *document = posing->document;
    const struct chain *chain = &document->rigs[rig]->chain;
    struct chain_bones bones;
    struct rig_pose whole;
    int model;
    const struct imported *imported = imported_of(posing, rig, &model);
    if (!imported || !posing_model(posing, model, sample, -1, NULL, &whole)) return false;
    if (!chain_find(&imported->gltf, chain->from, chain->to, &bones, NULL) || which >= bones.count) return false;
    const struct posed posed = {imported, whole.model.pose, whole.model.root};
    const vec3s end = end_of(&posed, &bones, which);
    const vec3s at = glms_mat4_mulv3(mat4_from(posed.root), end, 1.0f);
    const float length = length_of(imported, &bones, bones.count, posed.root);
    const float *from = posed.pose->world[bones.node[0]] + 12;
    const vec3s base = glms_mat4_mulv3(mat4_from(posed.root), vec3_from(from), 1.0f);
    *point = (struct pin_point){.size = (double)length,
                                .slack = (double)(SLACK * length + FLOATS * glms_vec3_norm(at)),
                                .at = {(double)at.x, (double)at.y, (double)at.z},
                                .base = {(double)base.x, (double)base.y, (double)base.z},
                                .reach = (double)length_of(imported, &bones, which + 1, posed.root)};
    for (int r = document_next_rig(document, RIG_CHAIN, 0); count > 0 && r >= 0;
         r = document_next_rig(document, RIG_CHAIN, r + 1)) {
        wiggly_value values[RIG_MAX_INPUTS];
        int other;
        if (!imported_of(posing, r, &other) || other != model) continue;
        posing_values(posing, r, sample, NULL, values);
        add_chain(&posed, &document->rigs[r]->chain, values, bones.node[which], end.raw, splines, count, c);
    }
    return true;
}

static void weigh(const struct posing *posing, int rig, const int *splines, int count, double *weights)
{
    const struct chain *chain = &posing->document->rigs[rig]->chain;
    const wiggly_value values[RIG_MAX_INPUTS] = {{0}};
    struct chain_bones bones;
    int model;
    const struct imported *imported = imported_of(posing, rig, &model);
    if (!imported || !chain_find(&imported->gltf, chain->from, chain->to, &bones, NULL)) return;
    const float scale = (float)posing->document->rigs[model]->model.scale;
    const float root[16] = {scale, 0, 0, 0, 0, scale, 0, 0, 0, 0, scale, 0, 0, 0, 0, 1};
    const struct posed posed = {imported, &imported->rest, root};
    for (int n = 0; n < bones.count; n++) {
        const vec3s end = end_of(&posed, &bones, n);
        for (int i = 0; i < count; i++) {
            pin_pull c[1] = {{{0}}};
            add_chain(&posed, chain, values, bones.node[n], end.raw, &splines[i], 1, c);
            weights[i] += pinning_square(c[0]) / bones.count;
        }
    }
}

const struct pinning_functions chain_pinning = {find, weigh};

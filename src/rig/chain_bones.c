/// Bends the bones of a chain.
#include "rig/chain_bones.h"
#include "model/vector.h"
#include <math.h>

static const float UPRIGHT = 0.98f; ///< cosine against world up from which on a chain stands or hangs

static double radians(double degrees) { return degrees * 3.14159265358979323846 / 180.0; }

static vec3s place_of(const float matrix[16]) { return vec3_from(matrix + 12); }

/// Character's space → a bone's own at rest, without its place.
static mat3s into_bone(const struct imported *imported, int node)
{
    return mat3_inverse(glms_mat4_pick3(mat4_from(imported->rest.world[node])));
}

/// The tip in the last bone's own space: where its first child is, else as far on as the bone before was long.
static vec3s tip_of(const struct imported *imported, const struct chain_bones *bones)
{
    const int last = bones->node[bones->count - 1], child = imported->gltf.nodes[last].child;
    const vec3s at = place_of(imported->rest.world[last]);
    vec3s on = {.raw = {0.0f, 0.1f, 0.0f}};
    if (child >= 0) {
        on = glms_vec3_sub(place_of(imported->rest.world[child]), at);
    } else if (bones->count > 1) {
        on = glms_vec3_sub(at, place_of(imported->rest.world[bones->node[bones->count - 2]]));
    }
    return glms_mat3_mulv(into_bone(imported, last), on);
}

static vec3s tip_at(const struct imported *imported, const struct chain_bones *bones, const struct gltf_pose *pose)
{
    return glms_mat4_mulv3(mat4_from(pose->world[bones->node[bones->count - 1]]), tip_of(imported, bones), 1.0f);
}

struct chain_axes chain_axes_at_rest(const struct imported *imported, const struct chain_bones *bones, double turn)
{
    const vec3s up = {.raw = {0, 1, 0}}, front = {.raw = {0, 0, 1}};
    const vec3s from = place_of(imported->rest.world[bones->node[0]]);
    vec3s along = glms_vec3_sub(tip_at(imported, bones, &imported->rest), from);
    along = glms_vec3_norm(along) > 0.0f ? glms_vec3_normalize(along) : front;
    const vec3s above = fabsf(glms_vec3_dot(along, up)) > UPRIGHT ? front : up;
    vec3s side = glms_vec3_normalize(glms_vec3_muladds(along, -glms_vec3_dot(above, along), above));
    side = glms_vec3_rotate(side, (float)radians(turn), along);
    const vec3s lift = glms_vec3_cross(along, side);
    struct chain_axes axes;
    memcpy(axes.side, side.raw, sizeof axes.side);
    memcpy(axes.up, lift.raw, sizeof axes.up);
    memcpy(axes.along, along.raw, sizeof axes.along);
    return axes;
}

void chain_angles(const struct chain *chain, const wiggly_value *values, enum look look, int n, int bones,
                  double angle[3])
{
    for (int axis = AXIS_SIDE; axis <= AXIS_TWIST; axis++) angle[axis] = 0;
    for (int c = 0; c < chain->channel_count; c++) {
        const struct channel *channel = &chain->channels[c];
        angle[channel->axis] += chain_sign(chain, channel->axis) * channel_bend(channel, values[c], n, bones, look);
    }
}

double chain_sign(const struct chain *chain, enum axis axis) { return chain->mirror && axis != AXIS_UP ? -1.0 : 1.0; }

void chain_own_axis(const struct imported *imported, int node, const float axis[3], float own[3])
{
    const mat3s inward = into_bone(imported, node);
    const float sign = glms_mat3_det(inward) < 0.0f ? -1.0f : 1.0f; // a mirrored frame turns the other way round
    const vec3s turned = glms_vec3_scale(glms_vec3_normalize(glms_mat3_mulv(inward, vec3_from(axis))), sign);
    memcpy(own, turned.raw, sizeof turned.raw);
}

/// rotation ← rotation · exp(angle · axis), the axis given in the character's space.
static void turn_about(const struct imported *imported, int node, const float axis[3], double angle,
                       float rotation[4])
{
    float own[3];
    chain_own_axis(imported, node, axis, own);
    versors before, turn = glms_quatv((float)angle, vec3_from(own));
    memcpy(before.raw, rotation, sizeof before.raw);
    const versors after = glms_quat_normalize(glms_quat_mul(before, turn));
    memcpy(rotation, after.raw, sizeof after.raw);
}

void chain_bend(const struct imported *imported, const struct chain *chain, const struct chain_bones *bones,
                const wiggly_value *values, enum look look, struct gltf_pose *pose)
{
    const struct chain_axes axes = chain_axes_at_rest(imported, bones, chain->turn);
    const float *const about[] = {[AXIS_SIDE] = axes.side, [AXIS_UP] = axes.up, [AXIS_TWIST] = axes.along};
    for (int n = 0; n < bones->count; n++) {
        double angle[3];
        chain_angles(chain, values, look, n, bones->count, angle);
        float *rotation = pose->place[bones->node[n]].rotation;
        for (int axis = AXIS_SIDE; axis <= AXIS_TWIST; axis++) {
            if (angle[axis] != 0.0) turn_about(imported, bones->node[n], about[axis], angle[axis], rotation);
        }
    }
}

void chain_points(const struct imported *imported, const struct chain_bones *bones, const struct gltf_pose *pose,
                  const float root[16], struct chain_pose *points)
{
    const mat4s to_world = mat4_from(root);
    points->count = bones->count + 1;
    for (int n = 0; n < bones->count; n++) {
        const vec3s at = glms_mat4_mulv3(to_world, place_of(pose->world[bones->node[n]]), 1.0f);
        memcpy(points->point[n], at.raw, sizeof points->point[n]);
    }
    const vec3s tip = glms_mat4_mulv3(to_world, tip_at(imported, bones, pose), 1.0f);
    memcpy(points->point[bones->count], tip.raw, sizeof points->point[0]);
}

/// Bends tails and chains, and follows the nodes from a root to their tips.
#include "rig/strand.h"
#include "maths/maths.h"
#include "model/fox.h"
#include "model/vector.h"
#include "rig/posing_kind.h"
#include <math.h>

static const float UPRIGHT = 0.98f; ///< cosine against world up above which a chain stands or hangs

static vec3s place_of(const float matrix[16]) { return vec3_from(matrix + 12); }

/// Character's space → a bone's own at rest, without its place.
static mat3s into_bone(const struct imported *imported, int node)
{
    return mat3_inverse(glms_mat4_pick3(mat4_from(imported->rest.world[node])));
}

/// From the last bone to the tip at rest: its first child's place, else as far on as the bone before was long.
static vec3s last_way(const struct imported *imported, const struct chain_bones *bones)
{
    const int last = bones->node[bones->count - 1], child = imported->gltf.nodes[last].child;
    const vec3s at = place_of(imported->rest.world[last]);
    if (child >= 0) return glms_vec3_sub(place_of(imported->rest.world[child]), at);
    if (bones->count > 1) return glms_vec3_sub(at, place_of(imported->rest.world[bones->node[bones->count - 2]]));
    return (vec3s){.raw = {0.0f, 0.1f, 0.0f}};
}

void chain_points_at_rest(const struct imported *imported, const struct chain_bones *bones, float (*point)[3])
{
    for (int n = 0; n < bones->count; n++)
        memcpy(point[n], imported->rest.world[bones->node[n]] + 12, sizeof point[n]);
    const vec3s tip = glms_vec3_add(vec3_from(point[bones->count - 1]), last_way(imported, bones));
    memcpy(point[bones->count], tip.raw, sizeof tip.raw);
}

/// The unit vector from the first bone to the tip at rest.
static vec3s direction(const struct imported *imported, const struct chain_bones *bones)
{
    float point[ANGLES_MAX_JOINTS + 1][3];
    chain_points_at_rest(imported, bones, point);
    const vec3s along = glms_vec3_sub(vec3_from(point[bones->count]), vec3_from(point[0]));
    return glms_vec3_norm(along) > 0.0f ? glms_vec3_normalize(along) : (vec3s){.raw = {0, 0, 1}};
}

/// The part of a vector perpendicular to a unit vector, normalised.
static vec3s perpendicular(vec3s vector, vec3s along)
{
    return glms_vec3_normalize(glms_vec3_muladds(along, -glms_vec3_dot(vector, along), vector));
}

/// The side axis without a turn.
static vec3s side_of(const struct imported *imported, const struct chain_bones *bones)
{
    const vec3s up = {.raw = {0, 1, 0}}, front = {.raw = {0, 0, 1}}, along = direction(imported, bones);
    return perpendicular(fabsf(glms_vec3_dot(along, up)) > UPRIGHT ? front : up, along);
}

/// The mirror image of the twin's side axis. Both must use the same one of up and front, and the mirror image of front is back if the pair is
/// apart along z.
static vec3s mirrored_side(const struct imported *imported, const struct chain_bones *bones,
                           const struct chain_bones *twin)
{
    const vec3s apart =
        glms_vec3_sub(place_of(imported->rest.world[bones->node[0]]), place_of(imported->rest.world[twin->node[0]]));
    vec3s side = side_of(imported, twin);
    const int across = fabsf(apart.z) > fabsf(apart.x) ? 2 : 0;
    side.raw[across] = -side.raw[across];
    return perpendicular(side, direction(imported, bones));
}

struct chain_axes chain_axes_at_rest(const struct imported *imported, const struct chain *chain,
                                     const struct chain_bones *bones)
{
    struct chain_bones twin;
    const bool has_twin = chain->mirror && chain_find_twin(&imported->gltf, chain->from, chain->to, &twin);
    const vec3s along = direction(imported, bones);
    const vec3s straight = has_twin ? mirrored_side(imported, bones, &twin) : side_of(imported, bones);
    const vec3s side = glms_vec3_rotate(straight, (float)radians(chain->turn), along);
    const vec3s lift = glms_vec3_cross(along, side);
    struct chain_axes axes;
    memcpy(axes.side, side.raw, sizeof axes.side);
    memcpy(axes.up, lift.raw, sizeof axes.up);
    memcpy(axes.along, along.raw, sizeof axes.along);
    return axes;
}

int rig_body(const struct document *document, int rig)
{
    const struct rig *of = document->rigs[rig];
    return of->kind == RIG_CHAIN ? document_find_model(document, of->chain.model, of->chain.by_file) : rig;
}

static struct strand strand_of_tail(const struct tail *tail)
{
    struct strand strand = {.channels = tail->channels,
                            .channel_count = tail->channel_count,
                            .joints = tail->joints,
                            .rest = &tail->rest};
    for (int n = 0; n < tail->joints; n++) strand.bones.node[n] = FOX_FIRST_JOINT + n;
    return strand;
}

bool strand_of_chain(const struct chain *chain, const struct imported *imported, struct strand *strand)
{
    *strand = (struct strand){.channels = chain->channels,
                              .channel_count = chain->channel_count,
                              .mirror = chain->mirror,
                              .imported = imported};
    if (!chain_find(&imported->gltf, chain->from, chain->to, &strand->bones, NULL)) return false;
    strand->joints = strand->bones.count;
    strand->axes = chain_axes_at_rest(imported, chain, &strand->bones);
    return true;
}

bool strand_find(const struct posing *posing, int body, int rig, struct strand *strand)
{
    const struct document *document = posing->document;
    if (rig_body(document, rig) != body) return false;
    if (document->rigs[rig]->kind == RIG_TAIL) {
        *strand = strand_of_tail(&document->rigs[rig]->tail);
        return true;
    }
    if (document->rigs[rig]->kind != RIG_CHAIN || body < 0) return false;
    const struct imported *imported = models_imported(posing->models, document, body);
    return imported && strand_of_chain(&document->rigs[rig]->chain, imported, strand);
}

/// The axes of a joint in its own frame at rest, by enum axis.
static void rest_axes(const struct strand *strand, int joint, double axis[3][3])
{
    static const double of_tail[3][3] = {{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}};
    memcpy(axis, of_tail, sizeof of_tail);
    if (!strand->imported) return;
    const float *const about[] = {strand->axes.side, strand->axes.up, strand->axes.along};
    const mat3s inward = into_bone(strand->imported, strand->bones.node[joint]);
    const float sign = glms_mat3_det(inward) < 0.0f ? -1.0f : 1.0f; // a mirrored frame turns the other way
    for (int a = 0; a < 3; a++) {
        const vec3s own = glms_vec3_scale(glms_mat3_mulv(inward, vec3_from(about[a])), sign);
        double length = 0;
        for (int k = 0; k < 3; k++) length += (double)own.raw[k] * (double)own.raw[k];
        for (int k = 0; k < 3; k++) axis[a][k] = length > 0 ? (double)own.raw[k] / sqrt(length) : 0;
    }
}

double strand_sign(const struct strand *strand, enum axis axis)
{
    return strand->mirror && axis != AXIS_UP ? -1.0 : 1.0;
}

/// The radians by which a joint turns about each axis.
static void find_angles(const struct strand *strand, const wiggly_value *values, enum look look, int joint,
                        double angle[3])
{
    for (int axis = AXIS_SIDE; axis <= AXIS_TWIST; axis++) angle[axis] = 0;
    if (strand->rest) angle[AXIS_UP] = radians(angles_at(strand->rest, joint, strand->joints));
    for (int c = 0; c < strand->channel_count; c++) {
        const struct channel *channel = &strand->channels[c];
        if (axis_bends(channel->axis))
            angle[channel->axis] +=
                strand_sign(strand, channel->axis) * channel_bend(channel, values[c], joint, strand->joints, look);
    }
}

static void vector_cross(const double a[3], const double b[3], double across[3])
{
    for (int k = 0; k < 3; k++) across[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}

/// rotation ← rotation · exp(angle · axis)
static void turn_about(const double axis[3], double angle, double rotation[4])
{
    const double c = maths_cos(angle / 2), s = maths_sin(angle / 2), x = s * axis[0], y = s * axis[1],
                 z = s * axis[2];
    const double before[4] = {rotation[0], rotation[1], rotation[2], rotation[3]};
    rotation[0] = before[3] * x + before[0] * c + before[1] * z - before[2] * y;
    rotation[1] = before[3] * y - before[0] * z + before[1] * c + before[2] * x;
    rotation[2] = before[3] * z + before[0] * y - before[1] * x + before[2] * c;
    rotation[3] = before[3] * c - before[0] * x - before[1] * y - before[2] * z;
}

/// Turns a joint's rotation (x y z w) by the values of the channels (eq. 27).
static void turn_joint(const struct strand *strand, const wiggly_value *values, enum look look, int joint,
                       double rotation[4])
{
    double axis[3][3], angle[3];
    rest_axes(strand, joint, axis);
    find_angles(strand, values, look, joint, angle);
    for (int a = 0; a < 3; a++) {
        if (angle[a] != 0.0) turn_about(axis[a], angle[a], rotation);
    }
}

void strand_bend(const struct strand *strand, const wiggly_value *values, enum look look, struct gltf_pose *pose)
{
    for (int n = 0; n < strand->joints; n++) {
        float *rotation = pose->place[strand->bones.node[n]].rotation;
        double turned[4], square = 0;
        for (int k = 0; k < 4; k++) turned[k] = (double)rotation[k];
        turn_joint(strand, values, look, n, turned);
        for (int k = 0; k < 4; k++) square += turned[k] * turned[k];
        for (int k = 0; k < 4 && square > 0; k++) rotation[k] = (float)(turned[k] / sqrt(square));
    }
}

void strand_turned_axes(const struct strand *strand, const wiggly_value *values, int joint, double axis[3][3])
{
    double angle[3];
    rest_axes(strand, joint, axis);
    find_angles(strand, values, LOOK_WIGGLY, joint, angle);
    for (int a = 1; a < 3; a++) {
        if (angle[a] == 0.0) continue;
        const double *about = axis[a], c = maths_cos(angle[a]), s = -maths_sin(angle[a]);
        for (int before = 0; before < a; before++) {
            double *v = axis[before], across[3];
            const double share = (1 - c) * (about[0] * v[0] + about[1] * v[1] + about[2] * v[2]);
            vector_cross(about, v, across);
            for (int k = 0; k < 3; k++) v[k] = c * v[k] + s * across[k] + share * about[k];
        }
    }
}

// --- the way from the root

static const double unit[3] = {1, 1, 1};

static void multiply(const double a[9], const double b[9], double product[9])
{
    for (int i = 0; i < 9; i++)
        product[i] = a[i % 3] * b[i / 3 * 3] + a[3 + i % 3] * b[i / 3 * 3 + 1] + a[6 + i % 3] * b[i / 3 * 3 + 2];
}

/// m · (v scaled)
static void apply(const double m[9], const double scale[3], const double v[3], double out[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = m[k] * scale[0] * v[0] + m[3 + k] * scale[1] * v[1] + m[6 + k] * scale[2] * v[2];
}

static void rotation_matrix(const double q[4], double m[9])
{
    const double x = q[0], y = q[1], z = q[2], w = q[3];
    const double turned[9] = {1 - 2 * (y * y + z * z), 2 * (x * y + w * z),     2 * (x * z - w * y),
                              2 * (x * y - w * z),     1 - 2 * (x * x + z * z), 2 * (y * z + w * x),
                              2 * (x * z + w * y),     2 * (y * z - w * x),     1 - 2 * (x * x + y * y)};
    memcpy(m, turned, sizeof turned);
}

/// Places all nodes in the world, from a root's columns and place.
static void place_nodes(struct path *path, const double root[12])
{
    const double *frame = root, *scale = unit, *at = root + 9;
    for (int n = 0; n < path->count; n++) {
        struct path_node *node = &path->nodes[n];
        double scaled[9];
        for (int k = 0; k < 9; k++) scaled[k] = frame[k] * scale[k / 3];
        apply(frame, scale, node->offset, node->at);
        for (int k = 0; k < 3; k++) node->at[k] += at[k];
        multiply(scaled, node->turn, node->frame);
        frame = node->frame, scale = node->scale, at = node->at;
    }
    apply(frame, scale, path->tip, path->end);
    for (int k = 0; k < 3; k++) path->end[k] += at[k];
}

/// The nodes from the root to a bone, posed by the clip. False if there are too many.
static bool list_nodes(const struct imported *imported, const struct gltf_pose *pose, int last, struct path *path)
{
    const struct gltf *gltf = &imported->gltf;
    path->count = 0;
    for (int n = last; n >= 0; n = gltf->nodes[n].parent) path->count++;
    if (path->count > PATH_MAX_NODES) return false;
    for (int n = last, i = path->count - 1; i >= 0; n = gltf->nodes[n].parent, i--) {
        const struct gltf_node *of = &gltf->nodes[n];
        const struct gltf_place *place = &pose->place[n];
        struct path_node *node = &path->nodes[i];
        *node = (struct path_node){.node = n};
        for (int k = 0; k < 4; k++) node->rotation[k] = (double)place->rotation[k];
        for (int k = 0; k < 3; k++) {
            node->offset[k] = (double)(of->has_matrix ? of->matrix[12 + k] : place->translation[k]);
            node->scale[k] = of->has_matrix ? 1 : (double)place->scale[k];
        }
        rotation_matrix(node->rotation, node->turn);
        for (int k = 0; k < 9 && of->has_matrix; k++) node->turn[k] = (double)of->matrix[4 * (k / 3) + k % 3];
    }
    return true;
}

/// Bends the nodes of a strand.
static void bend_nodes(const struct strand *strand, const wiggly_value *values, enum look look, struct path *path)
{
    for (int i = 0, n = 0; i < path->count && n < strand->joints; i++) {
        if (path->nodes[i].node != strand->bones.node[n]) continue;
        turn_joint(strand, values, look, n++, path->nodes[i].rotation);
        rotation_matrix(path->nodes[i].rotation, path->nodes[i].turn);
    }
}

/// The tip in the last bone's own space.
static void find_tip(const struct strand *strand, double tip[3])
{
    const vec3s way = last_way(strand->imported, &strand->bones);
    const mat3s inward = into_bone(strand->imported, strand->bones.node[strand->joints - 1]);
    const vec3s own = glms_mat3_mulv(inward, way);
    for (int k = 0; k < 3; k++) tip[k] = (double)own.raw[k];
}

/// A straight strand along +z.
static void list_joints(const struct tail *tail, struct path *path)
{
    const double segment = tail->length / tail->joints;
    path->count = tail->joints;
    for (int n = 0; n < path->count; n++)
        path->nodes[n] = (struct path_node){.node = FOX_FIRST_JOINT + n,
                                            .offset = {0, 0, n > 0 ? segment : 0},
                                            .rotation = {0, 0, 0, 1},
                                            .scale = {1, 1, 1}};
    memcpy(path->tip, (const double[]){0, 0, segment}, sizeof path->tip);
}

bool path_find(const struct posing *posing, int rig, double position, const struct by_hand *by_hand,
               struct path *path)
{
    const struct document *document = posing->document;
    const int body = rig_body(document, rig);
    const bool is_tail = body == rig;
    const struct gltf_pose *pose = is_tail ? NULL : posing_clip(posing, body, position, POSE_UNSEEN);
    double root[12] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    wiggly_value values[RIG_MAX_INPUTS];
    struct strand strand;
    if ((!pose && !is_tail) || !strand_find(posing, body, rig, &strand)) return false;
    if (is_tail) {
        list_joints(&document->rigs[rig]->tail, path);
        posing_values(posing, rig, position, by_hand, values);
        tail_base(posing, rig, position, values, by_hand, root + 9);
    } else {
        if (!list_nodes(strand.imported, pose, strand.bones.node[strand.joints - 1], path)) return false;
        find_tip(&strand, path->tip);
        posing_root(posing, body, NULL, root);
    }
    path->first = path->count - strand.joints;
    for (int r = 0; r < document->rig_count; r++) {
        if (!strand_find(posing, body, r, &strand)) continue;
        posing_values(posing, r, position, r == rig ? by_hand : NULL, values);
        bend_nodes(&strand, values, posing->look, path);
    }
    place_nodes(path, root);
    return true;
}

const double *path_end(const struct path *path, int joint)
{
    const int next = path->first + joint + 1;
    return next < path->count ? path->nodes[next].at : path->end;
}

void path_arms(struct path *path, int joint)
{
    const int last = path->first + joint;
    const double *end = last + 1 < path->count ? path->nodes[last + 1].offset : path->tip;
    double to[3] = {end[0], end[1], end[2]};
    for (int n = last; n >= 0; n--) {
        struct path_node *node = &path->nodes[n];
        for (int k = 0; k < 3; k++) node->arm[k] = node->scale[k] * to[k];
        apply(node->turn, unit, node->arm, to);
        for (int k = 0; k < 3; k++) to[k] += node->offset[k];
    }
}

void path_way(const struct path_node *node, const double axis[3], double way[3])
{
    double across[3];
    vector_cross(axis, node->arm, across);
    apply(node->frame, unit, across, way);
}

double path_length(const struct path *path, int count)
{
    double sum = 0;
    for (int n = 0; n < count; n++) {
        const double *from = path->nodes[path->first + n].at, *to = path_end(path, n);
        sum += maths_hypot(maths_hypot(to[0] - from[0], to[1] - from[1]), to[2] - from[2]);
    }
    return sum;
}

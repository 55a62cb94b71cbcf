/// Bends tails and chains, follows the nodes from a root to their tips, and poses and pins them.
#include "rig/strand.h"
#include "maths/maths.h"
#include "model/fox.h"
#include "model/vector.h"
#include "rig/posing.h"
#include <math.h>
#include <string.h>

_Static_assert((int)TAIL_MAX_JOINTS <= (int)POSE_MAX_JOINTS, "a pose holds every tail");

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
static vec3s chain_direction(const struct imported *imported, const struct chain_bones *bones)
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
    const vec3s up = {.raw = {0, 1, 0}}, front = {.raw = {0, 0, 1}}, along = chain_direction(imported, bones);
    return perpendicular(fabsf(glms_vec3_dot(along, up)) > UPRIGHT ? front : up, along);
}

struct chain_axes chain_axes_at_rest(const struct imported *imported, const struct chain *chain,
                                     const struct chain_bones *bones)
{
    struct chain_bones twin;
    const bool has_twin = chain->mirror && chain_find_twin(&imported->gltf, chain->from, chain->to, &twin);
    const vec3s along = chain_direction(imported, bones);
    vec3s straight = side_of(imported, bones);
    if (has_twin) { // The mirror image of the twin's. Both use the same one of up and front; back mirrors front if they are apart along z.
        const vec3s apart = glms_vec3_sub(place_of(imported->rest.world[bones->node[0]]),
                                          place_of(imported->rest.world[twin.node[0]]));
        const int across = fabsf(apart.z) > fabsf(apart.x) ? 2 : 0;
        straight = side_of(imported, &twin);
        straight.raw[across] = -straight.raw[across];
        straight = perpendicular(straight, along);
    }
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
    return of->kind == RIG_CHAIN ? document_find_model(document, of->chain.model) : rig;
}

bool strand_find(const struct posing *posing, int body, int rig, struct strand *strand)
{
    const struct document *document = posing->document;
    if (rig_body(document, rig) != body) return false;
    if (document->rigs[rig]->kind == RIG_TAIL) {
        const struct tail *tail = &document->rigs[rig]->tail;
        *strand = (struct strand){.channels = tail->channels,
                                  .channel_count = tail->channel_count,
                                  .joints = tail->joints,
                                  .rest = &tail->rest};
        for (int n = 0; n < tail->joints; n++) strand->bones.node[n] = FOX_FIRST_JOINT + n;
        return true;
    }
    if (document->rigs[rig]->kind != RIG_CHAIN || body < 0) return false;
    const struct imported *imported = models_imported(posing->models, document, body);
    const struct chain *chain = &document->rigs[rig]->chain;
    *strand = (struct strand){.channels = chain->channels,
                              .channel_count = chain->channel_count,
                              .mirror = chain->mirror,
                              .imported = imported};
    if (!imported || !chain_find(&imported->gltf, chain->from, chain->to, &strand->bones, NULL)) return false;
    strand->joints = strand->bones.count;
    strand->axes = chain_axes_at_rest(imported, chain, &strand->bones);
    return true;
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

/// Turns a joint's rotation (x y z w) by the values of the channels (eq. 27).
static void turn_joint(const struct strand *strand, const wiggly_value *values, enum look look, int joint,
                       double rotation[4])
{
    double axis[3][3], angle[3];
    rest_axes(strand, joint, axis);
    find_angles(strand, values, look, joint, angle);
    for (int a = 0; a < 3; a++) { // rotation ← rotation · exp(angle · axis)
        if (angle[a] == 0.0) continue;
        const double c = maths_cos(angle[a] / 2), s = maths_sin(angle[a] / 2);
        const double x = s * axis[a][0], y = s * axis[a][1], z = s * axis[a][2];
        const double before[4] = {rotation[0], rotation[1], rotation[2], rotation[3]};
        rotation[0] = before[3] * x + before[0] * c + before[1] * z - before[2] * y;
        rotation[1] = before[3] * y - before[0] * z + before[1] * c + before[2] * x;
        rotation[2] = before[3] * z + before[0] * y - before[1] * x + before[2] * c;
        rotation[3] = before[3] * c - before[0] * x - before[1] * y - before[2] * z;
    }
}

static void set_rotation(float rotation[4], const double turned[4])
{
    double square = 0;
    for (int k = 0; k < 4; k++) square += turned[k] * turned[k];
    for (int k = 0; k < 4 && square > 0; k++) rotation[k] = (float)(turned[k] / sqrt(square));
}

void strand_bend(const struct strand *strand, const wiggly_value *values, enum look look, struct gltf_pose *pose)
{
    for (int n = 0; n < strand->joints; n++) {
        float *rotation = pose->place[strand->bones.node[n]].rotation;
        double turned[4];
        for (int k = 0; k < 4; k++) turned[k] = (double)rotation[k];
        turn_joint(strand, values, look, n, turned);
        set_rotation(rotation, turned);
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

// --- the base of a tail

/// Limits of the body's parts, degrees and percent, so that no spline breaks the fox.
static const struct {
    double lowest, highest;
} limb_limits[AXES] = {
    [AXIS_LOOK] = {-70, 70},   [AXIS_NOD] = {-35, 35},     [AXIS_EARS] = {-30, 60},
    [AXIS_BREATH] = {-15, 25}, [AXIS_STRETCH] = {-40, 40}, [AXIS_BLINK] = {0, 100},
};

/// Sum of an axis' channels for a part's n-th joint, within the limb_limits.
static double limb_moved(const struct tail *tail, const wiggly_value *values, enum look look, enum axis axis, int n)
{
    double sum = 0;
    for (int c = 0; c < tail->channel_count; c++) {
        if (tail->channels[c].axis == axis) sum += channel_moves(&tail->channels[c], values[c], n, look);
    }
    return fmin(fmax(sum, limb_limits[axis].lowest), limb_limits[axis].highest);
}

/// The base of a tail, metres of the world, and the motion of the body's parts.
static struct limbs tail_base(const struct posing *posing, int rig, double position, const wiggly_value *values,
                              double base[3])
{
    const struct tail *tail = &posing->document->rigs[rig]->tail;
    const enum look look = posing->look;
    const double stretch = limb_moved(tail, values, look, AXIS_STRETCH, 1) / 100;
    struct limbs limbs = {
        .look = (float)radians(limb_moved(tail, values, look, AXIS_LOOK, 1)),
        .nod = (float)radians(limb_moved(tail, values, look, AXIS_NOD, 1)),
        .breath = (float)limb_moved(tail, values, look, AXIS_BREATH, 1) / 100,
        .stretch = (float)stretch,
        .blink = (float)limb_moved(tail, values, look, AXIS_BLINK, 1) / 100,
    };
    for (int n = 0; n < 2; n++) limbs.ears[n] = (float)radians(limb_moved(tail, values, look, AXIS_EARS, n + 1));

    double by[3];
    limbs_base(stretch, tail->length / (double)FOX_TAIL_LENGTH, base);
    posing_base(posing, rig, by);
    for (int k = 0; k < 3; k++) {
        const struct param *param = &tail->position[k];
        const wiggly_value value = evaluation_at(posing->evaluation, param->track, position);
        base[k] += by[k] + (param->track < 0 ? param->value : value.y + value.re);
    }
    return limbs;
}

// --- the way from the root

static const double unit[3] = {1, 1, 1};

/// m · (v scaled)
static void path_apply(const double m[9], const double scale[3], const double v[3], double out[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = m[k] * scale[0] * v[0] + m[3 + k] * scale[1] * v[1] + m[6 + k] * scale[2] * v[2];
}

bool path_find(const struct posing *posing, int rig, double position, struct path *path)
{
    const struct document *document = posing->document;
    const int body = rig_body(document, rig);
    const bool is_tail = body == rig;
    const struct gltf_pose *pose = is_tail ? NULL : posing_clip(posing, body, position, POSE_UNSEEN);
    double root[12] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    wiggly_value values[RIG_MAX_INPUTS];
    struct strand strand;
    if ((!pose && !is_tail) || !strand_find(posing, body, rig, &strand)) return false;
    if (is_tail) { // a straight strand along +z
        const struct tail *tail = &document->rigs[rig]->tail;
        const double segment = tail->length / tail->joints;
        path->count = tail->joints;
        for (int n = 0; n < path->count; n++)
            path->nodes[n] = (struct path_node){.node = FOX_FIRST_JOINT + n,
                                                .offset = {0, 0, n > 0 ? segment : 0},
                                                .rotation = {0, 0, 0, 1},
                                                .scale = {1, 1, 1}};
        memcpy(path->tip, (const double[]){0, 0, segment}, sizeof path->tip);
        posing_values(posing, rig, position, values);
        path->limbs = tail_base(posing, rig, position, values, root + 9);
    } else {
        // The nodes from the root to the last bone, posed by the clip.
        const struct gltf *gltf = &strand.imported->gltf;
        const int last = strand.bones.node[strand.joints - 1];
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
            quat_matrix(node->rotation, node->turn);
            for (int k = 0; k < 9 && of->has_matrix; k++) node->turn[k] = (double)of->matrix[4 * (k / 3) + k % 3];
        }
        const mat3s inward = into_bone(strand.imported, last);
        const vec3s tip = glms_mat3_mulv(inward, last_way(strand.imported, &strand.bones));
        for (int k = 0; k < 3; k++) path->tip[k] = (double)tip.raw[k];
        posing_root(posing, body, root);
    }
    path->first = path->count - strand.joints;
    for (int r = 0; r < document->rig_count; r++) {
        if (!strand_find(posing, body, r, &strand)) continue;
        posing_values(posing, r, position, values);
        for (int i = 0, n = 0; i < path->count && n < strand.joints; i++) {
            struct path_node *node = &path->nodes[i];
            if (node->node != strand.bones.node[n]) continue;
            turn_joint(&strand, values, posing->look, n++, node->rotation);
            quat_matrix(node->rotation, node->turn);
        }
    }

    const double *frame = root, *scale = unit, *at = root + 9;
    for (int n = 0; n < path->count; n++) {
        struct path_node *node = &path->nodes[n];
        double a[9];
        for (int k = 0; k < 9; k++) a[k] = frame[k] * scale[k / 3];
        path_apply(frame, scale, node->offset, node->at);
        for (int k = 0; k < 3; k++) node->at[k] += at[k];
        for (int k = 0; k < 9; k++) {
            const double *b = &node->turn[k / 3 * 3];
            node->frame[k] = a[k % 3] * b[0] + a[3 + k % 3] * b[1] + a[6 + k % 3] * b[2];
        }
        frame = node->frame, scale = node->scale, at = node->at;
    }
    path_apply(frame, scale, path->tip, path->end);
    for (int k = 0; k < 3; k++) path->end[k] += at[k];
    return true;
}

/// The end of the strand's joint in the world.
static const double *path_end(const struct path *path, int joint)
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
        path_apply(node->turn, unit, node->arm, to);
        for (int k = 0; k < 3; k++) to[k] += node->offset[k];
    }
}

void path_way(const struct path_node *node, const double axis[3], double way[3])
{
    double across[3];
    vector_cross(axis, node->arm, across);
    path_apply(node->frame, unit, across, way);
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

// --- posed

double channel_bend(const struct channel *channel, wiggly_value value, int n, int joints, enum look look)
{
    const double lag = look == LOOK_STIFF ? 0.0 : radians(angles_lag(&channel->lag, n, joints));
    return radians(angles_at(&channel->gain, n, joints)) * wiggly_lagged(value, lag);
}

double channel_moves(const struct channel *channel, wiggly_value value, int n, enum look look)
{
    const double lag = look == LOOK_STIFF ? 0.0 : n * radians(angles_at(&channel->lag, 0, 1));
    return angles_at(&channel->gain, 0, 1) * wiggly_lagged(value, lag);
}

static void set_strand(const struct path *path, struct pose *strand)
{
    strand->count = path->count - path->first + 1;
    for (int n = 0; n < strand->count; n++) {
        const struct path_node *node = &path->nodes[n + 1 < strand->count ? path->first + n : path->count - 1];
        const double *at = n + 1 < strand->count ? node->at : path->end;
        for (int k = 0; k < 12; k++)
            strand->matrix[n][k] = k % 4 == 3 ? 0.0f : (float)node->frame[3 * (k / 4) + k % 4];
        for (int k = 0; k < 3; k++) strand->matrix[n][12 + k] = (float)at[k];
        strand->matrix[n][15] = 1.0f;
    }
}

bool chain_pose(const struct posing *posing, int rig, double position, struct pose *strand)
{
    struct path path;
    if (!path_find(posing, rig, position, &path)) return false;
    set_strand(&path, strand);
    return true;
}

bool tail_pose(const struct posing *posing, int rig, double position, struct rig_pose *posed, struct rig_pose *fox)
{
    const struct tail *tail = &posing->document->rigs[rig]->tail;
    const double scale = tail->length / (double)FOX_TAIL_LENGTH;
    const double height = (double)(FOX_BASE_HEIGHT / FOX_TAIL_LENGTH) * tail->length;
    const float ground = tail->position[1].track < 0 ? (float)(tail->position[1].value - height) : 0.0f;
    struct path path;
    if (!path_find(posing, rig, position, &path)) return false;
    if (posed) {
        posed->kind = RIG_TAIL;
        posed->strand.ground = ground;
        posed->strand.scale = (float)scale;
        posed->strand.limbs = path.limbs;
        set_strand(&path, &posed->strand);
    }
    if (!fox) return true;

    struct gltf_pose *pose = posing_clip(posing, rig, position, posing->memory);
    if (!pose) return false;
    for (int n = 0; n < path.count; n++) // at rest the fox's tail is straight, too
        set_rotation(pose->place[path.nodes[n].node].rotation, path.nodes[n].rotation);
    fox_move(&path.limbs, pose);
    fox->kind = RIG_MODEL;
    fox->imported = models_imported(posing->models, posing->document, rig);
    fox->model = (struct model_pose){.gltf = &fox->imported->gltf, .pose = pose, .ground = ground};
    gltf_pose_world(fox->model.gltf, pose);
    for (int k = 0; k < 16; k++) fox->model.root[k] = k % 5 == 0 ? (float)scale : 0.0f;
    for (int k = 0; k < 3; k++) fox->model.root[12 + k] = (float)path.nodes[0].at[k]; // the tail's base
    fox->model.root[15] = 1.0f;
    return true;
}

// --- pinned: points where joints end
//
// Let L be the matrix from the frame of a bent joint to the world. A turn of the joint about an axis a moves a point at r from the joint, in
// that frame, by L (a × r). Each axis is the one left by the turns after it.

static const double SLACK = 1e-6; ///< of the length

/// How splines move the end of a path's joint by bending a strand.
static void add_bends(const struct path *path, int joint, const struct strand *strand, const wiggly_value *values,
                      const struct pin_query *query, pin_pull *c)
{
    for (int i = 0, n = 0; i <= path->first + joint && n < strand->joints; i++) {
        const struct path_node *node = &path->nodes[i];
        double axis[3][3], way[3][3];
        if (node->node != strand->bones.node[n]) continue;
        strand_turned_axes(strand, values, n, axis);
        for (int a = 0; a < 3; a++) {
            for (int k = 0; k < 3; k++) axis[a][k] *= strand_sign(strand, (enum axis)a);
            path_way(node, axis[a], way[a]);
        }
        for (int h = 0; h < strand->channel_count; h++) {
            const struct channel *channel = &strand->channels[h];
            for (int s = 0; s < query->count && axis_bends(channel->axis); s++) {
                if (query->splines[s] == channel->spline)
                    pinning_add_channel(channel, n, strand->joints, way[channel->axis], c[s]);
            }
        }
        n++;
    }
}

bool strand_find_pin(const struct posing *posing, const struct pin_query *query, pin_pull *c, struct pin_point *point)
{
    const struct document *document = posing->document;
    const double sample = document_sample(document, query->pin->frame) + query->later;
    const int rig = query->rig, body = rig_body(document, rig), joint = query->pin->point;
    wiggly_value values[RIG_MAX_INPUTS];
    struct strand strand;
    struct path path;
    if (!path_find(posing, rig, sample, &path) || joint >= path.count - path.first) return false;
    const double length = path_length(&path, path.count - path.first);
    *point = (struct pin_point){.size = length, .slack = SLACK * length, .reach = path_length(&path, joint + 1)};
    memcpy(point->at, path_end(&path, joint), sizeof point->at);
    memcpy(point->base, path.nodes[path.first].at, sizeof point->base);
    path_arms(&path, joint);
    for (int r = 0; query->count > 0 && r < document->rig_count; r++) {
        const bool at_once = document->rigs[r]->offset == document->rigs[rig]->offset; // others are as they are
        if (!at_once || !strand_find(posing, body, r, &strand)) continue;
        posing_values(posing, r, sample, values);
        add_bends(&path, joint, &strand, values, query, c);
        if (r != body) continue;

        // The motion of a tail's base, and how the body's stretch moves it; pinning_add_channel() takes percent for degrees.
        const struct tail *tail = &document->rigs[rig]->tail;
        double way[3];
        const struct limbs limbs = tail_base(posing, rig, 0, values, way);
        limbs_base_slope((double)limbs.stretch, tail->length / (double)FOX_TAIL_LENGTH, way);
        for (int k = 0; k < 3; k++) way[k] *= 1.8 / 3.14159265358979323846;
        for (int s = 0; s < query->count; s++) {
            for (int k = 0; k < 3 && document->rigs[r]->offset == 0; k++) // else the base is ahead of the bends
                c[s][k][0] += tail->position[k].track == query->splines[s];
            for (int i = 0; i < tail->channel_count; i++) {
                const struct channel *channel = &tail->channels[i];
                if (channel->spline == query->splines[s] && channel->axis == AXIS_STRETCH)
                    pinning_add_channel(channel, 1, 1, way, c[s]);
            }
        }
    }
    return true;
}

double strand_weigh(const struct posing *posing, int rig, int spline)
{
    const wiggly_value values[RIG_MAX_INPUTS] = {{0}};
    const struct pin_query query = {.splines = &spline, .count = 1};
    double sum = 0;
    struct strand strand;
    struct path path;
    if (!path_find(posing, rig, 0, &path) || !strand_find(posing, rig_body(posing->document, rig), rig, &strand))
        return 0;
    for (int n = 0; n < strand.joints; n++) {
        pin_pull c[1] = {{{0}}};
        path_arms(&path, n);
        add_bends(&path, n, &strand, values, &query, c);
        sum += pinning_square(c[0]) / strand.joints;
    }
    return sum;
}

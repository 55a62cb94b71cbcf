/// Poses of glTF characters: clips, matrices of nodes and joints, the vertices v′ = Σ wⱼ Jⱼ (v + Σ wₜ Δₜ v), normals by the cofactors of the
/// same matrix, and bounding boxes; and whether a clip loops.
#include "maths/maths.h"
#include "model/glb.h"
#include "model/vector.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

bool gltf_pose_create(const struct gltf *gltf, struct gltf_pose *pose)
{
    *pose = (struct gltf_pose){0};
    pose->place = pool_try(&pose->pool, (size_t)gltf->node_count, sizeof *pose->place);
    pose->world = pool_try(&pose->pool, (size_t)gltf->node_count, sizeof *pose->world);
    pose->joints = pool_try(&pose->pool, (size_t)gltf->joint_count, sizeof *pose->joints);
    pose->weights = pool_try(&pose->pool, (size_t)gltf->weight_count, sizeof *pose->weights);
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
    pool_free(&pose->pool);
    *pose = (struct gltf_pose){0};
}

void gltf_pose_world(const struct gltf *gltf, struct gltf_pose *pose)
{
    for (int i = 0; i < gltf->node_count; i++) {
        int n = gltf->order[i];
        const struct gltf_node *node = &gltf->nodes[n];
        mat4s m = mat4_from(node->matrix);
        if (!node->has_matrix) { // translation · rotation · scale
            const struct gltf_place *place = &pose->place[n];
            versors q;
            memcpy(&q, place->rotation, sizeof q);
            m = glms_quat_mat4(q);
            for (int c = 0; c < 3; c++) glm_vec4_scale(m.raw[c], place->scale[c], m.raw[c]);
            memcpy(m.raw[3], place->translation, sizeof place->translation);
        }
        if (node->parent >= 0) m = glms_mat4_mul(mat4_from(pose->world[node->parent]), m);
        memcpy(pose->world[n], &m, sizeof m);
    }
    for (int s = 0; s < gltf->skin_count; s++) {
        const struct gltf_skin *skin = &gltf->skins[s];
        for (int j = 0; j < skin->joint_count; j++) {
            mat4s m = glms_mat4_mul(mat4_from(pose->world[skin->joints[j]]), mat4_from(skin->inverse_bind[j]));
            memcpy(pose->joints[skin->first_joint + j], &m, sizeof m);
        }
    }
}

// --- vertices

/// v + Σ w Δ; `targets` are those of positions or normals, from the same array.
static void morph(const struct gltf_part *part, int target_count, const float *weights, bool normals, float (*out)[3])
{
    const float(*rest)[3] = normals ? part->normal : part->position;
    const size_t size = (size_t)part->vertex_count * sizeof *out;
    if (!rest) {
        memset(out, 0, size);
        return;
    }
    memcpy(out, rest, size);
    for (int t = 0; t < target_count; t++) {
        const float(*by)[3] = normals ? part->targets[t].normal : part->targets[t].position;
        float w = weights[t];
        if (!by || w == 0) continue;
        for (int i = 0; i < part->vertex_count; i++)
            for (int k = 0; k < 3; k++) out[i][k] += w * by[i][k];
    }
}

void gltf_blend(const float (*joints)[16], const uint16_t *joint, const float *weights, float m[16])
{
    memset(m, 0, 16 * sizeof *m);
    for (int k = 0; k < GLTF_INFLUENCES; k++) {
        if (weights[k] == 0) continue;
        const float *one = joints[joint[k]], w = weights[k];
        for (int n = 0; n < 16; n++) m[n] += w * one[n];
    }
}

/// Turns a vertex's matrix into the deformation gradient: weights that change along z move the vertex, too.
static void stretch(const float (*joints)[16], const uint16_t *joint, const float *along, const float at[3],
                    float m[16])
{
    for (int k = 0; k < GLTF_INFLUENCES; k++) {
        const float *one = joints[joint[k]];
        if (along[k] == 0) continue;
        for (int r = 0; r < 3; r++)
            m[8 + r] += along[k] * (one[r] * at[0] + one[4 + r] * at[1] + one[8 + r] * at[2] + one[12 + r]);
    }
}

void gltf_turn_normal(const float m[16], float normal[3])
{
    const vec3s x = vec3_from(m), y = vec3_from(m + 4), z = vec3_from(m + 8), yz = glms_vec3_cross(y, z);
    vec3s sum = glms_vec3_scale(yz, normal[0]);
    sum = glms_vec3_add(sum, glms_vec3_scale(glms_vec3_cross(z, x), normal[1]));
    sum = glms_vec3_add(sum, glms_vec3_scale(glms_vec3_cross(x, y), normal[2]));
    float length = glms_vec3_norm(sum);
    if (length > 0) sum = glms_vec3_divs(sum, glms_vec3_dot(x, yz) < 0 ? -length : length);
    glm_vec3_copy(sum.raw, normal);
}

void gltf_pose_vertices(const struct gltf *gltf, const struct gltf_pose *pose, int node, float (*positions)[3],
                        float (*normals)[3])
{
    const struct gltf_node *shown = &gltf->nodes[node];
    if (shown->mesh < 0) return;
    const struct gltf_mesh *mesh = &gltf->meshes[shown->mesh];
    const float *weights = pose->weights + shown->first_weight;
    const float(*joints)[16] = shown->skin >= 0 ? pose->joints + gltf->skins[shown->skin].first_joint : NULL;
    for (int p = 0; p < mesh->part_count; p++) {
        const struct gltf_part *part = &mesh->parts[p];
        bool skinned = joints && part->joints;
        morph(part, mesh->target_count, weights, false, positions);
        if (normals) morph(part, mesh->target_count, weights, true, normals);
        float m[16];
        memcpy(m, pose->world[node], sizeof m);
        for (int i = 0; i < part->vertex_count; i++) {
            const vec3s at = vec3_from(positions[i]);
            const float *v = at.raw;
            if (skinned) gltf_blend(joints, part->joints[i], part->weights[i], m);
            for (int k = 0; k < 3; k++) positions[i][k] = m[k] * v[0] + m[4 + k] * v[1] + m[8 + k] * v[2] + m[12 + k];
            if (!normals) continue;
            if (skinned && part->along) stretch(joints, part->joints[i], part->along[i], v, m);
            gltf_turn_normal(m, normals[i]);
        }
        positions += part->vertex_count;
        if (normals) normals += part->vertex_count;
    }
}

// --- clips at a time
//
// Between the keys k and k + 1 with s = (t − t_k) / T, T = t_{k+1} − t_k, a channel is v_k (step), (1 − s) v_k + s v_{k+1} (linear; a
// rotation goes along the great circle, the short way) or, with the tangents b_k out of and a_k into a key,
//     (2s³ − 3s² + 1) v_k + T (s³ − 2s² + s) b_k + (3s² − 2s³) v_{k+1} + T (s³ − s²) a_{k+1}.

static const double ROUNDING = 1e-7; ///< of a time: keys have single precision, and a frame must not miss its step

static void normalise(float q[4])
{
    float length = sqrtf(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    for (int k = 0; k < 4; k++) q[k] = length > 0 ? q[k] / length : (float)(k == 3);
}

/// From a to b, or to −b if that is nearer: both are the same rotation. cglm's version passes zero if b is almost −a.
static void slerp(const float a[4], const float b[4], float s, float out[4])
{
    float cosine = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
    float sign = cosine < 0 ? -1.0f : 1.0f, from = 1 - s, to = s;
    if (cosine * sign < 0.9999f) {
        float angle = maths_acosf(cosine * sign);
        from = maths_sinf(from * angle) / maths_sinf(angle);
        to = maths_sinf(to * angle) / maths_sinf(angle);
    }
    for (int k = 0; k < 4; k++) out[k] = from * a[k] + to * sign * b[k];
}

static void cubic(const float *key, const float *arriving, int components, float s, float T, float *out)
{
    const float *value = key + components, *leaving = key + 2 * components, *next = arriving + components;
    float s2 = s * s, s3 = s2 * s;
    for (int k = 0; k < components; k++)
        out[k] = (2 * s3 - 3 * s2 + 1) * value[k] + T * (s3 - 2 * s2 + s) * leaving[k] + (3 * s2 - 2 * s3) * next[k] +
                 T * (s3 - s2) * arriving[k];
}

/// The value between two keys `T` seconds apart, whose numbers begin at `from` and `to`.
static void between(const struct gltf_channel *channel, const float *from, const float *to, float s, double T,
                    float *out)
{
    const int n = channel->components;
    if (channel->interpolation == GLTF_CUBIC) {
        cubic(from, to, n, s, (float)T, out);
    } else if (channel->path == GLTF_ROTATION) {
        slerp(from, to, s, out);
    } else {
        for (int k = 0; k < n; k++) out[k] = (1 - s) * from[k] + s * to[k];
    }
}

void gltf_channel_at(const struct gltf_channel *channel, double time, float *out)
{
    if (channel->interpolation == GLTF_STEP) time += ROUNDING * fabs(time);
    int key = 0; // the last key at or before the time, else the first
    for (int end = channel->key_count; end - key > 1;) {
        const int middle = key + (end - key) / 2;
        if ((double)channel->times[middle] <= time) {
            key = middle;
        } else {
            end = middle;
        }
    }
    const int n = channel->components, stride = gltf_stride(channel);
    const float *at = channel->values + (size_t)key * (size_t)stride;
    const double from = (double)channel->times[key];
    if (key + 1 == channel->key_count || time <= from || channel->interpolation == GLTF_STEP) {
        memcpy(out, stride > n ? at + n : at, (size_t)n * sizeof *out);
    } else {
        const double T = (double)channel->times[key + 1] - from;
        between(channel, at, at + stride, (float)((time - from) / T), T, out);
    }
    if (channel->path == GLTF_ROTATION) normalise(out);
}

/// Where a channel's value is in a pose.
static float *value_in(const struct gltf *gltf, const struct gltf_channel *channel, struct gltf_pose *pose)
{
    struct gltf_place *place = &pose->place[channel->node];
    float *const of[] = {place->translation, place->rotation, place->scale,
                         pose->weights + gltf->nodes[channel->node].first_weight};
    return of[channel->path];
}

void gltf_pose_clip(const struct gltf *gltf, int clip, double time, struct gltf_pose *pose)
{
    for (int n = 0; n < gltf->node_count; n++) pose->place[n] = gltf->nodes[n].place;
    for (int w = 0; w < gltf->weight_count; w++) pose->weights[w] = gltf->weights[w];
    for (int i = 0; clip >= 0 && i < gltf->clips[clip].channel_count; i++) {
        const struct gltf_channel *channel = &gltf->clips[clip].channels[i];
        gltf_channel_at(channel, time, value_in(gltf, channel, pose));
    }
}

void gltf_pose_loop(const struct gltf *gltf, int clip, double time, struct gltf_pose *pose)
{
    gltf_pose_clip(gltf, clip, time, pose);
    if (clip < 0) return;
    const struct gltf_clip *of = &gltf->clips[clip];
    const double into = fmin(time - of->last, of->gap), share = into / (of->last - of->first);
    for (int i = 0; into > 0 && i < of->channel_count; i++) {
        const struct gltf_channel *channel = &of->channels[i];
        const int n = channel->components, stride = gltf_stride(channel), value = stride > n ? n : 0;
        const float *first = channel->values, *last = first + (size_t)(channel->key_count - 1) * (size_t)stride;
        float *out = value_in(gltf, channel, pose);
        if (channel->travels) {
            for (int k = 0; k < n; k++)
                out[k] = last[value + k] + (float)share * (last[value + k] - first[value + k]);
        } else if (channel->interpolation == GLTF_STEP) {
            if (into == of->gap) memcpy(out, first, (size_t)n * sizeof *out);
        } else {
            between(channel, last, first, (float)(into / of->gap), of->gap, out);
        }
        if (channel->path == GLTF_ROTATION) normalise(out);
    }
}

// --- a bounding box for each joint

static void add_vertex(struct gltf_box *box, const struct gltf_mesh *mesh, const struct gltf_part *part, int v)
{
    glm_vec3_minv(part->position[v], box->lo, box->lo);
    glm_vec3_maxv(part->position[v], box->hi, box->hi);
    for (int t = 0; t < mesh->target_count; t++) {
        const float(*position)[3] = (const float(*)[3])part->targets[t].position;
        for (int k = 0; position && k < 3; k++) {
            box->ways[t][0][k] = fminf(box->ways[t][0][k], position[v][k]);
            box->ways[t][1][k] = fmaxf(box->ways[t][1][k], position[v][k]);
        }
    }
}

static int box_count(const struct gltf *gltf, const struct gltf_node *node)
{
    if (node->mesh < 0) return 0;
    return node->skin < 0 ? 1 : gltf->skins[node->skin].joint_count;
}

bool gltf_bounds_create(struct gltf *gltf, struct gltf_bounds *bounds)
{
    size_t total = 0;
    for (int n = 0; n < gltf->node_count; n++) total += (size_t)box_count(gltf, &gltf->nodes[n]);
    *bounds = (struct gltf_bounds){.boxes = pool_try(&gltf->pool, total, sizeof *bounds->boxes)};
    if (!bounds->boxes) return false;
    for (int n = 0; n < gltf->node_count; n++) {
        const struct gltf_node *node = &gltf->nodes[n];
        const int count = box_count(gltf, node);
        struct gltf_box *first = bounds->boxes + bounds->count;
        const struct gltf_mesh *mesh = count > 0 ? &gltf->meshes[node->mesh] : NULL;
        const size_t targets = mesh ? (size_t)mesh->target_count : 0, ways = (size_t)count * targets;
        if (ways > gltf->room / sizeof *first->ways) return false;
        float(*way)[2][3] = pool_try(&gltf->pool, ways, sizeof *way);
        if (!way) return false;
        for (int f = 0; f < count; f++) {
            first[f] =
                (struct gltf_box){.node = n, .joint = node->skin < 0 ? -1 : f, .ways = way + (size_t)f * targets};
            glm_vec3_fill(first[f].lo, INFINITY);
            glm_vec3_fill(first[f].hi, -INFINITY);
        }
        for (int p = 0; mesh && p < mesh->part_count; p++) {
            const struct gltf_part *part = &mesh->parts[p];
            const bool skinned = node->skin >= 0 && part->joints;
            for (int i = 0; i < part->vertex_count * (skinned ? GLTF_INFLUENCES : 1); i++) {
                const int v = skinned ? i / GLTF_INFLUENCES : i, k = i % GLTF_INFLUENCES;
                if (!skinned) add_vertex(first, mesh, part, v);
                if (skinned && part->weights[v][k] > 0.0f) add_vertex(&first[part->joints[v][k]], mesh, part, v);
            }
        }
        for (int f = 0; f < count; f++) { // most joints of a large skin move a small part of one mesh, or nothing
            if (first[f].lo[0] <= first[f].hi[0]) bounds->boxes[bounds->count++] = first[f];
        }
    }
    return true;
}

void gltf_bounds_at(const struct gltf_bounds *bounds, const struct gltf *gltf, const struct gltf_pose *pose, int but,
                    float lo[3], float hi[3])
{
    glm_vec3_fill(lo, INFINITY);
    glm_vec3_fill(hi, -INFINITY);
    for (int f = 0; f < bounds->count; f++) {
        const struct gltf_box *box = &bounds->boxes[f];
        const struct gltf_node *node = &gltf->nodes[box->node];
        if (box->node == but) continue;
        const float *m =
            box->joint < 0 ? pose->world[box->node] : pose->joints[gltf->skins[node->skin].first_joint + box->joint];

        vec3 reached[2];
        memcpy(reached[0], box->lo, sizeof reached[0]);
        memcpy(reached[1], box->hi, sizeof reached[1]);
        for (int i = 0; i < 3 * gltf->meshes[node->mesh].target_count; i++) {
            const float weight = pose->weights[node->first_weight + i / 3];
            const float one = weight * box->ways[i / 3][0][i % 3], other = weight * box->ways[i / 3][1][i % 3];
            reached[0][i % 3] += fminf(one, other);
            reached[1][i % 3] += fmaxf(one, other);
        }
        mat4s placed = mat4_from(m);
        glm_aabb_transform(reached, placed.raw, reached);
        glm_vec3_minv(reached[0], lo, lo);
        glm_vec3_maxv(reached[1], hi, hi);
    }
}

// --- loops
//
// Judges whether a clip loops, by its pose without the travel of the root.
//
// A channel is closed if its last value is close to its first, in parts of its range. A translation that is open but steady, of a node that
// no open node carries, is travel. If all others are closed, the clip loops. Over all channels together it also loops
// - if it is cut less than half a step beside its start and goes on at the same speed there, as cycles from captured motion do;
// - if it leaves the copy of the first key out: then the step from its last key to its first is like the steps before and after it.

static const float SMALL_RANGE = 0.2f; ///< of a channel's largest value: a smaller range counts as that
static const float MOVES = 0.1f;       ///< of SMALL_RANGE: a channel that moves less stands still
static const float CLOSE = 0.02f;      ///< of a channel's range
static const float STEADY = 0.4f;      ///< of the mean speed: the least at both ends of a clip that travels
enum { PARTS = 8 };                    ///< of a clip, in which speeds are measured

// Of the step from the last key to the first, all squared:
static const double LIKE = 0.25; ///< of the steps around it: how far it may be from them,
static const double BENT = 2.25; ///< or of how far steps within the clip are from those around them
static const double CUT = 0.25;  ///< of the steps around it: a shorter one is a cut that nobody sees
static const double LEAST = 0.1; ///< of the mean step: a shorter one ends near the start, but not before it
static const double MOST = 6.25; ///< of the largest step of each channel
enum { LEAST_STEPS = 4, FEW_STEPS = 12, MOST_STEPS = 64 }; // MOST_STEPS are looked at

struct ends {
    const float *first, *last; ///< values
    float sign;                ///< of the last: a rotation may have the other sign
    float range, unit;         ///< of the values; and what differences are measured in
    bool open;
};

static double square(double x) { return x * x; }

static float dot(const float *a, const float *b, int count)
{
    float sum = 0;
    for (int k = 0; k < count; k++) sum += a[k] * b[k];
    return sum;
}

static struct ends ends_of(const struct gltf_channel *channel)
{
    const int n = channel->components, stride = gltf_stride(channel);
    const bool is_rotation = channel->path == GLTF_ROTATION;
    struct ends ends = {.first = channel->values + (stride > n ? n : 0), .sign = 1};
    ends.last = ends.first + (size_t)(channel->key_count - 1) * (size_t)stride;
    if (is_rotation && dot(ends.first, ends.last, n) < 0) ends.sign = -1;
    float largest = 1e-6f, apart = 0;
    for (int i = 0; i < n; i++) {
        float lo = ends.first[i], hi = lo;
        for (const float *key = ends.first; key <= ends.last; key += stride) {
            const float value = is_rotation && dot(ends.first, key, n) < 0 ? -key[i] : key[i];
            lo = fminf(lo, value);
            hi = fmaxf(hi, value);
        }
        largest = fmaxf(largest, fmaxf(-lo, hi));
        ends.range = fmaxf(ends.range, hi - lo);
        apart = fmaxf(apart, fabsf(ends.sign * ends.last[i] - ends.first[i]));
    }
    ends.unit = fmaxf(ends.range, SMALL_RANGE * largest);
    ends.open = apart > CLOSE * ends.unit;
    if (ends.range < MOVES * SMALL_RANGE * largest) ends.range = 0;
    return ends;
}

/// Whether an open translation goes on at about the same speed from the beginning to the end.
static bool is_steady(const struct gltf_channel *channel, const struct ends *ends, double first, double length)
{
    float way[3], at[3];
    if (channel->path != GLTF_TRANSLATION || channel->interpolation == GLTF_STEP) return false;
    for (int k = 0; k < 3; k++) way[k] = ends->last[k] - ends->first[k];
    float before = 0, size = dot(way, way, 3);
    for (int part = 1; part <= PARTS; part++) {
        gltf_channel_at(channel, first + length * part / PARTS, at);
        for (int k = 0; k < 3; k++) at[k] -= ends->first[k];
        const float now = dot(at, way, 3) / size, speed = PARTS * (now - before);
        if ((part == 1 || part == PARTS) && !(speed > STEADY && speed < 1 / STEADY)) return false;
        before = now;
    }
    return true;
}

/// Squares of differences, in parts of channels' units, summed over all channels that do not travel.
struct steps {
    double step, around[2]; ///< the step from one key to the next, and those before and after it
    double bend;            ///< how far it is from the mean of those
    double change;          ///< and how far those are from each other
};

/// Adds the step between the middle two of four times. `values` holds four values of the channel.
static void add_steps(const struct gltf_channel *channel, const struct ends *ends, const double times[4],
                      float *values, struct steps *sum)
{
    const int n = channel->components;
    for (int i = 0; i < 4; i++) {
        float *value = values + (size_t)i * (size_t)n;
        gltf_channel_at(channel, times[i], value);
        const bool turned = channel->path == GLTF_ROTATION && dot(ends->first, value, n) < 0;
        for (int k = 0; k < n; k++) value[k] = (turned ? -value[k] : value[k]) / ends->unit;
    }
    for (int k = 0; k < n; k++) {
        const float *v = values + k;
        const double before = (double)(v[n] - v[0]), step = (double)(v[2 * n] - v[n]),
                     after = (double)(v[3 * n] - v[2 * n]);
        sum->step += step * step;
        sum->around[0] += before * before;
        sum->around[1] += after * after;
        sum->bend += square(step - (before + after) / 2);
        sum->change += square(after - before);
    }
}

/// Whether the way from the last key to the first is a step like others, or so short a way that nobody sees it: then there is no gap.
static bool goes_on(struct gltf_clip *clip, const struct ends *ends, float *values)
{
    const double first = clip->first, last = clip->last, gap = clip->gap;
    const int steps = (int)((last - first) / gap + 0.5), apart = 1 + steps / MOST_STEPS;
    struct steps seam = {0}, within = {0};
    int count = 0;
    for (int c = 0; c < clip->channel_count; c++) {
        const struct gltf_channel *channel = &clip->channels[c];
        const double before = seam.step;
        double largest = square((double)CLOSE);
        if (channel->travels) continue;
        add_steps(channel, &ends[c], (const double[]){last - gap, last, first, first + gap}, values, &seam);
        count = 0;
        for (int k = 1; k + 1 < steps; k += apart, count++) {
            const double at = first + k * gap, so_far = within.step;
            add_steps(channel, &ends[c], (const double[]){at - gap, at, at + gap, at + 2 * gap}, values, &within);
            largest = fmax(largest, within.step - so_far);
        }
        if (seam.step - before > MOST * largest) return false;
    }
    const double around = fmax(seam.around[0], seam.around[1]), mean = count > 0 ? within.step / count : INFINITY;
    if (steps >= FEW_STEPS && seam.step < CUT * around && seam.change < LIKE * around) {
        clip->gap = 0;
        return true;
    }
    if (seam.step < (steps < FEW_STEPS ? CUT : LEAST) * mean) return false;
    return CUT * seam.step < around && (seam.bend < LIKE * around || seam.bend < BENT * within.bend / count);
}

bool gltf_judge_loop(const struct gltf *gltf, struct gltf_clip *clip)
{
    const double length = clip->last - clip->first;
    int most_keys = 0, most_components = 4;
    bool closed = true, moves = false, travels = false, done = false;
    struct pool work = {0};
    struct ends *ends = pool_try(&work, (size_t)clip->channel_count, sizeof *ends);
    bool *is_open = pool_try(&work, (size_t)gltf->node_count, sizeof *is_open);
    if (!ends || !is_open) goto end;
    for (int c = 0; c < clip->channel_count; c++) {
        const struct gltf_channel *channel = &clip->channels[c];
        ends[c] = ends_of(channel);
        is_open[channel->node] |= ends[c].open;
        if (channel->key_count > most_keys) most_keys = channel->key_count;
        if (channel->components > most_components) most_components = channel->components;
    }
    for (int c = 0; c < clip->channel_count; c++) {
        struct gltf_channel *channel = &clip->channels[c];
        bool is_root = true; // no node above it is open
        for (int n = gltf->nodes[channel->node].parent; n >= 0; n = gltf->nodes[n].parent) is_root &= !is_open[n];
        channel->travels = ends[c].open && is_root && is_steady(channel, &ends[c], clip->first, length);
        travels = travels || channel->travels;
        closed = closed && (!ends[c].open || channel->travels);
        moves = moves || (ends[c].range > 0 && !channel->travels);
    }
    clip->loops = closed && (moves || !travels);
    clip->gap = clip->loops || most_keys < 2 ? 0 : length / (most_keys - 1);
    float *values = pool_try(&work, 4 * (size_t)most_components, sizeof *values);
    done = values;
    if (done && !clip->loops && moves && clip->gap > 0 && most_keys > LEAST_STEPS)
        clip->loops = goes_on(clip, ends, values);
end:
    pool_free(&work);
    return done;
}

/// The dog's clips: gaits move paws and trunk, and two-bone inverse kinematics bends the legs to reach the paws.
///
/// A pose consists of rotations about the model's axes: A of each joint relative to its parent, G = G(parent)·A relative to the world. With
/// the joints' rest rotations R, a file stores R(parent)⁻¹·A·R.
#include "model/vector.h"
#include "models/dog.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

// --- gaits

enum { DOG_LEGS = 4 }; ///< front left, front right, hind left, hind right, as in dog_limbs

/// A gait, in place. Lengths in metres, angles in degrees, phases in cycles.
struct gait {
    float phase[DOG_LEGS]; ///< when each paw touches down
    float duty;            ///< share of the cycle that a paw is on the ground
    float stride;          ///< movement backwards on the ground
    float lift[2];         ///< of front and hind paws
    float bob, sway;       ///< of hips and chest
    float turn, roll;
    float nod;
};

/// A paw relative to its rest: its ball moves, the foot tilts forward about the ball, the toes tilt down.
struct paw {
    float up, ahead;
    float foot, toes; ///< degrees
};

/// Movement of one end of the trunk with its legs: 0 the chest, 1 the hips. Degrees: `turn` to the left, `roll` left side up.
struct sway {
    float across, up, turn, roll;
};

/// Lateral sequence: hind left, front left, hind right, front right, a quarter cycle apart.
static const struct gait walk = {
    .phase = {0.25f, 0.75f, 0.0f, 0.5f},
    .duty = 0.62f,
    .stride = 0.25f,
    .lift = {0.065f, 0.055f},
    .bob = 0.008f,
    .sway = 0.014f,
    .turn = 6.0f,
    .roll = 4.5f,
    .nod = 3.5f,
};
/// Diagonal pairs, with a moment in the air between them.
static const struct gait trot = {
    .phase = {0.5f, 0.0f, 0.0f, 0.5f},
    .duty = 0.44f,
    .stride = 0.21f,
    .lift = {0.095f, 0.085f},
    .bob = 0.014f,
    .sway = 0.006f,
    .turn = 5.0f,
    .roll = 3.0f,
    .nod = 2.5f,
};

/// An angle at a time of the step: 0 … 0.5 on the ground, 0.5 … 1 in the air.
struct key {
    float place, degrees;
};
enum { KEYS = 8 };

static const struct key foot_keys[2][KEYS] = {
    {{0, -8}, {0.12f, 0}, {0.30f, 3}, {0.44f, 20}, {0.56f, 50}, {0.70f, 58}, {0.86f, 18}, {0.95f, -8}},
    {{0, -8}, {0.12f, -4}, {0.30f, 2}, {0.44f, 18}, {0.56f, 46}, {0.70f, 48}, {0.86f, 8}, {0.95f, -8}},
};
static const float toe_curl[2] = {42.0f, 36.0f};

static float step_time(float place, float duty)
{
    return place < 0.5f ? 2.0f * place * duty : duty + (2.0f * place - 1.0f) * (1.0f - duty);
}

/// A periodic Catmull–Rom curve through the keys.
static float foot_tilt(const struct key *keys, float duty, float u)
{
    float at[4], value[4];
    int k = KEYS - 1;
    while (k > 0 && step_time(keys[k].place, duty) > u) k--;
    for (int n = 0; n < 4; n++) {
        const int key = k + n - 1, wrapped = (key + KEYS) % KEYS;
        at[n] = step_time(keys[wrapped].place, duty) + (key < 0 ? -1.0f : key >= KEYS ? 1.0f : 0.0f);
        value[n] = keys[wrapped].degrees;
    }
    const float span = at[2] - at[1], t = (u - at[1]) / span;
    const float in = (value[2] - value[0]) / (at[2] - at[0]) * span,
                out = (value[3] - value[1]) / (at[3] - at[1]) * span;
    return glm_hermite(t, value[1], in, out, value[2]);
}

/// On the ground a paw moves back flat at constant speed.
static struct paw gait_paw(const struct gait *gait, int leg, float time)
{
    const int pair = leg / 2;
    const float u = time - gait->phase[leg] - floorf(time - gait->phase[leg]), half = 0.5f * gait->stride;
    struct paw paw = {.foot = foot_tilt(foot_keys[pair], gait->duty, u)};
    if (u < gait->duty) {
        paw.ahead = half - gait->stride * u / gait->duty;
        return paw;
    }
    const float air = 1.0f - gait->duty, s = (u - gait->duty) / air, back = -gait->stride * air / gait->duty;
    const float rise = sinf(GLM_PIf * s), early = sinf(GLM_PIf * powf(s, 0.85f));
    paw.ahead = glm_hermite(s, -half, back, back, half);
    paw.up = gait->lift[pair] * early * early;
    paw.toes = rise * rise * (1.7f * toe_curl[pair] * (1.0f - s) - 12.0f * s);
    return paw;
}

static struct sway gait_sway(const struct gait *gait, int end, float time)
{
    const float left = 2.0f * GLM_PIf * (time - gait->phase[2 * end]); // 0 when the left paw touches down
    const float borne = left - GLM_PIf * gait->duty;                   // 0 halfway through its time on the ground
    return (struct sway){
        .across = gait->sway * cosf(borne),
        .up = gait->bob * cosf(2.0f * borne) * (gait->duty < 0.5f ? -1.0f : 1.0f),
        .turn = -gait->turn * cosf(left),
        .roll = gait->roll * cosf(borne),
    };
}

// --- poses

const struct dog_clip dog_clips[DOG_CLIPS] = {{"Walk", 24}, {"Trot", 14}, {"Idle", 120}};
enum { WALK, TROT, IDLE };

struct figure_pose {
    const struct dog_skeleton *skeleton;
    versors turn[DOG_MAX_JOINTS]; ///< A
    vec3s move;                   ///< of the hips
};

static vec3s place(const struct dog_skeleton *skeleton, int joint)
{
    return vec3_from(skeleton->joints[joint].position);
}

/// Degrees: x tilts forward, y turns to the left, z lifts the left side.
static versors angles(float x, float y, float z)
{
    const versors about_x = glms_quatv(glm_rad(x), (vec3s){{1, 0, 0}}),
                  about_y = glms_quatv(glm_rad(y), (vec3s){{0, 1, 0}});
    return glms_quat_mul(about_y, glms_quat_mul(about_x, glms_quatv(glm_rad(z), (vec3s){{0, 0, 1}})));
}

static void turn(struct figure_pose *pose, const char *name, float x, float y, float z)
{
    pose->turn[dog_joint(pose->skeleton, name)] = angles(x, y, z);
}

/// G and position of a joint.
static versors in_world(const struct figure_pose *pose, int joint, vec3s *at)
{
    const int parent = pose->skeleton->joints[joint].parent;
    if (parent < 0) {
        *at = glms_vec3_add(place(pose->skeleton, joint), pose->move);
        return pose->turn[joint];
    }
    const versors g = in_world(pose, parent, at);
    const vec3s bone = glms_vec3_sub(place(pose->skeleton, joint), place(pose->skeleton, parent));
    *at = glms_vec3_add(*at, glms_quat_rotatev(g, bone));
    return glms_quat_mul(g, pose->turn[joint]);
}

/// The rotation from a bone's plane and direction at rest to others.
static versors turn_between(vec3s from, vec3s from_normal, vec3s to, vec3s to_normal)
{
    mat3s a, b;
    a.col[0] = glms_vec3_normalize(from);
    a.col[1] = from_normal;
    a.col[2] = glms_vec3_cross(a.col[0], a.col[1]);
    b.col[0] = glms_vec3_normalize(to);
    b.col[1] = to_normal;
    b.col[2] = glms_vec3_cross(b.col[0], b.col[1]);
    return glms_quat_normalize(glms_mat3_quat(glms_mat3_mul(b, glms_mat3_transpose(a))));
}

/// Bends thigh and shin so that the foot's joint is at `ankle`, with the knee on the same side as at rest. False if it is too far.
static bool reach(const struct dog_skeleton *skeleton, const int leg[DOG_LEG_JOINTS], vec3s hip, vec3s ankle,
                  versors turned[2])
{
    const vec3s thigh = glms_vec3_sub(place(skeleton, leg[1]), place(skeleton, leg[0]));
    const vec3s shin = glms_vec3_sub(place(skeleton, leg[2]), place(skeleton, leg[1]));
    const vec3s line = glms_vec3_sub(ankle, hip), way = glms_vec3_normalize(line);
    const float a = glms_vec3_norm(thigh), b = glms_vec3_norm(shin), length = glms_vec3_norm(line);
    const float along = (a * a - b * b + length * length) / (2.0f * length);
    if (length > 0.998f * (a + b) || fabsf(along) >= a) return false;
    // The knee stays in the upright plane of its side at rest.
    const vec3s rest_normal = glms_vec3_normalize(glms_vec3_cross(thigh, shin));
    const vec3s side = glms_vec3_normalize(glms_vec3_cross(rest_normal, way));
    const vec3s normal = glms_vec3_cross(way, side);
    const vec3s knee =
        glms_vec3_sub(glms_vec3_scale(way, along), glms_vec3_scale(side, sqrtf(a * a - along * along)));
    turned[0] = turn_between(thigh, rest_normal, knee, normal);
    turned[1] = turn_between(shin, rest_normal, glms_vec3_sub(line, knee), normal);
    return true;
}

/// Places a leg's paw.
static void stand(struct figure_pose *pose, int leg, const struct paw *paw)
{
    int joint[DOG_LEG_JOINTS];
    for (int n = 0; n < DOG_LEG_JOINTS; n++)
        joint[n] = dog_joint(pose->skeleton, dog_limbs[DOG_FIRST_LEG + leg].joints[n]);
    vec3s hip, ball = glms_vec3_add(place(pose->skeleton, joint[3]), (vec3s){{0, paw->up, paw->ahead}});
    in_world(pose, joint[0], &hip);
    vec3s unused;
    const versors body = in_world(pose, pose->skeleton->joints[joint[0]].parent, &unused);
    versors g[DOG_LEG_JOINTS] = {[2] = angles(paw->foot, 0, 0), [3] = angles(paw->toes, 0, 0)};
    const vec3s foot = glms_vec3_sub(place(pose->skeleton, joint[3]), place(pose->skeleton, joint[2]));
    const vec3s ankle = glms_vec3_sub(ball, glms_quat_rotatev(g[2], foot));
    if (!reach(pose->skeleton, joint, hip, ankle, g)) {
        fprintf(stderr, "dog_glb: %s does not reach its paw\n", pose->skeleton->joints[joint[0]].name);
        exit(EXIT_FAILURE);
    }
    for (int n = 0; n < DOG_LEG_JOINTS; n++)
        pose->turn[joint[n]] = glms_quat_mul(glms_quat_inv(n == 0 ? body : g[n - 1]), g[n]);
}

/// The trunk between hips and chest, each following its legs; the head stays level and nods.
static void trunk(struct figure_pose *pose, const struct gait *gait, float time)
{
    const struct sway hips = gait_sway(gait, 1, time), chest = gait_sway(gait, 0, time);
    const float length = 0.29f; // from hips to chest
    const float tilt = glm_deg((hips.up - chest.up) / length), yaw = glm_deg((chest.across - hips.across) / length);
    pose->move = (vec3s){{hips.across, hips.up - 0.004f, 0}};
    turn(pose, "hips", tilt, hips.turn + 0.5f * yaw, hips.roll);
    const float twist = (chest.turn - hips.turn) / 3.0f, roll = (chest.roll - hips.roll) / 3.0f;
    turn(pose, "spine_1", 0, twist, roll);
    turn(pose, "spine_2", 0, twist, roll);
    turn(pose, "chest", 0, twist, roll);
    const float late = 4.0f * GLM_PIf * (time - gait->phase[0] - 0.06f), nod = gait->nod * cosf(late);
    turn(pose, "neck", nod - 0.4f * tilt, -0.5f * chest.turn - 0.25f * yaw, -0.6f * chest.roll);
    turn(pose, "head", -0.7f * nod - 0.4f * tilt, -0.4f * chest.turn - 0.25f * yaw, -0.3f * chest.roll);
    turn(pose, "jaw", 2.0f + 2.5f * cosf(late - 1.0f), 0, 0);
}

/// A value at a time in seconds, eased between keys.
static float eased(const float (*keys)[2], int count, float seconds)
{
    int k = 0;
    while (k + 2 < count && keys[k + 1][0] <= seconds) k++;
    return keys[k][1] + (keys[k + 1][1] - keys[k][1]) * glm_smoothstep(keys[k][0], keys[k + 1][0], seconds);
}

#define EASED(keys, seconds) eased(keys, sizeof keys / sizeof *keys, seconds)

/// It breathes, looks left and right, and blinks.
static void rest(struct figure_pose *pose, float time)
{
    static const float look[][2] = {{0, 0},      {0.8f, 0},   {1.3f, 26}, {2.2f, 24},
                                    {2.9f, -22}, {3.8f, -20}, {4.5f, 0},  {5, 0}};
    static const float gaze[][2] = {{0, 0},     {0.7f, 0},  {0.85f, 14}, {1.3f, 4}, {2.1f, 4}, {2.25f, -16},
                                    {2.9f, -4}, {3.7f, -4}, {3.85f, 10}, {4.4f, 0}, {5, 0}};
    static const float lean[][2] = {{0, 0},     {1.2f, 0},  {1.7f, 8}, {2.3f, 8},
                                    {2.9f, -5}, {3.7f, -5}, {4.4f, 0}, {5, 0}};
    static const float blink[][2] = {{0, 0},    {0.70f, 0}, {0.80f, 86}, {0.88f, 86}, {1.05f, 0},
                                     {2.3f, 0}, {2.4f, 86}, {2.48f, 86}, {2.65f, 0},  {5, 0}};
    const float seconds = time * (float)dog_clips[IDLE].frames / DOG_FPS;
    const float breath = sinf(4.0f * GLM_PIf * time), slow = sinf(2.0f * GLM_PIf * time);
    const float turned = EASED(look, seconds), leant = EASED(lean, seconds), shut = EASED(blink, seconds);
    pose->move = (vec3s){{0.006f * slow, 0.0015f * breath - 0.002f, 0}};
    turn(pose, "hips", -0.4f * breath, 0, 1.2f * slow);
    turn(pose, "spine_2", -0.5f * breath, 0, -0.6f * slow);
    turn(pose, "chest", -0.8f * breath, 0.06f * turned, -0.6f * slow);
    turn(pose, "neck", 1.2f * breath, 0.40f * turned, 0.3f * leant);
    turn(pose, "head", 0.6f * breath - 0.06f * fabsf(turned), 0.54f * turned, 0.7f * leant);
    turn(pose, "jaw", 1.5f + 2.0f * sinf(12.0f * GLM_PIf * time), 0, 0);
    for (int side = 0; side < 2; side++) {
        turn(pose, side ? "eye_R" : "eye_L", 0, EASED(gaze, seconds), 0);
        const int lid = dog_joint(pose->skeleton, side ? "lid_R" : "lid_L");
        const vec3s hinge = glms_vec3_sub(vec3_from(pose->skeleton->joints[lid].tip), place(pose->skeleton, lid));
        pose->turn[lid] = glms_quatv(glm_rad(side ? -shut : shut), glms_vec3_normalize(hinge));
    }
}

static versors rest_rotation(const struct dog_skeleton *skeleton, int joint)
{
    versors q = glms_quat_identity();
    if (joint >= 0) memcpy(q.raw, skeleton->joints[joint].rotation, sizeof q.raw);
    return q;
}

void dog_pose(const struct dog_skeleton *skeleton, int clip, float time, struct dog_pose *out)
{
    struct figure_pose pose = {.skeleton = skeleton};
    for (int j = 0; j < skeleton->count; j++) pose.turn[j] = glms_quat_identity();
    const struct gait *gait = clip == WALK ? &walk : clip == TROT ? &trot : NULL;
    if (gait) {
        trunk(&pose, gait, time);
    } else {
        rest(&pose, time);
    }
    for (int leg = 0; leg < DOG_LEGS; leg++) {
        const struct paw paw = gait ? gait_paw(gait, leg, time) : (struct paw){0};
        stand(&pose, leg, &paw);
    }
    for (int j = 0; j < skeleton->count; j++) {
        const versors parent = rest_rotation(skeleton, skeleton->joints[j].parent);
        const versors q =
            glms_quat_mul(glms_quat_inv(parent), glms_quat_mul(pose.turn[j], rest_rotation(skeleton, j)));
        memcpy(out->rotation[j], glms_quat_normalize(q).raw, sizeof out->rotation[j]);
    }
    const vec3s hips = glms_vec3_add(place(skeleton, 0), pose.move);
    memcpy(out->hips, hips.raw, sizeof out->hips);
}

/// The dog's joints, and the joints of a point of its coat: those of the limbs on or near it.
#include "model/vector.h"
#include "models/dog.h"
#include <assert.h>
#include <math.h>
#include <stdio.h>

const float dog_tail[DOG_TAIL_JOINTS + 1][3] = {
    {0, 0.500f, -0.285f}, {0, 0.516f, -0.361f}, {0, 0.548f, -0.433f}, {0, 0.596f, -0.494f}, {0, 0.656f, -0.544f},
    {0, 0.721f, -0.588f}, {0, 0.784f, -0.634f}, {0, 0.840f, -0.688f}, {0, 0.886f, -0.751f},
};
const float dog_ear[DOG_EAR_JOINTS + 1][3] = {
    {0.088f, 0.812f, 0.292f}, {0.137f, 0.800f, 0.292f}, {0.174f, 0.745f, 0.300f},
    {0.186f, 0.672f, 0.312f}, {0.184f, 0.594f, 0.326f},
};

/// A bone. Bones of the left side are mirrored; names get _L and _R.
struct bone {
    const char *name, *parent;
    float from[3], to[3];
    float roll; ///< degrees about the bone
    bool mirror;
};

static const struct bone bones[] = {
    {"hips", NULL, {0, 0.445f, -0.200f}, {0, 0.460f, -0.100f}, 0, false},
    {"spine_1", "hips", {0, 0.460f, -0.100f}, {0, 0.460f, 0.000f}, 0, false},
    {"spine_2", "spine_1", {0, 0.460f, 0.000f}, {0, 0.455f, 0.090f}, 0, false},
    {"chest", "spine_2", {0, 0.455f, 0.090f}, {0, 0.520f, 0.200f}, 0, false},
    {"neck", "chest", {0, 0.520f, 0.200f}, {0, 0.665f, 0.278f}, 15, false},
    {"head", "neck", {0, 0.665f, 0.278f}, {0, 0.780f, 0.380f}, 15, false},
    {"jaw", "head", {0, 0.668f, 0.375f}, {0, 0.630f, 0.500f}, -10, false},
    {"eye", "head", {0.060f, 0.788f, 0.399f}, {0.068f, 0.788f, 0.439f}, 0, true},
    {"lid", "head", {0.060f, 0.788f, 0.399f}, {0.087f, 0.781f, 0.390f}, 90, true},
    {"thigh_front", "chest", {0.085f, 0.430f, 0.160f}, {0.093f, 0.290f, 0.070f}, 20, true},
    {"shin_front", "thigh_front", {0.093f, 0.290f, 0.070f}, {0.091f, 0.105f, 0.110f}, 20, true},
    {"foot_front", "shin_front", {0.091f, 0.105f, 0.110f}, {0.092f, 0.042f, 0.135f}, 20, true},
    {"toe_front", "foot_front", {0.092f, 0.042f, 0.135f}, {0.094f, 0.030f, 0.200f}, 0, true},
    {"thigh_back", "hips", {0.080f, 0.440f, -0.205f}, {0.092f, 0.285f, -0.135f}, -35, true},
    {"shin_back", "thigh_back", {0.092f, 0.285f, -0.135f}, {0.092f, 0.155f, -0.275f}, -35, true},
    {"foot_back", "shin_back", {0.092f, 0.155f, -0.275f}, {0.094f, 0.042f, -0.235f}, -35, true},
    {"toe_back", "foot_back", {0.094f, 0.042f, -0.235f}, {0.096f, 0.030f, -0.165f}, 0, true},
};

#define TAIL_ROLL 40.0f
#define EAR_ROLL 65.0f

/// The shortest rotation from y to the bone's direction, after a roll about y.
static void bone_rotation(const float from[3], const float to[3], float roll, float rotation[4])
{
    versors along =
        glms_quat_from_vecs((vec3s){{0, 1, 0}}, glms_vec3_normalize(glms_vec3_sub(vec3_from(to), vec3_from(from))));
    const versors turned = glms_quat_normalize(glms_quat_mul(along, glms_quatv(glm_rad(roll), (vec3s){{0, 1, 0}})));
    memcpy(rotation, turned.raw, sizeof turned.raw);
}

static int find(const struct dog_skeleton *skeleton, const char *name)
{
    for (int j = 0; j < skeleton->count; j++) {
        if (strcmp(skeleton->joints[j].name, name) == 0) return j;
    }
    return -1;
}

int dog_joint(const struct dog_skeleton *skeleton, const char *name)
{
    const int joint = find(skeleton, name);
    assert(joint >= 0);
    return joint;
}

/// `side`: 0 middle, 1 left, −1 right. The parent is on the same side or in the middle.
static void add(struct dog_skeleton *skeleton, const struct bone *bone, int side)
{
    static const char *const suffix[3] = {"_R", "", "_L"};
    const float sign = side < 0 ? -1.0f : 1.0f;
    char parent[20];
    assert(skeleton->count < DOG_MAX_JOINTS);
    struct dog_joint *joint = &skeleton->joints[skeleton->count];
    snprintf(joint->name, sizeof joint->name, "%s%s", bone->name, suffix[side + 1]);
    joint->parent = -1;
    if (bone->parent) {
        snprintf(parent, sizeof parent, "%s%s", bone->parent, suffix[side + 1]);
        joint->parent = find(skeleton, parent);
        if (joint->parent < 0) joint->parent = dog_joint(skeleton, bone->parent);
    }
    for (int k = 0; k < 3; k++) {
        joint->position[k] = (k == 0 ? sign : 1.0f) * bone->from[k];
        joint->tip[k] = (k == 0 ? sign : 1.0f) * bone->to[k];
    }
    bone_rotation(joint->position, joint->tip, sign * bone->roll, joint->rotation);
    skeleton->count++;
}

static void add_chain(struct dog_skeleton *skeleton, const char *name, const char *parent, const float (*points)[3],
                      int bone_count, float roll, int side)
{
    char names[2][20];
    snprintf(names[0], sizeof names[0], "%s", parent);
    for (int i = 0; i < bone_count; i++) {
        char *own = names[(i + 1) % 2];
        snprintf(own, sizeof names[0], "%s_%d", name, i + 1);
        struct bone bone = {.name = own, .parent = names[i % 2], .roll = roll};
        memcpy(bone.from, points[i], sizeof bone.from);
        memcpy(bone.to, points[i + 1], sizeof bone.to);
        add(skeleton, &bone, side);
    }
}

void dog_skeleton_make(struct dog_skeleton *skeleton)
{
    *skeleton = (struct dog_skeleton){0};
    for (size_t b = 0; b < sizeof bones / sizeof *bones; b++) {
        if (!bones[b].mirror) add(skeleton, &bones[b], 0);
    }
    add_chain(skeleton, "tail", "hips", dog_tail, DOG_TAIL_JOINTS, TAIL_ROLL, 0);
    for (int side = 1; side >= -1; side -= 2) {
        for (size_t b = 0; b < sizeof bones / sizeof *bones; b++) {
            if (bones[b].mirror) add(skeleton, &bones[b], side);
        }
        add_chain(skeleton, "ear", "head", dog_ear, DOG_EAR_JOINTS, EAR_ROLL, side);
    }
}

// --- skin

/// Points this much further from a limb's axis than the nearest count little, with a soft limit.
#define AXIS_WIDTH 0.03f

/// The joints of a limb.
struct limb_joints {
    int joint[DOG_TAIL_JOINTS], count;
};

static struct limb_joints joints_of(const struct dog_skeleton *skeleton, const struct dog_limb *limb)
{
    struct limb_joints joints = {0};
    for (; limb->joints[joints.count]; joints.count++)
        joints.joint[joints.count] = dog_joint(skeleton, limb->joints[joints.count]);
    return joints;
}

/// A point's position along the limb, in bones; a mean if several bones are about equally near, so that it is smooth inside a bend.
static float place_along(const struct dog_skeleton *skeleton, const struct limb_joints *joints, const float p[3])
{
    float square[DOG_TAIL_JOINTS], place[DOG_TAIL_JOINTS], least = INFINITY, sum = 0.0f, total = 0.0f;
    for (int i = 0; i < joints->count; i++) {
        const struct dog_joint *joint = &skeleton->joints[joints->joint[i]];
        const vec3s from = vec3_from(joint->position), bone = glms_vec3_sub(vec3_from(joint->tip), from);
        const vec3s q = glms_vec3_sub(vec3_from(p), from);
        const float t = glm_clamp(glms_vec3_dot(q, bone) / glms_vec3_norm2(bone), 0.0f, 1.0f);
        square[i] = glms_vec3_distance2(q, glms_vec3_scale(bone, t));
        place[i] = (float)i + t;
        least = fminf(least, square[i]);
    }
    for (int i = 0; i < joints->count; i++) {
        const float weight = expf((least - square[i]) / (AXIS_WIDTH * AXIS_WIDTH));
        sum += weight * place[i];
        total += weight;
    }
    return sum / total;
}

static void add_limb(float *weights, const struct dog_skeleton *skeleton, const struct dog_limb *limb,
                     const float p[3], float share)
{
    const struct limb_joints joints = joints_of(skeleton, limb);
    const float place = place_along(skeleton, &joints, p);
    float before = 1.0f; // how far the point is past the joint
    for (int i = 0; i < joints.count; i++) {
        const float next = (float)(i + 1);
        const float after = i + 1 < joints.count ? glm_smoothstep(next - limb->bend, next + limb->bend, place) : 0.0f;
        weights[joints.joint[i]] += share * fmaxf(before - after, 0.0f);
        before = fminf(before, after);
    }
}

/// Keeps the strongest and normalises their sum to 1.
static void strongest(float *weights, struct dog_influences *influences)
{
    float sum = 0.0f;
    for (int n = 0; n < DOG_INFLUENCES; n++) {
        int best = 0;
        for (int j = 1; j < DOG_MAX_JOINTS; j++) {
            if (weights[j] > weights[best]) best = j;
        }
        influences->joint[n] = weights[best] > 0.0f ? best : 0;
        influences->weight[n] = weights[best];
        sum += weights[best];
        weights[best] = 0.0f;
    }
    for (int n = 0; n < DOG_INFLUENCES; n++) influences->weight[n] /= sum;
}

void dog_influences(const struct dog_skeleton *skeleton, const float p[3], struct dog_influences *influences)
{
    float distance[DOG_LIMBS], weights[DOG_MAX_JOINTS] = {0};
    int nearest = 0;
    for (int limb = 0; limb < DOG_LIMBS; limb++) {
        distance[limb] = dog_limb_distance(limb, p);
        if (distance[limb] < distance[nearest]) nearest = limb;
    }
    for (int limb = 0; limb < DOG_LIMBS; limb++) {
        const float blend = fminf(dog_limbs[limb].blend, dog_limbs[nearest].blend);
        const float share = glm_smoothstep(blend, 0.0f, distance[limb] - distance[nearest]);
        if (share > 0.0f) add_limb(weights, skeleton, &dog_limbs[limb], p, share);
    }
    strongest(weights, influences);
}

/// What the dog's coat follows: the limbs that a point lies on or near, and the joints along each.
#include "model/dog.h"
#include "model/vector.h"
#include <math.h>

/// Points this much further from a limb's axis than the nearest one do not count, softly.
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

/// How far along the limb the point lies, in bones. Where several bones are about as near, their mean: so it is smooth across the
/// inside of a bend.
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

static void add(float *weights, const struct dog_skeleton *skeleton, const struct dog_limb *limb, const float p[3],
                float share)
{
    const struct limb_joints joints = joints_of(skeleton, limb);
    const float place = place_along(skeleton, &joints, p);
    float before = 1.0f; // how far the point is beyond the joint
    for (int i = 0; i < joints.count; i++) {
        const float next = (float)(i + 1);
        const float after = i + 1 < joints.count ? glm_smoothstep(next - limb->bend, next + limb->bend, place) : 0.0f;
        weights[joints.joint[i]] += share * fmaxf(before - after, 0.0f);
        before = fminf(before, after);
    }
}

/// Keeps the strongest and makes their sum 1.
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
        if (share > 0.0f) add(weights, skeleton, &dog_limbs[limb], p, share);
    }
    strongest(weights, influences);
}

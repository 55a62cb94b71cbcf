/// Walk and trot: paths of paws, and what the trunk does above them.
#include "model/dog_gait.h"
#include "model/vector.h"
#include <math.h>

/// A lateral sequence: hind left, front left, hind right, front right, a quarter of a cycle apart.
const struct dog_gait dog_walk = {
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
const struct dog_gait dog_trot = {
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

/// An angle at a place in the step: 0 … 0.5 on the ground, 0.5 … 1 in the air.
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

struct dog_paw dog_gait_paw(const struct dog_gait *gait, int leg, float time)
{
    const int pair = leg / 2;
    const float u = time - gait->phase[leg] - floorf(time - gait->phase[leg]), half = 0.5f * gait->stride;
    struct dog_paw paw = {.foot = foot_tilt(foot_keys[pair], gait->duty, u)};
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

struct dog_sway dog_gait_sway(const struct dog_gait *gait, int end, float time)
{
    const float left = 2.0f * GLM_PIf * (time - gait->phase[2 * end]); // 0 where the left paw comes down
    const float borne = left - GLM_PIf * gait->duty;                   // 0 half-way through its time on the ground
    return (struct dog_sway){
        .across = gait->sway * cosf(borne),
        .up = gait->bob * cosf(2.0f * borne) * (gait->duty < 0.5f ? -1.0f : 1.0f),
        .turn = -gait->turn * cosf(left),
        .roll = gait->roll * cosf(borne),
    };
}

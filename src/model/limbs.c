/// Moves the parts of the fox's body, and measures it with its tail.
#include "model/limbs.h"
#include "model/fox.h"
#include "model/vector.h"
#include <math.h>

static const double FEET = -0.30;                      ///< z that the body stretches above, bind space
static const float neck[3] = {0.005f, 0.66f, -0.385f}; ///< what the head turns about, standing
static const float HEAD_RADIUS = 0.50f;                ///< around the neck's joint, bind size: holds head and ears
static const float SPLAY = 0.4f;                       ///< of an ear that is laid back

const float limbs_chest[3] = {0, 0.44f, -0.44f};
const float limbs_ear_root[3] = {0.088f, 0.10f, 0.015f}, limbs_ear_tip[3] = {0.152f, 0.292f, 0.02f};
const float limbs_ear_joint[2] = {0.15f, 0.65f};

const float fox_body_lo[3] = {-0.36f, -FOX_BASE_HEIGHT, -0.68f};
const float fox_body_hi[3] = {0.36f, 1.16f - FOX_BASE_HEIGHT, 0.38f};

const int limb_parents[LIMBS] = {-1, LIMB_BODY, LIMB_BODY, LIMB_HEAD, LIMB_HEAD, LIMB_EAR, LIMB_EAR + 1};

/// Standing place → bind space.
static void into_bind(const float standing[3], float bind[3])
{
    for (int k = 0; k < 3; k++) bind[k] = standing[k] - (k == 1 ? FOX_BASE_HEIGHT : 0.0f);
}

static vec3s size_of(const struct limbs *limbs)
{
    const float taller = 1.0f + limbs->stretch, wider = 1.0f / sqrtf(taller);
    return (vec3s){{wider, taller, wider}};
}

void limbs_base(double stretch, double scale, double base[3])
{
    base[0] = 0.0;
    base[1] = scale * (double)FOX_BASE_HEIGHT * stretch;
    base[2] = scale * FEET * (1.0 - 1.0 / sqrt(1.0 + stretch));
}

void limbs_base_slope(double stretch, double scale, double slope[3])
{
    slope[0] = 0.0;
    slope[1] = scale * (double)FOX_BASE_HEIGHT;
    slope[2] = 0.5 * scale * FEET * pow(1.0 + stretch, -1.5);
}

/// Middle of the head, how far it is turned to look back over its shoulder, and how far it is tilted (radians).
static const float head_middle[3] = {0.01f, 0.80f, -0.385f};
static const float HEAD_TURN = 1.35f; ///< about +y, towards the camera's first place
static const float HEAD_TILT = 0.12f;

void fox_head_from_bind(float matrix[16])
{
    const float ct = cosf(HEAD_TURN), st = sinf(HEAD_TURN), ci = cosf(HEAD_TILT), si = sinf(HEAD_TILT);
    const float column[3][3] = {{ct * ci, -ct * si, -st}, {si, ci, 0}, {st * ci, -st * si, ct}};
    const float middle[3] = {head_middle[0], head_middle[1] - FOX_BASE_HEIGHT, head_middle[2]};
    memset(matrix, 0, 16 * sizeof *matrix);
    for (int c = 0; c < 3; c++) {
        for (int r = 0; r < 3; r++) {
            matrix[4 * c + r] = column[c][r];
            matrix[12 + r] -= column[c][r] * middle[c];
        }
    }
    matrix[15] = 1;
}

static mat4s head_from_bind(void)
{
    float matrix[16];
    fox_head_from_bind(matrix);
    return mat4_from(matrix);
}

void limbs_pivots(float pivot[LIMBS][3])
{
    const mat4s from_head = glms_mat4_inv(head_from_bind());
    memset(pivot, 0, LIMBS * sizeof *pivot);
    into_bind(limbs_chest, pivot[LIMB_CHEST]);
    into_bind(neck, pivot[LIMB_HEAD]);
    for (int l = LIMB_EAR; l < LIMBS; l++) {
        const float place = limbs_ear_joint[l >= LIMB_EAR_TIP];
        vec3s joint = glms_vec3_lerp(vec3_from(limbs_ear_root), vec3_from(limbs_ear_tip), place);
        if ((l - LIMB_EAR) % 2 != 0) joint.x = -joint.x;
        joint = glms_mat4_mulv3(from_head, joint, 1.0f);
        memcpy(pivot[l], joint.raw, sizeof pivot[l]);
    }
}

void limbs_motions(const struct limbs *limbs, float turn[LIMBS][4], float size[LIMBS][3])
{
    const mat4s into_head = head_from_bind();
    const vec3s across = {{into_head.m00, into_head.m10, into_head.m20}};
    const vec3s forth = {{into_head.m02, into_head.m12, into_head.m22}};
    const versors look = glms_quatv(limbs->look, (vec3s){{0, 1, 0}}), nod = glms_quatv(limbs->nod, across);
    for (int l = 0; l < LIMBS; l++) {
        versors own = l == LIMB_HEAD ? glms_quat_mul(look, nod) : glms_quat_identity();
        if (l >= LIMB_EAR) {
            const float back = limbs->ears[l >= LIMB_EAR_TIP], sign = (l - LIMB_EAR) % 2 ? -1.0f : 1.0f;
            own = glms_quat_mul(glms_quatv(-sign * SPLAY * back, forth), glms_quatv(back, across));
        }
        memcpy(turn[l], own.raw, sizeof turn[l]);
        for (int k = 0; k < 3; k++) size[l][k] = l == LIMB_CHEST ? 1.0f + limbs->breath : 1.0f;
    }
    const vec3s stretched = size_of(limbs);
    memcpy(size[LIMB_BODY], stretched.raw, sizeof size[LIMB_BODY]);
}

void limbs_bounds(const struct limbs *limbs, float lo[3], float hi[3])
{
    const vec3s size = size_of(limbs);
    float joint[3];
    into_bind(neck, joint);
    for (int k = 0; k < 3; k++) {
        const bool still =
            limbs->look == 0.0f && limbs->nod == 0.0f && limbs->ears[0] == 0.0f && limbs->ears[1] == 0.0f;
        const float wider = fmaxf(limbs->breath, 0.0f) * LIMBS_CHEST_RADIUS, reach = still ? 0.0f : HEAD_RADIUS;
        lo[k] = size.raw[k] * fminf(fox_body_lo[k] - wider, joint[k] - reach);
        hi[k] = size.raw[k] * fmaxf(fox_body_hi[k] + wider, joint[k] + reach);
    }
}

void pose_bounds(const struct pose *pose, float lo[3], float hi[3])
{
    const float scale = pose->scale;
    limbs_bounds(&pose->limbs, lo, hi);
    for (int k = 0; k < 3; k++) {
        lo[k] = pose->matrix[0][12 + k] + scale * lo[k];
        hi[k] = pose->matrix[0][12 + k] + scale * hi[k];
    }
    for (int n = 0; n < pose->count; n++) {
        const float along = FOX_TAIL_LENGTH * (float)n / (float)(pose->count - 1);
        const float radius = scale * fox_tail_radius(along);
        for (int k = 0; k < 3; k++) {
            lo[k] = fminf(lo[k], pose->matrix[n][12 + k] - radius);
            hi[k] = fmaxf(hi[k], pose->matrix[n][12 + k] + radius);
        }
    }
}

/// Moves the parts of the fox's body.
#include "model/limbs.h"
#include "model/creature.h"
#include "model/vector.h"
#include <math.h>

static const double FEET = -0.30;                      ///< z that the body stretches above, bind space
static const float chest[3] = {0, 0.44f, -0.44f};      ///< standing, as all places here but those of ears
static const float neck[3] = {0.005f, 0.66f, -0.385f}; ///< what the head turns about
static const float CHEST_INNER = 0.05f,
                   CHEST_OUTER = 0.18f;                 ///< metres from its middle: wholly part of it, and not at all
static const float NECK_LOW = 0.57f, NECK_HIGH = 0.68f; ///< heights: not part of the head, and wholly
static const float ear_root[3] = {0.088f, 0.10f, 0.015f},
                   ear_tip[3] = {0.152f, 0.292f, 0.02f}; ///< in the head's own space
static const float JOINT[2] = {0.15f, 0.65f};            ///< places along the ear where it bends
static const float EAR_LENGTH = 0.202f;                  ///< from root to tip
static const float HALF_BEND = 0.25f;                    ///< of an ear's length, over which it does
static const float HEAD_RADIUS = 0.50f;                  ///< around the neck's joint, bind size: holds head and ears
static const float SPLAY = 0.4f;                         ///< of an ear that is laid back

const int limb_parents[LIMBS] = {-1, LIMB_BODY, LIMB_BODY, LIMB_HEAD, LIMB_HEAD, LIMB_EAR, LIMB_EAR + 1};

static mat4s about(const float pivot[3], mat4s turn)
{
    const vec3s p = vec3_from(pivot);
    return glms_mat4_mul(glms_translate_make(p), glms_mat4_mul(turn, glms_translate_make(glms_vec3_negate(p))));
}

/// Standing place → bind space at a scale.
static void into_bind(const float standing[3], float scale, float bind[3])
{
    for (int k = 0; k < 3; k++) bind[k] = scale * (standing[k] - (k == 1 ? CREATURE_BASE_HEIGHT : 0.0f));
}

static vec3s size_of(const struct limbs *limbs)
{
    const float taller = 1.0f + limbs->stretch, wider = 1.0f / sqrtf(taller);
    return (vec3s){{wider, taller, wider}};
}

void limbs_base(double stretch, double scale, double base[3])
{
    base[0] = 0.0;
    base[1] = scale * (double)CREATURE_BASE_HEIGHT * stretch;
    base[2] = scale * FEET * (1.0 - 1.0 / sqrt(1.0 + stretch));
}

void limbs_base_slope(double stretch, double scale, double slope[3])
{
    slope[0] = 0.0;
    slope[1] = scale * (double)CREATURE_BASE_HEIGHT;
    slope[2] = 0.5 * scale * FEET * pow(1.0 + stretch, -1.5);
}

static mat4s head_from_bind(void)
{
    float matrix[16];
    creature_head_from_bind(matrix);
    return mat4_from(matrix);
}

void limbs_pivots(float scale, float pivot[LIMBS][3])
{
    const mat4s from_head = glms_mat4_inv(head_from_bind());
    memset(pivot, 0, LIMBS * sizeof *pivot);
    into_bind(chest, 1.0f, pivot[LIMB_CHEST]);
    into_bind(neck, 1.0f, pivot[LIMB_HEAD]);
    for (int l = LIMB_EAR; l < LIMBS; l++) {
        const float place = JOINT[l >= LIMB_EAR_TIP];
        vec3s joint = glms_vec3_lerp(vec3_from(ear_root), vec3_from(ear_tip), place);
        if ((l - LIMB_EAR) % 2 != 0) joint.x = -joint.x;
        joint = glms_mat4_mulv3(from_head, joint, 1.0f);
        memcpy(pivot[l], joint.raw, sizeof pivot[l]);
    }
    for (int l = 0; l < LIMBS; l++) glm_vec3_scale(pivot[l], scale, pivot[l]);
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

void limbs_matrices(const struct limbs *limbs, float scale, float matrix[LIMBS][16])
{
    float pivot[LIMBS][3], turn[LIMBS][4], size[LIMBS][3];
    limbs_pivots(scale, pivot);
    limbs_motions(limbs, turn, size);
    for (int l = 0; l < LIMBS; l++) {
        versors q;
        memcpy(q.raw, turn[l], sizeof turn[l]);
        mat4s part = about(pivot[l], glms_mat4_mul(glms_quat_mat4(q), glms_scale_make(vec3_from(size[l]))));
        if (limb_parents[l] >= 0) part = glms_mat4_mul(mat4_from(matrix[limb_parents[l]]), part);
        memcpy(matrix[l], part.raw, sizeof matrix[l]);
    }
}

void limbs_bounds(const struct limbs *limbs, float lo[3], float hi[3])
{
    const vec3s size = size_of(limbs);
    float joint[3];
    into_bind(neck, 1.0f, joint);
    for (int k = 0; k < 3; k++) {
        const bool still =
            limbs->look == 0.0f && limbs->nod == 0.0f && limbs->ears[0] == 0.0f && limbs->ears[1] == 0.0f;
        const float wider = fmaxf(limbs->breath, 0.0f) * CHEST_OUTER, reach = still ? 0.0f : HEAD_RADIUS;
        lo[k] = size.raw[k] * fminf(creature_torso_lo[k] - wider, joint[k] - reach);
        hi[k] = size.raw[k] * fmaxf(creature_torso_hi[k] + wider, joint[k] + reach);
    }
}

struct limbs_back limbs_back(const struct limbs *limbs)
{
    float matrix[LIMBS][16];
    struct limbs_back back = {.laid = limbs->ears[0] != 0.0f || limbs->ears[1] != 0.0f};
    limbs_matrices(limbs, 1.0f, matrix);
    for (int l = 0; l < LIMBS; l++) {
        const mat4s part = glms_mat4_inv(mat4_from(matrix[l]));
        memcpy(back.part[l], part.raw, sizeof back.part[l]);
    }
    const vec3s size = size_of(limbs);
    back.step = fminf(1.0f, fminf(size.x, size.y));
    return back;
}

/// How far along its ear a place in the head's own space is: 0 at the root, 1 at the tip.
static float along_ear(vec3s in_head)
{
    const vec3s along = glms_vec3_sub(vec3_from(ear_tip), vec3_from(ear_root));
    const vec3s up_ear = glms_vec3_sub((vec3s){{fabsf(in_head.x), in_head.y, in_head.z}}, vec3_from(ear_root));
    return glms_vec3_dot(up_ear, along) / glms_vec3_norm2(along);
}

static vec3s place_in_head(const float p[3])
{
    vec3s in_head = {{0, 0, 0}};
    creature_into_head(p, in_head.raw);
    return in_head;
}

/// Distance to what of a part's skin lies between two places along an ear, where it is still.
static float piece_distance(const struct limbs_back *back, int part, const float p[3], float from, float to)
{
    const vec3s own = glms_mat4_mulv3(mat4_from(back->part[part]), vec3_from(p), 1.0f);
    const float place = along_ear(place_in_head(own.raw));
    const float outside = EAR_LENGTH * fmaxf(from - place, place - to);
    return fmaxf(creature_torso_distance(own.raw), outside);
}

/// Distance to the head with its ears as they are laid: they are each other's mirror image, so that the one on the point's side is nearer.
static float head_distance(const struct limbs_back *back, const float p[3], vec3s on_head)
{
    if (!back->laid) return creature_torso_distance(on_head.raw);
    const int side = place_in_head(on_head.raw).x < 0.0f;
    const float head = fmaxf(creature_torso_distance(on_head.raw),
                             EAR_LENGTH * (along_ear(place_in_head(on_head.raw)) - JOINT[0] - HALF_BEND));
    const float ear = piece_distance(back, LIMB_EAR + side, p, JOINT[0], JOINT[1] + HALF_BEND);
    return fminf(head, fminf(ear, piece_distance(back, LIMB_EAR_TIP + side, p, JOINT[1], INFINITY)));
}

/// Where parts are still they overlap, so that no cut shows: body and head between the neck's heights.
float limbs_distance(const struct limbs_back *back, const float p[3])
{
    const vec3s on_body = glms_mat4_mulv3(mat4_from(back->part[LIMB_BODY]), vec3_from(p), 1.0f);
    const vec3s on_head = glms_mat4_mulv3(mat4_from(back->part[LIMB_HEAD]), vec3_from(p), 1.0f);
    const float above = on_body.y + CREATURE_BASE_HEIGHT - NECK_HIGH,
                below = NECK_LOW - on_head.y - CREATURE_BASE_HEIGHT;
    const float body = fmaxf(creature_torso_distance(on_body.raw), above);
    return back->step * fminf(body, fmaxf(head_distance(back, p, on_head), below));
}

/// Between two parts, or wholly on the second.
static void hang(struct vertex *vertex, enum limb from, enum limb to, float share)
{
    vertex->limb[0] = (float)from;
    vertex->limb[1] = (float)to;
    vertex->limb[2] = share;
}

void limbs_hang(struct vertex *vertex)
{
    const float *p = vertex->position, standing[3] = {p[0], p[1] + CREATURE_BASE_HEIGHT, p[2]};
    const vec3s in_head = place_in_head(p);
    const float place = along_ear(in_head);
    const float root =
        glm_clamp((place - JOINT[0]) / (2.0f * HALF_BEND) + 0.5f, 0.0f, 1.0f); // evenly, or it would crease
    const float tip = glm_clamp((place - JOINT[1]) / (2.0f * HALF_BEND) + 0.5f, 0.0f, 1.0f);
    const float of_head = glm_smoothstep(NECK_LOW, NECK_HIGH, standing[1]);
    const int side = in_head.x < 0.0f;
    const bool on_ear = in_head.y > 0.0f && root > 0.0f;
    if (on_ear && tip > 0.0f && root == 1.0f) {
        hang(vertex, (enum limb)(LIMB_EAR + side), (enum limb)(LIMB_EAR_TIP + side), tip);
    } else if (on_ear) {
        hang(vertex, LIMB_HEAD, (enum limb)(LIMB_EAR + side), root);
    } else if (of_head > 0.0f) {
        hang(vertex, LIMB_BODY, LIMB_HEAD, of_head);
    } else {
        const float distance = glms_vec3_distance(vec3_from(standing), vec3_from(chest));
        hang(vertex, LIMB_BODY, LIMB_CHEST, glm_smoothstep(CHEST_OUTER, CHEST_INNER, distance));
    }
}

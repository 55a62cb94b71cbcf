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
static const float JOINT[2] = {0.12f, 0.52f};            ///< places along the ear where it bends
static const float HALF_BEND = 0.20f;                    ///< of an ear's length, over which it does
static const float HEAD_RADIUS = 0.50f;                  ///< around the neck's joint, bind size: holds head and ears
static const float SPLAY = 0.4f;                         ///< of an ear that is laid back

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

static mat4s head_turn(const struct limbs *limbs, mat4s into_head, float scale)
{
    float pivot[3];
    into_bind(neck, scale, pivot);
    const vec3s across = {{into_head.m00, into_head.m10, into_head.m20}};
    const mat4s nod = glms_rotate_make(limbs->nod, across), look = glms_rotate_make(limbs->look, (vec3s){{0, 1, 0}});
    return about(pivot, glms_mat4_mul(look, nod));
}

/// The bend of an ear's joint, in bind space; the head's own axes are right-handed and its left ear is at +x.
static mat4s ear_bend(mat4s into_head, float scale, int side, float place, float angle)
{
    const float sign = side ? -1.0f : 1.0f;
    float pivot[3];
    for (int k = 0; k < 3; k++) pivot[k] = scale * (ear_root[k] + place * (ear_tip[k] - ear_root[k]));
    pivot[0] *= sign;
    const mat4s back = glms_rotate_make(angle, (vec3s){{1, 0, 0}});
    const mat4s aside = glms_rotate_make(-sign * SPLAY * angle, (vec3s){{0, 0, 1}});
    return glms_mat4_mul(glms_mat4_inv(into_head),
                         glms_mat4_mul(about(pivot, glms_mat4_mul(aside, back)), into_head));
}

void limbs_matrices(const struct limbs *limbs, float scale, float matrix[LIMBS][16])
{
    mat4s part[LIMBS];
    float middle[3], head[16];
    creature_head_from_bind(head);
    mat4s into_head = mat4_from(head);
    glm_vec3_scale(into_head.raw[3], scale, into_head.raw[3]);
    into_bind(chest, scale, middle);
    const float wider = 1.0f + limbs->breath;
    part[LIMB_BODY] = glms_scale_make(size_of(limbs));
    part[LIMB_CHEST] = glms_mat4_mul(part[LIMB_BODY], about(middle, glms_scale_make((vec3s){{wider, wider, wider}})));
    part[LIMB_HEAD] = glms_mat4_mul(part[LIMB_BODY], head_turn(limbs, into_head, scale));
    for (int side = 0; side < 2; side++) {
        const mat4s root = ear_bend(into_head, scale, side, JOINT[0], limbs->ears[0]);
        const mat4s tip = ear_bend(into_head, scale, side, JOINT[1], limbs->ears[1]);
        part[LIMB_EAR + side] = glms_mat4_mul(part[LIMB_HEAD], root);
        part[LIMB_EAR_TIP + side] = glms_mat4_mul(part[LIMB_EAR + side], tip);
    }
    for (int l = 0; l < LIMBS; l++) memcpy(matrix[l], part[l].raw, sizeof matrix[l]);
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
    vec3s in_head;
    creature_into_head(p, in_head.raw);
    const vec3s along = glms_vec3_sub(vec3_from(ear_tip), vec3_from(ear_root));
    const vec3s up_ear = glms_vec3_sub((vec3s){{fabsf(in_head.x), in_head.y, in_head.z}}, vec3_from(ear_root));
    const float place = glms_vec3_dot(up_ear, along) / glms_vec3_norm2(along);
    const float root = glm_smoothstep(JOINT[0] - HALF_BEND, JOINT[0] + HALF_BEND, place);
    const float tip = glm_smoothstep(JOINT[1] - HALF_BEND, JOINT[1] + HALF_BEND, place);
    const float of_head = glm_smoothstep(NECK_LOW, NECK_HIGH, standing[1]);
    const int side = in_head.x < 0.0f;
    const bool on_ear = in_head.y > 0.0f && root > 0.0f;
    if (on_ear && tip > 0.0f && root == 1.0f) {
        hang(vertex, LIMB_EAR + side, LIMB_EAR_TIP + side, tip);
    } else if (on_ear) {
        hang(vertex, LIMB_HEAD, LIMB_EAR + side, root);
    } else if (of_head > 0.0f) {
        hang(vertex, LIMB_BODY, LIMB_HEAD, of_head);
    } else {
        const float distance = glms_vec3_distance(vec3_from(standing), vec3_from(chest));
        hang(vertex, LIMB_BODY, LIMB_CHEST, glm_smoothstep(CHEST_OUTER, CHEST_INNER, distance));
    }
}

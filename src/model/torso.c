/// The fox without its tail, as a union of round cones.
#include "model/coat.h"
#include "model/creature.h"
#include "model/isosurface.h"
#include "model/parts.h"
#include "model/refine.h"
#include "model/vector.h"
#include <math.h>
#include <stddef.h>

/// The torso is a smooth union of round cones. Metres, bind size, but with y = 0 on the ground. The animal looks towards
/// −z. Parts of the head are relative to its middle and also look towards −z: the head is turned afterwards.
///
/// Later parts lie on top of earlier ones with their colours and fillets.
static const struct part trunk[] = {
    {{0, 0.265f, -0.25f}, {0, 0.56f, -0.34f}, 0.245f, 0.150f, 0.001f, COAT_FUR, false},            // rump to neck
    {{0.12f, 0.17f, -0.27f}, {0.17f, 0.13f, -0.42f}, 0.165f, 0.110f, 0.10f, COAT_FUR, true},       // haunches
    {{0.20f, 0.050f, -0.40f}, {0.225f, 0.045f, -0.50f}, 0.055f, 0.050f, 0.06f, COAT_FUR, true},    // hind feet
    {{0.085f, 0.44f, -0.46f}, {0.085f, 0.06f, -0.52f}, 0.066f, 0.048f, 0.07f, COAT_FUR, true},     // fore legs
    {{0, 0.58f, -0.445f}, {0, 0.36f, -0.465f}, 0.100f, 0.115f, 0.10f, COAT_BELLY, false},          // chest
    {{0.080f, 0.045f, -0.54f}, {0.082f, 0.045f, -0.575f}, 0.050f, 0.047f, 0.05f, COAT_BAND, true}, // paws
};

static const struct part head[] = {
    {{0, 0.01f, 0.01f}, {0.080f, -0.035f, -0.02f}, 0.172f, 0.115f, 0.10f, COAT_FUR, true},           // skull
    {{0.10f, -0.065f, -0.085f}, {0.035f, -0.075f, -0.13f}, 0.065f, 0.055f, 0.05f, COAT_BELLY, true}, // cheeks
    {{0, -0.060f, -0.12f}, {0, -0.055f, -0.205f}, 0.085f, 0.047f, 0.07f, COAT_BELLY, false},         // muzzle
    {{0.110f, 0.10f, 0.02f}, {0.165f, 0.265f, 0.02f}, 0.085f, 0.032f, 0.05f, COAT_FUR, true},        // ears
    {{0.160f, 0.25f, 0.022f}, {0.168f, 0.275f, 0.02f}, 0.036f, 0.030f, 0.04f, COAT_BAND, true},      // their tips
    {{0.118f, 0.13f, -0.030f}, {0.150f, 0.205f, -0.005f}, 0.050f, 0.024f, 0.03f, COAT_BELLY, true},  // and insides
};

/// Eyes and nose; small, so they are meshed more finely.
static const struct part face[] = {
    {{0.082f, 0.025f, -0.140f}, {0.082f, 0.040f, -0.140f}, 0.030f, 0.030f, 0.001f, COAT_DARK, true},
    {{0, -0.035f, -0.247f}, {0, -0.032f, -0.252f}, 0.024f, 0.024f, 0.001f, COAT_DARK, false},
};

/// Middle of the head, how far it is turned to look back over its shoulder, and how far it is tilted (radians).
static const float head_middle[3] = {0.01f, 0.80f, -0.385f};
#define HEAD_TURN 1.35f /* about +y, towards the camera's first place */
#define HEAD_TILT 0.12f
#define HEAD_REACH 0.31f  /* of the face, from the head's middle, along each axis */
#define HEAD_RADIUS 0.36f /* of the ball that holds the head */
#define NECK_BLEND 0.12f
#define STUMP_BLEND 0.14f
#define REFINE_ROUNDS 3
#define LID_WIDTH 0.016f

/// Direction in which eyes and nose shine, standing coordinates.
static const float glint[3] = {0.68f, 0.69f, -0.25f};

const float creature_torso_lo[3] = {-0.36f, -CREATURE_BASE_HEIGHT, -0.68f};
const float creature_torso_hi[3] = {0.36f, 1.16f - CREATURE_BASE_HEIGHT, 0.38f};

/// Standing coordinates → the head's own, before it was turned and tilted.
static void into_head(const float p[3], float q[3])
{
    const float x = p[0] - head_middle[0], y = p[1] - head_middle[1], z = p[2] - head_middle[2];
    const float turned = x * cosf(HEAD_TURN) + z * sinf(HEAD_TURN);
    q[0] = turned * cosf(HEAD_TILT) + y * sinf(HEAD_TILT);
    q[1] = y * cosf(HEAD_TILT) - turned * sinf(HEAD_TILT);
    q[2] = z * cosf(HEAD_TURN) - x * sinf(HEAD_TURN);
}

/// The tail's stump: a hair thicker than the tail along the fillet, then sinking below the tail's own
/// skin at so flat an angle that the seam cannot be seen.
static float stump_distance(const float p[3])
{
    const float z = fminf(fmaxf(p[2], -0.14f), 0.25f);
    const float radius = creature_tail_radius(z) + 0.0012f - 0.006f * glm_smoothstep(0.10f, 0.25f, z);
    return sqrtf(p[0] * p[0] + p[1] * p[1] + (p[2] - z) * (p[2] - z)) - radius;
}

/// Distance to the torso at a point in bind space, and its colour if `rgb` is not NULL.
static float torso_distance_color(const float p[3], float rgb[3])
{
    const float standing[3] = {p[0], p[1] + CREATURE_BASE_HEIGHT, p[2]};
    float distance = parts_add(trunk, sizeof trunk / sizeof *trunk, standing, 1e3f, rgb);
    float fur[3] = {0}, in_head[3], head_rgb[3] = {0};
    if (rgb) coat_linear(COAT_FUR, fur);
    distance = parts_union(distance, stump_distance(p), STUMP_BLEND, rgb, fur);
    into_head(standing, in_head);
    const float bound = glm_vec3_norm(in_head) - HEAD_RADIUS;
    if (bound > distance + NECK_BLEND) return distance;
    const float head_distance = parts_add(head, sizeof head / sizeof *head, in_head, 1e3f, rgb ? head_rgb : NULL);
    return parts_union(distance, head_distance, NECK_BLEND, rgb, head_rgb);
}

float creature_torso_distance(const float p[3]) { return torso_distance_color(p, NULL); }

static float face_distance(const float p[3])
{
    const float standing[3] = {p[0], p[1] + CREATURE_BASE_HEIGHT, p[2]};
    float in_head[3];
    into_head(standing, in_head);
    return parts_add(face, sizeof face / sizeof *face, in_head, 1e3f, NULL);
}

/// Each part has its own colour; around the stump colour and bending go over into the tail's.
static void torso_paint(struct vertex *vertex)
{
    const float *p = vertex->position;
    torso_distance_color(p, vertex->color);
    const float from_axis = hypotf(p[0], p[1]) / CREATURE_TAIL_RADIUS;
    const float near = glm_smoothstep(2.4f, 1.3f, from_axis);
    float tail_rgb[3];
    coat_tail(fmaxf(p[2], 0.0f), p[1] / fmaxf(hypotf(p[0], p[1]), 1e-6f), tail_rgb);
    const float share = near * glm_smoothstep(-0.10f, 0.05f, p[2]);
    glm_vec3_lerp(vertex->color, tail_rgb, share, vertex->color);
    // A dark lid hides the hard line where eyes and nose sink into the fur.
    coat_mix(vertex->color, COAT_DARK, glm_smoothstep(LID_WIDTH, 0.3f * LID_WIDTH, face_distance(p)));
    vertex->bend = near * glm_smoothstep(-0.25f, -0.05f, p[2]);
}

/// Dark, with a glint as of a lamp above.
static void face_paint(struct vertex *vertex)
{
    const float shine = glms_vec3_dot(vec3_from(vertex->normal), vec3_from(glint));
    coat_linear(COAT_DARK, vertex->color);
    coat_mix(vertex->color, COAT_TIP, glm_smoothstep(0.87f, 0.95f, shine));
}

void mesh_torso(float cell, float tolerance, struct mesh *mesh)
{
    const struct solid torso = {creature_torso_distance, torso_paint};
    const int first_index = mesh->index_count;
    isosurface(&torso, creature_torso_lo, creature_torso_hi, cell, mesh);
    refine(&torso, tolerance, REFINE_ROUNDS, first_index, mesh);
    const struct solid features = {face_distance, face_paint};
    float lo[3], hi[3];
    for (int k = 0; k < 3; k++) {
        const float middle = head_middle[k] - (k == 1 ? CREATURE_BASE_HEIGHT : 0.0f);
        lo[k] = middle - HEAD_REACH;
        hi[k] = middle + HEAD_REACH;
    }
    const int first_feature = mesh->index_count;
    isosurface(&features, lo, hi, 0.3f * cell, mesh);
    refine(&features, tolerance, REFINE_ROUNDS - 1, first_feature, mesh);
}

/// The dog's coat: a smooth union of limbs, made of round cones that follow a chain of joints; its mesh and colours.
#include "base/need.h"
#include "model/figure.h"
#include "model/vector.h"
#include "models/dog.h"
#include "models/isosurface.h"
#include "models/mesh.h"
#include <math.h>
#include <stdlib.h>

/// Ratio of the ears' width to thickness.
#define EAR_FLATNESS 2.6f
#define SOLE_FILLET 0.010f

static const struct part trunk[] = {
    {{0, 0.460f, -0.195f}, {0, 0.462f, -0.04f}, 0.108f, 0.102f, 0.001f, 0, false}, // rump and loin
    {{0, 0.452f, 0.01f}, {0, 0.448f, 0.13f}, 0.122f, 0.132f, 0.08f, 0, false},     // ribs
    {{0, 0.400f, 0.13f}, {0, 0.440f, 0.205f}, 0.104f, 0.098f, 0.08f, 0, false},    // chest
    {{0, 0.520f, 0.19f}, {0, 0.665f, 0.280f}, 0.098f, 0.082f, 0.10f, 0, false},    // neck
};

static const struct part head[] = {
    {{-0.016f, 0.752f, 0.312f}, {0.016f, 0.752f, 0.312f}, 0.120f, 0.120f, 0.001f, 0, false}, // skull
    {{0.055f, 0.715f, 0.335f}, {0.042f, 0.716f, 0.395f}, 0.074f, 0.052f, 0.06f, 0, true},    // cheeks
    {{0, 0.712f, 0.400f}, {0, 0.712f, 0.515f}, 0.066f, 0.046f, 0.05f, 0, false},             // muzzle
    {{0.040f, 0.716f, 0.410f}, {0.027f, 0.690f, 0.520f}, 0.040f, 0.037f, 0.025f, 0, true},   // lips
};

static const struct part jaw[] = {
    {{0.018f, 0.682f, 0.365f}, {0.011f, 0.628f, 0.492f}, 0.044f, 0.027f, 0.02f, 0, true},
};

/// Left front leg; the hind leg follows.
static const struct part front_leg[] = {
    {{0.080f, 0.445f, 0.155f}, {0.093f, 0.300f, 0.078f}, 0.080f, 0.050f, 0.001f, 0, false}, // upper arm
    {{0.093f, 0.295f, 0.075f}, {0.091f, 0.105f, 0.110f}, 0.051f, 0.037f, 0.03f, 0, false},  // forearm
    {{0.091f, 0.105f, 0.110f}, {0.092f, 0.045f, 0.135f}, 0.037f, 0.039f, 0.02f, 0, false},  // pastern
    {{0.092f, 0.036f, 0.130f}, {0.094f, 0.032f, 0.165f}, 0.046f, 0.040f, 0.02f, 0, false},  // paw
    {{0.094f, 0.028f, 0.170f}, {0.095f, 0.026f, 0.196f}, 0.026f, 0.024f, 0.010f, 0, false}, // toes
    {{0.065f, 0.026f, 0.160f}, {0.064f, 0.024f, 0.182f}, 0.025f, 0.022f, 0.010f, 0, false},
    {{0.123f, 0.026f, 0.160f}, {0.125f, 0.024f, 0.182f}, 0.025f, 0.022f, 0.010f, 0, false},
};

static const struct part hind_leg[] = {
    {{0.070f, 0.435f, -0.205f}, {0.090f, 0.305f, -0.148f}, 0.100f, 0.070f, 0.001f, 0, false}, // thigh
    {{0.092f, 0.290f, -0.145f}, {0.092f, 0.160f, -0.270f}, 0.062f, 0.036f, 0.04f, 0, false},  // shin
    {{0.092f, 0.158f, -0.274f}, {0.094f, 0.045f, -0.235f}, 0.035f, 0.037f, 0.02f, 0, false},  // hock
    {{0.094f, 0.036f, -0.240f}, {0.096f, 0.032f, -0.200f}, 0.045f, 0.039f, 0.02f, 0, false},  // paw
    {{0.096f, 0.028f, -0.195f}, {0.097f, 0.026f, -0.168f}, 0.026f, 0.024f, 0.010f, 0, false}, // toes
    {{0.067f, 0.026f, -0.205f}, {0.066f, 0.024f, -0.183f}, 0.025f, 0.022f, 0.010f, 0, false},
    {{0.125f, 0.026f, -0.205f}, {0.127f, 0.024f, -0.183f}, 0.025f, 0.022f, 0.010f, 0, false},
};

static const float tail_radius[DOG_TAIL_JOINTS + 1] = {0.046f, 0.037f, 0.033f, 0.034f, 0.037f,
                                                       0.040f, 0.040f, 0.034f, 0.018f};
static const float ear_radius[DOG_EAR_JOINTS + 1] = {0.034f, 0.046f, 0.056f, 0.062f, 0.040f};

/// How limbs join the previous ones.
static const struct {
    const struct part *parts;
    size_t count;
    float side;   ///< −1: mirrored
    float fillet; ///< metres
} solids[DOG_LIMBS] = {
    {trunk, sizeof trunk / sizeof *trunk, 1, 0.001f},
    {head, sizeof head / sizeof *head, 1, 0.06f},
    {jaw, sizeof jaw / sizeof *jaw, 1, 0.008f},
    {NULL, 0, 1, 0.05f}, // tail
    {NULL, 0, 1, 0.022f},
    {NULL, 0, -1, 0.022f}, // ears
    {front_leg, sizeof front_leg / sizeof *front_leg, 1, 0.07f},
    {front_leg, sizeof front_leg / sizeof *front_leg, -1, 0.07f},
    {hind_leg, sizeof hind_leg / sizeof *hind_leg, 1, 0.08f},
    {hind_leg, sizeof hind_leg / sizeof *hind_leg, -1, 0.08f},
};

const struct dog_limb dog_limbs[DOG_LIMBS] = {
    {{"hips", "spine_1", "spine_2", "chest", "neck"}, 0.06f, 0.6f},
    {{"head"}, 0.05f, 0.5f},
    {{"jaw"}, 0.016f, 0.5f},
    {{"tail_1", "tail_2", "tail_3", "tail_4", "tail_5", "tail_6", "tail_7", "tail_8"}, 0.05f, 0.75f},
    {{"ear_1_L", "ear_2_L", "ear_3_L", "ear_4_L"}, 0.020f, 0.6f},
    {{"ear_1_R", "ear_2_R", "ear_3_R", "ear_4_R"}, 0.020f, 0.6f},
    {{"thigh_front_L", "shin_front_L", "foot_front_L", "toe_front_L"}, 0.07f, 0.5f},
    {{"thigh_front_R", "shin_front_R", "foot_front_R", "toe_front_R"}, 0.07f, 0.5f},
    {{"thigh_back_L", "shin_back_L", "foot_back_L", "toe_back_L"}, 0.08f, 0.5f},
    {{"thigh_back_R", "shin_back_R", "foot_back_R", "toe_back_R"}, 0.08f, 0.5f},
};

/// A point of the Catmull–Rom curve through the points, at `t` between number i and the next.
static vec3s curve_point(const float (*points)[3], int count, int i, float t)
{
    vec3s at = glms_vec3_zero();
    const float *p[4];
    for (int n = 0; n < 4; n++) p[n] = points[i + n - 1 < 0 ? 0 : i + n - 1 > count ? count : i + n - 1];
    for (int k = 0; k < 3; k++)
        at.raw[k] = glm_hermite(t, p[1][k], 0.5f * (p[2][k] - p[0][k]), 0.5f * (p[3][k] - p[1][k]), p[2][k]);
    return at;
}

/// Round cones along a curve, with x stretched by `flatness`; the distance is scaled back.
static float tube(const float (*points)[3], const float *radii, int count, float flatness, const float p[3])
{
    enum { CONES = 3 }; // between two points
    const float q[3] = {flatness * p[0], p[1], p[2]};
    float nearest = 1e3f;
    for (int n = 0; n < CONES * count; n++) {
        struct part part = {.blend = 0.002f};
        for (int end = 0; end < 2; end++) {
            const int i = n / CONES;
            const float t = (float)(n % CONES + end) / CONES;
            const vec3s at = curve_point(points, count, i, t);
            float *to = end ? part.b : part.a;
            to[0] = flatness * at.x, to[1] = at.y, to[2] = at.z;
            *(end ? &part.radius_b : &part.radius_a) = glm_lerp(radii[i], radii[i + 1], t);
        }
        nearest = parts_add(&part, 1, q, nearest, NULL);
    }
    return nearest / flatness;
}

float dog_limb_distance(int limb, const float p[3])
{
    const float q[3] = {solids[limb].side * p[0], p[1], p[2]};
    if (solids[limb].parts) return parts_add(solids[limb].parts, solids[limb].count, q, 1e3f, NULL);
    if (limb == DOG_TAIL) return tube(dog_tail, tail_radius, DOG_TAIL_JOINTS, 1.0f, q);
    return tube(dog_ear, ear_radius, DOG_EAR_JOINTS, EAR_FLATNESS, q);
}

/// Everything below the ground is cut off, which flattens the soles.
static float distance(const float p[3])
{
    float nearest = 1e3f;
    for (int limb = 0; limb < DOG_LIMBS; limb++)
        nearest = parts_union(nearest, dog_limb_distance(limb, p), solids[limb].fillet, NULL, NULL);
    return -parts_union(-nearest, p[1], SOLE_FILLET, NULL, NULL);
}

// --- mesh and colours

#define WHITE 0xF1E7D8u
#define EAR 0x70402Cu
#define CHESTNUT 0xA5633Au
#define MOUTH 0x4A1F22u
#define SOFT 0.009f /* half the width of a patch's edge */

#define CELL 0.0090f
#define TOLERANCE 0.0006f
enum { REFINE_ROUNDS = 3 };

static const float lo[3] = {-0.26f, -0.02f, -0.82f}, hi[3] = {0.26f, 0.95f, 0.66f};

/// Rises from 0 to 1 as a exceeds b, over a soft edge.
static float beyond(float a, float b, float edge) { return glm_smoothstep(-edge, edge, a - b); }

static float patches(const float p[3])
{
    const float side = fabsf(p[0]);
    const float saddle = beyond(0.19f, hypotf(hypotf(0.8f * p[0], p[1] - 0.61f), 0.8f * fabsf(p[2] + 0.11f)), SOFT);
    const float nape =
        beyond(p[1] - 0.50f, 1.1f * (p[2] - 0.12f), SOFT) * beyond(p[1], 0.60f, SOFT) * beyond(p[2], 0.0f, 0.01f);
    const float tail = beyond(-0.27f, p[2], SOFT) * beyond(p[1], 0.45f, 0.02f) * beyond(0.735f, p[1], SOFT);
    const float mask = beyond(side, 0.016f + 0.25f * fmaxf(0.80f - p[1], 0.0f), SOFT) * beyond(0.448f, p[2], SOFT) *
                       beyond(p[1], 0.675f + 0.25f * (p[2] - 0.36f), SOFT);
    return fmaxf(fmaxf(saddle, tail), fmaxf(p[2] < 0.30f ? nape : 0.0f, mask * beyond(p[2], 0.22f, 0.02f)));
}

/// Distance to the lines around the muzzle: from the nose down to the lip, and up from the corner of the mouth, for a smile.
static float smile(const float p[3])
{
    static const struct part lines[] = {
        {{0, 0.715f, 0.565f}, {0, 0.660f, 0.557f}, 0.0035f, 0.0025f, 0.001f, 0, false},
        {{0.062f, 0.684f, 0.418f}, {0.078f, 0.712f, 0.392f}, 0.0045f, 0.0030f, 0.001f, 0, true},
    };
    return parts_add(lines, sizeof lines / sizeof *lines, p, 1e3f, NULL);
}

/// White with chestnut patches: a saddle, a mask with a blaze, the nape and the tail except its white tip. The ears are darker, the inside
/// of the mouth is dark.
static void paint(struct vertex *vertex)
{
    const float *p = vertex->position;
    coat_linear(WHITE, vertex->color);
    const float from_head = dog_limb_distance(DOG_HEAD, p), from_jaw = dog_limb_distance(DOG_JAW, p);
    const float ear = fminf(dog_limb_distance(DOG_EAR_LEFT, p), dog_limb_distance(DOG_EAR_RIGHT, p));
    coat_mix(vertex->color, CHESTNUT, patches(p) * beyond(from_jaw, from_head - 0.004f, 0.004f));
    coat_mix(vertex->color, EAR, glm_smoothstep(0.010f, -0.002f, ear - 0.3f * glm_clamp(from_head, 0.0f, 0.03f)));
    coat_mix(vertex->color, MOUTH, 0.8f * glm_smoothstep(0.006f, 0.0f, smile(p)));
    coat_mix(vertex->color, MOUTH,
             glm_smoothstep(0.014f, 0.003f, fmaxf(from_head, from_jaw)) * beyond(p[2], 0.405f, 0.01f));
}

/// Decimates the mesh as a character that owns all its data.
static void thin(struct mesh *mesh, int triangles)
{
    const size_t count = (size_t)mesh->vertex_count;
    struct character c = {
        .vertex_count = mesh->vertex_count, .indices = mesh->indices, .index_count = mesh->index_count};
    uint32_t *indices = need((size_t)mesh->index_count, sizeof *indices);
    c.position = need(count, sizeof *c.position);
    c.color = need(count, sizeof *c.color);
    for (size_t i = 0; i < count; i++) {
        memcpy(c.position[i], mesh->vertices[i].position, sizeof *c.position);
        memcpy(c.color[i], mesh->vertices[i].color, sizeof *c.color);
    }
    int index_count = 0;
    decimate(&c, triangles, indices, &index_count);
    memcpy(mesh->indices, indices, (size_t)index_count * sizeof *indices);
    mesh->index_count = index_count;
    free(indices);
    free(c.position);
    free(c.color);
}

/// Drops unused vertices.
static void drop_unused(struct mesh *mesh)
{
    uint32_t *place = need((size_t)mesh->vertex_count, sizeof *place);
    memset(place, 0xFF, (size_t)mesh->vertex_count * sizeof *place);
    for (int i = 0; i < mesh->index_count; i++) place[mesh->indices[i]] = 0;
    uint32_t kept = 0;
    for (int v = 0; v < mesh->vertex_count; v++) {
        if (place[v] != 0) continue;
        mesh->vertices[kept] = mesh->vertices[v];
        place[v] = kept++;
    }
    for (int i = 0; i < mesh->index_count; i++) mesh->indices[i] = place[mesh->indices[i]];
    mesh->vertex_count = (int)kept;
    free(place);
}

void dog_coat(int triangles, struct mesh *mesh)
{
    const struct solid solid = {distance, paint};
    isosurface(&solid, lo, hi, CELL, mesh);
    refine(&solid, TOLERANCE, REFINE_ROUNDS, 0, mesh);
    thin(mesh, triangles);
    drop_unused(mesh);
}

/// The fox without its tail, as a union of round cones.
#include "model/fox.h"
#include "model/vector.h"
#include "models/fox_maker.h"
#include "models/isosurface.h"
#include <math.h>
#include <stddef.h>

/// The chest's centre, standing (y = 0 is the ground); and an ear in the head's space, with its joints' places.
static const float chest[3] = {0, 0.44f, -0.44f};
static const float ear_root[3] = {0.088f, 0.10f, 0.015f}, ear_tip[3] = {0.152f, 0.292f, 0.02f},
                   ear_joint[2] = {0.15f, 0.65f};

#define PARTS(table) (sizeof(table) / sizeof *(table))

/// The torso is a smooth union of round cones, in metres, bind size, but with y = 0 on the ground. The animal looks towards −z. Parts of
/// the head are relative to its middle and also look towards −z; the head is turned afterwards. Later parts override colours and fillets of
/// earlier ones.
static const struct part trunk[] = {
    {{0, 0.235f, -0.22f}, {0, 0.53f, -0.40f}, 0.210f, 0.120f, 0.001f, COAT_FUR, false},           // rump to chest
    {{0, 0.54f, -0.40f}, {0, 0.70f, -0.385f}, 0.115f, 0.100f, 0.08f, COAT_FUR, false},            // neck
    {{0.105f, 0.175f, -0.23f}, {0.155f, 0.12f, -0.34f}, 0.150f, 0.090f, 0.07f, COAT_FUR, true},   // haunches
    {{0.175f, 0.044f, -0.34f}, {0.205f, 0.040f, -0.485f}, 0.046f, 0.040f, 0.05f, COAT_FUR, true}, // hind feet
    {{0.074f, 0.45f, -0.460f}, {0.064f, 0.07f, -0.535f}, 0.064f, 0.035f, 0.08f, COAT_FUR, true},  // fore legs
    {{0.064f, 0.039f, -0.54f}, {0.066f, 0.037f, -0.580f}, 0.041f, 0.039f, 0.05f, COAT_FUR, true}, // paws
    {{0, 0.60f, -0.455f}, {0, 0.43f, -0.490f}, 0.088f, 0.070f, 0.08f, COAT_TIP, false},           // bib
};

static const struct part head[] = {
    {{0, 0.010f, 0.015f}, {0.052f, -0.005f, 0.0f}, 0.140f, 0.118f, 0.08f, COAT_FUR, true},          // skull
    {{0.085f, -0.055f, -0.035f}, {0.172f, -0.085f, 0.005f}, 0.072f, 0.020f, 0.06f, COAT_TIP, true}, // cheeks
    {{0, -0.050f, -0.10f}, {0, -0.066f, -0.235f}, 0.078f, 0.041f, 0.07f, COAT_FUR, false},          // muzzle
    {{0.088f, 0.10f, 0.015f}, {0.152f, 0.292f, 0.02f}, 0.082f, 0.021f, 0.04f, COAT_FUR, true},      // ears
    {{0, -0.046f, -0.262f}, {0, -0.050f, -0.270f}, 0.021f, 0.018f, 0.012f, COAT_DARK, false},       // nose
};

/// Hollows in the ears.
static const struct part ear_hollow[] = {
    {{0.096f, 0.120f, -0.078f}, {0.143f, 0.245f, -0.034f}, 0.050f, 0.018f, 0.001f, COAT_TIP, true},
};

/// Volumes of white, then dark, markings.
static const struct part white_trunk[] = {
    {{0, 0.64f, -0.57f}, {0, 0.40f, -0.60f}, 0.105f, 0.070f, 0.001f, COAT_TIP, false},
};
static const struct part white_head[] = {
    {{0.036f, -0.098f, -0.250f}, {0.165f, -0.105f, -0.040f}, 0.064f, 0.080f, 0.001f, COAT_TIP, true},
    {{0, -0.130f, -0.20f}, {0, -0.13f, -0.05f}, 0.050f, 0.060f, 0.02f, COAT_TIP, false},
    {{0.100f, 0.125f, -0.050f}, {0.143f, 0.240f, -0.016f}, 0.062f, 0.022f, 0.001f, COAT_TIP, true},
};
static const struct part dark_trunk[] = {
    {{0.064f, -0.02f, -0.56f}, {0.066f, 0.140f, -0.510f}, 0.095f, 0.060f, 0.001f, COAT_DARK, true},
    {{0.207f, -0.02f, -0.53f}, {0.200f, -0.02f, -0.465f}, 0.085f, 0.080f, 0.001f, COAT_DARK, true},
};
static const struct part dark_head[] = {
    {{0.128f, 0.215f, 0.140f}, {0.185f, 0.380f, 0.140f}, 0.105f, 0.110f, 0.001f, COAT_DARK, true},
};

/// Eyes and nose of a mesh with vertex colours; the stage draws them per pixel (stage_mesh.frag).
static const struct part face[] = {
    {{0.074f, 0.012f, -0.40f}, {0.074f, 0.018f, 0.0f}, 0.029f, 0.029f, 0.001f, COAT_DARK, true},
    {{0, -0.046f, -0.262f}, {0, -0.050f, -0.272f}, 0.024f, 0.021f, 0.001f, COAT_DARK, false},
};

#define HEAD_RADIUS 0.36f /* of the ball that holds the head */
#define NECK_BLEND 0.12f
#define STUMP_BLEND 0.14f
#define EAR_BLEND 0.020f

/// Box of eyes, nose and mouth in the head's own space (stage_mesh.frag).
static const float face_lo[3] = {-0.118f, -0.112f, -0.32f}, face_hi[3] = {0.118f, 0.066f, -0.035f};

/// From bind space to the head's own, before it was turned and tilted.
static vec3s in_head(const float bind[3])
{
    float matrix[16];
    fox_head_from_bind(matrix);
    return glms_mat4_mulv3(mat4_from(matrix), vec3_from(bind), 1.0f);
}

bool fox_is_face(const struct mesh *mesh, const uint32_t corners[3])
{
    vec3s lo = glms_vec3_fill(INFINITY), hi = glms_vec3_fill(-INFINITY);
    for (int c = 0; c < 3; c++) {
        const struct vertex *vertex = &mesh->vertices[corners[c]];
        const vec3s place = in_head(vertex->position);
        if (vertex->bend > 0.0f) return false;
        lo = glms_vec3_minv(lo, place);
        hi = glms_vec3_maxv(hi, place);
    }
    for (int k = 0; k < 3; k++) {
        if (lo.raw[k] > face_hi[k] || hi.raw[k] < face_lo[k]) return false;
    }
    return true;
}

/// The tail's stump: slightly thicker than the tail along the fillet, then sinking below the tail's skin at a flat angle that hides the
/// seam.
static float stump_distance(const float p[3])
{
    const float z = fminf(fmaxf(p[2], -0.14f), 0.25f);
    const float radius = fox_tail_radius(z) + 0.0012f - 0.006f * glm_smoothstep(0.10f, 0.25f, z);
    return sqrtf(p[0] * p[0] + p[1] * p[1] + (p[2] - z) * (p[2] - z)) - radius;
}

static float fox_body_distance(const float p[3])
{
    const float standing[3] = {p[0], p[1] + FOX_BASE_HEIGHT, p[2]};
    float distance = parts_add(trunk, PARTS(trunk), standing, 1e3f, NULL);
    const vec3s of_head = in_head(p);
    distance = parts_union(distance, stump_distance(p), STUMP_BLEND, NULL, NULL);
    const float bound = glms_vec3_norm(of_head) - HEAD_RADIUS;
    if (bound > distance + NECK_BLEND) return distance;
    const float solid = parts_add(head, PARTS(head), of_head.raw, 1e3f, NULL);
    const float hollow = parts_add(ear_hollow, PARTS(ear_hollow), of_head.raw, 1e3f, NULL);
    return parts_union(distance, -parts_union(-solid, hollow, EAR_BLEND, NULL, NULL), NECK_BLEND, NULL, NULL);
}

/// Share of ambient light at a place on the skin. It is lower if, some way outwards, skin or ground is nearer than that.
static float openness(const float position[3], const float normal[3])
{
    static const struct {
        float way, weight; // metres
    } looks[] = {{0.025f, 5.0f}, {0.060f, 3.6f}, {0.130f, 2.2f}, {0.240f, 0.9f}};
    float shade = 0.0f;
    for (size_t i = 0; i < PARTS(looks); i++) {
        const vec3s out = glms_vec3_muladds(vec3_from(normal), looks[i].way, vec3_from(position));
        const float free = fminf(fox_body_distance(out.raw), out.y + FOX_BASE_HEIGHT);
        shade += looks[i].weight * fmaxf(looks[i].way - free, 0.0f);
    }
    return expf(-shade);
}

static const float CHEST_INNER = 0.05f;                 ///< metres from its middle: fully part of it
static const float NECK_LOW = 0.57f, NECK_HIGH = 0.68f; ///< heights: not part of the head, fully part of it
static const float HALF_BEND = 0.25f;                   ///< of an ear's length, over which it bends

/// Position along its ear in the head's own space: 0 at the root, 1 at the tip.
static float along_ear(vec3s of_head)
{
    const vec3s root = vec3_from(ear_root), along = glms_vec3_sub(vec3_from(ear_tip), root);
    const vec3s up_ear = glms_vec3_sub((vec3s){{fabsf(of_head.x), of_head.y, of_head.z}}, root);
    return glms_vec3_dot(up_ear, along) / glms_vec3_norm2(along);
}

/// Weights between two parts, or only the second.
static void hang_on(struct vertex *vertex, int from, int to, float share)
{
    vertex->limb[0] = (float)from;
    vertex->limb[1] = (float)to;
    vertex->limb[2] = share;
}

/// Linear from 0 to 1 around an ear's bend, to avoid a crease.
static float behind_joint(float place, int joint)
{
    return glm_clamp((place - ear_joint[joint]) / (2.0f * HALF_BEND) + 0.5f, 0.0f, 1.0f);
}

/// Sets a vertex's joints.
static void hang(struct vertex *vertex, vec3s of_head)
{
    const float *p = vertex->position, standing[3] = {p[0], p[1] + FOX_BASE_HEIGHT, p[2]};
    const float place = along_ear(of_head), root = behind_joint(place, 0), tip = behind_joint(place, 1);
    const float on_head = glm_smoothstep(NECK_LOW, NECK_HIGH, standing[1]);
    const int side = of_head.x < 0.0f;
    const bool on_ear = of_head.y > 0.0f && root > 0.0f;
    if (on_ear && tip > 0.0f && root == 1.0f) {
        hang_on(vertex, LIMB_EAR + side, LIMB_EAR_TIP + side, tip);
    } else if (on_ear) {
        hang_on(vertex, LIMB_HEAD, LIMB_EAR + side, root);
    } else if (on_head > 0.0f) {
        hang_on(vertex, LIMB_BODY, LIMB_HEAD, on_head);
    } else {
        const float distance = glms_vec3_distance(vec3_from(standing), vec3_from(chest));
        hang_on(vertex, LIMB_BODY, LIMB_CHEST, glm_smoothstep(LIMBS_CHEST_RADIUS, CHEST_INNER, distance));
    }
}

/// Each marking has a volume; around the stump markings and bending blend into the tail's.
static void torso_paint(struct vertex *vertex)
{
    const float *p = vertex->position, standing[3] = {p[0], p[1] + FOX_BASE_HEIGHT, p[2]};
    const vec3s of_head = in_head(p);
    float of_tail[MARKS];
    const float on_head = glm_smoothstep(HEAD_RADIUS, 0.8f * HEAD_RADIUS, glms_vec3_norm(of_head));
    const float white = parts_add(white_trunk, PARTS(white_trunk), standing, 1e3f, NULL);
    const float dark = parts_add(dark_trunk, PARTS(dark_trunk), standing, 1e3f, NULL);
    vertex->mark[MARK_WHITE] = -fminf(white, parts_add(white_head, PARTS(white_head), of_head.raw, 1e3f, NULL));
    vertex->mark[MARK_DARK] = -fminf(dark, parts_add(dark_head, PARTS(dark_head), of_head.raw, 1e3f, NULL));
    vertex->mark[MARK_BROWN] = 0.25f * glm_smoothstep(0.2f, 1.0f, vertex->normal[2]) * (1.0f - on_head);
    const float from_axis = hypotf(p[0], p[1]) / FOX_TAIL_RADIUS;
    const float near = glm_smoothstep(3.6f, 1.5f, from_axis);
    coat_tail(fmaxf(p[2], 0.0f), p[1] / fmaxf(hypotf(p[0], p[1]), 1e-6f), of_tail);
    const float share = near * glm_smoothstep(-0.10f, 0.05f, p[2]);
    glm_vec3_lerp(vertex->mark, of_tail, share, vertex->mark);
    hang(vertex, of_head);
    vertex->bend = near * glm_smoothstep(-0.25f, -0.05f, p[2]);
    coat_marked(vertex->mark, vertex->color);
    const float features = of_head.z < 0.0f ? parts_add(face, PARTS(face), of_head.raw, 1e3f, NULL) : 1.0f;
    coat_mix(vertex->color, COAT_DARK, glm_smoothstep(0.004f, -0.004f, features));
}

void mesh_fox_body(float cell, float tolerance, int rounds, struct mesh *mesh)
{
    const struct solid torso = {fox_body_distance, torso_paint};
    const int first = mesh->vertex_count, first_index = mesh->index_count;
    isosurface(&torso, fox_body_lo, fox_body_hi, cell, mesh);
    refine(&torso, tolerance, rounds, first_index, mesh);
    for (int v = first; v < mesh->vertex_count; v++) {
        struct vertex *vertex = &mesh->vertices[v];
        vertex->open = glm_lerp(openness(vertex->position, vertex->normal), 1.0f, vertex->bend);
    }
}

static const struct level {
    float cell, tolerance; ///< of the body, see mesh_fox_body()
    int rounds;
    int rings, segments; ///< of the tail
} levels[FOX_LEVELS] = {
    {0.030f, 0.0028f, 3, 72, 32},
    {0.036f, 0.0036f, 1, 68, 24},
    {0.047f, 0.0150f, 1, 48, 15},
    {0.059f, 0.0000f, 0, 30, 9},
};

void mesh_fox(int level, struct mesh *mesh)
{
    const struct level *l = &levels[level];
    mesh_fox_body(l->cell, l->tolerance, l->rounds, mesh);
    mesh_fox_tail(l->rings, l->segments, mesh);
}

void fox_pivots(float pivot[LIMBS][3])
{
    float matrix[16];
    fox_head_from_bind(matrix);
    const mat4s from_head = glms_mat4_inv(mat4_from(matrix));
    memset(pivot, 0, LIMBS * sizeof *pivot);
    for (int k = 0; k < 3; k++) {
        pivot[LIMB_CHEST][k] = chest[k] - (k == 1 ? FOX_BASE_HEIGHT : 0.0f);
        pivot[LIMB_HEAD][k] = limbs_neck[k] - (k == 1 ? FOX_BASE_HEIGHT : 0.0f);
    }
    for (int l = LIMB_EAR; l < LIMBS; l++) {
        vec3s joint = glms_vec3_lerp(vec3_from(ear_root), vec3_from(ear_tip), ear_joint[l >= LIMB_EAR_TIP]);
        if ((l - LIMB_EAR) % 2 != 0) joint.x = -joint.x;
        joint = glms_mat4_mulv3(from_head, joint, 1.0f);
        memcpy(pivot[l], joint.raw, sizeof pivot[l]);
    }
}

/// Builds foxes with tails of any number of joints, moves their bodies, and measures both.
///
/// The skin is the file's, except for the tail: its weights are the uniform cubic B-spline along it, four joints at a time. Weights that
/// reach back over the base go to the body. The file's attribute `bend` says how much a vertex follows the tail.
#include "model/fox.h"
#include "base/embedded.h"
#include "base/need.h"
#include "maths/maths.h"
#include "model/vector.h"
#include <assert.h>
#include <math.h>
#include <pthread.h>
#include <stdio.h>

enum { BODY = 0 }; ///< of the skin's joints

_Static_assert((int)FOX_FIRST_JOINT == (int)FOX_FIRST_LIMB + (int)LIMBS, "the tail's joints follow the body's parts");

float fox_tail_radius(float z)
{
    const float by = FOX_BRUSH_RADIUS - FOX_TAIL_RADIUS;
    if (z < FOX_TIP_START) {
        const float t = fmaxf((z - FOX_SWELL_START) / (FOX_TIP_START - FOX_SWELL_START), 0.0f);
        return FOX_TAIL_RADIUS + by * t * t * (3.0f - 2.0f * t);
    }
    const float s = fminf((z - FOX_TIP_START) / (FOX_TAIL_LENGTH - FOX_TIP_START), 1.0f);
    return FOX_BRUSH_RADIUS * sqrtf(1.0f - s * s) * (1.0f - FOX_TIP_POINT * s * s);
}

int fox_level(int animals)
{
    static const int most[FOX_LEVELS] = {1, 2, 4, 8};
    int level = 0;
    while (level + 1 < FOX_LEVELS && most[level] < animals) level++;
    return level;
}

static struct gltf asset; ///< read once and never freed, so that foxes share its vertices

static void read_asset(void)
{
    const struct embedded *file = embedded_find("models/fox.glb");
    struct error error;
    char *data = need(file->size + 1, 1);
    memcpy(data, file->data, file->size + 1);
    if (!gltf_read_bytes(file->name, data, file->size, &asset, &error))
        need_failed(); // our own file is good, so memory ran out
}

/// Adds a weight, and its slope along the tail, for a vertex's joint.
static void add_influence(struct gltf_part *part, int vertex, int joint, float weight, float slope)
{
    uint16_t *joints = part->joints[vertex];
    float *weights = part->weights[vertex];
    int i = 0;
    while (i < GLTF_INFLUENCES && weights[i] != 0.0f && joints[i] != joint) i++;
    assert(i < GLTF_INFLUENCES);
    joints[i] = (uint16_t)joint;
    weights[i] += weight;
    part->along[vertex][i] += slope;
}

void fox_hang(struct gltf_part *part, int joints)
{
    const float segment = FOX_TAIL_LENGTH / (float)joints, by_metre = 0.5f / segment;
    for (int v = 0; v < part->vertex_count; v++) {
        const float bend = part->fur[v][0];
        if (!(bend > 0.0f)) continue;
        const float along = part->position[v][2] / segment - 0.5f, first = floorf(along);
        const float t = along - first, s = 1.0f - t;
        const float weight[4] = {s * s * s / 6.0f, (4.0f - 3.0f * t * t * (2.0f - t)) / 6.0f,
                                 (4.0f - 3.0f * s * s * (2.0f - s)) / 6.0f, t * t * t / 6.0f};
        const float slope[4] = {-s * s * by_metre, t * (3.0f * t - 4.0f) * by_metre, s * (4.0f - 3.0f * s) * by_metre,
                                t * t * by_metre};
        memset(part->joints[v], 0, sizeof part->joints[v]);
        memset(part->weights[v], 0, sizeof part->weights[v]);
        if (bend < 1.0f) add_influence(part, v, BODY, 1.0f - bend, 0.0f);
        for (int k = 0; k < 4; k++) {
            const int slot = (int)first + k;
            const int joint = slot <= 0 ? BODY : LIMBS + (slot > joints ? joints : slot) - 1;
            if (weight[k] > 0.0f) add_influence(part, v, joint, bend * weight[k], bend * slope[k]);
        }
    }
}

static void *copy_of(struct gltf *fox, const void *block, int count, size_t size)
{
    return memcpy(pool_take(&fox->pool, (size_t)count, size), block, (size_t)count * size);
}

void fox_create(int level, int joints, struct gltf *fox)
{
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    pthread_once(&once, read_asset);
    *fox = (struct gltf){.path = asset.path, .id = gltf_new_id(), .weight_count = 1, .room = SIZE_MAX};
    struct pool *pool = &fox->pool;
    fox->weights = pool_take(pool, 1, sizeof *fox->weights);
    fox->material_count = asset.material_count;
    fox->materials = asset.materials;

    const struct gltf_mesh *from = &asset.meshes[level];
    struct gltf_mesh *mesh = fox->meshes = pool_take(pool, 1, sizeof *mesh);
    fox->mesh_count = 1;
    *mesh = (struct gltf_mesh){.name = from->name, .part_count = from->part_count, .target_count = 1};
    mesh->parts = pool_take(pool, (size_t)from->part_count, sizeof *mesh->parts);
    mesh->weights = pool_take(pool, 1, sizeof *mesh->weights);
    for (int p = 0; p < from->part_count; p++) {
        struct gltf_part *part = &mesh->parts[p];
        *part = from->parts[p];
        part->joints = copy_of(fox, part->joints, part->vertex_count, sizeof *part->joints);
        part->weights = copy_of(fox, part->weights, part->vertex_count, sizeof *part->weights);
        part->along = pool_take(pool, (size_t)part->vertex_count, sizeof *part->along);
        part->targets = pool_take(pool, 1, sizeof *part->targets);
        fox_hang(part, joints);
    }

    // The file's nodes without the tail's, the last one with the mesh; and the skin.
    const int bones = FOX_FIRST_JOINT + joints;
    struct gltf_skin *skin = fox->skins = pool_take(pool, 1, sizeof *skin);
    fox->skin_count = 1;
    fox->joint_count = skin->joint_count = bones - FOX_FIRST_LIMB;
    skin->joints = pool_take(pool, (size_t)skin->joint_count, sizeof *skin->joints);
    skin->inverse_bind = pool_take(pool, (size_t)skin->joint_count, sizeof *skin->inverse_bind);
    fox->node_count = bones + 1;
    fox->nodes = pool_take(pool, (size_t)fox->node_count, sizeof *fox->nodes);
    fox->order = pool_take(pool, (size_t)fox->node_count, sizeof *fox->order);
    for (int n = 0; n < fox->node_count; n++) {
        struct gltf_node *node = &fox->nodes[n];
        const int joint = n - FOX_FIRST_LIMB, tail = n - FOX_FIRST_JOINT;
        fox->order[n] = n;
        if (tail >= 0 && n < bones) { // a child of the joint before, or of the fox
            char name[32];
            const int length = snprintf(name, sizeof name, "tail_%d", tail);
            *node = (struct gltf_node){.name = copy_of(fox, name, length + 1, 1),
                                       .parent = tail > 0 ? n - 1 : 0,
                                       .place = {.rotation = {0, 0, 0, 1}, .scale = {1, 1, 1}},
                                       .mesh = -1,
                                       .skin = -1};
            if (tail > 0) node->place.translation[2] = FOX_TAIL_LENGTH / (float)joints;
        } else {
            *node = asset.nodes[n < bones ? n : asset.node_count - 1];
        }
        if (joint < 0 || n == bones) continue;
        const vec3s back = {{0, 0, -FOX_TAIL_LENGTH * (float)tail / (float)joints}};
        const mat4s matrix = tail < 0 ? mat4_from(asset.skins->inverse_bind[joint]) : glms_translate_make(back);
        memcpy(skin->inverse_bind[joint], matrix.raw, sizeof skin->inverse_bind[joint]);
        skin->joints[joint] = n;
    }
    gltf_link_nodes(fox);
}

// --- parts of the body, and their places

static const double FEET = -0.30;       ///< the body stretches above this z, bind space
static const float HEAD_RADIUS = 0.50f; ///< around the neck's joint, bind size: contains head and ears
static const float SPLAY = 0.4f;        ///< of an ear laid back

const float limbs_neck[3] = {0.005f, 0.66f, -0.385f};
const float fox_body_lo[3] = {-0.36f, -FOX_BASE_HEIGHT, -0.68f};
const float fox_body_hi[3] = {0.36f, 1.16f - FOX_BASE_HEIGHT, 0.38f};

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
    slope[2] = 0.5 * scale * FEET / ((1.0 + stretch) * sqrt(1.0 + stretch));
}

/// Centre of the head, its turn to look over the shoulder, and its tilt (radians).
static const float head_middle[3] = {0.01f, 0.80f, -0.385f};
static const float HEAD_TURN = 1.35f; ///< about +y, towards the camera's first place
static const float HEAD_TILT = 0.12f;

void fox_head_from_bind(float matrix[16])
{
    const float ct = maths_cosf(HEAD_TURN), st = maths_sinf(HEAD_TURN), ci = maths_cosf(HEAD_TILT),
                si = maths_sinf(HEAD_TILT);
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

void fox_move(const struct limbs *limbs, struct gltf_pose *pose)
{
    float matrix[16];
    fox_head_from_bind(matrix);
    const mat4s into_head = mat4_from(matrix);
    const vec3s across = {{into_head.m00, into_head.m10, into_head.m20}}, stretched = size_of(limbs);
    const vec3s forth = {{into_head.m02, into_head.m12, into_head.m22}};
    const versors look = glms_quatv(limbs->look, (vec3s){{0, 1, 0}}), nod = glms_quatv(limbs->nod, across);
    for (int l = 0; l < LIMBS; l++) { // relative to its parent: a turn after scaling along bind space's axes
        struct gltf_place *place = &pose->place[FOX_FIRST_LIMB + l];
        versors own = l == LIMB_HEAD ? glms_quat_mul(look, nod) : glms_quat_identity();
        if (l >= LIMB_EAR) {
            const float back = limbs->ears[l >= LIMB_EAR_TIP], sign = (l - LIMB_EAR) % 2 ? -1.0f : 1.0f;
            own = glms_quat_mul(glms_quatv(-sign * SPLAY * back, forth), glms_quatv(back, across));
        }
        memcpy(place->rotation, own.raw, sizeof place->rotation);
        for (int k = 0; k < 3; k++)
            place->scale[k] = l == LIMB_BODY ? stretched.raw[k] : l == LIMB_CHEST ? 1.0f + limbs->breath : 1.0f;
    }
    pose->weights[0] = limbs->blink;
}

void limbs_bounds(const struct limbs *limbs, float lo[3], float hi[3])
{
    const vec3s size = size_of(limbs);
    const float joint[3] = {limbs_neck[0], limbs_neck[1] - FOX_BASE_HEIGHT, limbs_neck[2]};
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

// --- shadows

/// A weaker blob changes no pixel.
#define STRENGTH_SEEN 0.02f

/// Samples along the tail, and the height at which its shadow has faded to 1/e (bind size, metres).
enum { TAIL_BLOBS = 11 };
#define FADE_HEIGHT 0.45f
#define BODY_FADE_HEIGHT 0.35f /* likewise for the body of a hopping fox */

/// The parts that cast shadow, in bind space, with heights: rump, chest, and the ground contact of each hind foot and fore paw; then chest,
/// neck and head.
static const struct {
    struct shadow_blob blob;
    float height;
} body_blobs[] = {
    {{0.0f, -0.27f, 0.44f, 0.60f}, 0.0f},     {{0.0f, -0.48f, 0.27f, 0.36f}, 0.0f},
    {{0.195f, -0.43f, 0.13f, 0.50f}, 0.0f},   {{-0.195f, -0.43f, 0.13f, 0.50f}, 0.0f},
    {{0.065f, -0.555f, 0.085f, 0.75f}, 0.0f}, {{-0.065f, -0.555f, 0.085f, 0.75f}, 0.0f},
    {{0.0f, -0.38f, 0.29f, 0.34f}, 0.42f},    {{0.0f, -0.40f, 0.25f, 0.24f}, 0.62f},
    {{0.01f, -0.40f, 0.29f, 0.30f}, 0.80f},
};

int pose_blobs(const struct pose *pose, const float from[3], struct shadow_blob *blobs, int capacity)
{
    const float scale = pose->scale, ground = pose->ground;
    const float above = fmaxf(pose->matrix[0][13] - ground - scale * FOX_BASE_HEIGHT, 0.0f);
    const int body_count = (int)(sizeof body_blobs / sizeof *body_blobs);
    const float down = fmaxf(from[1], 0.3f);                  // so that a low lamp's shadow is not endless
    const vec2s slope = {{-from[0] / down, -from[2] / down}}; // how far the light moves sideways per metre down
    int count = 0;
    for (int b = 0; b < body_count && count < capacity; b++) {
        const struct shadow_blob *blob = &body_blobs[b].blob;
        const float fade = maths_expf(-above / (scale * BODY_FADE_HEIGHT)),
                    height = scale * body_blobs[b].height + above;
        blobs[count++] = (struct shadow_blob){pose->matrix[0][12] + scale * blob->x + slope.x * height,
                                              pose->matrix[0][14] + scale * blob->z + slope.y * height,
                                              scale * blob->radius * (1.5f - 0.5f * fade), blob->strength * fade};
    }
    for (int b = 0; b < TAIL_BLOBS && count < capacity; b++) {
        // At `along` from the base (0) to the tip (1): the higher, the wider and the weaker.
        const float along = ((float)b + 0.5f) / TAIL_BLOBS, at = along * (float)(pose->count - 1);
        const int n = (int)fminf(at, (float)(pose->count - 2));
        const vec3s p =
            glms_vec3_lerp(vec3_from(pose->matrix[n] + 12), vec3_from(pose->matrix[n + 1] + 12), at - (float)n);
        const float radius = scale * fox_tail_radius(along * FOX_TAIL_LENGTH);
        const float over = fmaxf(p.y - radius - ground, 0.0f), height = over / (scale * FADE_HEIGHT);
        const struct shadow_blob blob = {p.x + slope.x * over, p.z + slope.y * over,
                                         1.6f * radius + 0.12f * scale * (1.0f + height),
                                         0.45f * maths_expf(-height)};
        if (blob.strength > STRENGTH_SEEN) blobs[count++] = blob;
    }
    return count;
}

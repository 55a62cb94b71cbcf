/// Gives the fox a tail of any number of joints, and poses it.
///
/// Its skin is the file's but for the tail, whose weights are the uniform cubic B-spline along it, four joints at a time; where they reach back
/// over the base, the body takes them. Vertices say in the file how far they follow the tail (`bend`).
#include "model/fox.h"
#include "base/embedded.h"
#include "base/need.h"
#include "model/limbs.h"
#include "model/vector.h"
#include <assert.h>
#include <math.h>
#include <pthread.h>
#include <stdlib.h>

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

static struct gltf asset; ///< read once, never freed

static void read_asset(void)
{
    const struct embedded *file = embedded_find("models/fox.glb");
    struct error error;
    char *data = need(file->size + 1, 1);
    memcpy(data, file->data, file->size + 1);
    if (!gltf_read_bytes(file->name, data, file->size, &asset, &error))
        need_failed(); // it is ours, so memory was short
}

/// Adds a weight, and how it changes along the tail, to a vertex's joint.
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

/// Hangs a vertex `z` from the tail's base on it, as much as it follows the tail.
static void hang_on_tail(struct gltf_part *part, int vertex, int joints)
{
    const float segment = FOX_TAIL_LENGTH / (float)joints, bend = part->fur[vertex][0], by_metre = 0.5f / segment;
    const float along = part->position[vertex][2] / segment - 0.5f, first = floorf(along), t = along - first,
                s = 1.0f - t;
    const float weight[4] = {s * s * s / 6.0f, (4.0f - 3.0f * t * t * (2.0f - t)) / 6.0f,
                             (4.0f - 3.0f * s * s * (2.0f - s)) / 6.0f, t * t * t / 6.0f};
    const float slope[4] = {-s * s * by_metre, t * (3.0f * t - 4.0f) * by_metre, s * (4.0f - 3.0f * s) * by_metre,
                            t * t * by_metre};
    memset(part->joints[vertex], 0, sizeof part->joints[vertex]);
    memset(part->weights[vertex], 0, sizeof part->weights[vertex]);
    if (bend < 1.0f) add_influence(part, vertex, BODY, 1.0f - bend, 0.0f);
    for (int k = 0; k < 4; k++) {
        const int slot = (int)first + k;
        const int joint = slot <= 0 ? BODY : LIMBS + (slot > joints ? joints : slot) - 1;
        if (weight[k] > 0.0f) add_influence(part, vertex, joint, bend * weight[k], bend * slope[k]);
    }
}

void fox_hang(struct gltf_part *part, int joints)
{
    for (int v = 0; v < part->vertex_count; v++) {
        if (part->fur[v][0] > 0.0f) hang_on_tail(part, v, joints);
    }
}

static void *copy_of(const void *block, int count, size_t size)
{
    void *copy = need((size_t)count + 1, size);
    return memcpy(copy, block, (size_t)count * size);
}

static void copy_part(const struct gltf_part *from, int joints, struct gltf_part *part)
{
    const int count = from->vertex_count;
    *part = *from;
    part->position = copy_of(from->position, count, sizeof *part->position);
    part->normal = copy_of(from->normal, count, sizeof *part->normal);
    part->color = copy_of(from->color, count, sizeof *part->color);
    part->mark = copy_of(from->mark, count, sizeof *part->mark);
    part->fur = copy_of(from->fur, count, sizeof *part->fur);
    part->joints = copy_of(from->joints, count, sizeof *part->joints);
    part->weights = copy_of(from->weights, count, sizeof *part->weights);
    part->indices = copy_of(from->indices, from->index_count, sizeof *part->indices);
    part->along = need_zeroed((size_t)count + 1, sizeof *part->along);
    part->targets = need_zeroed(1, sizeof *part->targets);
    fox_hang(part, joints);
}

static void copy_mesh(const struct gltf_mesh *from, int joints, struct gltf_mesh *mesh)
{
    *mesh = (struct gltf_mesh){.name = need_text(from->name), .part_count = from->part_count, .target_count = 1};
    mesh->parts = need((size_t)from->part_count, sizeof *mesh->parts);
    mesh->weights = need_zeroed(1, sizeof *mesh->weights);
    for (int p = 0; p < from->part_count; p++) copy_part(&from->parts[p], joints, &mesh->parts[p]);
}

void fox_place(int node, int joints, float place[3])
{
    float pivot[LIMBS][3];
    limbs_pivots(1.0f, pivot);
    memset(place, 0, 3 * sizeof *place);
    if (node >= FOX_FIRST_JOINT) {
        place[2] = FOX_TAIL_LENGTH * (float)(node - FOX_FIRST_JOINT) / (float)joints;
    } else if (node >= FOX_FIRST_LIMB) {
        memcpy(place, pivot[node - FOX_FIRST_LIMB], sizeof pivot[0]);
    }
}

int fox_parent(int node)
{
    const int limb = node - FOX_FIRST_LIMB;
    if (node == 0) return -1;
    if (limb >= LIMBS) return node > FOX_FIRST_JOINT ? node - 1 : 0;
    return limb_parents[limb] < 0 ? 0 : FOX_FIRST_LIMB + limb_parents[limb];
}

/// The nodes, the last one showing the mesh, and the skin.
static void make_skeleton(struct gltf *fox, int joints)
{
    const int bones = FOX_FIRST_JOINT + joints;
    struct gltf_skin *skin = fox->skins = need_zeroed(1, sizeof *skin);
    fox->skin_count = 1;
    fox->joint_count = skin->joint_count = bones - FOX_FIRST_LIMB;
    skin->joints = need((size_t)skin->joint_count, sizeof *skin->joints);
    skin->inverse_bind = need((size_t)skin->joint_count, sizeof *skin->inverse_bind);
    fox->node_count = bones + 1;
    fox->nodes = need_zeroed((size_t)fox->node_count, sizeof *fox->nodes);
    fox->order = need((size_t)fox->node_count, sizeof *fox->order);
    for (int n = 0; n < fox->node_count; n++) {
        static const struct gltf_place still = {.rotation = {0, 0, 0, 1}, .scale = {1, 1, 1}};
        const bool shows = n == bones;
        fox->order[n] = n;
        fox->nodes[n] = (struct gltf_node){.parent = shows ? -1 : fox_parent(n),
                                           .child = -1,
                                           .next = -1,
                                           .place = still,
                                           .mesh = shows ? 0 : -1,
                                           .skin = shows ? 0 : -1};
        if (n < FOX_FIRST_LIMB || shows) continue;
        float place[3];
        fox_place(n, joints, place);
        const mat4s back = glms_translate_make(glms_vec3_negate(vec3_from(place)));
        skin->joints[n - FOX_FIRST_LIMB] = n;
        memcpy(skin->inverse_bind[n - FOX_FIRST_LIMB], back.raw, sizeof skin->inverse_bind[0]);
    }
}

static void make_pose(const struct gltf *gltf, struct gltf_pose *pose)
{
    const size_t nodes = (size_t)gltf->node_count;
    *pose = (struct gltf_pose){.place = need_zeroed(nodes, sizeof *pose->place),
                               .world = need_zeroed(nodes, sizeof *pose->world),
                               .joints = need_zeroed((size_t)gltf->joint_count, sizeof *pose->joints),
                               .weights = need_zeroed(1, sizeof *pose->weights)};
}

void fox_create(int level, int joints, struct fox *fox)
{
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    struct gltf *gltf = &fox->gltf;
    pthread_once(&once, read_asset);
    *fox = (struct fox){.level = level, .joints = joints};
    *gltf = (struct gltf){.path = need_text(asset.path), .id = gltf_new_id(), .mesh_count = 1, .weight_count = 1};
    gltf->meshes = need_zeroed(1, sizeof *gltf->meshes);
    gltf->weights = need_zeroed(1, sizeof *gltf->weights);
    copy_mesh(&asset.meshes[level], joints, gltf->meshes);
    gltf->material_count = asset.material_count;
    gltf->materials = copy_of(asset.materials, asset.material_count, sizeof *gltf->materials);
    for (int m = 0; m < gltf->material_count; m++) gltf->materials[m].name = need_text(asset.materials[m].name);
    make_skeleton(gltf, joints);
    make_pose(gltf, &fox->pose);
}

void fox_free(struct fox *fox)
{
    gltf_pose_free(&fox->pose);
    gltf_free(&fox->gltf);
    *fox = (struct fox){0};
}

void fox_pose(const struct fox *fox, const struct pose *pose)
{
    const struct gltf_skin *skin = &fox->gltf.skins[0];
    const struct gltf_pose *out = &fox->pose;
    const vec3s size = glms_vec3_fill(pose_scale(pose));
    const mat4s base = glms_scale(glms_translate_make(vec3_from(pose->matrix[0] + 12)), size);
    float limbs[LIMBS][16];
    limbs_matrices(&pose->limbs, 1.0f, limbs);
    for (int j = 0; j < skin->joint_count; j++) {
        const mat4s back = mat4_from(skin->inverse_bind[j]);
        mat4s moved, world;
        if (j < LIMBS) {
            moved = glms_mat4_mul(base, mat4_from(limbs[j]));
            world = glms_mat4_mul(moved, glms_mat4_inv(back));
        } else {
            world = glms_scale(mat4_from(pose->matrix[j - LIMBS]), size);
            moved = glms_mat4_mul(world, back);
        }
        memcpy(out->joints[j], moved.raw, sizeof out->joints[j]);
        memcpy(out->world[skin->joints[j]], world.raw, sizeof out->world[0]);
    }
    memcpy(out->world[0], base.raw, sizeof out->world[0]);
    out->weights[0] = pose->limbs.blink;
}

int fox_vertex_count(const struct fox *fox) { return gltf_vertex_count(&fox->gltf, fox->gltf.node_count - 1); }

void fox_places(const struct fox *fox, float (*places)[3])
{
    gltf_pose_vertices(&fox->gltf, &fox->pose, fox->gltf.node_count - 1, places, NULL);
}

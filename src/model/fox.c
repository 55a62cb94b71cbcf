/// Gives the fox a tail of any number of joints, and moves its body.
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
#include <stdio.h>
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

/// A node of the tail continues the one before, or the whole fox.
static struct gltf_node make_joint(int n, int joints)
{
    char name[32];
    struct gltf_node node = {.parent = n > 0 ? FOX_FIRST_JOINT + n - 1 : 0,
                             .place = {.rotation = {0, 0, 0, 1}, .scale = {1, 1, 1}}};
    snprintf(name, sizeof name, "tail_%d", n);
    node.name = need_text(name);
    node.mesh = node.skin = -1;
    if (n > 0) node.place.translation[2] = FOX_TAIL_LENGTH / (float)joints;
    return node;
}

/// The file's nodes but for the tail's, the last one showing the mesh; and the skin.
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
        const struct gltf_node *own = &asset.nodes[n < bones ? n : asset.node_count - 1];
        const int joint = n - FOX_FIRST_LIMB, tail = n - FOX_FIRST_JOINT;
        fox->order[n] = n;
        if (tail >= 0 && n < bones) {
            fox->nodes[n] = make_joint(tail, joints);
        } else {
            fox->nodes[n] = *own;
            fox->nodes[n].name = need_text(own->name);
        }
        if (joint < 0 || n == bones) continue;
        const vec3s back = {{0, 0, -FOX_TAIL_LENGTH * (float)tail / (float)joints}};
        const mat4s matrix = tail < 0 ? mat4_from(asset.skins->inverse_bind[joint]) : glms_translate_make(back);
        memcpy(skin->inverse_bind[joint], matrix.raw, sizeof skin->inverse_bind[joint]);
        skin->joints[joint] = n;
    }
    gltf_link_nodes(fox);
}

void fox_create(int level, int joints, struct gltf *fox)
{
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    pthread_once(&once, read_asset);
    *fox = (struct gltf){.path = need_text(asset.path), .id = gltf_new_id(), .mesh_count = 1, .weight_count = 1};
    fox->meshes = need_zeroed(1, sizeof *fox->meshes);
    fox->weights = need_zeroed(1, sizeof *fox->weights);
    copy_mesh(&asset.meshes[level], joints, fox->meshes);
    fox->material_count = asset.material_count;
    fox->materials = copy_of(asset.materials, asset.material_count, sizeof *fox->materials);
    for (int m = 0; m < fox->material_count; m++) fox->materials[m].name = need_text(asset.materials[m].name);
    make_skeleton(fox, joints);
}

void fox_move(const struct limbs *limbs, struct gltf_pose *pose)
{
    float turn[LIMBS][4], size[LIMBS][3];
    limbs_motions(limbs, turn, size);
    for (int l = 0; l < LIMBS; l++) {
        struct gltf_place *place = &pose->place[FOX_FIRST_LIMB + l];
        memcpy(place->rotation, turn[l], sizeof turn[l]);
        memcpy(place->scale, size[l], sizeof size[l]);
    }
    pose->weights[0] = limbs->blink;
}

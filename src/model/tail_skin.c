/// Moves and measures a posed tail, and places its skin.
#include "model/tail_skin.h"
#include "model/creature.h"
#include "model/limbs.h"
#include "model/pose.h"
#include "model/vector.h"
#include <assert.h>
#include <math.h>

void pose_move(struct pose *pose, const double by[3])
{
    for (int n = 0; n < pose->count; n++) {
        for (int k = 0; k < 3; k++) pose->matrix[n][12 + k] += (float)by[k];
    }
}

float pose_length(const struct pose *pose)
{
    const vec3s base = vec3_from(pose->matrix[0] + 12), next = vec3_from(pose->matrix[1] + 12);
    return glms_vec3_distance(base, next) * (float)(pose->count - 1);
}

void pose_bounds(const struct pose *pose, float lo[3], float hi[3])
{
    const float scale = pose_length(pose) / CREATURE_TAIL_LENGTH;
    limbs_bounds(&pose->limbs, lo, hi);
    for (int k = 0; k < 3; k++) {
        lo[k] = pose->matrix[0][12 + k] + scale * lo[k];
        hi[k] = pose->matrix[0][12 + k] + scale * hi[k];
    }
    for (int n = 0; n < pose->count; n++) {
        const float along = CREATURE_TAIL_LENGTH * (float)n / (float)(pose->count - 1);
        const float radius = scale * creature_tail_radius(along);
        for (int k = 0; k < 3; k++) {
            lo[k] = fminf(lo[k], pose->matrix[n][12 + k] - radius);
            hi[k] = fmaxf(hi[k], pose->matrix[n][12 + k] + radius);
        }
    }
}

/// matrix · translation by −along on z, as three rows: takes a point of the straight tail to its place on the posed one.
static void slot_rows(mat4s matrix, float along, float rows[3][4])
{
    glm_translate_z(matrix.raw, -along);
    glm_mat4_transpose(matrix.raw);
    memcpy(rows, matrix.raw, 3 * sizeof *rows);
}

static int slot_of_limb(float limb, int joints) { return limb > 0.0f ? joints + (int)limb : 0; }

int tail_slots(const struct pose *pose, float rows[TAIL_SLOTS][3][4])
{
    const int joints = pose->count - 1;
    const float segment = pose_length(pose) / (float)joints;
    const mat4s base = glms_translate_make(vec3_from(pose->matrix[0] + 12));
    float limbs[LIMBS][16];
    limbs_matrices(&pose->limbs, pose_length(pose) / CREATURE_TAIL_LENGTH, limbs);
    for (int n = 0; n < joints; n++) slot_rows(mat4_from(pose->matrix[n]), (float)n * segment, rows[n + 1]);
    for (int l = 0; l < LIMBS; l++)
        slot_rows(glms_mat4_mul(base, mat4_from(limbs[l])), 0.0f, rows[slot_of_limb((float)l, joints)]);
    return joints + LIMBS;
}

/// The B-spline at a place along the tail: its first slot, which may lie before the base, weights and their slopes by metre.
struct blend {
    int first;
    float weight[4], slope[4];
};

static struct blend blend_at(float z, float segment)
{
    const float along = z / segment - 0.5f, first = floorf(along), t = along - first, s = 1.0f - t;
    const float by_metre = 0.5f / segment;
    return (struct blend){
        (int)first,
        {s * s * s / 6.0f, (4.0f - 3.0f * t * t * (2.0f - t)) / 6.0f, (4.0f - 3.0f * s * s * (2.0f - s)) / 6.0f,
         t * t * t / 6.0f},
        {-s * s * by_metre, t * (3.0f * t - 4.0f) * by_metre, s * (4.0f - 3.0f * s) * by_metre, t * t * by_metre}};
}

static int slot_of(const struct blend *blend, int k, int joints)
{
    const int slot = blend->first + k;
    return slot < 0 ? 0 : slot > joints ? joints : slot;
}

static int add_influence(int count, uint16_t slot[TAIL_INFLUENCES], float weight[TAIL_INFLUENCES], int to, float by)
{
    if (by == 0.0f) return count;
    for (int i = 0; i < count; i++) {
        if (slot[i] != to) continue;
        weight[i] += by;
        return count;
    }
    assert(count < TAIL_INFLUENCES);
    slot[count] = (uint16_t)to;
    weight[count] = by;
    return count + 1;
}

void tail_influences(const struct vertex *vertex, int joints, float segment, uint16_t slot[TAIL_INFLUENCES],
                     float weight[TAIL_INFLUENCES])
{
    const struct blend blend = blend_at(vertex->position[2], segment);
    memset(slot, 0, TAIL_INFLUENCES * sizeof *slot);
    memset(weight, 0, TAIL_INFLUENCES * sizeof *weight);
    int count = 0;
    for (int i = 0; i < 2; i++) {
        const float share = i ? vertex->limb[2] : 1.0f - vertex->limb[2];
        count =
            add_influence(count, slot, weight, slot_of_limb(vertex->limb[i], joints), (1.0f - vertex->bend) * share);
    }
    for (int k = 0; k < 4; k++)
        count = add_influence(count, slot, weight, slot_of(&blend, k, joints), vertex->bend * blend.weight[k]);
}

/// What the joints do at a place along the tail: rows of bind → world, and how they change by metre.
struct bend {
    float z, rows[3][4], change[3][4];
};

static struct bend bend_at(float z, const float rows[TAIL_SLOTS][3][4], int joints, float segment)
{
    struct bend bend = {.z = z};
    const struct blend blend = blend_at(z, segment);
    for (int k = 0; k < 4; k++) {
        const float(*slot)[4] = rows[slot_of(&blend, k, joints)];
        for (int r = 0; r < 3; r++) {
            for (int c = 0; c < 4; c++) {
                bend.rows[r][c] += blend.weight[k] * slot[r][c];
                bend.change[r][c] += blend.slope[k] * slot[r][c];
            }
        }
    }
    return bend;
}

/// A vertex's own rows of bind → world, and how the weights' change along the tail moves it.
struct skinned {
    float rows[3][4], stretch[3];
};

static struct skinned skinned_at(const struct vertex *vertex, const float bind[4], const float rows[TAIL_SLOTS][3][4],
                                 int joints, const struct bend *bend)
{
    struct skinned own = {0};
    const float(*from)[4] = rows[slot_of_limb(vertex->limb[0], joints)];
    const float(*to)[4] = rows[slot_of_limb(vertex->limb[1], joints)];
    for (int r = 0; r < 3; r++) {
        for (int c = 0; c < 4; c++) own.rows[r][c] = from[r][c] + vertex->limb[2] * (to[r][c] - from[r][c]);
    }
    if (vertex->bend <= 0.0f) return own;
    for (int r = 0; r < 3; r++) {
        for (int c = 0; c < 4; c++) {
            own.rows[r][c] += vertex->bend * (bend->rows[r][c] - own.rows[r][c]);
            own.stretch[r] += vertex->bend * bend->change[r][c] * bind[c];
        }
    }
    return own;
}

/// Normals go by the cofactors of the deformation's gradient.
static void turn_normal(const struct skinned *own, const float normal[3], float out[3])
{
    vec3s column[3], sum = glms_vec3_zero();
    for (int c = 0; c < 3; c++) column[c] = (vec3s){.raw = {own->rows[0][c], own->rows[1][c], own->rows[2][c]}};
    column[2] = glms_vec3_add(column[2], vec3_from(own->stretch));
    for (int c = 0; c < 3; c++) {
        const vec3s cofactor = glms_vec3_cross(column[(c + 1) % 3], column[(c + 2) % 3]);
        sum = glms_vec3_add(sum, glms_vec3_scale(cofactor, normal[c]));
    }
    sum = glms_vec3_divs(sum, fmaxf(glms_vec3_norm(sum), 1e-9f));
    glm_vec3_copy(sum.raw, out);
}

void tail_skin(const struct pose *pose, const struct mesh *mesh, float (*positions)[3], float (*normals)[3])
{
    float rows[TAIL_SLOTS][3][4];
    const int joints = pose->count - 1;
    tail_slots(pose, rows);
    const float length = pose_length(pose), scale = length / CREATURE_TAIL_LENGTH, segment = length / (float)joints;
    struct bend bend = {.z = INFINITY};
    for (int i = 0; i < mesh->vertex_count; i++) {
        const struct vertex *v = &mesh->vertices[i];
        const float bind[4] = {scale * v->position[0], scale * v->position[1], scale * v->position[2], 1.0f};
        // Vertices of a ring follow each other.
        if (v->bend > 0.0f && bind[2] != bend.z) bend = bend_at(bind[2], (const float(*)[3][4])rows, joints, segment);
        const struct skinned own = skinned_at(v, bind, (const float(*)[3][4])rows, joints, &bend);
        for (int r = 0; r < 3; r++) {
            positions[i][r] = 0.0f;
            for (int c = 0; c < 4; c++) positions[i][r] += own.rows[r][c] * bind[c];
        }
        if (normals) turn_normal(&own, v->normal, normals[i]);
    }
}

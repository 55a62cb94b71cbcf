/// Vertices of glTF characters: v′ = Σ wⱼ Jⱼ (v + Σ wₜ Δₜ v), and normals by the cofactors of the same matrix.
#include "model/gltf.h"
#include "model/vector.h"

/// v + Σ w Δ; `targets` are those of positions or, from the same array, of normals.
static void morph(const struct gltf_part *part, int target_count, const float *weights, bool normals, float (*out)[3])
{
    memcpy(out, normals ? part->normal : part->position, (size_t)part->vertex_count * sizeof *out);
    for (int t = 0; t < target_count; t++) {
        const float(*by)[3] = normals ? part->targets[t].normal : part->targets[t].position;
        float w = weights[t];
        if (!by || w == 0) continue;
        for (int i = 0; i < part->vertex_count; i++)
            for (int k = 0; k < 3; k++) out[i][k] += w * by[i][k];
    }
}

static void blend(const float (*joints)[16], const uint16_t *joint, const float *weights, float m[16])
{
    memset(m, 0, 16 * sizeof *m);
    for (int k = 0; k < GLTF_INFLUENCES; k++) {
        if (weights[k] == 0) continue;
        const float *one = joints[joint[k]], w = weights[k];
        for (int n = 0; n < 16; n++) m[n] += w * one[n];
    }
}

static void move(const float m[16], float v[3])
{
    const float x = v[0], y = v[1], z = v[2];
    for (int k = 0; k < 3; k++) v[k] = m[k] * x + m[4 + k] * y + m[8 + k] * z + m[12 + k];
}

/// Turns a normal whatever the scale; a mirror turns it round, with the triangles.
static void turn(const float m[16], float normal[3])
{
    const vec3s x = vec3_from(m), y = vec3_from(m + 4), z = vec3_from(m + 8), yz = glms_vec3_cross(y, z);
    vec3s sum = glms_vec3_scale(yz, normal[0]);
    sum = glms_vec3_add(sum, glms_vec3_scale(glms_vec3_cross(z, x), normal[1]));
    sum = glms_vec3_add(sum, glms_vec3_scale(glms_vec3_cross(x, y), normal[2]));
    float length = glms_vec3_norm(sum);
    if (length > 0) sum = glms_vec3_divs(sum, glms_vec3_dot(x, yz) < 0 ? -length : length);
    glm_vec3_copy(sum.raw, normal);
}

void gltf_pose_vertices(const struct gltf *gltf, const struct gltf_pose *pose, int node, float (*positions)[3],
                        float (*normals)[3])
{
    const struct gltf_node *shown = &gltf->nodes[node];
    if (shown->mesh < 0) return;
    const struct gltf_mesh *mesh = &gltf->meshes[shown->mesh];
    const float *weights = pose->weights + shown->first_weight;
    const float(*joints)[16] = shown->skin >= 0 ? pose->joints + gltf->skins[shown->skin].first_joint : NULL;
    for (int p = 0; p < mesh->part_count; p++) {
        const struct gltf_part *part = &mesh->parts[p];
        bool skinned = joints && part->joints;
        morph(part, mesh->target_count, weights, false, positions);
        if (normals) morph(part, mesh->target_count, weights, true, normals);
        float m[16];
        memcpy(m, pose->world[node], sizeof m);
        for (int i = 0; i < part->vertex_count; i++) {
            if (skinned) blend(joints, part->joints[i], part->weights[i], m);
            move(m, positions[i]);
            if (normals) turn(m, normals[i]);
        }
        positions += part->vertex_count;
        if (normals) normals += part->vertex_count;
    }
}

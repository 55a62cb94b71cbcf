/// Finds the outlines of imported characters.
#include "draw/model_skirt.h"
#include "base/need.h"
#include "model/triangle_neighbours.h"
#include "model/vector.h"
#include <stdlib.h>

static int index_count(const struct gltf *gltf, int node)
{
    int count = 0;
    if (gltf->nodes[node].mesh < 0) return 0;
    const struct gltf_mesh *mesh = &gltf->meshes[gltf->nodes[node].mesh];
    for (int p = 0; p < mesh->part_count; p++) count += mesh->parts[p].index_count;
    return count;
}

/// False where a mesh that many nodes show is too much: a small file can claim any number of triangles.
static bool allocate(struct model_skirt *skirt, const struct gltf *gltf)
{
    const size_t nodes = (size_t)gltf->node_count + 1;
    size_t vertices = 1, indices = 1;
    for (int n = 0; n < gltf->node_count; n++) {
        vertices += (size_t)gltf_vertex_count(gltf, n);
        indices += (size_t)index_count(gltf, n);
    }
    *skirt = (struct model_skirt){0};
    if (!need_has_room(vertices * 2 * sizeof *skirt->place + indices * 8 * sizeof *skirt->neighbours)) return false;
    *skirt = (struct model_skirt){
        need(indices, sizeof *skirt->indices),         need(indices, sizeof *skirt->neighbours),
        need(vertices, sizeof *skirt->place),          need(vertices, sizeof *skirt->normal),
        need(indices, sizeof *skirt->front),           need_zeroed(nodes, sizeof *skirt->first_vertex),
        need_zeroed(nodes, sizeof *skirt->first_index)};
    return true;
}

/// Fills a node's part of the arrays, from its mesh at rest.
static void add_node(const struct model_skirt *skirt, uint32_t *look, const struct gltf *gltf, int node)
{
    const struct gltf_mesh *mesh = &gltf->meshes[gltf->nodes[node].mesh];
    const int first = skirt->first_index[node], count = index_count(gltf, node);
    static const float white[4] = {1, 1, 1, 1};
    uint32_t vertex = 0, *indices = skirt->indices + first;
    int index = 0;
    for (int p = 0; p < mesh->part_count; p++) {
        const struct gltf_part *part = &mesh->parts[p];
        memcpy(skirt->place + vertex, part->position, (size_t)part->vertex_count * sizeof *skirt->place);
        for (int i = 0; i < part->index_count; i++, index++) {
            const uint32_t own = part->indices[i];
            indices[index] = vertex + own;
            look[index] = neighbours_look(part->material, part->color ? part->color[own] : white);
        }
        vertex += (uint32_t)part->vertex_count;
    }
    const float(*place)[3] = (const float(*)[3])skirt->place;
    neighbours_find(place, (int)vertex, indices, count, skirt->neighbours + first);
    neighbours_cut(place, indices, look, count, skirt->neighbours + first);
}

void model_skirt_create(struct model_skirt *skirt, const struct gltf *gltf)
{
    if (!allocate(skirt, gltf)) return;
    for (int n = 0; n < gltf->node_count; n++) {
        skirt->first_vertex[n + 1] = skirt->first_vertex[n] + gltf_vertex_count(gltf, n);
        skirt->first_index[n + 1] = skirt->first_index[n] + index_count(gltf, n);
    }
    uint32_t *look = need((size_t)skirt->first_index[gltf->node_count] + 1, sizeof *look);
    for (int n = 0; n < gltf->node_count; n++) {
        if (gltf->nodes[n].mesh >= 0) add_node(skirt, look, gltf, n);
    }
    free(look);
}

void model_skirt_free(struct model_skirt *skirt)
{
    free(skirt->indices);
    free(skirt->neighbours);
    free(skirt->place);
    free(skirt->normal);
    free(skirt->front);
    free(skirt->first_vertex);
    free(skirt->first_index);
    *skirt = (struct model_skirt){0};
}

bool model_is_mirrored(const struct gltf *gltf, const struct gltf_pose *pose, int node)
{
    return gltf->nodes[node].skin < 0 && glms_mat4_det(mat4_from(pose->world[node])) < 0.0f;
}

struct skirt_mesh model_skirt_pose(const struct model_skirt *skirt, const struct gltf *gltf,
                                   const struct gltf_pose *pose, int node, const float root[16], const float eye[3])
{
    const int first = skirt->first_index[node], vertices = gltf_vertex_count(gltf, node);
    float(*place)[3] = skirt->place + skirt->first_vertex[node],
    (*normal)[3] = skirt->normal + skirt->first_vertex[node];
    mat4s to_world = mat4_from(root);
    const struct skirt_mesh mesh = {.indices = skirt->indices + first,
                                    .neighbours = skirt->neighbours + first,
                                    .place = (const float(*)[3])place,
                                    .front = skirt->front + first / 3,
                                    .mirrored = model_is_mirrored(gltf, pose, node)};
    gltf_pose_vertices(gltf, pose, node, place, normal);
    for (int v = 0; v < vertices; v++) {
        glm_mat4_mulv3(to_world.raw, place[v], 1.0f, place[v]);
        glm_mat4_mulv3(to_world.raw, normal[v], 0.0f, normal[v]);
    }
    skirt_face(&mesh, 0, index_count(gltf, node), eye);
    return mesh;
}

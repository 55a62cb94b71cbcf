/// Joins the meshes of imported characters, and poses them.
#include "draw/model_surface.h"
#include "base/need.h"
#include "model/adjacency.h"
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
static bool allocate(struct model_surface *surface, const struct gltf *gltf)
{
    const size_t nodes = (size_t)gltf->node_count + 1;
    size_t vertices = 1, indices = 1;
    for (int n = 0; n < gltf->node_count; n++) {
        vertices += (size_t)gltf_vertex_count(gltf, n);
        indices += (size_t)index_count(gltf, n);
    }
    *surface = (struct model_surface){0};
    if (!need_has_room(vertices * 2 * sizeof *surface->place + indices * 8 * sizeof *surface->neighbours))
        return false;
    *surface = (struct model_surface){.indices = need(indices, sizeof *surface->indices),
                                      .neighbours = need(indices, sizeof *surface->neighbours),
                                      .place = need(vertices, sizeof *surface->place),
                                      .normal = need(vertices, sizeof *surface->normal),
                                      .front = need(indices, sizeof *surface->front),
                                      .first_vertex = need_zeroed(nodes, sizeof *surface->first_vertex),
                                      .first_index = need_zeroed(nodes, sizeof *surface->first_index),
                                      .vertex_count = (int)vertices - 1,
                                      .index_count = (int)indices - 1};
    return true;
}

/// Fills a node's part of the arrays, from its mesh at rest.
static void add_node(const struct model_surface *surface, uint32_t *look, const struct gltf *gltf, int node)
{
    static const float white[4] = {1, 1, 1, 1};
    const struct gltf_mesh *mesh = &gltf->meshes[gltf->nodes[node].mesh];
    const int first = surface->first_index[node], count = index_count(gltf, node);
    uint32_t vertex = (uint32_t)surface->first_vertex[node];
    int index = first;
    for (int p = 0; p < mesh->part_count; p++) {
        const struct gltf_part *part = &mesh->parts[p];
        memcpy(surface->place + vertex, part->position, (size_t)part->vertex_count * sizeof *surface->place);
        for (int i = 0; i < part->index_count; i++, index++) {
            const uint32_t own = part->indices[i];
            surface->indices[index] = vertex + own;
            look[index] = part->mark ? 0 : neighbours_look(part->material, part->color ? part->color[own] : white);
        }
        vertex += (uint32_t)part->vertex_count;
    }
    const float(*place)[3] = (const float(*)[3])surface->place;
    neighbours_find(place, (int)vertex, surface->indices + first, count, surface->neighbours + first);
    neighbours_cut(place, surface->indices + first, look + first, count, surface->neighbours + first);
    for (int i = first; i < index; i++) surface->neighbours[i] += surface->neighbours[i] >= 0 ? first / 3 : 0;
}

void model_surface_create(struct model_surface *surface, const struct gltf *gltf)
{
    if (!allocate(surface, gltf)) return;
    for (int n = 0; n < gltf->node_count; n++) {
        surface->first_vertex[n + 1] = surface->first_vertex[n] + gltf_vertex_count(gltf, n);
        surface->first_index[n + 1] = surface->first_index[n] + index_count(gltf, n);
    }
    uint32_t *look = need((size_t)surface->index_count + 1, sizeof *look);
    for (int n = 0; n < gltf->node_count; n++) {
        if (gltf->nodes[n].mesh >= 0) add_node(surface, look, gltf, n);
    }
    free(look);
}

void model_surface_free(struct model_surface *surface)
{
    free(surface->indices);
    free(surface->neighbours);
    free(surface->place);
    free(surface->normal);
    free(surface->front);
    free(surface->first_vertex);
    free(surface->first_index);
    *surface = (struct model_surface){0};
}

struct skirt_mesh model_surface_mesh(const struct model_surface *surface, const struct gltf *gltf,
                                     const struct gltf_pose *pose, int node)
{
    return (struct skirt_mesh){.indices = surface->indices,
                               .neighbours = surface->neighbours,
                               .place = (const float(*)[3])surface->place,
                               .front = surface->front,
                               .mirrored =
                                   gltf->nodes[node].skin < 0 && glms_mat4_det(mat4_from(pose->world[node])) < 0.0f};
}

void model_surface_pose(const struct model_surface *surface, const struct gltf *gltf, const struct gltf_pose *pose,
                        const float root[16], const float eye[3])
{
    mat4s to_world = mat4_from(root);
    for (int n = 0; surface->indices && n < gltf->node_count; n++) {
        const struct skirt_mesh mesh = model_surface_mesh(surface, gltf, pose, n);
        const int first = surface->first_vertex[n], end = surface->first_vertex[n + 1];
        gltf_pose_vertices(gltf, pose, n, surface->place + first, surface->normal + first);
        for (int v = first; v < end; v++) {
            glm_mat4_mulv3(to_world.raw, surface->place[v], 1.0f, surface->place[v]);
            glm_mat4_mulv3(to_world.raw, surface->normal[v], 0.0f, surface->normal[v]);
        }
        skirt_face(&mesh, surface->first_index[n], surface->first_index[n + 1], eye);
    }
}

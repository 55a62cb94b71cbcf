/// Finds outlines, which way skirts hang, and the outlines of imported characters.
#include "draw/skirt.h"
#include "base/need.h"
#include "model/adjacency.h"
#include "model/vector.h"
#include <stdlib.h>

/// Whether a triangle faces the eye, or nearly: the rasteriser, which rounds, has the last word.
static bool is_front(const float a[3], const float b[3], const float c[3], const float eye[3], float sign)
{
    static const float slack = 1e-6f; // the square of a cosine
    const vec3s normal = triangle_normal(a, b, c);
    const vec3s to_eye = glms_vec3_sub(vec3_from(eye), vec3_from(a));
    const float facing = sign * glms_vec3_dot(normal, to_eye);
    return facing >= 0.0f || facing * facing < slack * glms_vec3_norm2(normal) * glms_vec3_norm2(to_eye);
}

void skirt_face(const struct skirt_mesh *mesh, int first, int end, const float eye[3])
{
    const float(*place)[3] = mesh->place;
    for (int i = first; i < end; i += 3) {
        const uint32_t *corner = mesh->indices + i;
        mesh->front[i / 3] =
            is_front(place[corner[0]], place[corner[1]], place[corner[2]], eye, mesh->mirrored ? -1.0f : 1.0f);
    }
}

int skirt_next(const struct skirt_mesh *mesh, int first, int end, bool both_sides)
{
    for (int i = first; i < end; i++) {
        const int other = mesh->neighbours[i];
        const bool front = mesh->front[i / 3];
        if (other < 0 ? front || both_sides : front && !mesh->front[other]) return i;
    }
    return end;
}

/// Along the vertex's normal, so that the skirts of edges that follow each other meet; but off the edge, where the normal does not point away from it.
static vec3s outwards(vec3s ray, const float normal[3], vec3s off_edge)
{
    const float depth = glms_vec3_dot(vec3_from(normal), ray) / glms_vec3_norm2(ray);
    const vec3s out = glms_vec3_normalize(glms_vec3_sub(vec3_from(normal), glms_vec3_scale(ray, depth)));
    return glms_vec3_dot(out, off_edge) < 0.3f ? off_edge : out;
}

void skirt_out(const struct skirt_mesh *mesh, int corner, const float normal[2][3], const float eye[3], float pixel,
               float out[2][3])
{
    const float *end[2] = {mesh->place[mesh->indices[corner]], mesh->place[mesh->indices[next_corner(corner)]]};
    const vec3s edge = glms_vec3_sub(vec3_from(end[1]), vec3_from(end[0]));
    const float side =
        mesh->front[corner / 3] == mesh->mirrored ? -1.0f : 1.0f; // the triangle lies to the left of its edge
    for (int e = 0; e < 2; e++) {
        const vec3s ray = glms_vec3_sub(vec3_from(end[e]), vec3_from(eye));
        const vec3s off_edge = glms_vec3_scale(glms_vec3_normalize(glms_vec3_cross(ray, edge)), side);
        vec3s step = mesh->neighbours[corner] < 0 ? off_edge : outwards(ray, normal[e], off_edge);
        step = glms_vec3_scale(step, pixel * glms_vec3_norm(ray));
        memcpy(out[e], step.raw, sizeof out[e]);
    }
}

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

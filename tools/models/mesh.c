/// Grows and frees triangle meshes, and colours the fox's coat.
#include "models/mesh.h"
#include "base/need.h"
#include "base/png.h"
#include "model/fox.h"
#include "model/vector.h"
#include <stdlib.h>

/// Makes room for `more` elements of `size` bytes.
static void *grow(void *block, int *capacity, int count, int more, size_t size)
{
    if (count <= *capacity - more) return block;
    *capacity = *capacity * 2 + 1024;
    return need_more(block, (size_t)*capacity, size);
}

uint32_t mesh_vertex(struct mesh *mesh, const struct vertex *vertex)
{
    mesh->vertices = grow(mesh->vertices, &mesh->vertex_capacity, mesh->vertex_count, 1, sizeof *vertex);
    mesh->vertices[mesh->vertex_count] = *vertex;
    return (uint32_t)mesh->vertex_count++;
}

void mesh_triangle(struct mesh *mesh, uint32_t a, uint32_t b, uint32_t c)
{
    mesh->indices = grow(mesh->indices, &mesh->index_capacity, mesh->index_count, 3, sizeof a);
    uint32_t *triangle = mesh->indices + mesh->index_count;
    triangle[0] = a, triangle[1] = b, triangle[2] = c;
    mesh->index_count += 3;
}

void mesh_free(struct mesh *mesh)
{
    free(mesh->vertices);
    free(mesh->indices);
    *mesh = (struct mesh){0};
}

bool model_write(const char *path, struct gltf_file *file, json_t *root, struct error *error)
{
    if (json_object_update_missing(root, file->root) != 0) file->without_memory = true;
    json_decref(file->root);
    file->root = root;
    const bool written = gltf_file_save(file, path, error);
    gltf_file_free(file);
    return written;
}

#define EDGE 0.025f /* metres: half the width of a marking's edge; a narrower one costs triangles */

void coat_linear(uint32_t srgb, float rgb[3])
{
    for (int k = 0; k < 3; k++) rgb[k] = srgb_to_linear((float)(srgb >> (16 - 8 * k) & 0xFF) / 255.0f);
}

void coat_mix(float rgb[3], uint32_t to, float amount)
{
    float other[3];
    coat_linear(to, other);
    glm_vec3_lerp(rgb, other, amount, rgb);
}

void coat_marked(const float mark[MARKS], float rgb[3])
{
    coat_linear(COAT_FUR, rgb);
    coat_mix(rgb, COAT_BAND, mark[MARK_BROWN]);
    coat_mix(rgb, COAT_TIP, glm_smoothstep(-EDGE, EDGE, mark[MARK_WHITE]));
    coat_mix(rgb, COAT_DARK, glm_smoothstep(-EDGE, EDGE, mark[MARK_DARK]));
}

void coat_tail(float z, float up, float mark[MARKS])
{
    const float u = z / FOX_TAIL_LENGTH;
    mark[MARK_WHITE] = z - 0.79f * FOX_TAIL_LENGTH;
    mark[MARK_DARK] = -1.0f;
    mark[MARK_BROWN] = glm_smoothstep(0.45f, 0.78f, u) * (0.45f + 0.2f * up);
}

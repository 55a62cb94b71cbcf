/// Grows and frees triangle meshes.
#include "model/mesh.h"
#include "base/need.h"
#include <stdlib.h>

/// Room for `more` further elements of `size` bytes.
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

/// Grows and frees triangle meshes.
#include "model/mesh.h"
#include <limits.h>
#include <stdlib.h>

/// Room for `more` further elements of `size` bytes; the old block stays valid where it fails.
static bool grow(void **block, int *capacity, int count, int more, size_t size)
{
    if (count <= *capacity - more) return true;
    if (*capacity > INT_MAX / 2 - 1024) return false;
    int wanted = *capacity * 2 + 1024;
    void *larger = realloc(*block, (size_t)wanted * size);
    if (!larger) return false;
    *block = larger;
    *capacity = wanted;
    return true;
}

uint32_t mesh_vertex(struct mesh *mesh, const struct vertex *vertex)
{
    void *block = mesh->vertices;
    if (!grow(&block, &mesh->vertex_capacity, mesh->vertex_count, 1, sizeof *vertex)) {
        mesh->failed = true;
        return 0;
    }
    mesh->vertices = block;
    mesh->vertices[mesh->vertex_count] = *vertex;
    return (uint32_t)mesh->vertex_count++;
}

void mesh_triangle(struct mesh *mesh, uint32_t a, uint32_t b, uint32_t c)
{
    void *block = mesh->indices;
    if (!grow(&block, &mesh->index_capacity, mesh->index_count, 3, sizeof a)) {
        mesh->failed = true;
        return;
    }
    mesh->indices = block;
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

/// Which vertices of a triangle mesh are joined by edges.
#ifndef MODEL_ADJACENCY_H
#define MODEL_ADJACENCY_H

#include <stdbool.h>
#include <stdint.h>

/// The neighbours of vertex i are other[first[i]] … other[first[i + 1] − 1], in ascending order. Vertices at the very same place
/// (the seams of a mesh with several normals or colours at a corner) count as neighbours too, in a chain. Those with the same normal besides
/// (seams of texture coordinates) have their neighbours in common.
struct adjacency {
    int *first;
    uint32_t *other;
};

void adjacency_create(struct adjacency *adjacency, const float (*position)[3], const float (*normal)[3],
                      int vertex_count, const uint32_t *indices, int index_count);

/// Leaves an empty one, all zero.
void adjacency_free(struct adjacency *adjacency);

/// A vertex, by its place.
struct spot {
    float position[3];
    uint32_t vertex;
};

/// Lists all vertices, sorted by place, then by number.
void spots_sort(const float (*position)[3], int count, struct spot *spots);

/// Whether two vertices are at the very same place.
bool spots_meet(const struct spot *a, const struct spot *b);

#endif

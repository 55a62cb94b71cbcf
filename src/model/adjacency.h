/// Which vertices of a triangle mesh are joined by edges, and which triangle lies on the other side of each edge.
#ifndef MODEL_ADJACENCY_H
#define MODEL_ADJACENCY_H

#include "base/need.h"
#include <stdbool.h>
#include <stdint.h>

/// The neighbours of vertex i are other[first[i]] … other[first[i + 1] − 1], in ascending order. Vertices at the very same place
/// (the seams of a mesh with several normals or colours at a corner) count as neighbours too, in a chain. Those with the same normal besides
/// (seams of texture coordinates) have their neighbours in common.
struct adjacency {
    int *first;
    uint32_t *other;
};

/// Its memory is the pool's.
struct adjacency adjacency_create(struct pool *pool, const float (*position)[3], const float (*normal)[3],
                                  int vertex_count, const uint32_t *indices, int index_count);

/// A vertex, by its place.
struct spot {
    float position[3];
    uint32_t vertex;
};

/// Lists all vertices, sorted by place, then by number.
void spots_sort(const float (*position)[3], int count, struct spot *spots);

/// Whether two vertices are at the very same place.
bool spots_meet(const struct spot *a, const struct spot *b);

/// Of each vertex: the first one at the very same place.
void spots_first(const struct spot *spots, int count, uint32_t *first);

// The triangle across each edge.

enum { NEIGHBOUR_NONE = -1, NEIGHBOUR_CUT = -2 }; ///< the mesh ends; its look changes

/// Per index, for the edge from it to its triangle's next one: the triangle across, or NEIGHBOUR_NONE. Vertices at the same place, except for
/// rounding, are one. If sheets lie back to back, a triangle's neighbour is in its own sheet; at the sheet's end it is its own back.
void neighbours_find(const float (*position)[3], int vertex_count, const uint32_t *indices, int index_count,
                     int *neighbours);

/// Writes NEIGHBOUR_CUT, for the later of two triangles, at edges where the corners' look changes abruptly; `look` is per index.
void neighbours_cut(const float (*position)[3], const uint32_t *indices, const uint32_t *look, int index_count,
                    int *neighbours);

/// The look of a corner with a material and colour, for neighbours_cut(): hardly distinguishable colours may look the same.
uint32_t neighbours_look(int material, const float color[3]);

/// The corner after a corner in its triangle.
static inline int next_corner(int i) { return i % 3 == 2 ? i - 2 : i + 1; }

#endif

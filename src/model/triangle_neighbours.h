/// Which triangle lies on the other side of each edge.
#ifndef MODEL_TRIANGLE_NEIGHBOURS_H
#define MODEL_TRIANGLE_NEIGHBOURS_H

#include <stdbool.h>
#include <stdint.h>

enum { NEIGHBOUR_NONE = -1, NEIGHBOUR_CUT = -2 }; ///< the mesh ends; what it looks like does

/// Per index, of the edge from it to its triangle's next one: the triangle on its other side, or NEIGHBOUR_NONE. Vertices at the
/// same place, but for rounding, are one. Where sheets lie back to back, a triangle's neighbour is the next of its own sheet; its own back only where that ends.
void neighbours_find(const float (*position)[3], int vertex_count, const uint32_t *indices, int index_count,
                     int *neighbours);

/// Writes NEIGHBOUR_CUT, for the later of two triangles, at edges where what corners look like changes at once; `look` is of each index.
void neighbours_cut(const float (*position)[3], const uint32_t *indices, const uint32_t *look, int index_count,
                    int *neighbours);

/// What a corner of a material and a colour looks like, to neighbours_cut(): colours that are hardly told apart may look the same.
uint32_t neighbours_look(int material, const float color[3]);

/// The corner after a corner in its triangle.
static inline int next_corner(int i) { return i % 3 == 2 ? i - 2 : i + 1; }

#endif

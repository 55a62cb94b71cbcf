/// Distances along a figure's surface from a few spots on it, up to a limit: a brush must not reach what is near only
/// through the air.
///
/// Shortest paths along edges (Dijkstra) zigzag, and are up to 16 % too long on a regular mesh; straight lines are too short
/// where the surface bends. The distance is the larger of the straight line and the path along edges shortened by 16 %: circles
/// on flat surfaces stay round.
#ifndef MODEL_REACH_H
#define MODEL_REACH_H

#include "model/figure.h"

enum { REACH_MAX_SPOTS = 8 }; ///< at once

/// A point in a triangle.
struct surface_spot {
    uint32_t corner[3];
    float weight[3]; ///< their sum is 1
};

struct reach {
    float *distance; ///< by vertex, metres at rest; INFINITY beyond the limit
    int *vertices;   ///< those within it
    int count, capacity;
    // private
    float *along; ///< shortest way along edges so far, INFINITY: none
    int *heap;    ///< vertices on the way, a binary heap by `along`
    int *place;   ///< of a vertex in it
    int heap_count;
};

/// For a figure of so many vertices; its memory is the pool's.
void reach_create(struct reach *reach, struct pool *pool, int vertices);

/// Finds distances from the nearest of the spots. Allocates nothing.
void reach_find(struct reach *reach, const struct figure *figure, const struct surface_spot *spots, int count,
                float limit);

// Where a ray hits what is posed.

/// Distance along the ray to the front of a triangle, or a negative number; `uv` are the weights of the second and third corner.
float pick_triangle(const float *const corner[3], const float eye[3], const float direction[3], float uv[2]);

/// The nearest triangle that faces the eye; false if there is none. `direction` need not be of unit length.
bool pick_ray(const struct figure *figure, const float (*posed)[3], const float eye[3], const float direction[3],
              struct surface_spot *spot);

#endif

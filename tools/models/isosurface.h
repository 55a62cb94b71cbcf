/// Solids of round cones (hulls of two balls) that blend into each other, each with its own colour, and triangles for any distance
/// function.
#ifndef MODELS_ISOSURFACE_H
#define MODELS_ISOSURFACE_H

#include "models/mesh.h"
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/// Distance to a solid: negative inside, never larger than the true distance, and close to it near the surface.
struct solid {
    float (*distance)(const float p[3]);
    /// Sets colour and bend of a vertex, after its position and normal.
    void (*paint)(struct vertex *vertex);
};

/// Appends the surface in the box lo … hi, which must contain it, with edges about `cell` metres long. Surface nets: a vertex per grid cell
/// that the surface passes through, a quad per grid edge that it crosses. Vertices lie on the surface; normals are the distance's gradient.
void isosurface(const struct solid *solid, const float lo[3], const float hi[3], float cell, struct mesh *mesh);

/// Moves a vertex less than `cell` metres off onto the surface, and sets its normal and colour.
void surface_place(const struct solid *solid, float cell, struct vertex *vertex);

/// A round cone, metres; mirrored parts are given for x > 0.
struct part {
    float a[3], b[3];
    float radius_a, radius_b;
    float blend;    ///< width of the fillet to the parts before it
    uint32_t color; ///< sRGB 0xRRGGBB
    bool mirror;
};

/// Smooth minimum of two distances (polynomial, with a fillet `blend` wide); colours mix in the same measure, into
/// `rgb`, where that is not NULL.
float parts_union(float old, float added, float blend, float rgb[3], const float added_rgb[3]);

/// Adds the parts of a table, in their order, to a solid at distance `distance` (1e3: none yet): returns the distance of
/// all of them from `p`, and in `rgb`, if not NULL, the linear colour there.
float parts_add(const struct part *table, size_t count, const float p[3], float distance, float rgb[3]);

/// Halves every edge that stays more than `tolerance` metres away from the solid, or whose ends have very different
/// colours, in up to `rounds` rounds; new vertices lie on the surface and no gaps open. Works on the triangles from index `first_index` on, which must not
/// share edges with earlier ones.
void refine(const struct solid *solid, float tolerance, int rounds, int first_index, struct mesh *mesh);

#endif

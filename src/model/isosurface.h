/// Turns a solid given by its distance function into triangles by surface nets: one vertex per grid cell that
/// the surface passes through, one quad per edge that it crosses.
#ifndef MODEL_ISOSURFACE_H
#define MODEL_ISOSURFACE_H

#include "model/mesh.h"

/// A solid: negative inside; never larger than the true distance, and close to it near the surface.
struct solid {
    float (*distance)(const float p[3]);
    /// Colour and bend of a vertex whose position and normal are set.
    void (*paint)(struct vertex *vertex);
};

/// Appends the surface inside the box lo … hi, which must hold it whole, with edges about `cell` metres long.
/// Vertices lie on the surface; normals are the distance's gradient.
void isosurface(const struct solid *solid, const float lo[3], const float hi[3], float cell, struct mesh *mesh);

/// Moves a vertex less than `cell` metres off onto the surface, and sets its normal and colour.
void surface_place(const struct solid *solid, float cell, struct vertex *vertex);

#endif

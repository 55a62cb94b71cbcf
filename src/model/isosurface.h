/// Turns a solid that is given by its distance function into triangles ("surface nets": one vertex a grid cell that
/// the surface passes through, one quad an edge that it crosses).
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
/// Vertices lie on the surface; normals are the distance's gradient. mesh->failed where memory is short.
void isosurface(const struct solid *solid, const float lo[3], const float hi[3], float cell, struct mesh *mesh);

/// Brings a vertex that is less than `cell` metres off onto the surface, and gives it the surface's normal and coat.
void surface_place(const struct solid *solid, float cell, struct vertex *vertex);

#endif

/// Splits a solid's triangles where they are too flat for its curves or too large for its colours.
#ifndef MODEL_REFINE_H
#define MODEL_REFINE_H

#include "model/isosurface.h"

/// Halves every edge that stays more than `tolerance` metres away from the solid, or whose ends have very different
/// colours, in up to `rounds` rounds; new vertices lie on the surface and no gaps open. Works on the triangles from index `first_index` on, which must not
/// share edges with earlier ones.
void refine(const struct solid *solid, float tolerance, int rounds, int first_index, struct mesh *mesh);

#endif

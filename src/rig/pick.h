/// Finds where a ray hits what is posed.
#ifndef RIG_PICK_H
#define RIG_PICK_H

#include "model/figure.h"
#include "model/reach.h"

/// Distance along the ray to the front of a triangle, or a negative number; `uv` are the weights of the second and third corner.
float pick_triangle(const float *const corner[3], const float eye[3], const float direction[3], float uv[2]);

/// The nearest triangle that faces the eye; false if there is none. `direction` need not be of unit length.
bool pick_ray(const struct figure *figure, const float (*posed)[3], const float eye[3], const float direction[3],
              struct surface_spot *spot);

#endif

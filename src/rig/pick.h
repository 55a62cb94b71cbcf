/// Finds where a ray hits a posed figure.
#ifndef RIG_PICK_H
#define RIG_PICK_H

#include "model/figure.h"
#include "model/reach.h"

/// The nearest triangle that faces the eye; false if there is none. `direction` need not be of unit length.
bool pick_ray(const struct figure *figure, const float (*posed)[3], const float eye[3], const float direction[3],
              struct surface_spot *spot);

#endif

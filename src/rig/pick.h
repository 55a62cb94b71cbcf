/// Finds where a ray hits a posed figure.
#ifndef RIG_PICK_H
#define RIG_PICK_H

#include "model/morph.h"
#include "model/reach.h"

/// Positions of all vertices in the world: the posed figure standing on the ground at `position`, as the stage draws it.
void pick_pose(const struct figure *figure, const struct morph *morph, const float position[3], float (*posed)[3]);

/// The nearest triangle that faces the eye; false if there is none. `direction` need not be of unit length.
bool pick_ray(const struct figure *figure, const float (*posed)[3], const float eye[3], const float direction[3],
              struct surface_spot *spot);

#endif

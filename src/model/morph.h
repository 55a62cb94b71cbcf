/// A soft character in motion: the sum of its complex normal coordinates, each turned and scaled by a weight.
///
///     D(j) = Re(Σ_k z_k Ñ_{k,j})
#ifndef MODEL_MORPH_H
#define MODEL_MORPH_H

#include "model/figure.h"

enum { MORPH_MAX_COORDINATES = 4 };

/// The weights of a figure's coordinates at one time.
struct morph {
    int count;
    int coordinate[MORPH_MAX_COORDINATES];  ///< index in the figure
    float weight[MORPH_MAX_COORDINATES][2]; ///< z: real and imaginary part
};

/// The position and unit normal of a vertex, as the stage's vertex shader computes them. `normal` may be NULL.
void morph_vertex(const struct figure *figure, const struct morph *morph, int vertex, float position[3],
                  float normal[3]);

/// Positions of all vertices in the world: the posed figure standing on the ground at `position`, as the stage draws it.
void morph_places(const struct figure *figure, const struct morph *morph, const float position[3],
                  float (*places)[3]);

/// The box around the posed figure, relative to the rig's position.
void morph_bounds(const struct figure *figure, const struct morph *morph, float lo[3], float hi[3]);

#endif

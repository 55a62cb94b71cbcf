/// Samples → the pose of a soft character: its complex normal coordinates, each turned and scaled by its own drive (the paper's
/// section 7.2, eq. 29 and 30).
///
///     D(j) = Re(Σ_k z_k Ñ_{k,j}),   z_k = A_k (y + e^{−j·lag_k} x)
///
/// The paper writes e^{iφ} for the turn; what lags has φ = −lag. Where the drive's spline has an equilibrium y, the
/// character rests in the shape that y gives it.
#ifndef RIG_MORPH_H
#define RIG_MORPH_H

#include "model/figure.h"
#include "rig/pose.h"
#include "scene/document.h"

/// What moves a figure at one time.
struct morph {
    int count;
    int coordinate[CHARACTER_MAX_DRIVES];  ///< index in the figure
    float weight[CHARACTER_MAX_DRIVES][2]; ///< z: real and imaginary part
};

/// `values[k]` is the spline value of drive k at the time shown. Drives whose coordinate the figure does not have are left
/// out. LOOK_STIFF is the stiff motion that the paper warns of: the real part of x moves the real part of Ñ, all points in
/// step. Allocates nothing.
void pose_character(const struct character_rig *rig, const struct figure *figure, const wiggly_value *values,
                    enum look look, struct morph *morph);

/// Where a vertex and its unit normal are now: what the stage's vertex shader computes. `normal` may be NULL.
void morph_vertex(const struct figure *figure, const struct morph *morph, int vertex, float position[3],
                  float normal[3]);

/// The box around the posed figure, relative to the rig's position.
void morph_bounds(const struct figure *figure, const struct morph *morph, float lo[3], float hi[3]);

#endif

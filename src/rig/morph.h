/// Samples → the pose of a soft character: its complex normal coordinates, each turned and scaled by its own drive (the paper's
/// section 7.2, eq. 29 and 30).
///
///     D(j) = Re(Σ_k z_k Ñ_{k,j}),   z_k = A_k (y + e^{−j·lag_k} x)
///
/// The paper writes e^{iφ} for the turn; what lags has φ = −lag. Where the drive's spline has an equilibrium y, the
/// character rests in the shape that y gives it.
#ifndef RIG_MORPH_H
#define RIG_MORPH_H

#include "model/morph.h"
#include "rig/look.h"
#include "scene/document.h"

/// `values[k]` is the spline value of drive k at the time shown. Drives whose coordinate the figure does not have are left
/// out. LOOK_STIFF is the stiff motion that the paper warns of: the real part of x moves the real part of Ñ, all points in
/// step. Allocates nothing.
void pose_character(const struct character_rig *rig, const struct figure *figure, const wiggly_value *values,
                    enum look look, struct morph *morph);

#endif

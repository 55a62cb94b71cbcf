/// The bones of a chain: which they are, the axes that they turn about, and how splines bend them.
///
/// A bone that a clip turns by q turns by q · exp(side · a_s) · exp(up · a_u) · exp(twist · a_t): each axis a is one of the character's space,
/// taken into the bone's own frame at rest, so that a chain bends in a plane whatever the rolls of its bones.
#ifndef RIG_CHAIN_BONES_H
#define RIG_CHAIN_BONES_H

#include "rig/bones.h"
#include "rig/posing.h"

/// Unit axes in the character's space. `along`: from the first bone to the tip at rest. `side`: world up made perpendicular to it (for a
/// chain that stands or hangs, world z); a positive angle takes the tip towards side × along. `up`: along × side; lifts the tip towards `side`.
struct chain_axes {
    float side[3], up[3], along[3];
};

/// `turn`: degrees by which `side` and `up` are turned about `along`.
struct chain_axes chain_axes_at_rest(const struct imported *imported, const struct chain_bones *bones, double turn);

/// Radians by which joint n of so many bones turns about each axis, and the sign that a mirrored chain gives an axis, which is in them.
void chain_angles(const struct chain *chain, const wiggly_value *values, enum look look, int n, int bones,
                  double angle[3]);
double chain_sign(const struct chain *chain, enum axis axis);

/// An axis of the character's space in a bone's own frame at rest.
void chain_own_axis(const struct imported *imported, int node, const float axis[3], float own[3]);

/// Turns the bones over the clip's pose, by the values of the chain's channels (eq. 27). Leaves world matrices alone. Allocates nothing.
void chain_bend(const struct imported *imported, const struct chain *chain, const struct chain_bones *bones,
                const wiggly_value *values, enum look look, struct gltf_pose *pose);

/// Where the bones begin, and the tip, in the world.
void chain_points(const struct imported *imported, const struct chain_bones *bones, const struct gltf_pose *pose,
                  const float root[16], struct chain_pose *points);

#endif

/// Shared by tails and chains: joints in a row, each the parent of the next, bent by splines.
///
/// A joint that a clip turns by q turns by q · exp(side · a_s) · exp(up · a_u) · exp(twist · a_t): each axis a is one of the character's space,
/// taken into the joint's own frame at rest, so that a chain bends in a plane whatever the rolls of its bones. A tail is straight at
/// rest, along +z; its own rest is angles too.
#ifndef RIG_STRAND_H
#define RIG_STRAND_H

#include "rig/posing.h"

/// Unit axes in the character's space. `along`: from the first bone to the tip at rest. `side`: world up made perpendicular to it (for a
/// chain that stands or hangs, world z); a positive angle takes the tip towards side × along. `up`: along × side; lifts the tip towards `side`.
struct chain_axes {
    float side[3], up[3], along[3];
};

/// The chain's `turn` turns `side` and `up` about `along`. A mirrored chain's `side` is the mirror image of its twin's.
struct chain_axes chain_axes_at_rest(const struct imported *imported, const struct chain *chain,
                                     const struct chain_bones *bones);

/// The ends of the bones at rest, in the character's space: one more than bones.
void chain_points_at_rest(const struct imported *imported, const struct chain_bones *bones, float (*point)[3]);

/// A bent rig, and its bends.
struct strand {
    const struct channel *channels;
    int channel_count, joints;
    const struct angles *rest;       ///< of a tail
    bool mirror;                     ///< of a chain, as what follows
    const struct imported *imported; ///< NULL: a tail
    struct chain_bones bones;
    struct chain_axes axes;
};

/// The strand of a rig, if it bends that body.
bool strand_find(const struct posing *posing, int body, int rig, struct strand *strand);

/// The sign that a mirrored chain gives an axis.
double strand_sign(const struct strand *strand, enum axis axis);

/// The axes of a joint as left by the turns after each, in its own bent frame.
void strand_turned_axes(const struct strand *strand, const wiggly_value *values, int joint, double axis[3][3]);

/// Bends the joints of a model on top of the clip's pose. Does not change world matrices. Allocates nothing.
void strand_bend(const struct strand *strand, const wiggly_value *values, enum look look, struct gltf_pose *pose);

enum { PATH_MAX_NODES = 512 };

/// A node on the way from the root to a strand's tip. Matrices are of columns.
struct path_node {
    int node; ///< of the model
    double offset[3], rotation[4], turn[9],
        scale[3];           ///< relative to the one before; `turn` is the rotation, or the node's own matrix
    double at[3], frame[9]; ///< in the world, before its own scale
    double arm[3];          ///< to the point of path_arms(), in its frame
};

/// The way from the root to a strand's tip, in double precision, because floats are too coarse for solving.
struct path {
    struct path_node nodes[PATH_MAX_NODES];
    int first, count;   ///< the strand's joints are the last ones, from `first` on
    double tip[3];      ///< in the last joint's own space
    double end[3];      ///< the tip in the world
    struct limbs limbs; ///< a tail's
};

/// Poses a tail or chain at a position in samples. False if its model is missing, or has too many nodes above it.
bool path_find(const struct posing *posing, int rig, double position, struct path *path);

/// Finds the arms of all nodes up to one of the strand's joints, to that joint's end.
void path_arms(struct path *path, int joint);

/// Motion of the point of path_arms() per radian of a node's turn about an axis of its own frame.
void path_way(const struct path_node *node, const double axis[3], double way[3]);

/// Metres along the first `count` joints.
double path_length(const struct path *path, int count);

#endif

/// Where the joints of a tail are.
#ifndef MODEL_POSE_H
#define MODEL_POSE_H

enum { POSE_MAX_JOINTS = 256 };

/// How far the parts of the body are moved from how they were made; see limbs.h.
struct limbs {
    float look, nod, ears[2];     ///< radians; of the ears' roots and tips
    float breath, stretch, blink; ///< shares
};

/// A pose: frames of joints+1 points along the tail, in metres; entry n is where joint n sits, the last one is the
/// tip. Column-major 4×4, +z along the tail, y up. Entry n carries the bend of joint n.
struct pose {
    int count;    ///< joints + 1
    float ground; ///< height of what the body stands on, metres
    struct limbs limbs;
    float matrix[POSE_MAX_JOINTS + 1][16];
};

/// Moves a posed tail, metres: for a position that follows splines, and for a drag.
void pose_move(struct pose *pose, const double by[3]);

/// Length of the tail that was posed, in metres.
float pose_length(const struct pose *pose);

/// Size of its animal against the one that is made (fox.h).
float pose_scale(const struct pose *pose);

/// The box around the skin of tail and torso (whose size follows the tail's length), metres.
void pose_bounds(const struct pose *pose, float lo[3], float hi[3]);

#endif

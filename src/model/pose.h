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
    float ground; ///< height of what the body of a tail stands on, metres
    float scale;  ///< of its animal against the one that is made (fox.h)
    struct limbs limbs;
    float matrix[POSE_MAX_JOINTS + 1][16];
};

/// The box around the skin of tail and torso (whose size follows the tail's length), metres.
void pose_bounds(const struct pose *pose, float lo[3], float hi[3]);

#endif

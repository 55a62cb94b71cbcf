/// The stage's animal: a small sitting fox that looks back at its long tail. The asset models/fox.glb is made by tools/models/fox_glb.c; here it gets
/// a tail with as many joints as its rig.
///
/// One size is made; shown at tail length L it is scaled by L / FOX_TAIL_LENGTH. Bind space: metres, y up, the tail straight along +z with its
/// base at the origin; the ground that it sits on is at y = −FOX_BASE_HEIGHT.
#ifndef MODEL_FOX_H
#define MODEL_FOX_H

#include "model/gltf.h"

#define FOX_TAIL_LENGTH 1.6f
#define FOX_TAIL_RADIUS 0.072f  /* at the base */
#define FOX_BRUSH_RADIUS 0.140f /* where it is thickest */
#define FOX_BASE_HEIGHT 0.26f

/// Where the brush begins to swell, where the tail's tip begins, and how much narrower than half an ellipsoid the tip is.
#define FOX_SWELL_START (0.10f * FOX_TAIL_LENGTH)
#define FOX_TIP_START (0.66f * FOX_TAIL_LENGTH)
#define FOX_TIP_POINT 0.35f

/// Box of the body: the animal without its tail, bind space.
extern const float fox_body_lo[3], fox_body_hi[3];

/// Radius of the tail at z metres from its base, bind size; 0 at the tip and beyond.
float fox_tail_radius(float z);

/// The head's own space, which looks towards −z: bind space → it, column-major.
void fox_head_from_bind(float matrix[16]);

/// Levels of detail, each coarser than the last, so that all animals of a stage together stay below 20,000 triangles.
enum { FOX_LEVELS = 4 };

/// The level at which that many animals are drawn.
int fox_level(int animals);

/// Nodes: the root, the body's parts (enum limb), and from FOX_FIRST_JOINT on the tail's joints. The skin's joints do not include the root.
enum { FOX_FIRST_LIMB = 1, FOX_FIRST_JOINT = 8 };

/// A fox with a tail of that many joints. Its only morph target moves nothing: its weight tells the material how far the lids are closed.
void fox_create(int level, int joints, struct gltf *fox);

/// Gives vertices that follow the tail (`fur`) weights for that many joints, and sets `along` to 0.
void fox_hang(struct gltf_part *part, int joints);

// --- the moving parts of its body: chest, head and ears. Each moves with its parent: the ears' tips with their roots, these with the head,
// --- and the head and chest with the body.

/// How far the parts of the body are moved from how they were made; see fox_move().
struct limbs {
    float look, nod, ears[2];     ///< radians; of the ears' roots and tips
    float breath, stretch, blink; ///< shares
};

enum limb { LIMB_BODY, LIMB_CHEST, LIMB_HEAD, LIMB_EAR, LIMB_EAR_TIP = LIMB_EAR + 2, LIMBS = LIMB_EAR_TIP + 2 };

/// How far the chest reaches, and the pivot of the head on a standing fox (y = 0 is the ground); metres, bind size.
#define LIMBS_CHEST_RADIUS 0.18f
extern const float limbs_neck[3];

/// Place of the tail's base when the body of a fox of that scale stretches from its feet; metres.
void limbs_base(double stretch, double scale, double base[3]);

/// Its change per change of the stretch.
void limbs_base_slope(double stretch, double scale, double slope[3]);

/// Where the box around the body comes to, bind size, from its tail's base.
void limbs_bounds(const struct limbs *limbs, float lo[3], float hi[3]);

// --- where it is

enum { POSE_MAX_JOINTS = 256 };

/// A pose: frames of joints+1 points along the tail, in metres; entry n is where joint n sits, the last one is the
/// tip. Column-major 4×4, +z along the tail, y up. Entry n carries the bend of joint n.
struct pose {
    int count;    ///< joints + 1
    float ground; ///< height of the ground under a tail's body, metres
    float scale;  ///< of its animal, relative to the asset
    struct limbs limbs;
    float matrix[POSE_MAX_JOINTS + 1][16];
};

/// The box around the skin of tail and torso (whose size follows the tail's length), metres.
void pose_bounds(const struct pose *pose, float lo[3], float hi[3]);

/// A soft contact shadow on the ground: a dark disc; `strength` 0 … 1.
struct shadow_blob {
    float x, z, radius, strength;
};

/// The shadows of a tail and its animal under a lamp in direction `from`: the body's, then evenly along the tail; invisible ones are skipped.
/// Writes at most `capacity` (20 is enough for a tail) and returns how many. Allocates nothing.
int pose_blobs(const struct pose *pose, const float from[3], struct shadow_blob *blobs, int capacity);

/// Sets the places of the body's parts, and the lids, over those at rest.
void fox_move(const struct limbs *limbs, struct gltf_pose *pose);

#endif

/// The animal of the stage: a small sitting fox that looks back at its long tail. An asset, models/fox.glb, which tools/fox_glb.c makes; here it
/// gets a tail of as many joints as its rig has.
///
/// One size is made; shown at tail length L it is scaled by L / FOX_TAIL_LENGTH. Bind space: metres, y up, the tail straight along +z with its
/// base at the origin; the ground that it sits on is at y = −FOX_BASE_HEIGHT.
#ifndef MODEL_FOX_H
#define MODEL_FOX_H

#include "model/gltf.h"
#include "model/pose.h"

#define FOX_TAIL_LENGTH 1.6f
#define FOX_TAIL_RADIUS 0.072f  /* at the base */
#define FOX_BRUSH_RADIUS 0.140f /* where it is thickest */
#define FOX_BASE_HEIGHT 0.26f

/// Where the brush begins to swell, where the tail's tip begins, and how much narrower that is than half an ellipsoid.
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

/// Nodes: what carries all, the body's parts (limbs.h), and from FOX_FIRST_JOINT on the tail's joints. Of the skin's joints the first is left out.
enum { FOX_FIRST_LIMB = 1, FOX_FIRST_JOINT = 8 };

/// A fox with a tail of so many joints. Its only morph target moves nothing: its weight says how far the lids are closed, which its material
/// draws.
void fox_create(int level, int joints, struct gltf *fox);

/// Sets the places of the body's parts, and the lids, over those at rest.
void fox_move(const struct limbs *limbs, struct gltf_pose *pose);

/// Gives what follows the tail (`fur`) weights of so many joints, and `along`, which is 0.
void fox_hang(struct gltf_part *part, int joints);

#endif

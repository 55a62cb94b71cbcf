/// The animal of the stage: a small sitting fox that looks back at its long tail.
///
/// One size is made; shown at tail length L it is scaled by L / CREATURE_TAIL_LENGTH. Bind space as in mesh.h: the
/// ground that it sits on is at y = −CREATURE_BASE_HEIGHT.
#ifndef MODEL_CREATURE_H
#define MODEL_CREATURE_H

#include "model/mesh.h"

#define CREATURE_TAIL_LENGTH 1.6f
#define CREATURE_TAIL_RADIUS 0.072f  /* at the base */
#define CREATURE_BRUSH_RADIUS 0.140f /* where it is thickest */
#define CREATURE_BASE_HEIGHT 0.26f

/// Box of the torso: the animal without its tail, bind space.
extern const float creature_torso_lo[3], creature_torso_hi[3];

/// Distance from a point to the torso's skin without the face, metres, bind space; negative inside, and never much too
/// large, so that a ray can be marched in steps of it.
float creature_torso_distance(const float p[3]);

/// The head's own space, which looks towards −z: bind space → it, column-major; and a place in it.
void creature_head_from_bind(float matrix[16]);
void creature_into_head(const float bind[3], float place[3]);

/// The box in the head's own space that eyes, nose and mouth are drawn in (stage_mesh.frag).
extern const float creature_face_lo[3], creature_face_hi[3];

/// Radius of the tail at z metres from its base, bind size; 0 at the tip and beyond.
float creature_tail_radius(float z);

/// Levels of detail of the animal, each coarser than the last, so that all animals of a stage together stay below 20,000
/// triangles.
enum { CREATURE_LEVELS = 4 };

/// The level at which that many animals are drawn.
int creature_level(int animals);

/// Appends torso and tail of a level.
void mesh_creature(int level, struct mesh *mesh);

/// Appends the torso, with the stump that the tail hides. Edges are about `cell` metres long,
/// and halved in up to `rounds` rounds where they would miss the round shape by more than `tolerance` metres, or blur colours.
void mesh_torso(float cell, float tolerance, int rounds, struct mesh *mesh);

/// Appends the tail: `rings` rings of `segments` vertices each, from inside the body, where it is open, to a rounded
/// tip.
void mesh_tail(int rings, int segments, struct mesh *mesh);

#endif

/// Makes the skin of the fox (model/fox.h): a smooth union of round cones, and a tube for the tail.
#ifndef MODELS_FOX_MAKER_H
#define MODELS_FOX_MAKER_H

#include "model/fox.h"
#include "models/mesh.h"

/// Appends body and tail at a level of detail.
void mesh_fox(int level, struct mesh *mesh);

/// Appends the body, with the stump that the tail hides. Edges are about `cell` metres long, and halved in up to `rounds` rounds where they
/// deviate from the round shape by more than `tolerance` metres or blur colours.
void mesh_fox_body(float cell, float tolerance, int rounds, struct mesh *mesh);

/// Appends the tail: `rings` rings of `segments` vertices each, from inside the body, where it is open, to a rounded tip.
void mesh_fox_tail(int rings, int segments, struct mesh *mesh);

/// Whether eyes, nose or mouth are drawn on a triangle.
bool fox_is_face(const struct mesh *mesh, const uint32_t corners[3]);

/// The pivot of each part's turn and scale, bind space.
void fox_pivots(float pivot[LIMBS][3]);

#endif

/// The parts of the fox's body that move: chest, head and ears.
///
/// Each part moves with the one that it is
/// attached to: the ears' tips with their roots, these with the head, all with the body.
#ifndef MODEL_LIMBS_H
#define MODEL_LIMBS_H

#include "model/pose.h"

enum limb { LIMB_BODY, LIMB_CHEST, LIMB_HEAD, LIMB_EAR, LIMB_EAR_TIP = LIMB_EAR + 2, LIMBS = LIMB_EAR_TIP + 2 };

/// What the maker of the skin needs too: the middle of the chest and how far it reaches, standing (y = 0 is the ground); and an ear, in the
/// head's own space, with the places along it where it bends.
#define LIMBS_CHEST_RADIUS 0.18f
extern const float limbs_chest[3], limbs_ear_root[3], limbs_ear_tip[3], limbs_ear_joint[2];

/// Where the tail's base comes to as the body stretches from its feet, at a fox of that scale; metres.
void limbs_base(double stretch, double scale, double base[3]);

/// By how much that changes for a change of the stretch.
void limbs_base_slope(double stretch, double scale, double slope[3]);

/// The part that each is attached to, −1 for the body.
extern const int limb_parents[LIMBS];

/// What each part turns and scales about, bind space.
void limbs_pivots(float pivot[LIMBS][3]);

/// How each part moves against what it is attached to: turned (a unit quaternion x y z w), and before that scaled along bind space's axes.
void limbs_motions(const struct limbs *limbs, float turn[LIMBS][4], float size[LIMBS][3]);

/// Where the box around the body comes to, bind size, from its tail's base.
void limbs_bounds(const struct limbs *limbs, float lo[3], float hi[3]);

#endif

/// How the dog's paws and trunk move in a walk or a trot.
#ifndef MODEL_DOG_GAIT_H
#define MODEL_DOG_GAIT_H

enum { DOG_LEGS = 4 }; ///< front left, front right, hind left, hind right, as in dog_limbs

/// A gait, in place. Lengths in metres, angles in degrees, phases in cycles.
struct dog_gait {
    float phase[DOG_LEGS]; ///< at which each paw comes down
    float duty;            ///< share of the cycle that a paw is on the ground
    float stride;          ///< how far it then moves back
    float lift[2];         ///< of front and hind paws
    float bob, sway;       ///< of hips and chest
    float turn, roll;
    float nod;
};

extern const struct dog_gait dog_walk, dog_trot;

/// A paw against where it stands at rest: its ball moves, the foot tilts forward about the ball, the toes tilt down.
struct dog_paw {
    float up, ahead;
    float foot, toes; ///< degrees
};

/// On the ground a paw moves back evenly, flat; its path is smooth.
struct dog_paw dog_gait_paw(const struct dog_gait *gait, int leg, float time);

/// Where one end of the trunk goes with its pair of legs: 0 the chest, 1 the hips. Degrees: `turn` to its left, `roll` left side up.
struct dog_sway {
    float across, up, turn, roll;
};
struct dog_sway dog_gait_sway(const struct dog_gait *gait, int end, float time);

#endif

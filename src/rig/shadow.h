/// Shadows: where a posed tail and its animal keep the lamp from the ground.
#ifndef RIG_SHADOW_H
#define RIG_SHADOW_H

#include "model/fox.h"

/// A soft disc on the ground; strength 0 … 1, more where nearer to it.
struct shadow_blob {
    float x, z, radius, strength;
};

/// The blobs of one pose under a lamp in direction `from`: the torso's, then evenly along the tail; those too weak to be seen are skipped.
/// Writes at most `capacity` (20 shows a tail well) and returns how many. Allocates nothing.
int pose_blobs(const struct pose *pose, const float from[3], struct shadow_blob *blobs, int capacity);

#endif

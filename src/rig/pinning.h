/// Where pinned points of rigs are, and how splines move them: what the scene solves pins from (scene/pin_source.h).
#ifndef RIG_PINNING_H
#define RIG_PINNING_H

#include "rig/posing.h"

/// Where an evaluation's pinned points come from: the document's models, which must stay where they are. `models` may be NULL.
struct pin_source pin_points(struct models *models);

#endif

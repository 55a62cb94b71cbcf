/// What the scene solves pins, floors and motions from (scene/model_source.h).
#ifndef RIG_PINNING_H
#define RIG_PINNING_H

#include "rig/posing.h"

/// Of the document's models, which must stay where they are. `models` may be NULL.
struct model_source models_source(struct models *models);

#endif

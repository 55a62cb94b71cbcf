/// What joints of imported characters do in their clips, as the equilibria of splines follow it.
#ifndef RIG_CLIP_MOTION_H
#define RIG_CLIP_MOTION_H

#include "rig/models.h"
#include "scene/motion.h"

/// Where an evaluation's motions come from (motions_bake()): the document's models, which must stay where they are.
struct motion_source clip_motions(struct models *models);

#endif

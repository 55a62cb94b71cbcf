/// Points of rigs: where tails begin, the ends of joints, the vertices of a surface.
#ifndef EDITOR_STAGE_POINTS_H
#define EDITOR_STAGE_POINTS_H

#include "editor/stage/state.h"

/// Whether the document has it and, of a character, its model.
bool point_exists(const struct editor_world *world, struct rig_point point);
/// Where the document has it at a position in samples, world; false where its model is missing.
bool point_place(const struct core *core, const struct editor_world *world, struct rig_point point, double position,
                 float place[3]);

#endif

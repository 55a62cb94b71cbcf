/// What a moment of the brush does to the paint.
#ifndef EDITOR_STAGE_BRUSH_DAB_H
#define EDITOR_STAGE_BRUSH_DAB_H

#include "editor/stage/state.h"

/// A dab for what work.reach holds: `flow` is the strength times the time. Its arrays are the brush's own.
struct dab brush_dab(struct painting *painting, const struct paint *paint, const struct figure *figure,
                     int coordinate, float radius, double flow);

#endif

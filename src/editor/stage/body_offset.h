/// How far a held body has been moved.
#ifndef EDITOR_STAGE_BODY_OFFSET_H
#define EDITOR_STAGE_BODY_OFFSET_H

#include "editor/stage/state.h"

/// How far the running drag has moved a tail's base from where the document has it, metres; 0 for all others.
void body_offset(const struct stage *stage, const struct core *core, int tail, double offset[3]);

#endif

/// One click against a warning.
#ifndef EDITOR_CURVES_REMEDY_H
#define EDITOR_CURVES_REMEDY_H

#include "editor/curves/state.h"

/// Does away with a warning, as one undo step; of several remedies the first that helps when it is tried.
void warning_remedy(const struct curves *curves, struct core *core, const struct editor_world *world,
                    const struct warning *warning);

#endif

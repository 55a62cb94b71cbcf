/// What is written over characters.
#ifndef EDITOR_STAGE_CHARACTERS_SHOW_H
#define EDITOR_STAGE_CHARACTERS_SHOW_H

#include "editor/stage/state.h"

/// Where the legend is, when it is shown.
struct rect characters_legend(const struct core *core);
/// Legend of the phase map, and what the two of a pair are.
void characters_show(const struct stage *stage, struct core *core, const struct editor_world *world);

#endif

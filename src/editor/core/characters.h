/// The selected soft character and its brush.
#ifndef EDITOR_CORE_CHARACTERS_H
#define EDITOR_CORE_CHARACTERS_H

#include "editor/core/state.h"
#include "rig/models.h"

const struct character_rig *characters_selected(const struct core *core);
const struct coordinate *characters_coordinate(const struct core *core);
/// Call for a new document.
void characters_open(struct core *core);
/// The selected character's figure, or NULL, and its coordinate.
const struct figure *characters_figure(const struct core *core, int *coordinate);
/// Turns the brush on or off. It stays off unless a character with a coordinate is selected.
void characters_set_brush(struct core *core, bool on);
/// Index of the selected character's rig.
int characters_rig(const struct core *core);
/// Gives the selected character blank paint of the figure's size. Edits.
bool characters_blank_paint(struct core *core, const struct figure *figure);
/// Removes the selected character's paint in one undo step.
void characters_clean_paint(struct core *core, int unused);

#endif

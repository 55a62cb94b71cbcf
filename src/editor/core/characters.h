/// The character that is worked on, and the brush that paints on it.
#ifndef EDITOR_CORE_CHARACTERS_H
#define EDITOR_CORE_CHARACTERS_H

#include "editor/core/state.h"
#include "rig/models.h"

/// The rig that is selected, or NULL; and its coordinate.
const struct character_rig *characters_selected(const struct core *core);
/// The coordinate that is selected of it, or NULL.
const struct coordinate *characters_coordinate(const struct core *core);
/// A new document: sets what its first character shows.
void characters_open(struct core *core);
/// The figure that is painted on, or NULL; and its coordinate.
const struct figure *characters_figure(const struct core *core, int *coordinate);
/// Takes the brush up or puts it away. It cannot be taken up where no character with a coordinate is selected.
void characters_set_brush(struct core *core, bool on);
/// The rig of the selected character.
int characters_rig(const struct core *core);
/// An edit: gives the selected character blank paint of the figure's shape.
bool characters_blank_paint(struct core *core, const struct figure *figure);
/// Takes all paint off the selected character, as a step of the history.
void characters_clean_paint(struct core *core, int unused);

#endif

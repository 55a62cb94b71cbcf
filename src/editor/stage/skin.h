/// The surface of a character as the stage shows it, and what of it lies under a point.
#ifndef EDITOR_STAGE_SKIN_H
#define EDITOR_STAGE_SKIN_H

#include "editor/stage/state.h"

/// Frees its memory.
void skin_free(struct skin *skin);
/// Memory for the surface of any character that is shown; allocates only where a larger one has come onto the stage.
void skin_reserve(struct stage *stage);
/// Poses the surface of a character (its number among those of the document, its stiff twin left out), unless it is posed so
/// already. false where it is not shown.
bool skin_pose(struct stage *stage, int character);
/// What of the posed surface, which is the figure's, is under a point of the stage; false where that is nothing.
bool skin_spot(const struct stage *stage, const struct figure *figure, float x, float y, struct surface_spot *spot);

#endif

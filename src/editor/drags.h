/// What the files of the editor itself share: running drags, whichever panel began them; leaving; memory.
#ifndef EDITOR_DRAGS_H
#define EDITOR_DRAGS_H

#include "editor/state.h"

/// Events of a running drag; true where the event is used up.
bool drags_event(struct editor *editor, const struct editor_world *world, const struct event *event);
/// Ends it; `keep` false takes everything back.
void drags_end(struct editor *editor, const struct editor_world *world, bool keep);
/// Does what leaves the document, but asks first where work would be lost.
void editor_leave(struct editor *editor, const struct editor_world *world, const struct request *request);
/// Memory for the document's knots in selection and drags; allocates only where knots were added.
void editor_reserve(struct editor *editor, const struct document *document);

#endif

/// Questions before an edit.
#ifndef EDITOR_DIALOGS_DIALOG_ASK_H
#define EDITOR_DIALOGS_DIALOG_ASK_H

#include "editor/dialogs/state.h"

/// DIALOG_ASK: does what was asked about as the answer says.
void dialog_ask_answer(struct dialogs *dialogs, struct core *core, const struct editor_world *world, int answer);

#endif

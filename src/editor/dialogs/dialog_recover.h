/// What to do with unsaved work that was left behind.
#ifndef EDITOR_DIALOGS_DIALOG_RECOVER_H
#define EDITOR_DIALOGS_DIALOG_RECOVER_H

#include "editor/dialogs/state.h"

enum recover_answer { RECOVER_RECOVER, RECOVER_DISCARD, RECOVER_LATER };

/// What DIALOG_RECOVER asks.
void dialog_recover_question(const struct dialogs *dialogs, struct question *question);
/// What an answer (enum recover_answer) to it does.
void dialog_recover_answer(struct dialogs *dialogs, struct core *core, int answer);

#endif

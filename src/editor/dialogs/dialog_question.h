/// A dialog that asks a question with a few answers, by button, letter or arrows. Private to dialog*.c.
#ifndef EDITOR_DIALOGS_DIALOG_QUESTION_H
#define EDITOR_DIALOGS_DIALOG_QUESTION_H

#include "editor/dialogs/state.h"

enum { QUESTION_UNUSED = -2, QUESTION_OPEN = -1 };

/// Lays the question out; returns the answer that was pressed, or QUESTION_OPEN.
int question_build(struct dialog *dialog, const struct question *question);

/// What a key does: an answer, QUESTION_OPEN where it moved the choice, or QUESTION_UNUSED.
int question_key(struct dialog *dialog, const struct question *question, int key);

#endif

/// A dialog that asks a question with a few answers, by button, letter or arrows. Private to dialog*.c.
#ifndef EDITOR_DIALOG_QUESTION_H
#define EDITOR_DIALOG_QUESTION_H

#include "editor/panels.h"

struct answer {
    const char *name;  ///< of its button
    const char *label; ///< on it
    int key;           ///< letter that answers as well
};

/// The last answer is the one that changes nothing; Esc gives it. The dialog's `choice` is the one Enter gives.
struct question {
    char title[320];
    char note[256]; ///< below it, unless the dialog has an error to show
    const struct answer *answers;
    int count;
};

enum { QUESTION_UNUSED = -2, QUESTION_OPEN = -1 };

/// Lays the question out; returns the answer that was pressed, or QUESTION_OPEN.
int question_build(struct dialog *dialog, const struct question *question);

/// What a key does: an answer, QUESTION_OPEN where it moved the choice, or QUESTION_UNUSED.
int question_key(struct dialog *dialog, const struct question *question, int key);

#endif

/// The dialog on the screen: a path to type, or a question.
#ifndef EDITOR_DIALOGS_DIALOG_H
#define EDITOR_DIALOGS_DIALOG_H

#include "editor/dialogs/state.h"

/// Shows a dialog that has no text.
void dialog_open(struct dialogs *dialogs, enum dialog_kind kind);
/// Closes whichever is shown.
void dialog_close(struct dialogs *dialogs);
/// Asks which file to open.
void dialog_ask_open(struct dialogs *dialogs);
/// Asks something of the app; the dialog takes nothing until dialogs_answer().
void dialog_await(struct dialogs *dialogs, struct core *core, enum request_kind kind, const char *path);

/// The Export dialog's keys: true where it has used one. They also come while the app is at work, as all its events do.
bool export_key(struct dialogs *dialogs, struct core *core, int key);
/// Lays it out.
void export_build(struct dialogs *dialogs, struct core *core);

enum { QUESTION_UNUSED = -2, QUESTION_OPEN = -1 };

/// Lays the dialog's question out; returns the answer that was pressed, or QUESTION_OPEN.
int question_build(struct dialog *dialog);
/// What a key does: an answer, QUESTION_OPEN where it moved the choice, or QUESTION_UNUSED.
int question_key(struct dialog *dialog, int key);

/// DIALOG_ASK: does what was asked about as the answer says.
void dialog_ask_answer(struct dialogs *dialogs, struct core *core, int answer);

enum unsaved_answer { UNSAVED_SAVE, UNSAVED_DISCARD, UNSAVED_CANCEL };

/// DIALOG_UNSAVED: asks what to do with unsaved changes.
void dialog_ask_unsaved(struct dialogs *dialogs, const struct core *core);
/// DIALOG_CHANGED: what an answer does.
void dialog_changed_answer(struct dialogs *dialogs, struct core *core, int answer);
/// DIALOG_RECOVER: what an answer does.
void dialog_recover_answer(struct dialogs *dialogs, struct core *core, int answer);

#endif

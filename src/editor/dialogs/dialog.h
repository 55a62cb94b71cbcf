/// What the dialogs' two halves share: the path being typed, with the names that complete it. Private to dialog*.c.
#ifndef EDITOR_DIALOGS_DIALOG_H
#define EDITOR_DIALOGS_DIALOG_H

#include "editor/dialogs/dialog_question.h"

/// Lists the folder of the path where it is a new one, and picks the names that fit what is typed after it.
void dialog_match(struct dialog *dialog);
/// Tab: adds what all matches have in common.
void dialog_complete(struct dialog *dialog);
/// Puts the chosen match into the path; true where it is a file (a folder is listed instead, of one that is gone it is said).
bool dialog_take(struct dialog *dialog, int match);
/// The recent file that a match is, or NULL.
const struct dialog_recent *dialog_recent_of(const struct dialog *dialog, int match);
/// Lays out one match of the list; true where it was pressed.
bool dialog_row(struct dialog *dialog, struct rect r, int match);
/// Whether the path is one of the names listed.
bool dialog_exists(const struct dialog *dialog);

/// Shows a dialog that has no text, and closes whichever is shown.
void dialog_open(struct editor *editor, enum dialog_kind kind);
void dialog_close(struct editor *editor);
/// Asks something of the app; the dialog takes nothing until dialog_answer().
void dialog_await(struct editor *editor, enum request_kind kind, const char *path);

/// DIALOG_RECOVER: its question, and what an answer (enum recover_answer) does.
enum recover_answer { RECOVER_RECOVER, RECOVER_DISCARD, RECOVER_LATER };
void dialog_recover_question(const struct editor *editor, struct question *question);
void dialog_recover_answer(struct editor *editor, int answer);

/// DIALOG_ASK: does what was asked about as the answer says.
void dialog_ask_answer(struct editor *editor, const struct editor_world *world, int answer);

#endif

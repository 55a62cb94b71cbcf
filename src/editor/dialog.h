/// What the dialogs' two halves share: the path being typed, with the names that complete it. Private to dialog*.c.
#ifndef EDITOR_DIALOG_H
#define EDITOR_DIALOG_H

#include "editor/panels.h"

/// Lists the folder of the path where it is a new one, and picks the names that fit what is typed after it.
void dialog_match(struct dialog *dialog);
/// Tab: adds what all matches have in common.
void dialog_complete(struct dialog *dialog);
/// Puts the chosen match into the path; true where it is a file (a folder is listed instead).
bool dialog_take(struct dialog *dialog, int match);
/// Whether the path is one of the names listed.
bool dialog_exists(const struct dialog *dialog);

#endif

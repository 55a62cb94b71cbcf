/// The path being typed, with the names that complete it.
#ifndef EDITOR_DIALOGS_DIALOG_PATH_H
#define EDITOR_DIALOGS_DIALOG_PATH_H

#include "editor/dialogs/state.h"

/// Lists the folder of the path where it is a new one, and picks the names that fit what is typed after it.
void dialog_match(struct dialog *dialog);
/// Tab: adds what all matches have in common.
void dialog_complete(struct dialog *dialog);
/// The recent file that a match is, or NULL.
const struct dialog_recent *dialog_recent_of(const struct dialog *dialog, int match);
/// Puts the chosen match into the path; true where it is a file (a folder is listed instead, of one that is gone it is said).
bool dialog_take(struct dialog *dialog, int match);
/// Whether the path is one of the names listed.
bool dialog_exists(const struct dialog *dialog);
/// Lays out one match of the list; true where it was pressed.
bool dialog_row(struct dialog *dialog, struct rect r, int match);

#endif

/// Recent files: absolute paths in the settings, newest first.
#ifndef APP_RECENT_H
#define APP_RECENT_H

#include "app/settings.h"
#include "editor/dialogs/dialog_files.h"

/// Puts a file at the top of the list, by its absolute path; at most DIALOG_MAX_RECENT are kept.
void recent_note(struct settings *settings, const char *path);

/// Writes the list, newest first; returns how many. Files that are not there any more are marked.
int recent_list(const struct settings *settings, struct dialog_recent *files, int most);

#endif

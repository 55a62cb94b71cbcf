/// Recent files: absolute paths in the settings, newest first.
#ifndef APP_RECENT_H
#define APP_RECENT_H

#include "app/settings.h"
#include "editor/dialogs/dialog_files.h"

/// Moves a file's absolute path to the top of the list, which keeps at most DIALOG_MAX_RECENT.
void recent_note(struct settings *settings, const char *path);

/// Writes the list, newest first; returns how many. Missing files are marked.
int recent_list(const struct settings *settings, struct dialog_recent *files, int most);

#endif
